#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/contact/gap/condition_gap.hpp"
#include "core/flank/relief_starts.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

/// A place on a line at which a relief of one gear begins: there the load has a kink between two points.
struct LineCrest {
  /// A point of the line with its weight in what is smooth along it.
  struct Point {
    Eigen::Index index{-1};
    double weight{0.0};
  };

  Member gear{Member::Pinion};
  std::size_t start{0};                     ///< of its ReliefStarts
  bool rises{false};                        ///< the relief lies towards rising z
  ContactPoint place{};                     ///< without a weight
  Eigen::Index before{-1};                  ///< it lies between this point and the next,
  double way{0.0};                          ///< at this part of the way to that, 0 .. 1
  std::array<double, 2> approach_shares{};  ///< in f_t there of what these two points approach by: they add up to 1
  double deflection{0.0};                   ///< f_t - g - s [mm]
  double seen_load{0.0};                    ///< w_s, what the points see there of the load [N/mm]
  double compliance{0.0};                   ///< kappa, of structure and contact to what they do not see, of either sign [mm^2/N]
  std::array<Point, 4> from{};
  std::size_t count{0};  ///< of these
};

/// Line load and pressure on a crest, and their derivatives by f_t - g - s + kappa w_s.
struct CrestLoad {
  double line_load{0.0}, pressure{0.0};                ///< [N/mm], [MPa]
  double load_by_deflection{0.0}, by_deflection{0.0};  ///< [N/mm^2], [MPa/mm]
};

/// Both gears' relief starts in a condition.
using PairReliefStarts = PerGear<ReliefStarts>;
PairReliefStarts relief_starts(const GearPair& pair, const FlankCondition& condition);

/// The lines of a position under load.
struct LoadedLines {
  const MeshModel& model;
  const MeshPosition& at;
  const ConditionGap& gaps;  ///< of the condition
  const PairReliefStarts& starts;
  const Gap& gap;                       ///< as gap_under() has it
  double force;                         ///< normal force of the mesh [N]
  const std::vector<ContactLaw>& laws;  ///< of the points, moved by the condition
  const Eigen::VectorXd& line_load;     ///< [N/mm]
  const Eigen::VectorXd& structural;    ///< K a w [mm]
};

/// The crests of a position's lines.
///
/// Where a linear relief begins the load has a kink, which no point of the quadrature meets. Its load w there is that of
///
///     c(w) + kappa (w - w_s) = f_t - g - s,
///
/// c the contact law, g the gap of the flanks there. What the structure yields, s, is smooth and is laid through the points of the line by
/// smooth_interpolation(), and so is the load w_s that they see; f_t is c + s + g of the loaded points on either side, so that loads which are held while
/// the mesh moves have a crest as well. What they do not see is a triangle between two points. It moves the structure by more than
/// its force spread out does: by as much as the points' own influence exceeds that on the next interval,
///
///     kappa = (K_own - K_next) (distance of the points along the line)/2 - e.
///
/// K_own is without what contact takes back on the diagonal for the law of an even load, e (ContactCouplingEffect), which is taken back of the load on the crest.
/// So much of e counts that half of the law's slope is left: under a heavy load contact alone may no longer rise with it, see ContactKernel. The derivatives
/// hold kappa, also where this limit moves with the load.
/// Where points yield each for itself (thin slices) it is what they yield per line load, K_ii a_i. Departure: flanks that touch where less has been taken
/// off, FlankTouchSearch, round the kink over R h' along the profile; the place taken is the end without relief.
///
/// There are none without contact laws, and none next to points that reach an edge, where the pressure has crests of its own.
std::vector<LineCrest> line_crests(const LoadedLines& lines);

/// The contact law is between those of the points on either side.
CrestLoad load_on_crest(const std::vector<ContactLaw>& laws, const LineCrest& crest);

/// Derivatives at a position's points, one column for each parameter.
struct PointSlopes {
  const Eigen::MatrixXd& line_load;
  const Eigen::MatrixXd& gap;  ///< ParameterSlopes::gap
};

/// Derivatives of LineCrest by parameters, a row for each crest.
struct CrestSlopes {
  Eigen::MatrixXd deflection;      ///< of f_t - g - s + kappa w_s with the place held; of what moves the mesh without its motion, see MeshSlope
  Eigen::MatrixXd load, pressure;  ///< what the motion of the place adds to those of CrestLoad
};
/// Extents of reliefs and what moves the wheel along the profile take the place along.
/// @param condition  of the lines
CrestSlopes crest_slopes(const LoadedLines& lines, const std::vector<LineCrest>& crests, const PointSlopes& slopes, const ConditionSlopes& condition);

}  // namespace flankwright
