#include "core/fidelity/effect_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/stopwatch.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/contact/gap/condition_gap.hpp"
#include "core/load/solve/load_solver.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "core/load/solve/sensitivity.hpp"

namespace flankwright {

namespace {

/// Whether an effect's size is found by leaving it out of a mesh.
bool is_sized(const EffectDecision& decision) { return decision.on && changes_mesh(decision.name); }

/// A load case with some effects on: the mesh and the flanks that they leave.
struct Case {
  std::shared_ptr<const MeshModel> model;
  FlankCondition condition;
};

/// Builds the cases of one scene; data of the gears alone are computed once.
class Cases {
 public:
  Cases(const EffectScene& scene, EffectMeshes& meshes) : scene_(scene), meshes_(meshes) {
    if (scene.structure == nullptr) slices_.emplace(ThinSlice(scene.pair, scene.material.pinion, scene.material.wheel));
    gears_.pair = scene.pair;
    gears_.material = scene.material;
    gears_.contact_modulus = contact_modulus(scene.material.pinion, scene.material.wheel);
  }

  /// @param left_out  name of what the decisions leave out; empty: nothing
  Case with(const EffectDecisions& decisions, const std::string& left_out = {}) const {
    FlankCondition condition = apply_effects(decisions, scene_.condition);
    const MeshPlacement placement = placement_of(gap_model(decisions), condition, scene_.shafts, scene_.pinion_torque);
    const PairCompliance* structure = slices_ ? &*slices_ : scene_.structure;
    const auto make = [&] {
      return mesh_with_effects(gears_, scene_.resolution, mesh_effects(decisions), placement, {.structure = structure, .shafts = scene_.shafts});
    };
    return {meshes_.mesh(left_out, placement, make), std::move(condition)};
  }

  /// Whether something yields under these effects, and there is a structure for them: that on rigid bodies needs its own run.
  bool yield_by(const EffectDecisions& decisions) const {
    const bool has_structure = slices_ || scene_.structure->knows_rigid_bodies() || is_on(decisions, "gear_body_compliance");
    return has_structure && mesh_effects(decisions).make_compliant();
  }

  CycleOutputs outputs(const EffectDecisions& decisions, const std::string& left_out = {}) const {
    const Case made = with(decisions, left_out);
    return cycle_outputs(analyse_cycle(*made.model, made.condition, scene_.pinion_torque));
  }

 private:
  const EffectScene& scene_;
  EffectMeshes& meshes_;
  std::optional<ThinSlicePair> slices_;  ///< where the scene has no structure
  MeshModel gears_;                      ///< without positions
};

/// Outputs as positions come in.
class OutputSum {
 public:
  void add(double highest_stress, double transmission_error, double approach_of_teeth) {
    least_ = std::fmin(least_, transmission_error);
    most_ = std::fmax(most_, transmission_error);
    sum_ += transmission_error;
    approach_ += approach_of_teeth;
    te_.push_back(transmission_error);
    stress_ = std::max(stress_, highest_stress);
    ++count_;
  }

  CycleOutputs outputs() const { return {sum_ / count_, most_ - least_, stress_, approach_ / count_, harmonics()}; }

 private:
  /// Over evenly spaced positions; orders below half their number.
  std::vector<std::complex<double>> harmonics() const {
    constexpr int most_orders = 5;
    std::vector<std::complex<double>> found;
    for (int k = 1; k <= most_orders && 2 * k < count_; ++k) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < count_; ++i) sum += std::polar(2.0 / count_, -2.0 * units::pi * k * i / count_) * te_[static_cast<std::size_t>(i)];
      found.push_back(sum);
    }
    return found;
  }

  std::vector<double> te_;
  double least_{not_given}, most_{not_given}, sum_{0.0}, approach_{0.0}, stress_{0.0};
  int count_{0};
};

