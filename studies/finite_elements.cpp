#include "studies/finite_elements.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>

#include "core/base/stopwatch.hpp"
#include "core/compliance/fitted/refinement_fit.hpp"
#include "core/compliance/pair_compliance.hpp"
#include "studies/run_cache.hpp"

namespace flankwright::studies {

namespace {

/// To be raised whenever the same task comes to mean other numbers: mesh, load functional, removed motion, solution.
constexpr int model_version = 3;

/// Share of the machine's memory that runs may take.
constexpr double share_of_memory = 0.8;

const char* name_of(Member m) { return m == Member::Pinion ? "pinion" : "wheel"; }

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

// clang-format off
/// A field that is added to these structs must be added to the key: the bindings then no longer compile.
Json mesh_key(const GearMeshOptions& options) {
  const auto& [flank, fillet, half_thickness, adjacent_flank, adjacent_fillet, teeth_each_side, end, axial_growth, largest,
               most_layers, body_growth, shaft] = options;
  static_cast<void>(teeth_each_side);  // teeth_apart says it
  return {flank, fillet, half_thickness, adjacent_flank, adjacent_fillet, end, axial_growth, largest, most_layers,
          body_growth, shaft};
}
// clang-format on

Json gear_key(const GearToMesh& gear) {
  const auto& [data, module, pressure_angle, helix_angle, body] = gear;
  const auto& [teeth, face_width, profile_shift, tip_diameter, rack, generation] = data;
  const auto& [addendum, dedendum, root_radius] = rack;
  const auto& [shaft_diameter, bore_diameter, shaft_overhang, torque_end] = body;
  static_cast<void>(module);      // 1
  static_cast<void>(generation);  // amounts of micrometres, which the mesh does not know
  return {{"teeth", teeth},
          {"face_width", face_width},
          {"profile_shift", profile_shift},
          {"tip_diameter", tip_diameter},
          {"rack", {addendum, dedendum, root_radius}},
          {"pressure_angle", pressure_angle},
          {"helix_angle", helix_angle},
          {"body", {shaft_diameter, bore_diameter, shaft_overhang, torque_end == FaceEnd::Blunt ? "blunt" : "sharp"}}};
}

/// Everything that defines the outcome of a task, in modules, as the key of its stored run.
Json cache_key(const InfluenceTableTask& task) {
  return {{"model", model_version},
          {"gear", gear_key(in_modules(task).gear)},
          {"poissons_ratio", task.poissons_ratio},
          {"teeth_apart", task.teeth_apart},
          {"mesh", mesh_key(task.mesh)},
          {"removed_motion", static_cast<int>(task.removed)},
          {"root_stress", task.root_stress},
          {"us", task.grid.us()},
          {"zetas", task.grid.zetas()}};
}

std::string table_name(int teeth_apart) { return fmt::format("influence {} apart", teeth_apart); }
std::string root_stress_name(int tooth) { return fmt::format("root stress by tooth {}", tooth); }

StoredRun to_store(const InfluenceTableRun& run) {
  const InfluenceTable& table = *run.table;
  StoredRun stored;
  stored.facts = {{"bricks", run.statistics.bricks},
                  {"unknowns", run.statistics.unknowns},
                  {"factor_entries", run.statistics.factor_entries},
                  {"peak_bytes", run.statistics.peak_bytes},
                  {"model_seconds", run.statistics.model_seconds},
                  {"solve_seconds", run.statistics.solve_seconds},
                  {"lowest_eigenvalue", table.projection().lowest_eigenvalue},
                  {"added", table.projection().added}};
  for (int m = 0; m <= table.teeth_apart(); ++m) {
    stored.matrices.emplace_back(table_name(m), table.tables()[static_cast<std::size_t>(m)]);
  }
  if (run.root_stress) {
    const RootStressTable& root = *run.root_stress;
    stored.facts["fillet_along"] = root.fillet.along;
    stored.facts["fillet_tangent"] = root.fillet.tangent;
    stored.facts["fillet_zetas"] = root.fillet.zetas;
    for (int m = -root.teeth_each_side(); m <= root.teeth_each_side(); ++m) {
      stored.matrices.emplace_back(root_stress_name(m), root.stress[static_cast<std::size_t>(m + root.teeth_each_side())]);
    }
  }
  return stored;
}

const Eigen::MatrixXd& stored_matrix(const StoredRun& stored, const std::string& name) {
  const Eigen::MatrixXd* matrix = stored.find(name);
  if (matrix == nullptr) throw InvalidInput("run", name, "there");
  return *matrix;
}

RootStressTable root_stress_from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  const Json& facts = stored.facts;
  RootStressTable root{task.grid, {facts.at("fillet_along"), facts.at("fillet_tangent"), facts.at("fillet_zetas")}, {}};
  for (int m = -task.teeth_apart; m <= task.teeth_apart; ++m) {
    root.stress.push_back(stored_matrix(stored, root_stress_name(m)));
    const Eigen::MatrixXd& stress = root.stress.back();
    if (stress.rows() != 3 * root.fillet.size() || stress.cols() != task.grid.size() ||
        root.fillet.tangent >= root.fillet.along.size()) {
      throw InvalidInput("run", root_stress_name(m), "as large as its grids");
    }
  }
  return root;
}

/// A run as to_store() writes it.
/// @throws Json::exception, InvalidInput where something is missing
InfluenceTableRun from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  InfluenceTableRun run{FactorStatus::Factorised, std::nullopt, std::nullopt, {}};
  const Json& facts = stored.facts;
  run.statistics = {facts.at("bricks"),     facts.at("unknowns"),      facts.at("factor_entries"),
                    facts.at("peak_bytes"), facts.at("model_seconds"), facts.at("solve_seconds")};
  std::vector<Eigen::MatrixXd> tables;
  for (int m = 0; m <= task.teeth_apart; ++m) tables.push_back(stored_matrix(stored, table_name(m)));
  run.table.emplace(task.grid, std::move(tables), TableProjection{facts.at("lowest_eigenvalue"), facts.at("added")});
  if (task.root_stress) run.root_stress = root_stress_from_store(task, stored);
  return run;
}

