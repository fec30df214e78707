#include "studies/compliance/finite_elements.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>

#include "core/base/stopwatch.hpp"
#include "core/compliance/fitted/refinement_fit.hpp"
#include "core/compliance/fitted/refinement_library.hpp"
#include "core/compliance/pair/pair_compliance.hpp"
#include "studies/compliance/stored_table.hpp"

namespace flankwright::studies {

namespace {

/// Share of the machine's memory that runs may take.
constexpr double share_of_memory = 0.8;


/// Does something with one gear; what it refuses is said under the study's keys.
template <typename Work>
auto with_study_keys(ComplianceModel model, Member member, Work&& work) {
  try {
    return work();
  } catch (const InvalidInput& problem) {
    if (problem.field().starts_with("options")) {
      throw InvalidInput("fidelity.compliance", to_string(model),
                         fmt::format("another compliance: the {} cannot be meshed ({})", name_of(member), problem.value()));
    }
    const bool of_pair = problem.field() == "helix_angle" || problem.field() == "pressure_angle";
    const char* of_gear = problem.field() == "poissons_ratio" ? "material." : "";
    const std::string key = of_pair ? "pair." + problem.field() : fmt::format("{}.{}{}", name_of(member), of_gear, problem.field());
    throw InvalidInput(key, problem.value(), problem.allowed());
  }
}

double machine_memory() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

enum class Purpose {
  Gear,       ///< its influence values
  Fine,       ///< what its own fit shall meet
  RigidBody,  ///< the same, nothing giving way below its teeth
  FitCoarse,  ///< what that is fitted beside, where the gear's own run is of a wider face
};

/// What a run is for.
struct Use {
  Member member;
  Purpose purpose;
};

GearRun& place_of(FiniteElementRuns& runs, const Use& use) {
  const std::size_t i = use.member == Member::Pinion ? 0 : 1;
  switch (use.purpose) {
    case Purpose::Gear: return runs.gears[i];
    case Purpose::RigidBody: return runs.rigid_body[i].emplace();
    case Purpose::Fine: return runs.fine[i].emplace();
    case Purpose::FitCoarse: return runs.narrow[i].emplace();
  }
  __builtin_unreachable();
}

/// One mesh of one or both gears of a study, alike but for their size.
struct Job {
  std::vector<Use> uses;
  InfluenceTableTask task;
  Json key;
  InfluenceTableRun run{};
  bool from_cache{false};
  std::string file{};
  double seconds{0.0};

  Member member() const { return uses.front().member; }
};

std::vector<Job> jobs_of(const Study& study, const GearPair& pair) {
  std::vector<Job> jobs;
  const auto add = [&](Use use, InfluenceTableTask task) {
    const Json key = cache_key(task);
    const auto same = std::ranges::find(jobs, key, &Job::key);
    if (same != jobs.end()) {
      same->uses.push_back(use);
    } else {
      jobs.push_back({.uses = {use}, .task = std::move(task), .key = key});
    }
  };
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    InfluenceTableTask task = influence_table_task(study, pair, member);
    if (!unknown_to_library(study, task).empty()) {
      InfluenceTableTask fit = task_of_fit(task), fine = fit;
      fine.mesh = {};
      const bool narrower = fit.grid.face_width() < task.grid.face_width();
      if (narrower) add({member, Purpose::FitCoarse}, std::move(fit));
      if (!narrower) task.root_stress = false;  // the finest mesh of the whole face tells it
      add({member, Purpose::Fine}, std::move(fine));
    }
    if (wants_rigid_bodies(study)) {
      InfluenceTableTask rigid = task;
      rigid.gear.body.rigid = true;
      rigid.removed = RemovedMotion::None;
      rigid.root_stress = false;
      add({member, Purpose::RigidBody}, std::move(rigid));
    }
    add({member, Purpose::Gear}, std::move(task));
  }
  return jobs;
}

/// True where the job's run could be taken from the cache; one that tells more than is wanted will do.
bool take(Job& job, const RunCache& cache, std::vector<std::string>& notes) {
  const Stopwatch clock;
  std::vector<Json> keys{job.key};
  if (!job.task.root_stress) {
    InfluenceTableTask with_root_stress = job.task;
    with_root_stress.root_stress = true;
    keys.push_back(cache_key(with_root_stress));
  }
  for (const Json& key : keys) {
    const auto stored = cache.find(key, notes);
    if (!stored) continue;
    job.file = cache.file_of(key).string();
    try {
      job.run = from_store(job.task, *stored);
    } catch (const std::exception& problem) {
      notes.push_back("the stored finite-element run " + job.file + " is not used: " + problem.what());
      continue;
    }
    job.from_cache = true;
    job.seconds = clock.seconds();
    return true;
  }
  return false;
}

/// Progress of several jobs as one.
class JointProgress {
 public:
  JointProgress(const std::vector<Job*>& jobs, const ProgressReport& report) : report_(report), steps_(jobs.size()) {
    const bool one_gear = std::ranges::all_of(jobs, [&](const Job* job) {
      return std::ranges::all_of(job->uses, [&](const Use& use) { return use.member == jobs.front()->member(); });
    });
    label_ = one_gear ? fmt::format("solving the {}'s finite elements", name_of(jobs.front()->member()))
                      : "solving both gears' finite elements";
  }
  void at(std::size_t job, int done, int total) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    steps_[job] = {done, total};
    // A job that has not begun counts like the longest that has: the bar shall not be full before the last one.
    const int longest = std::ranges::max(steps_, {}, &std::pair<int, int>::second).second;
    int all_done = 0, all = 0;
    for (const auto& [d, t] : steps_) {
      all_done += d;
      all += t > 0 ? t : longest;
    }
    report_(label_, all_done, all, done == 0 ? "mesh and factor" : "loads");
  }

