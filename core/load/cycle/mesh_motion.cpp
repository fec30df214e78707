#include "core/load/cycle/mesh_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/line_crest.hpp"

namespace flankwright {

namespace {

/// The values whose slope is MeshSlope, for the points of a position in a perturbed mesh.
struct HeldLoads {
  Eigen::VectorXd gap, deflection, contact_stress, peak_load, edge_stress, root_components;
  double force, edge_force{0.0};
};

/// @param force  of the mesh, under which the gap is
/// @param load  of all points
HeldLoads held_loads(const MeshModel& model, const MeshPosition& at, const ConditionGap& gaps, double force, const Eigen::VectorXd& load) {
  const Gap gap = gap_under(at, gaps, force);
  const PairReliefStarts starts = relief_starts(model.pair, gaps.condition());
  const Eigen::VectorXd forces = at.weight.cwiseProduct(load);
  const Eigen::VectorXd structural = at.influence * forces;
  HeldLoads held{gap.total, structural, Eigen::VectorXd(load.size()), load, Eigen::VectorXd(load.size()), {}, forces.sum()};
  if (!at.root_stress.stations.empty()) held.root_components = at.root_stress.components(forces);
  const std::vector<ContactLaw> moved_edges = laws_with_moved_edges(at, gap, load);
  const std::vector<ContactLaw>& laws = moved_edges.empty() ? at.laws : moved_edges;
  const std::vector<PointPeaks> peaks =
      point_peaks(model, at, laws, load, line_crests({model, at, gaps, starts, gap, force, laws, load, structural}));
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!laws.empty()) held.deflection[i] += laws[k].deflection(load[i]);
    held.contact_stress[i] = peaks[k].stress.value;
    held.peak_load[i] = peaks[k].load.value;
    held.edge_stress[i] = peaks[k].on_edge.value;
    held.edge_force += at.weight[i] * peaks[k].edge_load.load;
  }
  return held;
}

}  // namespace

double mesh_step_of(const GearPair& pair, MisalignmentParameter parameter) {
  const double length = mesh_step * pair.data.normal_module;
  const MisalignmentParameter angles[] = {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::pinion_lead_angle,
                                          &Misalignment::pinion_pressure_angle};
  return std::ranges::find(angles, parameter) == std::end(angles) ? length : length / (0.5 * pair.face_width);
}

MeshModel with_perturbed_meshes(MeshModel model, const MeshPlaced& mesh, const std::vector<MeshParameter>& parameters) {
  model.perturbed.clear();
  for (const Eigen::Index p : moving_among(model.placement.gap, parameters)) {
    const auto parameter = std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]);
    if (std::ranges::find(model.perturbed, parameter, &PerturbedMeshes::parameter) != model.perturbed.end()) continue;
    PerturbedMeshes along{parameter, mesh_step_of(model.pair, parameter), {}};
    for (int steps : {1, 2}) {
      MeshPlacement perturbed = model.placement;
      perturbed.misalignment.*parameter += steps * along.step;
      along.meshes.push_back(mesh(perturbed));
    }
    model.perturbed.push_back(std::move(along));
  }
  return model;
}

const PerturbedMeshes& perturbed_meshes(const MeshModel& model, MisalignmentParameter parameter) {
  const auto found = std::ranges::find(model.perturbed, parameter, &PerturbedMeshes::parameter);
  if (found == model.perturbed.end()) {
    throw InvalidInput("misalignment." + std::string(name_of(parameter)), "a derivative", "a model with perturbed meshes along it");
  }
  return *found;
}

FlankCondition placed_as(const MeshModel& mesh, MisalignmentParameter parameter, FlankCondition condition) {
  condition.misalignment.*parameter = mesh.placement.misalignment.*parameter;
  return condition;
}

Eigen::VectorXd as_at(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values) {
  Eigen::VectorXd sorted = Eigen::VectorXd::Zero(std::ssize(same));
  for (Eigen::Index i = 0; i < sorted.size(); ++i) {
    if (const Eigen::Index k = same[static_cast<std::size_t>(i)]; k >= 0) sorted[i] = values[k];
  }
  return sorted;
}

Eigen::VectorXd as_perturbed(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values, Eigen::Index points) {
  Eigen::VectorXd sorted = Eigen::VectorXd::Zero(points);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (const Eigen::Index k = same[static_cast<std::size_t>(i)]; k >= 0) sorted[k] = values[i];
  }
  return sorted;
}

