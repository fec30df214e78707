#include "core/compliance/model/gear_runs.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/stopwatch.hpp"
#include "core/compliance/fitted/correction_fit.hpp"

namespace flankwright {

namespace {

enum class Purpose {
  Gear,       ///< its influence values
  Fine,       ///< what its own fit shall meet
  RigidBody,  ///< the same with a rigid body below its teeth
  FitCoarse,  ///< the coarse run of that fit, where the gear's own run has a wider face or another body
};

/// The purpose of a run.
struct Use {
  Member member;
  Purpose purpose;
};

GearRun& place_of(FiniteElementRuns& runs, const Use& use) {
  switch (use.purpose) {
    case Purpose::Gear:
      return runs.gears[use.member];
    case Purpose::RigidBody:
      return runs.rigid_body[use.member].emplace();
    case Purpose::Fine:
      return runs.fine[use.member].emplace();
    case Purpose::FitCoarse:
      return runs.narrow[use.member].emplace();
  }
  __builtin_unreachable();
}

/// The body of a run, in the frame of the pair [mm].
GearBody body_used(const ComplianceTask& task, const Use& use) {
  const InfluenceTableTask own = influence_table_task(task, use.member);
  GearBody body = use.purpose == Purpose::Fine || use.purpose == Purpose::FitCoarse ? task_of_fit(own).gear.body : own.gear.body;
  if (body.web) body.web->web_offset = 0.0 - task.pair.acute_end(use.member) * body.web->web_offset;
  return body;
}

/// One mesh of one or both gears of a pair, alike but for their size.
struct Job {
  std::vector<Use> uses;
  InfluenceTableTask task;
  InfluenceTableRun run{};
  bool from_cache{false};
  std::string file{};
  double seconds{0.0};

  Member member() const { return uses.front().member; }
};

std::vector<Job> jobs_of(const ComplianceTask& pair) {
  std::vector<Job> jobs;
  const auto add = [&](Use use, InfluenceTableTask task) {
    const auto same = std::ranges::find_if(jobs, [&](const Job& job) { return alike_but_for_size(job.task, task); });
    if (same != jobs.end()) {
      same->uses.push_back(use);
    } else {
      jobs.push_back({.uses = {use}, .task = std::move(task)});
    }
  };
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    InfluenceTableTask task = influence_table_task(pair, member);
    if (!unknown_to_library(pair, task).empty()) {
      InfluenceTableTask fit = task_of_fit(task), fine = fit;
      fine.mesh = {};
      const bool own_run = !alike_but_for_size(fit, task);
      if (own_run) add({member, Purpose::FitCoarse}, std::move(fit));
      if (!own_run) task.root_stress = false;  // the finest mesh of the whole face tells it
      add({member, Purpose::Fine}, std::move(fine));
    }
    if (pair.rigid_bodies && couples_teeth(pair.model)) {
      InfluenceTableTask rigid = task;
      rigid.gear.body.rigid = true;
      rigid.removed = RemovedRigidMotion::None;
      rigid.root_stress = false;
      add({member, Purpose::RigidBody}, std::move(rigid));
    }
    add({member, Purpose::Gear}, std::move(task));
  }
  return jobs;
}

/// Progress of several jobs as one.
class JointProgress {
 public:
  JointProgress(const std::vector<Job*>& jobs, const ProgressReport& report) : report_(report), steps_(jobs.size()) {
    const bool one_gear = std::ranges::all_of(
        jobs, [&](const Job* job) { return std::ranges::all_of(job->uses, [&](const Use& use) { return use.member == jobs.front()->member(); }); });
    label_ = one_gear ? std::string("solving the ") + name_of(jobs.front()->member()) + "'s finite elements" : "solving both gears' finite elements";
  }
  void at(std::size_t job, int done, int total) {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    steps_[job] = {done, total};
    // A job that has not begun counts like the longest that has, so that the bar is not full before the last one.
    const int longest = std::ranges::max(steps_, {}, &std::pair<int, int>::second).second;
    int all_done = 0, all = 0;
    for (const auto& [d, t] : steps_) {
      all_done += d;
      all += t > 0 ? t : longest;
    }
    report_(label_, all_done, all, done == 0 ? "mesh" : "elimination");
  }

