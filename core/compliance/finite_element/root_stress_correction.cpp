#include "core/compliance/finite_element/root_stress_correction.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "core/compliance/finite_element/quadratic_edge.hpp"

namespace flankwright {
namespace {

/// Stress along a section's fillet, as FilletStress takes it: at two points of every edge, with cubic splines between them.
class SectionFillet {
 public:
  explicit SectionFillet(const LoadedSection& section) : section_(section) {
    double begin = 0;
    std::vector<double> arcs;
    for (const SectionEdge& edge : section.loaded_tooth().fillet) {
      for (const double x : gauss2_abscissae) arcs.push_back(begin + arc_length(nodes(edge), x));
      begin += arc_length(nodes(edge), 1);
    }
    length_ = begin;
    arcs_.emplace(std::move(arcs));
  }

  double length() const { return length_; }

  /// Under every column of displacements, at a distance along the fillet from its start.
  Eigen::RowVectorXd stress(double along, const Eigen::MatrixXd& displacements) const {
    const Eigen::VectorXd weights = arcs_->weights(along);
    Eigen::RowVectorXd stress = Eigen::RowVectorXd::Zero(displacements.cols());
    Eigen::Index point = 0;
    for (const SectionEdge& edge : section_.loaded_tooth().fillet) {
      for (const double x : gauss2_abscissae) {
        const Eigen::Vector3d slopes = EdgeShape(x).derivatives;
        const Eigen::Vector2d tangent = nodes(edge) * slopes;
        for (int i = 0; i < 3; ++i) {
          const Eigen::Vector2d share = weights[point] * slopes[i] / tangent.squaredNorm() * tangent;
          stress += share.transpose() * displacements.middleRows<2>(2 * edge[static_cast<std::size_t>(i)]);
        }
        ++point;
      }
    }
    return stress / (1 - section_.poissons_ratio * section_.poissons_ratio);
  }

  /// Position and unit tangent, downwards.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> at(double along) const {
    const auto& edges = section_.loaded_tooth().fillet;
    double begin = 0;
    for (const SectionEdge& edge : edges) {
      const double size = arc_length(nodes(edge), 1);
      if (along <= begin + size || &edge == &edges.back()) {
        const double x = std::min(1.0, 2 * (along - begin) / size - 1);  // elements are all but evenly long in x
        const EdgeShape shape(x);
        return {nodes(edge) * shape.values, (nodes(edge) * shape.derivatives).normalized()};
      }
      begin += size;
    }
    assert(false);
    return {};
  }

 private:
  EdgeNodes nodes(const SectionEdge& edge) const { return edge_nodes(section_.mesh, edge); }

  const LoadedSection& section_;
  double length_{0};
  std::optional<SplineAxis> arcs_;  ///< of the points
};

/// (s_tt, s_aa, s_ta) of a unit stress across a helical tooth with nu along it. The tooth's direction in the fillet is -sin(delta) t + cos(delta) a.
/// @param tangent  in the section across the tooth
Eigen::Vector3d across_tooth(const Eigen::Vector2d& tangent, double radius_share, double helix_angle, double nu) {
  const double steepness =
      std::atan2(std::abs(tangent.x()), std::abs(tangent.y()) * std::cos(helix_angle));  // of the transverse tangent against the centre line
  const double helix = std::atan(radius_share * std::tan(helix_angle));
  const double sine = std::sin(helix) * std::sin(steepness), cosine = std::sqrt(1 - sine * sine);
  return {cosine * cosine + nu * sine * sine, sine * sine + nu * cosine * cosine, (1 - nu) * sine * cosine};
}

/// Part of what a point load adds, from the middle up to t along z.
double spread(double t, double distance) { return t / (2 * std::sqrt(distance * distance + t * t)); }

}  // namespace

RootStressCorrection::RootStressCorrection(const LoadedSection& fine, const LoadedSection& as_table, const Gear& gear, const GearPair& pair,
                                           const FilletGrid& fillet) {
  const SectionFillet exact(fine), coarse(as_table);
  const std::vector<double> heights(section_heights.begin(), section_heights.end());
  const double helix_angle = std::abs(pair.data.helix_angle), module = pair.data.normal_module;
  for (const double along : fillet.along) {
    const double arc = along * coarse.length();  // both fillets start alike, but end where their elements do
    const Eigen::RowVectorXd by_line = exact.stress(arc, fine.by_flank), by_patches = exact.stress(arc, fine.by_patch),
                             by_table = coarse.stress(arc, as_table.by_patch);
    const double factor = by_patches.dot(by_table) / by_table.squaredNorm();
    const auto [position, tangent] = exact.at(arc);
    std::vector<double> added, distance;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      added.push_back(by_line[k] - factor * by_table[k]);
      distance.push_back((fine.places[i].position - position).norm());
    }
    places_.push_back({factor, NaturalSpline(heights, added), NaturalSpline(heights, distance),
                       across_tooth(tangent, 1 + (position.norm() - fine.form.reference_radius()) * module / gear.reference_radius, helix_angle,
                                    fine.poissons_ratio)});
  }
}

Eigen::MatrixXd RootStressCorrection::added(const FilletGrid& fillet, const std::vector<FlankStation>& forces, const std::vector<double>& lengths,
                                            double slant) const {
  assert(places_.size() == fillet.along.size() && forces.size() == lengths.size());
  const double face = fillet.zetas.back();
  Eigen::MatrixXd result(fillet.size(), std::ssize(forces));
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const double height = std::clamp((forces[k].u + 1) / 2, section_heights.front(), section_heights.back()), half = lengths[k] * slant / 2;
    Eigen::Index row = 0;
    for (const Place& place : places_) {
      const double per_force = place.added(height) / lengths[k], distance = place.distance(height);
      for (const double zeta : fillet.zetas) {
        double share = 0;
        for (const double centre : {forces[k].zeta, -forces[k].zeta, 2 * face - forces[k].zeta}) {
          share += spread(centre + half - zeta, distance) - spread(centre - half - zeta, distance);
        }
        result(row++, static_cast<Eigen::Index>(k)) = per_force * share;
      }
    }
  }
  return result;
}

RootStressTable RootStressCorrection::scaled(RootStressTable table) const {
  const auto across = 3 * std::ssize(table.fillet.zetas);
  for (Eigen::MatrixXd& stress : table.stress) {
    for (std::size_t i = 0; i < places_.size(); ++i) stress.middleRows(static_cast<Eigen::Index>(i) * across, across) *= places_[i].factor;
  }
  return table;
}

}  // namespace flankwright