/// One or both gears of a study, alike but for their size.
struct Job {
  std::vector<Member> members;
  InfluenceTableTask task;
  Json key;
  InfluenceTableRun run{};
  bool from_cache{false};
  std::string file{};
  double seconds{0.0};
};

std::vector<Job> jobs_of(const Study& study, const GearPair& pair) {
  std::vector<Job> jobs;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    InfluenceTableTask task = influence_table_task(study, pair, member);
    const Json key = cache_key(task);
    if (!jobs.empty() && jobs.front().key == key) {
      jobs.front().members.push_back(member);
    } else {
      jobs.push_back({.members = {member}, .task = std::move(task), .key = key});
    }
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
    const bool one_gear = jobs.size() == 1 && jobs.front()->members.size() == 1;
    label_ = one_gear ? fmt::format("solving the {}'s finite elements", name_of(jobs.front()->members.front()))
                      : "solving both gears' finite elements";
  }
  void at(std::size_t job, int done, int total) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    steps_[job] = {done, total};
    int all_done = 0, all = 0;
    for (const auto& [d, t] : steps_) {
      all_done += d;
      all += t;
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
  const double limit = share_of_memory * machine_memory() / static_cast<double>(jobs.size());
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    const Stopwatch clock;
    Job& job = *jobs[i];
    job.run = with_study_keys(model, job.members.front(), [&] {
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
                                 name_of(job.members.front()), why));
}

}  // namespace

bool wants_root_stress(const Study& study) {
  const Fidelity& fidelity = study.fidelity;
  if (fidelity.compliance == ComplianceModel::Rigid) return false;
  if (!fidelity.automatic_effects) return std::ranges::find(fidelity.effects, "root_stress") != fidelity.effects.end();
  const auto is_root_stress = [](const ObjectiveTerm& term) { return term.output == Output::PeakRootStress; };
  const bool optimised =
      study.task == Task::Optimise &&
      (std::ranges::any_of(study.optimise.objective, is_root_stress) ||
       std::ranges::any_of(study.optimise.constraints, is_root_stress, &OutputConstraint::output));
  return fidelity.compliance == ComplianceModel::Fe || optimised ||
         std::ranges::any_of(study.expect, [](const Expectation& e) { return e.key.find("root_stress") != std::string::npos; });
}

bool solves_finite_elements(const Study& study) {
  return couples_teeth(study.fidelity.compliance) || study.task == Task::Fit || wants_root_stress(study);
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
    if (by_fits) RefinementLibrary::shipped().require_known(task.gear, task.poissons_ratio);
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
    section_mesh(form, to_mesh.gear.teeth, to_mesh.normal_module, task.gear.body, options);  // only for what it refuses
  });
  return task;
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
    for (const Member member : job.members) {
      GearRun& run = runs.gears[member == Member::Pinion ? 0 : 1];
      run = {table, root_stress, job.run.statistics, influence_table_task(study, pair, member).gear.body, job.task.removed,
             job.from_cache, job.file, job.seconds};
    }
  }
  runs.seconds = clock.seconds();
  return runs;
}

}  // namespace flankwright::studies
