#include "tests/hard_cases/scene_check.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/contact/path/path_of_contact.hpp"
#include "core/contact/unloaded/transmission_error.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/hard_cases/floating_point_traps.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::hard_cases {

namespace {

using studies::Study;

/// The first property that does not hold.
class Findings {
 public:
  void require(bool holds, const std::string& property, double value) {
    if (holds || first_) return;
    char digits[40];
    std::snprintf(digits, sizeof digits, ": %.6g", value);
    first_ = property + digits;
  }
  const std::optional<std::string>& first() const { return first_; }

 private:
  std::optional<std::string> first_;
};

/// How far modifications and errors may move a gear's flank anywhere [mm]: each formula is at most twice its amount within the active
/// profile, and up to four times that on the way down to the form circle. Dedendum crowning is an exception: its parabola has its amount
/// at the start of active profile, which may be close to the pitch point, and goes on to the form circle.
double largest_deviation(const GearPair& pair, Member member, const Modification& m, const ManufacturingError& e, double turned) {
  const Gear& gear = pair[member];
  const double dedendum = gear.working_pitch_radius - gear.active_root_radius;
  const double extents = dedendum > 0.0 ? std::max(1.0, (gear.working_pitch_radius - gear.form_radius) / dedendum) : 1.0;
  double amounts = std::abs(m.lead_crowning) + std::abs(m.lead_slope) + std::abs(m.addendum_crowning) +
                   std::abs(m.dedendum_crowning) * extents * extents + std::abs(m.profile_slope) + std::abs(m.twist) + std::abs(m.tip_relief.amount) +
                   std::abs(m.root_relief.amount) + std::abs(m.end_relief.amount) + std::abs(m.triangular_tip_relief.amount) +
                   std::abs(m.triangular_root_relief.amount) + std::abs(e.helix_slope) + std::abs(e.profile_slope) + std::abs(e.twist);
  for (const ModificationDescriptor& d : modification_parameters) {
    if (d.key.starts_with("topography.")) amounts += std::abs(d.get(m));
  }
  const double pitches = turned / (2.0 * units::pi / pair.data.pinion.teeth) + 2.0;
  return 8.0 * amounts + std::abs(e.pitch_step) * pitches + pair.wheel.base_radius * m.parabolic_te * turned * turned * 8.0;
}

/// Displacement of the flanks by misalignment [mm], to either side.
double largest_displacement(const GearPair& pair, const Misalignment& m) {
  const double reach = 2.0 * (pair.wheel.tip_radius + pair.pinion.tip_radius) + pair.wheel.data.face_width + pair.pinion.data.face_width;
  const double angles = std::abs(m.crossing) + std::abs(m.intersecting) + std::abs(m.pinion_lead_angle) + std::abs(m.pinion_pressure_angle);
  return angles * reach + std::abs(m.centre_distance) + std::abs(m.axial_offset) +
         std::abs(m.mesh_misalignment) * std::max(pair.pinion.data.face_width, pair.wheel.data.face_width) / pair.face_width;
}

void check_unloaded(const Study& study, const GearPair& pair, const FlankCondition& c, Findings& findings) {
  const FlankAssembly scene = assemble_flanks(pair, c);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, study.cycle.positions);
  if (mesh.missing > 0) return;
  // The pair's way through the mesh, and as much again for tips that touch early and late.
  const double turned = 2.0 * units::pi / pair.data.pinion.teeth * (pair.total_contact_ratio() + 2.0);
  const double largest = largest_deviation(pair, Member::Pinion, c.modification.pinion, c.error.pinion, turned) +
                         largest_deviation(pair, Member::Wheel, c.modification.wheel, c.error.wheel, turned) +
                         largest_displacement(pair, c.misalignment);
  // A tip that reaches below its mate's form circle may push the mate's flank away with nothing moved at all.
  const bool interferes = pair.pinion.fillet_interference || pair.wheel.fillet_interference;
  for (const double te : mesh.transmission_error) {
    findings.require(std::isfinite(te), "unloaded transmission error is a number [rad]", te);
    findings.require(interferes || std::abs(te) * pair.wheel.base_radius <= largest + 1e-9 * pair.centre_distance,
                     "unloaded transmission error within what moves the flanks [mm]", te * pair.wheel.base_radius);
  }
  for (const PairCurve& curve : mesh.pairs) {
    for (const ToothContact& contact : curve.positions) {
      if (!contact.exists()) continue;
      findings.require(std::isfinite(contact.slope), "slope of a pair's transmission error is a number", contact.slope);
      findings.require(std::isfinite(contact.pinion_radius + contact.wheel_radius + contact.pinion_z + contact.wheel_z),
                       "place of contact is a number [mm]", contact.pinion_radius);
    }
  }
  findings.require(std::isfinite(mesh.peak_to_peak) && mesh.peak_to_peak >= 0.0, "peak-to-peak of the transmission error [rad]", mesh.peak_to_peak);
}

