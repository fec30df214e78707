#include "core/rating/edge_contact_start.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace flankwright {

namespace {

/// The model at one of its positions, without what contact does not need.
MeshModel at_position(const MeshModel& model, std::size_t position) {
  const MeshPosition& at = model.positions[position];
  return {.pair = model.pair,
          .material = model.material,
          .effects = model.effects,
          .placement = model.placement,
          .axial_offset = model.axial_offset,
          .face_width = model.face_width,
          .contact_modulus = model.contact_modulus,
          .calibration = model.calibration,
          .iso = model.iso,
          .couples_points = model.couples_points,
          .positions = {{.phase = at.phase,
                         .points = at.points,
                         .weight = at.weight,
                         .influence = at.influence,
                         .laws = at.laws,
                         .outside = at.outside,
                         .shaft_compliance = at.shaft_compliance}}};
}

/// A position at which an edge is touched.
struct Touched {
  std::size_t position;
  double stress;  ///< the largest of a strip that reaches an edge; of a sharp one that of the flank [MPa]
};

/// Nothing where no edge of the gear is touched.
std::optional<Touched> touched(const MeshPosition& at, const LoadedPosition& loaded, std::size_t position, Member of) {
  std::optional<Touched> found;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    if (at.points[i].tip_edge.gear != of) continue;
    const double stress = loaded.contact_stress[static_cast<Eigen::Index>(i)];
    if ((!found || stress > found->stress) && reaches_tip_edge(at, loaded, i)) found = {position, stress};
  }
  return found;
}

}  // namespace

bool reaches_tip_edge(const MeshPosition& at, const LoadedPosition& loaded, std::size_t point) {
  const double load = loaded.load.line_load[static_cast<Eigen::Index>(point)];
  if (at.laws.empty() || !at.laws[point].edge() || !(load > 0.0)) return false;
  return at.laws[point].with_edge_moved(edge_moved_by(at.points[point], loaded.gap.touches[point])).reaches_edge(load);
}

bool reaches_tip_edge(const MeshModel& model, const LoadedCycle& cycle) {
  for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
    const MeshPosition& at = model.positions[p];
    if (!cycle.positions[p].load.usable()) continue;
    for (std::size_t i = 0; i < at.points.size(); ++i) {
      if (reaches_tip_edge(at, cycle.positions[p], i)) return true;
    }
  }
  return false;
}

std::optional<EdgeContactStart> edge_contact_start(const MeshModel& model, const FlankCondition& condition, double pinion_torque, Member of,
                                                   double earlier_than) {
  const double close = 1e-3 * pinion_torque;
  const double whole = std::min(pinion_torque, earlier_than - close);
  if (!(whole > 0.0)) return std::nullopt;
  const LoadedCycle cycle = analyse_cycle(model, condition, whole, {}, RootStresses::Later);
  std::vector<Touched> candidates;
  if (cycle.usable()) {
    for (std::size_t p = 0; p < cycle.positions.size(); ++p) {
      if (const auto found = touched(model.positions[p], cycle.positions[p], p, of)) candidates.push_back(*found);
    }
  }
  if (candidates.empty()) return std::nullopt;
  std::ranges::stable_sort(candidates, std::greater(), &Touched::stress);

  // Positions that no edge touches at some torque are out of the question below it.
  EdgeContactStart start{whole, of, model.positions[candidates.front().position].phase};
  for (const Touched& candidate : candidates) {
    const MeshModel one = at_position(model, candidate.position);
    const auto touches = [&](double torque) {
      const LoadedCycle there = analyse_cycle(one, condition, torque, {}, RootStresses::Later);
      return there.usable() && touched(one.positions[0], there.positions[0], candidate.position, of).has_value();
    };
    double without = 0.0, torque = start.torque;
    // The first is known to touch at this torque, the others have to do so earlier than those before them.
    if (&candidate != &candidates.front()) torque -= close;
    if (!(torque > 0.0)) break;
    if (&candidate != &candidates.front() && !touches(torque)) continue;
    while (torque - without > close) {
      const double between = 0.5 * (without + torque);
      if (touches(between)) {
        torque = between;
      } else {
        without = between;
      }
    }
    start = {without == 0.0 ? 0.0 : torque, of, one.positions[0].phase};
  }
  return start;
}

EdgeContactStart edge_contact_start_near(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, EdgeContactStart start,
                                         double spacing) {
  constexpr int parts = 4;
  constexpr double close = 1.0 / 512.0;  // base pitches: phases lie closer than that in the end
  for (; spacing > close; spacing /= parts) {
    std::vector<double> phases;
    for (int k = 1 - parts; k < parts; ++k) {
      const double phase = start.phase + spacing * k / parts;
      if (k != 0) phases.push_back(phase - std::floor(phase));
    }
    std::ranges::sort(phases);
    if (const auto beside = edge_contact_start(mesh_at(phases), condition, pinion_torque, start.gear, start.torque)) start = *beside;
  }
  return start;
}

}  // namespace flankwright
