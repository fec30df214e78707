#include "optimize/assessment/rules_of_thumb.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/rating/iso_load_factors.hpp"

namespace flankwright {

namespace {

/// Adds one rule's modification to both gears.
struct Rule {
  std::string name;  ///< empty: nothing is changed
  std::string basis;
  std::function<void(PerGear<Modification>&)> apply;
};

Rule nothing() {
  return {"", "", [](PerGear<Modification>&) {}};
}

Rule tip_relief(const std::string& name, const std::string& basis, double amount, double pinion_height, double wheel_height) {
  return {name, basis, [=](PerGear<Modification>& modification) {
            modification.pinion.tip_relief = {amount, pinion_height, ReliefShape::Linear};
            modification.wheel.tip_relief = {amount, wheel_height, ReliefShape::Linear};
          }};
}

std::vector<Rule> profile_rules(const GearPair& pair, const RuleBasis& basis) {
  std::vector<Rule> rules{nothing()};
  const double overlap = (pair.transverse_contact_ratio - 1.0) * pair.transverse_base_pitch;  // path with two pairs, each end
  const auto over = [&](double length) { return std::pair{relief_height(pair.pinion, length), relief_height(pair.wheel, length)}; };
  const bool one_or_two_pairs = pair.transverse_contact_ratio > 1.0 && pair.transverse_contact_ratio < 2.0;
  if (one_or_two_pairs) {
    const auto [pinion, wheel] = over(0.5 * overlap);
    rules.push_back(tip_relief("short tip relief", "Munro, Haddad 1991 eq. 4.13; mean deflection, ISO 6336-1", basis.deflection, pinion, wheel));
  }
  rules.push_back(tip_relief("long tip relief", "Munro, Haddad 1991 section 4.3.3: from the pitch point; mean deflection, ISO 6336-1",
                             basis.deflection, pair.pinion.tip_form_radius - pair.pinion.working_pitch_radius,
                             pair.wheel.tip_form_radius - pair.wheel.working_pitch_radius));
  if (one_or_two_pairs) {
    const auto [pinion, wheel] = over(overlap);
    rules.push_back(tip_relief("tip relief to single contact", "as commercial gear software proposes; deflection of a single pair, ISO 6336-1",
                               basis.single_pair_deflection, pinion, wheel));
  }
  rules.push_back(
      {"profile crowning", "Haddad 1991 section 4.3.3; mean deflection, ISO 6336-1",
       [amount = basis.deflection](PerGear<Modification>& modification) { set(modification.pinion, parameter_of("profile_crowning"), amount); }});
  return rules;
}

std::vector<Rule> lead_rules(const GearPair& pair, const RuleBasis& basis) {
  std::vector<Rule> rules{nothing()};
  if (!(basis.misalignment > 0.0)) return rules;
  const auto crowning = [](const std::string& name, const std::string& source, double amount) {
    return Rule{name, source, [amount](PerGear<Modification>& modification) { modification.pinion.lead_crowning = amount; }};
  };
  rules.push_back(crowning("crowning of half the misalignment", "Munro and Myers, Haddad 1991 section 4.2.4", 0.5 * basis.misalignment));
  rules.push_back(crowning("crowning after ISO 6336-1", "annex B: half the misalignment, 10 .. 40 um",
                           std::clamp(0.5 * basis.misalignment, 10.0 * units::um, 40.0 * units::um)));
  const double length = std::min(0.1 * pair.face_width, pair.data.normal_module);
  rules.push_back({"end relief after ISO 6336-1", "annex B: the misalignment, over the smaller of 0.1 b and m_n",
                   [amount = basis.misalignment, length](PerGear<Modification>& modification) {
                     modification.pinion.end_relief = {amount, length};
                   }});
  return rules;
}

std::string joined(const std::string& a, const std::string& b, const char* between) { return a.empty() || b.empty() ? a + b : a + between + b; }

/// Each variable by itself moved into its bounds.
Eigen::VectorXd nearest_scaled(const DesignProblem& problem, const NamedDesign& design) {
  std::vector<double> values;
  for (const DesignVariable& variable : problem.task().variables) values.push_back(get(design.modification[variable.member], variable.parameter));
  return problem.nearest_design(values);
}

}  // namespace

RuleBasis rule_basis(const DesignProblem& problem) {
  const DesignTask& task = problem.task();
  RuleBasis basis{.torque = 0.0, .misalignment = 0.0};
  for (const DesignScene& scene : task.scenes) basis.torque = std::max(basis.torque, scene.torque);
  for (int s = 0; s < problem.scenes(); ++s) {
    FlankCondition condition = task.scenes[static_cast<std::size_t>(s)].condition;
    condition.modification.pinion = condition.modification.wheel = {};
    basis.misalignment = std::max(basis.misalignment, iso_deviations(problem.model(s).pair, condition).misalignment);
  }
  const MeshModel& model = problem.model(0);  // stiffness and face width are the same in every scene
  const double specific_load = basis.torque / task.pair.pinion.base_radius / model.face_width;
  basis.deflection = specific_load / model.iso.c_gamma * units::um;
  basis.single_pair_deflection = specific_load / model.iso.c_prime * units::um;
  return basis;
}

double relief_height(const Gear& gear, double length) {
  const double start = gear.roll_length_at(gear.tip_form_radius) - length;
  return gear.tip_form_radius - std::hypot(gear.base_radius, start);
}

std::vector<NamedDesign> rules_of_thumb(const DesignTask& task, const RuleBasis& basis) {
  std::vector<NamedDesign> designs;
  for (const Rule& profile : profile_rules(task.pair, basis)) {
    for (const Rule& lead : lead_rules(task.pair, basis)) {
      NamedDesign design{joined(profile.name, lead.name, " and "), joined(profile.basis, lead.basis, "; "), {}};
      if (design.name.empty()) design.name = "unmodified";
      for (const Member m : {Member::Pinion, Member::Wheel}) {
        design.modification[m].topography = task.modification[m].topography;
        design.modification[m].opposite_topography = task.modification[m].opposite_topography;
        design.modification[m].process = task.modification[m].process;
      }
      profile.apply(design.modification);
      lead.apply(design.modification);
      designs.push_back(std::move(design));
    }
  }
  return designs;
}

std::vector<Eigen::VectorXd> within_bounds(const DesignProblem& problem, const std::vector<NamedDesign>& designs) {
  std::vector<Eigen::VectorXd> found;
  for (const NamedDesign& design : designs) {
    const Eigen::VectorXd x = nearest_scaled(problem, design);
    if (std::ranges::find(found, x) == found.end()) found.push_back(x);
  }
  return found;
}

std::vector<std::string> out_of_reach(const DesignProblem& problem, const NamedDesign& design) {
  constexpr double noticed = 1e-7;  // mm or rad: far below what can be ground
  const PerGear<Modification> nearest = problem.modification(nearest_scaled(problem, design));
  for (const ParameterKind kind : {ParameterKind::Amount, ParameterKind::Extent}) {
    std::vector<std::string> names;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      for (const ModificationDescriptor& d : modification_parameters) {
        // A number of both halves stands for them.
        const bool is_half = std::ranges::any_of(modification_parameters, [&](const auto& o) { return o.half == d.key || o.other_half == d.key; });
        const bool differs = std::abs(d.get(design.modification[m]) - d.get(nearest[m])) > noticed;
        if (d.kind == kind && differs && !is_half) names.push_back(std::string(name_of(m)) + " " + std::string(d.name));
      }
    }
    if (!names.empty()) return names;
  }
  return {};
}

}  // namespace flankwright
