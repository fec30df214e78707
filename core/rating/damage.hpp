#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"
#include "core/rating/operation.hpp"
#include "core/rating/sn_curve.hpp"

namespace flankwright {

/// The S-N curves of one gear's material; empty: not known.
struct FatigueStrength {
  std::optional<SnCurve> contact;  ///< of the largest contact pressure at a point of the flank
  std::optional<SnCurve> root;     ///< of the largest principal stress at a point of the fillet
};

/// One load case of a spectrum. All load cases of a spectrum have the same mesh model.
struct SpectrumCase {
  const LoadedCycle* cycle{nullptr};  ///< usable()
  Operation operation{};              ///< its revolutions, how often teeth are loaded in each, and its load factors
};
using LoadSpectrum = std::vector<SpectrumCase>;

/// A sum of damage and its derivatives with respect to the parameters of the cycles.
struct DamageSum {
  double value{0.0};            ///< [-]; 1: failure is expected
  Eigen::RowVectorXd gradient;  ///< 1 x m; empty where a cycle has no derivatives
};

/// Damage of the flank of one gear at every contact point of one mesh position, by Palmgren's and Miner's rule over the load cases k of a
/// spectrum [ISO 6336-6:2006, 4.2],
///
///     D = sum_k n_k / N(sigma_k),     n_k = load cycles of the gear's teeth
///
/// with the local contact stress there, times sqrt(K_A K_v), as sigma_k. A line of contact passes a point of the flank once in a revolution, at one phase and on one tooth pair: the
/// points of all positions of a cycle are different points of the flank, and the stress of a point in all load cases stands at the same index.
Eigen::VectorXd contact_damage(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, std::size_t position);
/// The same at one point, with its derivatives.
DamageSum contact_damage_at(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, std::size_t position,
                            Eigen::Index point);

/// Points of one gear's fillet as all its teeth have them: the stations of one tooth at one position, in their order.
struct FilletPoints {
  Eigen::Index count{0};
  /// A tooth at a mesh position, and the index of its first point among RootStressInfluence::stations.
  struct Pass {
    std::size_t position;
    Eigen::Index begin;
  };
  std::vector<Pass> passes;
};
FilletPoints fillet_points(const MeshModel& model, Member member);

/// Damage of one gear's root at every point of its fillet. A tooth that passes through the mesh has one load cycle, of the largest stress at that point over all
/// positions and teeth, times K_A K_v; the stress between teeth in mesh counts as none, and compression on the way is left out.
/// @throws std::runtime_error where a cycle has no root stress
Eigen::VectorXd root_damage(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, const FilletPoints& points);
/// The same at one point; the derivative of a largest stress is that of the position where it is.
DamageSum root_damage_at(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, const FilletPoints& points,
                         Eigen::Index point);

}  // namespace flankwright
