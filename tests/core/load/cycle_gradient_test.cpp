#include "core/contact/gap/condition_gap.hpp"
#include "core/load/cycle/cycle_gradient.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "core/fidelity/cycle_quantities.hpp"
#include "core/rating/position_gradient.hpp"
#include "tests/core/load/load_cases.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// A mesh with every kind of modification, error and misalignment, and its torque.
struct Scene {
  FlankCondition condition;
  double torque;
};

Scene random_scene(const GearPair& gears, Random& random) {
  Scene scene;
  for (Modification* m : {&scene.condition.modification.pinion, &scene.condition.modification.wheel}) {
    m->lead_crowning = random(1.0, 8.0) * units::um;
    m->lead_slope = random(-3.0, 3.0) * units::um;
    m->addendum_crowning = m->dedendum_crowning = random(0.5, 4.0) * units::um;
    m->tip_relief = {random(2.0, 8.0) * units::um, random(0.3, 0.6) * gears.data.normal_module, ReliefShape::Parabolic};
    m->twist = random(-2.0, 2.0) * units::um;
  }
  Misalignment& misalignment = scene.condition.misalignment;
  misalignment.crossing = random(-0.2, 0.2) * units::arcmin;
  misalignment.intersecting = random(-0.2, 0.2) * units::arcmin;
  misalignment.centre_distance = random(-0.02, 0.02);
  misalignment.pinion_lead_angle = random(-0.1, 0.1) * units::arcmin;
  misalignment.pinion_pressure_angle = random(-0.1, 0.1) * units::arcmin;
  misalignment.mesh_misalignment = random(-5.0, 5.0) * units::um;
  scene.torque = mesh_cases::torque_for(gears, random.log_uniform(150.0, 600.0));
  return scene;
}

void shift(Scene& scene, const MeshParameter& parameter, double by) {
  if (const auto* gear = std::get_if<GearParameter>(&parameter)) {
    FlankCondition& c = scene.condition;
    Modification& m = c.modification[gear->member];
    set(m, gear->parameter, get(m, gear->parameter) + by);
  } else if (const auto* misalignment = std::get_if<MisalignmentParameter>(&parameter)) {
    scene.condition.misalignment.*(*misalignment) += by;
  } else {
    scene.torque += by;
  }
}

std::vector<MeshParameter> all_kinds() {
  std::vector<MeshParameter> parameters{
      GearParameter{Member::Pinion, parameter_of("lead_crowning")},      GearParameter{Member::Pinion, parameter_of("tip_relief.amount")},
      GearParameter{Member::Wheel, parameter_of("profile_crowning")},    GearParameter{Member::Wheel, parameter_of("twist")},
      GearParameter{Member::Pinion, parameter_of("twist_compensation")}, GearParameter{Member::Wheel, parameter_of("twist_compensation")}};
  for (const NamedMisalignmentParameter& p : misalignment_parameters) {
    if (p.parameter != &Misalignment::axial_offset) parameters.push_back(p.parameter);  // moves the mesh
  }
  parameters.push_back(PinionTorque{});
  return parameters;
}

/// Every output of a cycle in one list, and what derivatives say of it.
struct Outputs {
  Eigen::VectorXd values;
  Eigen::MatrixXd derivatives;
  std::vector<std::string> names;

  void add(const std::string& name, const Eigen::VectorXd& more, const Eigen::MatrixXd& slopes) {
    const Eigen::Index n = values.size();
    values.conservativeResize(n + more.size());
    values.tail(more.size()) = more;
    if (slopes.cols() > 0) {
      derivatives.conservativeResize(n + more.size(), slopes.cols());
      derivatives.bottomRows(more.size()) = slopes;
    }
    names.insert(names.end(), static_cast<std::size_t>(more.size()), name);
  }
  void add(const std::string& name, double value, const Eigen::RowVectorXd& slope) {
    add(name, Eigen::VectorXd(Eigen::VectorXd::Constant(1, value)), Eigen::MatrixXd(slope));
  }
};