std::vector<Eigen::Index> same_points(const MeshPosition& at, const MeshPosition& perturbed) {
  const std::vector<ContactPoint>&from = at.points, &to = perturbed.points;
  std::vector<Eigen::Index> same(from.size(), -1);
  const auto end_of_line = [](const std::vector<ContactPoint>& points, std::size_t begin) {
    std::size_t end = begin;
    while (end < points.size() && points[end].tooth == points[begin].tooth) ++end;
    return end;
  };
  for (std::size_t begin = 0, end = 0, other = 0; begin < from.size(); begin = end) {
    end = end_of_line(from, begin);
    while (other < to.size() && to[other].tooth < from[begin].tooth) ++other;
    if (other == to.size() || to[other].tooth != from[begin].tooth) continue;
    // Where a line has gained or lost points it did so at one of its ends.
    const std::ptrdiff_t more = static_cast<std::ptrdiff_t>(end_of_line(to, other) - other) - static_cast<std::ptrdiff_t>(end - begin);
    const std::size_t skipped = more < 0 ? static_cast<std::size_t>(-more) : 0, added = more > 0 ? static_cast<std::size_t>(more) : 0;
    const bool at_start = std::abs(to[other + added].z - from[begin + skipped].z) < std::abs(to[other].z - from[begin].z);
    const std::size_t first = begin + (at_start ? skipped : 0), last = end - (at_start ? 0 : skipped);
    for (std::size_t i = first; i < last; ++i) same[i] = static_cast<Eigen::Index>(other + (at_start ? added : 0) + (i - first));
  }
  return same;
}

MeshSlopes::Perturbed::Perturbed(const MeshModel& mesh, MisalignmentParameter parameter, const FlankCondition& of)
    : model(mesh), condition(placed_as(mesh, parameter, of)), gaps(mesh.pair, mesh.placement.gap, condition) {}

MeshSlopes::MeshSlopes(const MeshModel& model, const FlankCondition& condition, MisalignmentParameter parameter)
    : model_(model),
      gaps_(model.pair, model.placement.gap, condition),
      perturbed_(perturbed_meshes(model, parameter)),
      one_(perturbed_.meshes[0], parameter, condition),
      two_(perturbed_.meshes[1], parameter, condition) {}

MeshSlopes::Same MeshSlopes::same(std::size_t position) const {
  const MeshPosition& here = model_.positions[position];
  Same both{same_points(here, one_.model.positions[position]), same_points(here, two_.model.positions[position]),
            Eigen::VectorXd::Ones(here.weight.size())};
  for (std::size_t i = 0; i < here.points.size(); ++i) {
    if (both.one[i] < 0 || both.two[i] < 0) both.known[static_cast<Eigen::Index>(i)] = 0.0;
  }
  return both;
}

MeshSlope MeshSlopes::at(std::size_t position, const LoadDistribution& load) const {
  const Same same_as = same(position);
  const Eigen::VectorXd loads = load.line_load.cwiseProduct(same_as.known);
  const double force = model_.positions[position].weight.dot(load.line_load);
  const auto perturbed = [&](const Perturbed& mesh, const std::vector<Eigen::Index>& same) {
    const MeshPosition& there = mesh.model.positions[position];
    HeldLoads held = held_loads(mesh.model, there, mesh.gaps, force, as_perturbed(same, loads, there.weight.size()));
    for (Eigen::VectorXd* values : {&held.gap, &held.deflection, &held.contact_stress, &held.peak_load, &held.edge_stress})
      *values = as_at(same, *values);
    return held;
  };
  const HeldLoads here = held_loads(model_, model_.positions[position], gaps_, force, loads);
  const HeldLoads one = perturbed(one_, same_as.one), two = perturbed(two_, same_as.two);
  const auto slope = [&](Eigen::VectorXd HeldLoads::*what) -> Eigen::VectorXd {
    return forward_difference(here.*what, one.*what, two.*what, perturbed_.step).cwiseProduct(same_as.known);
  };
  MeshSlope by{slope(&HeldLoads::gap),
               slope(&HeldLoads::deflection),
               forward_difference(here.force, one.force, two.force, perturbed_.step),
               slope(&HeldLoads::contact_stress),
               slope(&HeldLoads::peak_load),
               slope(&HeldLoads::edge_stress),
               forward_difference(here.edge_force, one.edge_force, two.edge_force, perturbed_.step),
               {}};
  by.root_components = Eigen::VectorXd::Zero(here.root_components.size());
  if (here.root_components.size() == one.root_components.size() && here.root_components.size() == two.root_components.size()) {
    by.root_components = forward_difference(here.root_components, one.root_components, two.root_components, perturbed_.step);
  }
  return by;
}

double MeshSlopes::face_width() const { return forward_difference(model_.face_width, one_.model.face_width, two_.model.face_width, perturbed_.step); }

}  // namespace flankwright