 private:
  const ProgressReport& report_;
  std::string label_;
  std::vector<std::pair<int, int>> steps_;
  std::mutex mutex_;
};

/// Solves jobs side by side, each within its share of the memory.
void solve_side_by_side(const std::vector<Job*>& jobs, ComplianceModel model, const ProgressReport& report) {
  JointProgress progress(jobs, report);
  const auto abreast = std::min<std::size_t>(jobs.size(), static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  const double limit = share_of_memory * machine_memory() / static_cast<double>(abreast);
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    const Stopwatch clock;
    Job& job = *jobs[i];
    job.run = with_study_keys(model, job.member(), [&] {
      return solve_influence_table(job.task, limit, [&](int done, int total) { progress.at(i, done, total); });
    });
    job.seconds = clock.seconds();
  });
}

void refuse_unsolved(const Job& job, ComplianceModel model) {
  if (job.run.status == FactorStatus::Factorised) return;
  const bool memory = job.run.status == FactorStatus::OutOfMemory;
  const auto unknowns = job.run.statistics.unknowns;
  const std::string why =
      memory ? fmt::format("{} unknowns need about {:.1f} GB, this machine has {:.1f}", unknowns,
                           expected_bytes(unknowns) / 1e9, machine_memory() / 1e9)
             : "its stiffness matrix is singular to round-off";
  throw InvalidInput("fidelity.compliance", to_string(model),
                     fmt::format("another compliance: the {}'s finite elements cannot be solved: {}",
                                 name_of(job.member()), why));
}

}  // namespace

bool asks_for_root_stress(const Study& study) {
  if (study.task != Task::Optimise) return false;
  const auto is_root_stress = [](const ObjectiveTerm& term) { return term.output == Output::PeakRootStress; };
  const auto in_goal = [&](const Goal& goal) { return std::ranges::any_of(goal.terms, is_root_stress); };
  const OptimiseTable& optimise = study.optimise;
  return std::ranges::any_of(optimise.objective, is_root_stress) || std::ranges::any_of(optimise.constraints, is_root_stress, &OutputConstraint::output) ||
         std::ranges::any_of(optimise.then, in_goal) || std::ranges::any_of(optimise.pareto_goals, in_goal);
}

bool wants_root_stress(const Study& study) {
  const Fidelity& fidelity = study.fidelity;
  if (fidelity.compliance == ComplianceModel::Rigid) return false;
  if (!fidelity.automatic_effects) return std::ranges::find(fidelity.effects, "root_stress") != fidelity.effects.end();
  return couples_teeth(fidelity.compliance) || asks_for_root_stress(study) ||
         std::ranges::any_of(study.expect, [](const Expectation& e) { return e.key.find("root_stress") != std::string::npos; });
}

bool wants_rigid_bodies(const Study& study) {
  const Fidelity& fidelity = study.fidelity;
  if (study.task == Task::Fit || !couples_teeth(fidelity.compliance)) return false;
  const bool left_out =
      !fidelity.automatic_effects && std::ranges::find(fidelity.effects, "gear_body_compliance") == fidelity.effects.end();
  return left_out || study.task == Task::Accuracy || fidelity.effect_sizes == EffectSizing::Exact;
}

bool solves_finite_elements(const Study& study) {
  return study.task == Task::Fit || (has_torque(study) && (couples_teeth(study.fidelity.compliance) || wants_root_stress(study)));
}

