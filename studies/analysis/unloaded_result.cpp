#include "studies/analysis/unloaded_result.hpp"

#include <algorithm>
#include <cmath>

#include "core/flank/revolution_tool.hpp"

namespace flankwright::studies {

namespace {

constexpr int pattern_rows = 33, pattern_columns = 49;  // of a bearing pattern, over radius and face width
constexpr double shared_lead = 1e-12;                   // rad: mesh TE - pair TE <= shared_lead, the round-off of the angles

/// Change of radius and z in a gear's frame along a direction in the tangent plane.
FlankDirection seen_in(const Eigen::Matrix3d& axes, const Eigen::Vector3d& centre, const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d p = axes.transpose() * (point - centre), v = axes.transpose() * direction;
  return {p.head<2>().normalized().dot(v.head<2>()), v.z()};
}

ContactMark mark_of(const FlankAssembly& scene, const ToothContact& contact, double marking_thickness) {
  ContactMark mark;
  mark.ellipse = contact_ellipse(scene, contact, marking_thickness);
  if (std::isnan(mark.ellipse.semi_minor)) return mark;
  const double rotation = contact.phi1 + contact.tooth * 2.0 * units::pi / scene.pinion_teeth;
  const SurfacePoint at = surface_point(scene.pinion, scene.pinion.roll_at(contact.pinion_radius), contact.pinion_z, contact.tooth, rotation);
  const auto on_both = [&](double d_rho, double d_z, FlankDirection& pinion, FlankDirection& wheel) {
    const Eigen::Vector3d direction = d_rho * at.d_rho + d_z * at.d_z;
    pinion = seen_in(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), at.position, direction);
    wheel = seen_in(scene.wheel_axes, scene.wheel_centre, at.position, direction);
  };
  on_both(mark.ellipse.major_d_rho, mark.ellipse.major_d_z, mark.pinion_major, mark.wheel_major);
  on_both(mark.ellipse.minor_d_rho, mark.ellipse.minor_d_z, mark.pinion_minor, mark.wheel_minor);
  return mark;
}

/// The mesh's transmission error at an angle of its list.
double mesh_te_at(const UnloadedMesh& mesh, double phi1) {
  const auto found = std::lower_bound(mesh.phi1.begin(), mesh.phi1.end(), phi1);
  return found == mesh.phi1.end() ? not_given : mesh.transmission_error[static_cast<std::size_t>(found - mesh.phi1.begin())];
}

/// a of the parabola that was designed into the pair [1/rad]; 0 where none was.
double wanted_parabola(const GearPair& pair, const FlankCondition& condition) {
  double a = condition.modification.pinion.parabolic_te + condition.modification.wheel.parabolic_te;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const auto* tool = std::get_if<RevolutionTool>(&pair.data[member].generation);
    if (tool != nullptr) a += parabola_of_arc(pair, member, tool->arc_radius);
  }
  return a;
}

ParabolaCheck judged_parabola(const FlankAssembly& scene, const UnloadedMesh& mesh, double wanted) {
  constexpr std::size_t fewest_positions = 4;  // three numbers are fitted
  if (mesh.phi1.size() >= fewest_positions) return check_parabola(scene, mesh, wanted);
  ParabolaCheck check;
  check.wanted = wanted;
  check.why = "fewer than four mesh positions do not determine it";
  return check;
}

/// One name of a sequence and the next, equal neighbours once.
void append_kind(std::string& sequence, std::string& last, const ToothContact& contact) {
  if (!contact.exists() || last == to_string(contact.kind)) return;
  last = to_string(contact.kind);
  sequence.append(sequence.empty() ? "" : ", ").append(last);
}

}  // namespace

UnloadedResult analyse_unloaded(const GearPair& of_study, const std::string& scene, const FlankCondition& condition, int positions,
                                double marking_thickness) {
  const GearPair pair = condition.other_flanks ? of_study.on_other_flanks() : of_study;
  const FlankAssembly placed = assemble_flanks(pair, condition);
  UnloadedResult result;
  result.scene = scene;
  result.marking_thickness = marking_thickness;
  result.mesh = analyse_unloaded_mesh(pair, placed, positions);
  for (const PairCurve& curve : result.mesh.pairs) {
    std::vector<ContactMark>& marks = result.marks.emplace_back();
    for (const ToothContact& contact : curve.positions) {
      marks.push_back(mark_of(placed, contact, marking_thickness));
      marks.back().carries = mesh_te_at(result.mesh, contact.phi1) - contact.transmission_error <= shared_lead;
    }
  }
  result.pinion_pattern = bearing_pattern(placed, result.mesh, Member::Pinion, pattern_rows, pattern_columns);
  result.wheel_pattern = bearing_pattern(placed, result.mesh, Member::Wheel, pattern_rows, pattern_columns);
  const double wanted = wanted_parabola(pair, condition);
  if (wanted > 0.0) result.parabola = judged_parabola(placed, result.mesh, wanted);
  return result;
}

std::string contact_sequence(const PairCurve& curve) {
  std::string sequence, last;
  for (const ToothContact& contact : curve.positions) append_kind(sequence, last, contact);
  return sequence;
}

std::string whole_sequence(const UnloadedResult& result, int pinion_teeth, bool carrying) {
  struct Step {
    double turned;  ///< of the pair since it was at the pitch point [rad of the pinion]
    const ToothContact* contact;
  };
  std::vector<Step> steps;
  for (std::size_t i = 0; i < result.mesh.pairs.size(); ++i) {
    const PairCurve& curve = result.mesh.pairs[i];
    for (std::size_t j = 0; j < curve.positions.size(); ++j) {
      if (carrying && !result.marks[i][j].carries) continue;
      steps.push_back({curve.positions[j].phi1 + curve.tooth * 2.0 * units::pi / pinion_teeth, &curve.positions[j]});
    }
  }
  std::stable_sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.turned < b.turned; });
  std::string sequence, last;
  for (const Step& step : steps) append_kind(sequence, last, *step.contact);
  return sequence;
}

}  // namespace flankwright::studies