 private:
  const ProgressReport& report_;
  std::string label_;
  std::vector<std::pair<int, int>> steps_;
  std::mutex mutex_;
};

/// Takes the job's run from the store; false where there is none.
bool take(Job& job, ComplianceStore* store) {
  if (store == nullptr) return false;
  const Stopwatch clock;
  auto kept = store->find(job.task);
  if (!kept) return false;
  job.run = std::move(kept->value);
  job.file = std::move(kept->where);
  job.seconds = clock.seconds();
  return true;
}

/// Solves jobs side by side, each within its part of the memory.
void solve_side_by_side(const std::vector<Job*>& jobs, ComplianceModel model, const ComplianceBuild& build) {
  JointProgress progress(jobs, build.progress);
  const double limit = build.memory_limit / static_cast<double>(std::min<std::size_t>(jobs.size(), static_cast<std::size_t>(build.abreast)));
  const auto solve = [&](std::size_t turn) {
    const Stopwatch clock;
    // As a rule the wheel takes longer. It goes to the thread that waits for the others at the end; the thread that ends first then shares its panels.
    const std::size_t i = jobs.size() - 1 - turn;
    Job& job = *jobs[i];
    const auto report = [&](int done, int total) { progress.at(i, done, total); };
    job.run = with_gear_names(model, job.member(), [&] { return solve_influence_table(job.task, limit, report, build.for_each); });
    job.seconds = clock.seconds();
  };
  run_for_each(build.for_each, jobs.size(), solve);
}

void refuse_unsolved(const Job& job, ComplianceModel model, double memory_limit) {
  if (job.run.status == FactorStatus::Factorised) return;
  const auto gigabytes = [](double bytes) { return in_words(std::round(bytes / 1e8) / 10) + " GB"; };
  const auto unknowns = job.run.statistics.unknowns;
  std::string why = "its stiffness matrix is singular to round-off";
  if (job.run.status == FactorStatus::OutOfMemory) {
    why = std::to_string(unknowns) + " unknowns need about " + gigabytes(job.run.statistics.peak_bytes) +
          (std::isfinite(memory_limit) ? ", of which " + gigabytes(memory_limit) + " may be taken" : ", which there are not");
  }
  throw InvalidInput("fidelity.compliance", to_string(model),
                     std::string("another compliance: the ") + name_of(job.member()) + "'s finite elements cannot be solved: " + why);
}

}  // namespace

FiniteElementRuns solve_finite_elements(const ComplianceTask& task, const ComplianceBuild& build) {
  const Stopwatch clock;
  FiniteElementRuns runs;
  std::vector<Job> jobs = jobs_of(task);
  run_for_each(build.for_each, jobs.size(), [&](std::size_t i) { jobs[i].from_cache = take(jobs[i], build.store); });
  std::vector<Job*> missing;
  for (Job& job : jobs) {
    if (!job.from_cache) missing.push_back(&job);
  }
  if (!missing.empty()) solve_side_by_side(missing, task.model, build);
  for (Job* job : missing) {
    // A gear that did not fit in memory beside the other may fit alone.
    if (job->run.status == FactorStatus::OutOfMemory && missing.size() > 1) solve_side_by_side({job}, task.model, build);
    refuse_unsolved(*job, task.model, build.memory_limit);
    if (build.store != nullptr) job->file = build.store->keep(job->task, job->run);
  }
  for (Job& job : jobs) {
    const auto table = std::make_shared<const InfluenceTable>(std::move(*job.run.table));
    std::shared_ptr<const RootStressTable> root_stress;
    if (job.run.root_stress) root_stress = std::make_shared<const RootStressTable>(std::move(*job.run.root_stress));
    std::shared_ptr<const RimMotionTable> rim_motion;
    if (job.run.rim_motion) rim_motion = std::make_shared<const RimMotionTable>(std::move(*job.run.rim_motion));
    for (const Use& use : job.uses) {
      place_of(runs, use) = {table,          root_stress, job.run.statistics, body_used(task, use), job.task.removed,
                             job.from_cache, job.file,    job.seconds,        rim_motion,           job.task.mesh};
    }
  }
  runs.seconds = clock.seconds();
  return runs;
}

}  // namespace flankwright
