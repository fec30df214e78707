#include "optimize/assessment/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "optimize/assessment/optimum.hpp"
#include "optimize/design/search/optimality.hpp"

namespace flankwright {

namespace {

using Kind = EpigraphRow::Kind;

/// Whether a task varies a parameter, a half of it, or one that it is a half of.
bool is_varied(const DesignTask& task, Member member, const ModificationDescriptor& parameter) {
  const auto touches = [&](const DesignVariable& v) { return v.touches(member, parameter.parameter); };
  return std::ranges::any_of(task.variables, touches) || std::ranges::any_of(task.links, touches, &LinkingConstraint::linked);
}

/// Whether another parameter sets this one together with a second.
bool is_half(const ModificationDescriptor& parameter) {
  return std::ranges::any_of(modification_parameters,
                             [&](const ModificationDescriptor& p) { return p.half == parameter.key || p.other_half == parameter.key; });
}

/// The extent by rule of an amount [mm]; 0: no rule.
double usual_extent(const GearPair& pair, Member member, std::string_view amount) {
  const Gear& gear = pair[member];
  if (amount == "end_relief.amount") return std::min(0.1 * pair.face_width, pair.data.normal_module);
  if (amount == "tip_relief.amount") return gear.tip_form_radius - gear.working_pitch_radius;
  return 0.0;
}

struct UnvariedAmount {
  AssessedParameter parameter;
  double extent{not_given};  ///< where the design does not give it
  bool either_way{false};
};

/// The lead and profile amounts that a task does not vary. Extents that the design does not give are set in it.
std::vector<UnvariedAmount> unvaried_amounts(const DesignTask& task, PerGear<Modification>& design) {
  std::vector<UnvariedAmount> found;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    for (const ModificationDescriptor& p : modification_parameters) {
      const bool is_amount = p.kind == ParameterKind::Amount && p.flank_class != ModificationClass::Topography && !p.key.starts_with("topography.");
      if (!is_amount || is_half(p) || is_varied(task, member, p)) continue;
      const DesignVariable v{
          .path = std::string(name_of(member)) + ".modification." + std::string(p.key), .member = member, .parameter = p.parameter};
      const double step = assessment_step(v.unit());
      UnvariedAmount amount{{v.path, step, v.unit(), GearParameter{member, p.parameter}, step / v.outside_factor()}};
      amount.either_way = !p.sense.empty();
      const ModificationDescriptor* extent = p.extent.empty() ? nullptr : find_parameter(p.extent);
      if (extent != nullptr && extent->get(design[member]) == 0.0) {
        amount.extent = usual_extent(task.pair, member, p.key);
        if (!(amount.extent > 0.0)) continue;
        extent->set(design[member], amount.extent);
      }
      found.push_back(std::move(amount));
    }
  }
  return found;
}

/// The limits that the rows of judged_by_excess() stand for, those on outputs and then those on objectives, with their multipliers.
std::vector<Relaxation::Limit> exceeded_limits(const DesignTask& task, const Optimality& optimality) {
  std::vector<Relaxation::Limit> of_row;
  for (int c = 0; c < static_cast<int>(task.constraints.size()); ++c) {
    if (task.constraints[static_cast<std::size_t>(c)].has_smooth_excess()) of_row.push_back({.constraint = c});
  }
  for (int b = 0; b < static_cast<int>(task.objective_bounds.size()); ++b) of_row.push_back({.objective_bound = b});
  std::map<int, double> multipliers, of_scenes;    // of a row: its own and the sum over its scenes
  std::map<std::pair<int, int>, double> of_scene;  // [row, scene]
  for (const ActiveBound& felt : optimality.active) {
    if (felt.variable >= 0) continue;
    if (felt.row.kind == Kind::ScalarisedObjective) multipliers[felt.row.index] += felt.multiplier;
    if (felt.row.kind != Kind::Floor || felt.row.objective >= static_cast<int>(of_row.size())) continue;
    of_scene[{felt.row.objective, felt.row.scene}] += felt.multiplier;
    of_scenes[felt.row.objective] += felt.multiplier;
  }
  std::vector<Relaxation::Limit> limits;
  for (const auto& [which, multiplier] : of_scene) {
    Relaxation::Limit limit = of_row[static_cast<std::size_t>(which.first)];
    limit.scene = which.second;
    limit.weight = multipliers[which.first] * multiplier / of_scenes[which.first];
    limits.push_back(limit);
  }
  std::ranges::stable_sort(limits, std::greater(), &Relaxation::Limit::weight);
  return limits;
}

}  // namespace

Relaxation find_relaxation(const DesignProblem& problem, const PerGear<Modification>& design, const std::vector<double>& values) {
  DesignProblem by_excess = problem.judged_by_excess();
  const Eigen::VectorXd x = by_excess.nearest_design(values);
  by_excess.set_start(x);
  const Optimality optimality = first_order_optimality(by_excess, x);
  PerGear<Modification> with_extents = design;
  const std::vector<UnvariedAmount> unvaried = unvaried_amounts(problem.task(), with_extents);
  std::vector<AssessedParameter> parameters = variable_parameters(by_excess.task());
  const auto assessed = static_cast<Eigen::Index>(parameters.size());
  for (const UnvariedAmount& amount : unvaried) parameters.push_back(amount.parameter);
  const LocalModel model(by_excess, with_extents, parameters, optimality.active);
  const Optimum optimum = find_optimum(by_excess, optimality, values);

  Relaxation found;
  found.excess = by_excess.objective(by_excess.analyse(x, false));
  found.limits = exceeded_limits(problem.task(), optimality);
  const auto helps = [&](double gain) { return gain < -optimum.resolution; };
  for (const Optimum::Bound& bound : optimum.bounds) {
    if (helps(bound.gain)) found.moves.push_back({parameters[static_cast<std::size_t>(bound.variable)], bound.upper ? 1.0 : -1.0, bound.gain});
  }
  for (std::size_t i = 0; i < unvaried.size(); ++i) {
    const double slope = optimality.objective_scale * model.lagrangian_slope()[assessed + static_cast<Eigen::Index>(i)];
    const double steps = unvaried[i].either_way && slope > 0.0 ? -1.0 : 1.0;
    if (helps(steps * slope)) found.moves.push_back({unvaried[i].parameter, steps, steps * slope, unvaried[i].extent});
  }
  std::ranges::stable_sort(found.moves, std::less(), &Relaxation::Move::gain);
  return found;
}

}  // namespace flankwright