/// Loads of one position carried to the points of another: those of the same tooth at the same z, 0 where there is none.
Eigen::VectorXd carried(const MeshPosition& from, const Eigen::VectorXd& loads, const MeshPosition& to) {
  Eigen::VectorXd carried = Eigen::VectorXd::Zero(std::ssize(to.points));
  std::size_t j = 0;
  for (std::size_t i = 0; i < to.points.size(); ++i) {
    const ContactPoint& here = to.points[i];
    const auto is_here = [&](const ContactPoint& point) { return point.tooth == here.tooth && point.z == here.z; };
    const auto found = std::find_if(from.points.begin() + static_cast<std::ptrdiff_t>(j), from.points.end(), is_here);
    if (found == from.points.end()) continue;
    j = static_cast<std::size_t>(found - from.points.begin());
    carried[static_cast<Eigen::Index>(i)] = loads[static_cast<Eigen::Index>(j)];
  }
  return carried;
}

struct Solution {
  Eigen::VectorXd line_load;
  double transmission_error;
};

Eigen::VectorXd approach(const LoadProblem& problem, const Eigen::VectorXd& loads) {
  Eigen::VectorXd approach = problem.influence * problem.weight.cwiseProduct(loads) + problem.gap;
  for (std::size_t i = 0; i < problem.laws.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    approach[row] += problem.laws[i].deflection(loads[row]);
  }
  return approach;
}

/// One step from loads that solve another problem; nothing where it goes too far.
std::optional<Solution> first_order(const LoadProblem& problem, const Eigen::VectorXd& loads, double transmission_error, double trust) {
  if (!(loads.maxCoeff() > 0.0)) return std::nullopt;
  LoadDistribution start;
  start.status = LoadStatus::Converged;
  start.line_load = loads;
  const Eigen::VectorXd residual = approach(problem, loads).array() - transmission_error;
  const Eigen::RowVectorXd missing = Eigen::RowVectorXd::Constant(1, problem.force - problem.weight.dot(loads));
  const auto step = LoadSensitivity(problem, start).with(residual, missing);
  const Solution next{loads + step.line_load.col(0), transmission_error + step.transmission_error[0]};
  const bool small = step.line_load.cwiseAbs().maxCoeff() <= trust * loads.maxCoeff();  // false where it is NaN
  if (!small || next.line_load.minCoeff() < 0.0) return std::nullopt;
  const Eigen::VectorXd reached = approach(problem, next.line_load);
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    if (loads[i] == 0.0 && reached[i] < next.transmission_error) return std::nullopt;
  }
  return next;
}

EstimatedSize estimate(const Cases& cases, const EffectDecisions& decisions, const std::string& name, const Case& all, const LoadedCycle& cycle,
                       const CycleOutputs& with, double trust) {
  const Stopwatch clock;
  EstimatedSize result{{name, {}, not_given}};
  const EffectDecisions rest = without(decisions, name, "left out");
  if (!cases.yield_by(rest)) return result;
  const Case other = cases.with(rest, name);
  const ConditionGap gaps(other.model->pair, other.model->placement.gap, other.condition);
  const PairReliefStarts starts = relief_starts(other.model->pair, other.condition);
  OutputSum outputs;
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const MeshPosition& at = other.model->positions[i];
    const LoadDistribution& solved = cycle.positions[i].load;
    const Gap gap = gap_under(at, gaps, cycle.force);
    const Eigen::VectorXd most = cycle.force * at.weight.cwiseInverse();
    const std::vector<ContactLaw> moved_edges = laws_with_moved_edges(at, gap, most);
    const LoadProblem problem{at.influence, at.weight, gap.total, moved_edges.empty() ? at.laws : moved_edges, cycle.force};
    const Eigen::VectorXd loads = carried(all.model->positions[i], solved.line_load, at);
    std::optional<Solution> found = at.points.empty() ? std::nullopt : first_order(problem, loads, solved.transmission_error, trust);
    ++result.positions;
    if (!found) {
      ++result.solved_again;
      const LoadDistribution again = solve_load_distribution(problem, {}, loads.size() > 0 && loads.maxCoeff() > 0.0 ? loads : Eigen::VectorXd());
      if (!again.usable()) return result;
      found = Solution{again.line_load, again.transmission_error};
    }
    double highest = 0.0;
    const Eigen::VectorXd structural = at.influence * at.weight.cwiseProduct(found->line_load);
    const std::vector<LineCrest> crests = line_crests({*other.model, at, gaps, starts, gap, cycle.force, problem.laws, found->line_load, structural});
    for (const PointPeaks& peaks : point_peaks(*other.model, at, problem.laws, found->line_load, crests)) {
      highest = std::max(highest, peaks.stress.value);
    }
    const double approach = found->transmission_error - gap.total.minCoeff() - at.shaft_compliance * cycle.force;
    outputs.add(highest, found->transmission_error, std::max(0.0, approach));
  }
  result.size.influence = EffectInfluence::between(with, outputs.outputs());
  result.size.seconds = clock.seconds();
  return result;
}

}  // namespace