/// What a position has beside loads and f_t.
void add_position_outputs(const MeshModel& model, const FlankCondition& condition, const LoadedCycle& cycle, std::size_t k,
                          const std::vector<MeshParameter>& parameters, Outputs& all) {
  const MeshPosition& at = model.positions[k];
  const LoadedPosition& p = cycle.positions[k];
  const std::vector<LineEnd> ends = line_ends(model, at, p, condition);
  const std::vector<ToothShare> teeth = load_sharing(at, p);
  const PositionGradient gradient = position_gradient(model, condition, cycle, k, ends, parameters);
  Eigen::VectorXd shares(std::ssize(teeth)), loads(std::ssize(ends)), stresses(std::ssize(ends));
  for (Eigen::Index i = 0; i < shares.size(); ++i) shares[i] = teeth[static_cast<std::size_t>(i)].share;
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    loads[i] = ends[static_cast<std::size_t>(i)].line_load;
    stresses[i] = ends[static_cast<std::size_t>(i)].contact_stress;
  }
  all.add("point force", at.weight.cwiseProduct(p.load.line_load), gradient.point_force);
  all.add("structural deflection", p.load.structural_deflection, gradient.structural_deflection);
  all.add("contact deflection", p.load.contact_deflection, gradient.contact_deflection);
  all.add("gap", p.gap.total, gradient.gap);
  all.add("error", p.gap.error, gradient.error);
  all.add("share", shares, gradient.shares);
  all.add("line end's load", loads, gradient.line_end_load);
  all.add("line end's stress", stresses, gradient.line_end_stress);
  for (const ToothShare& tooth : teeth) {
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      const Eigen::Index highest = highest_root_stress(at, p, {member, tooth.tooth});
      REQUIRE(highest >= 0);
      all.add("root stress of a tooth", p.root_stress[highest], root_stress_derivative(at, p, highest));
    }
  }
}

Outputs outputs(const MeshModel& model, const Scene& scene, const std::vector<MeshParameter>& parameters) {
  const LoadedCycle cycle = analyse_cycle(model, scene.condition, scene.torque, parameters);
  REQUIRE(cycle.usable());
  Outputs all;
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    const LoadedPosition& p = cycle.positions[k];
    all.add("line load", p.load.line_load, p.line_load_derivative);
    all.add("contact stress", p.contact_stress, p.contact_stress_derivative);
    all.add("f_t", p.load.transmission_error, p.transmission_error_derivative);
    all.add("stiffness", p.stiffness, stiffness_derivative(cycle, p));
    Eigen::MatrixXd root(p.root_stress.size(), p.transmission_error_derivative.size());
    for (Eigen::Index i = 0; i < root.rows(); ++i) root.row(i) = root_stress_derivative(model.positions[k], p, i);
    all.add("root stress", p.root_stress, root);
    add_position_outputs(model, scene.condition, cycle, k, parameters, all);
  }
  const CycleSummary summary = summarise(model, cycle);
  const CycleGradient gradient = summary_gradient(model, cycle, summary);
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const std::vector<double> values = quantity.values(summary);
    if (std::isnan(values.front())) continue;  // what needs rounded tip edges
    all.add(std::string(quantity.name), Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)), quantity.gradients(summary, gradient));
  }
  all.add("pinion_root_tangent", summary.pinion_root_stress.tangent_stress, gradient.pinion_root_stress.tangent_stress);
  all.add("wheel_root_tangent", summary.wheel_root_stress.tangent_stress, gradient.wheel_root_stress.tangent_stress);
  return all;
}

}  // namespace