InfluenceTableTask influence_table_task(const Study& study, const GearPair& pair, Member member) {
  const bool pinion = member == Member::Pinion;
  const Gear& gear = pair[member];
  GearToMesh to_mesh;
  to_mesh.gear = gear.data;
  to_mesh.gear.tip_diameter = 2 * gear.tip_radius;
  to_mesh.normal_module = pair.data.normal_module;
  to_mesh.pressure_angle = pair.data.pressure_angle;
  to_mesh.helix_angle = pair.data.helix_angle;
  InfluenceTableTask task{.gear = to_mesh,
                          .poissons_ratio = (pinion ? study.pinion_material : study.wheel_material).poissons_ratio,
                          .teeth_apart = std::max(2, teeth_apart_in_contact(pair)),
                          .grid = flank_grid(gear.data.face_width / pair.data.normal_module),
                          .root_stress = wants_root_stress(study)};
  if (2 * task.teeth_apart + 1 > gear.data.teeth) {
    throw InvalidInput("fidelity.compliance", to_string(study.fidelity.compliance),
                       fmt::format("another compliance: teeth {} pitches apart touch at once, too many for the {}'s {}",
                                   task.teeth_apart, name_of(member), gear.data.teeth));
  }
  const bool by_fits = study.fidelity.compliance == ComplianceModel::Fitted && study.task != Task::Fit;
  if (by_fits) task.mesh = coarse_mesh();
  with_study_keys(study.fidelity.compliance, member, [&] {
    const ToothForm form(to_mesh.gear, to_mesh.normal_module, to_mesh.pressure_angle, to_mesh.helix_angle);
    task.gear.body = complete_body(pinion ? study.pinion_body : study.wheel_body, form, to_mesh.normal_module);
    // The gear's wind-up starts where the torque leaves it, and the shaft's own bearings hold it axially.
    const std::optional<ShaftData>& shaft = pinion ? study.pinion_shaft : study.wheel_shaft;
    if (study.task != Task::Fit && shaft) {
      task.removed = RemovedMotion::WholeTranslationTorsionAndTilt;
      task.gear.body.torque_end = shaft->torque_side() == sharp_end(pair, member) ? FaceEnd::Sharp : FaceEnd::Blunt;
    }
    GearMeshOptions options = task.mesh;
    options.teeth_each_side = task.teeth_apart;
    section_radii(form, to_mesh.gear.teeth, to_mesh.normal_module, task.gear.body, options);  // only for what it refuses
  });
  return task;
}

std::string unknown_to_library(const Study& study, const InfluenceTableTask& task) {
  if (study.fidelity.compliance != ComplianceModel::Fitted || study.task == Task::Fit) return "";
  return RefinementLibrary::shipped().unknown(task.gear, task.poissons_ratio);
}

std::vector<std::string> library_notes(const Study& study, const GearPair& pair) {
  std::vector<std::string> notes;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const InfluenceTableTask task = influence_table_task(study, pair, member);
    const std::string unknown = unknown_to_library(study, task);
    if (unknown.empty()) continue;
    const bool narrower = task_of_fit(task).grid.face_width() < task.grid.face_width();
    notes.push_back(fmt::format("the {} is outside the library of fits ({}): its first run takes {} finite-element models instead of one, and a fit of its own",
                                name_of(member), unknown, narrower ? "three" : "two"));
  }
  return notes;
}

InfluenceTableTask task_of_fit(InfluenceTableTask coarse) {
  if (coarse.grid.face_width() <= widest_own_fit) return coarse;
  coarse.gear.gear.face_width = widest_own_fit * coarse.gear.normal_module;
  coarse.grid = flank_grid(widest_own_fit);
  coarse.root_stress = false;
  return coarse;
}

FiniteElementRuns solve_finite_elements(const Study& study, const GearPair& pair, const ProgressReport& progress) {
  const Stopwatch clock;
  FiniteElementRuns runs;
  const RunCache cache(RunCache::default_folder());
  std::vector<Job> jobs = jobs_of(study, pair);
  std::vector<Job*> missing;
  for (Job& job : jobs) {
    if (!take(job, cache, runs.notes)) missing.push_back(&job);
  }
  for (const std::string& note : library_notes(study, pair)) {
    runs.notes.push_back(note);
    if (!missing.empty()) spdlog::info("{}", note);  // before the wait that it explains
  }
  if (!missing.empty()) solve_side_by_side(missing, study.fidelity.compliance, progress);
  for (Job* job : missing) {
    // What did not fit beside the other gear may fit alone.
    if (job->run.status == FactorStatus::OutOfMemory && missing.size() > 1) solve_side_by_side({job}, study.fidelity.compliance, progress);
    refuse_unsolved(*job, study.fidelity.compliance);
    const bool kept = cache.store(job->key, to_store(job->run), runs.notes);
    job->file = kept ? cache.file_of(job->key).string() : "";
  }
  for (Job& job : jobs) {
    const auto table = std::make_shared<const InfluenceTable>(std::move(*job.run.table));
    std::shared_ptr<const RootStressTable> root_stress;
    if (job.run.root_stress) root_stress = std::make_shared<const RootStressTable>(std::move(*job.run.root_stress));
    for (const Use& use : job.uses) {
      place_of(runs, use) = {table, root_stress, job.run.statistics, influence_table_task(study, pair, use.member).gear.body,
                             job.task.removed, job.from_cache, job.file, job.seconds};
    }
  }
  runs.seconds = clock.seconds();
  return runs;
}

}  // namespace flankwright::studies