CycleOutputs cycle_outputs(const LoadedCycle& cycle) {
  if (!cycle.usable() || cycle.positions.empty()) return {};
  OutputSum outputs;
  for (const LoadedPosition& position : cycle.positions) {
    outputs.add(position.contact_stress.size() > 0 ? position.contact_stress.maxCoeff() : 0.0, position.load.transmission_error,
                position.approach_of_teeth());
  }
  return outputs.outputs();
}

CycleOutputs outputs_with(const EffectScene& scene, const EffectDecisions& decisions) {
  EffectMeshes meshes;
  return Cases(scene, meshes).outputs(decisions);
}

EffectInfluence exact_influence(const EffectScene& scene, const EffectDecisions& decisions, const std::string& name) {
  const EffectDecisions rest = without(decisions, name, "left out");
  if (!mesh_effects(rest).make_compliant()) return {};
  EffectMeshes meshes;
  const Cases cases(scene, meshes);
  return EffectInfluence::between(cases.outputs(decisions), cases.outputs(rest, name));
}

std::shared_ptr<const MeshModel> EffectMeshes::mesh(const std::string& left_out, const MeshPlacement& placement,
                                                    const std::function<MeshModel()>& make) {
  Entry* entry = nullptr;
  {
    const std::lock_guard lock(mutex_);
    entry = &entries_[{left_out, placement}];
  }
  std::call_once(entry->made, [&] { entry->mesh = std::make_shared<const MeshModel>(make()); });
  return entry->mesh;
}

void make_effect_meshes(const EffectScene& scene, const EffectDecisions& decisions, EffectMeshes& meshes, const ForEachIndex& for_each) {
  const Cases cases(scene, meshes);
  std::vector<std::string> names{{}};
  for (const EffectDecision& decision : decisions) {
    if (is_sized(decision) && cases.yield_by(without(decisions, decision.name, "left out"))) names.push_back(decision.name);
  }
  run_for_each(for_each, names.size(),
               [&](std::size_t i) { cases.with(names[i].empty() ? decisions : without(decisions, names[i], "left out"), names[i]); });
}

std::vector<EstimatedSize> estimate_effect_sizes(const EffectScene& scene, const EffectDecisions& decisions, const SizeOptions& options) {
  EffectMeshes meshes;
  return estimate_effect_sizes(scene, decisions, options, meshes);
}

std::vector<EstimatedSize> estimate_effect_sizes(const EffectScene& scene, const EffectDecisions& decisions, const SizeOptions& options,
                                                 EffectMeshes& meshes) {
  const Cases cases(scene, meshes);
  const Case all = cases.with(decisions);
  const LoadedCycle cycle = analyse_cycle(*all.model, all.condition, scene.pinion_torque);
  const CycleOutputs with = cycle_outputs(cycle);
  std::vector<EstimatedSize> sizes;
  for (const EffectDecision& decision : decisions) {
    if (!is_sized(decision)) continue;
    if (options.only && std::ranges::find(*options.only, decision.name) == options.only->end()) continue;
    if (!cycle.usable()) {
      sizes.push_back({{decision.name, {}, not_given}});
      continue;
    }
    sizes.push_back(estimate(cases, decisions, decision.name, all, cycle, with, options.trust));
  }
  return sizes;
}

}  // namespace flankwright