/// How many tooth pairs' flanks can meet at all.
int pairs_that_meet(const GearPair& pair, const FlankCondition& c, double phase) {
  const FlankAssembly scene = assemble_flanks(pair, c);
  const PathOfContact path(pair);
  const ToothContactSolver solver(scene);
  int meeting = 0;
  for (int tooth = -1; tooth <= static_cast<int>(path.last_line_phase()) + 1; ++tooth) {
    if (solver.find(tooth, path.pinion_angle_at(phase, pair)).exists()) ++meeting;
  }
  return meeting;
}

void check_position(const MeshModel& model, const MeshPosition& at, const LoadedPosition& position, double force, const FlankCondition& condition,
                    Findings& findings) {
  const LoadDistribution& load = position.load;
  if (load.status == LoadStatus::NoContactPoints) {
    const int meeting = pairs_that_meet(model.pair, condition, at.phase);
    findings.require(meeting == 0, "without contact points no pair meets, meeting", meeting);
    return;
  }
  findings.require(load.usable(), "load distribution found, residual", load.kkt_residual);
  if (!load.usable()) return;
  findings.require(load.kkt_residual <= LoadOptions{}.tolerance, "residual of the optimality conditions", load.kkt_residual);
  findings.require(load.line_load.allFinite() && load.line_load.minCoeff() >= 0.0, "loads are numbers and none pulls [N/mm]",
                   load.line_load.minCoeff());
  findings.require(position.contact_stress.allFinite(), "contact stress is a number [MPa]", position.contact_stress.sum());
  findings.require(position.edge_stress.size() == 0 || (position.edge_stress.array() <= position.contact_stress.array()).all(),
                   "stress on edges is part of the contact stress [MPa]", position.edge_stress.sum());
  findings.require(std::abs(at.weight.dot(load.line_load) / force - 1.0) <= 1e-9, "forces balance the torque", at.weight.dot(load.line_load) / force);
  findings.require(std::isfinite(position.stiffness) && position.stiffness > 0.0, "mesh stiffness [N/(mm um)]", position.stiffness);
  findings.require(position.line_load_derivative.allFinite() && position.transmission_error_derivative.allFinite(), "derivatives are numbers", 0.0);
  Eigen::Index nearest = 0;
  const double touch = position.gap.total.minCoeff(&nearest);
  const ContactLaw law = *contact_law_in(model, at.points[static_cast<std::size_t>(nearest)], condition);
  const double alone = at.influence(nearest, nearest) * force + law.deflection(force / at.weight[nearest]);
  const double approach = load.transmission_error - touch, round_off = 1e-9 * (alone + std::abs(touch));
  findings.require(approach >= -round_off, "f_t beyond first touch [mm]", approach);
  findings.require(approach <= alone + round_off, "f_t within what one point alone yields [mm]", approach - alone);
}

void check_loaded(const Study& study, const GearPair& pair, const FlankCondition& condition, Findings& findings) {
  std::vector<MeshParameter> parameters;
  for (const studies::GradientParameter& p : study.gradients) parameters.push_back(p.parameter);
  const MeshPlaced placed = [&](const MeshPlacement& placement) {
    return make_mesh_model(pair, study.material, {study.fidelity.quadrature, equally_spaced_phases(study.cycle.positions)}, {}, placement);
  };
  const MeshModel model = with_perturbed_meshes(placed(MeshPlacement::of(study.fidelity.gap, condition.misalignment)), placed, parameters);
  for (const double torque : study.scenes.front().torques) {
    const LoadedCycle cycle = analyse_cycle(model, condition, torque, parameters);
    for (std::size_t i = 0; i < cycle.positions.size(); ++i)
      check_position(model, model.positions[i], cycle.positions[i], cycle.force, condition, findings);
    if (!cycle.usable()) continue;
    const CycleSummary summary = summarise(model, cycle);
    findings.require(std::isfinite(summary.peak_contact_stress) && std::isfinite(summary.te_mean), "summary is of numbers", summary.te_mean);
  }
}

}  // namespace

SceneVerdict examine(const std::string& text, const std::string& name) {
  Findings findings;
  try {
    const FloatingPointTraps traps;
    const Study study = studies::parse_study(text, name);
    const GearPair pair = make_gear_pair(study.pair);
    const studies::Scene& scene = study.scenes.front();
    const FlankCondition condition{study.modification, scene.error, scene.misalignment};
    check_unloaded(study, pair, condition, findings);
    check_loaded(study, pair, condition, findings);
  } catch (const InvalidInput& problem) {
    return {SceneVerdict::Refused, problem.what()};
  } catch (const std::exception& error) {
    return {SceneVerdict::Failed, std::string("thrown: ") + error.what()};
  }
  if (findings.first()) return {SceneVerdict::Failed, *findings.first()};
  return {SceneVerdict::Passed, ""};
}

std::string save_scene(const std::string& folder, const std::string& study, std::uint64_t seed, std::uint64_t index, const std::string& why) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = std::filesystem::path(folder) / ("scene-" + std::to_string(seed) + "-" + std::to_string(index) + ".toml");
  std::string reason = why;
  std::ranges::replace(reason, '\n', ' ');
  studies::write_whole(path, "# seed " + std::to_string(seed) + ", index " + std::to_string(index) + "\n# " + reason + "\n" + study);
  return path.string();
}

}  // namespace flankwright::hard_cases