TEST_CASE("Every output's derivative by modification, misalignment and torque is that of central differences", "[core][load][gradient]") {
  // Of the difference quotients, extrapolated from two steps, relative to the output's change over what moves it appreciably; points
  // that gain or lose contact within the step leave a kink, and are told apart by the quotients of the two steps, which differ.
  constexpr double kDiscretisation = 2e-7;
  const bool helical = GENERATE(false, true);
  const GearPair gears = helical ? mesh_cases::pair(18, 54, 30, 10, 120) : mesh_cases::pair(20, 40, 0, 4, 30);
  const mesh_cases::SyntheticRootStress fillets(gears);
  const MeshModel model = make_mesh_model(gears, {}, {{QuadratureRule::Gauss2, 4}, equally_spaced_phases(7)}, {}, {}, {.root_stress = &fillets});
  const std::vector<MeshParameter> parameters = all_kinds();
  Random random(helical ? 61 : 62);
  int compared = 0, kinks = 0;
  double worst = 0.0;
  std::string worst_output;
  for (int trial = 0; trial < 3; ++trial) {
    Scene scene = random_scene(gears, random);
    if (trial == 1) scene.condition.modification.pinion.process.kind = GrindingKind::GeneratingGrinding;
    if (trial == 2) {
      scene.condition.modification.pinion.process.kind = GrindingKind::FormGrinding;
      scene.condition.modification.wheel.process = {GrindingKind::GeneratingGrinding, 0.3};
    }
    const ConditionGap gaps(model.pair, model.placement.gap, scene.condition);
    const Outputs here = outputs(model, scene, parameters);
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const auto column = static_cast<Eigen::Index>(p);
      // A step that moves the gap by about 2 nm, or the torque by 1e-4 of itself.
      double change = 0.0;
      const std::vector<MeshParameter> one{parameters[p]};
      for (const MeshPosition& at : model.positions) {
        const Gap gap = gaps.at(at.points, at.phase);
        change = std::max(change, ConditionSlopes(model, gaps, one).at(at, gap).gap.cwiseAbs().maxCoeff());
      }
      const double step = change > 0.0 ? 2e-6 / change : 1e-4 * scene.torque;
      const auto values = [&](double by) {
        Scene moved = scene;
        shift(moved, parameters[p], by);
        return outputs(model, moved, {}).values;
      };
      const Eigen::VectorXd once = (values(step) - values(-step)) / (2 * step);
      const Eigen::VectorXd twice = (values(2 * step) - values(-2 * step)) / (4 * step);
      const Eigen::VectorXd difference = (4.0 * once - twice) / 3.0;
      for (Eigen::Index i = 0; i < difference.size(); ++i) {
        const double exact = here.derivatives(i, column);
        const double scale = std::max(std::abs(exact), 1e-3 * std::abs(here.values[i]) / step);
        if (std::abs(once[i] - twice[i]) > 3e-5 * scale) {
          ++kinks;
          continue;
        }
        ++compared;
        if (std::abs(exact - difference[i]) / scale > worst) {
          worst = std::abs(exact - difference[i]) / scale;
          worst_output = here.names[static_cast<std::size_t>(i)] + " by parameter " + std::to_string(p);
        }
      }
    }
  }
  CAPTURE(helical, compared, kinks, worst_output);
  CHECK(worst <= kDiscretisation);
  CHECK(compared >= 10000);
  CHECK(10 * kinks <= compared);
}

TEST_CASE("Twice the torque on a perfect pair without Hertzian contact doubles loads, and derivatives know", "[core][load][gradient][closed-form]") {
  constexpr double kRoundOff = 1e-10;
  // Linear slices that all touch from the start: w = T dw/dT, f_t = T df_t/dT; load factor and stiffness stay.
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model =
      mesh_cases::model(gears, {{}, equally_spaced_phases(5)}, MeshEffects::all_but({"hertzian_contact", "extended_contact_region"}));
  const double torque = mesh_cases::torque_for(gears, 200);
  const LoadedCycle cycle = analyse_cycle(model, {}, torque, {PinionTorque{}});
  const CycleSummary summary = summarise(model, cycle);
  const CycleGradient gradient = summary_gradient(model, cycle, summary);
  CHECK(gradient.peak_line_load[0] * torque == Approx(summary.peak_line_load).epsilon(kRoundOff));
  CHECK(gradient.te_mean[0] * torque == Approx(summary.te_mean).epsilon(kRoundOff));
  CHECK(gradient.te_peak_to_peak[0] * torque == Approx(summary.te_peak_to_peak).epsilon(kRoundOff));
  CHECK(gradient.peak_contact_stress[0] * torque == Approx(0.5 * summary.peak_contact_stress).epsilon(kRoundOff));
  CHECK(std::abs(gradient.load_factor[0] * torque) <= kRoundOff * summary.load_factor);
  CHECK(std::abs(gradient.mean_stiffness[0] * torque) <= kRoundOff * summary.mean_stiffness);
  CHECK(gradient.peak_root_stress.size() == 0);  // the model has none
}

TEST_CASE("Without torque the flanks follow the nearest point", "[core][load][gradient]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {0.3}});
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = 0.01;
  const std::vector<MeshParameter> parameters{&Misalignment::mesh_misalignment, PinionTorque{}};
  const LoadedCycle cycle = analyse_cycle(model, condition, 0.0, parameters);
  // f_t = min(g), and g is proportional to the misalignment.
  CHECK(cycle.positions[0].transmission_error_derivative[0] * 0.01 == Approx(cycle.positions[0].load.transmission_error).epsilon(1e-12));
  CHECK(cycle.positions[0].line_load_derivative.isZero(0.0));
}
