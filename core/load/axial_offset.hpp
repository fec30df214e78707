#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "core/contact/condition_gap.hpp"
#include "core/load/load_problem.hpp"
#include "core/load/mesh_model.hpp"

namespace flankwright {

/// How far apart the meshes lie that derivatives with respect to the axial offset are taken from [m_n]. The slope of a smooth f over three
/// of them is wrong by step^2 f'''/3, and by about four times the round-off of f over the step.
inline constexpr double offset_step = 1e-4;

/// The mesh at a placement.
using MeshPlaced = std::function<MeshModel(const MeshPlacement&)>;
/// The same with what a derivative with respect to the axial offset needs, MeshModel::further.
MeshModel with_further_offsets(const MeshPlaced& mesh, const MeshPlacement& placement);

/// The mesh with the wheel one (0) or two (1) steps further along.
/// @throws InvalidInput  where the model knows no further offsets
const MeshModel& further_mesh(const MeshModel& model, std::size_t which);
/// A condition with the wheel where a mesh has it.
FlankCondition placed_as(const MeshModel& mesh, FlankCondition condition);

/// What the axial offset changes at one mesh position while loads are held, per mm of offset, following each point of the mesh.
struct OffsetSlope {
  Eigen::VectorXd gap;              ///< g [mm/mm]
  Eigen::VectorXd deflection;       ///< K a w + c(w) [mm/mm]
  double carried_force{0.0};        ///< a'w [N/mm]
  Eigen::VectorXd relative_radius;  ///< R [mm/mm]
  Eigen::VectorXd root_components;  ///< RootStressInfluence::components a w [MPa/mm]; empty without
};

/// The axial offset moves the common face, and with it the points, their weights, influence and contact laws: unlike other
/// parameters it changes more than the gap. How, is read off three meshes, at the offset itself and one and two steps beyond (second-order
/// one-sided difference); what loads then do follows exactly, by the same factorisation as for any other parameter (LoadSensitivity).
///
/// It is the derivative as the offset grows: where two end faces are flush (as of equal gears without an offset) another end would be
/// cut off as it falls, and loads have a kink there. Points that enter or leave the extended region within two steps stay as they are: they carry
/// nothing, unless the study leaves that region out.
class OffsetSlopes {
 public:
  /// @param model, condition  must outlive this; the model made by with_further_offsets()
  /// @throws InvalidInput  where the model knows no further offsets
  OffsetSlopes(const MeshModel& model, const FlankCondition& condition);

  /// @param position  index into MeshModel::positions
  OffsetSlope at(std::size_t position, const LoadDistribution& load, const Gap& gap) const;
  /// Of MeshModel::face_width [-]: -1, 0, or 1 where the offset is negative and shrinks.
  double face_width() const;
  /// Of the length of all contact lines between A and E, over all positions, relative [1/mm].
  double relative_line_length() const;

 private:
  /// A further mesh, in the condition that belongs to it.
  struct Further {
    Further(const MeshModel& mesh, const FlankCondition& of);
    const MeshModel& model;
    FlankCondition condition;
    ConditionGap gaps;
  };

  /// Which of their points those of a position are.
  struct Same {
    std::vector<Eigen::Index> one, two;
    Eigen::VectorXd known;  ///< 1 where both have the point, else 0
  };
  Same same(std::size_t position) const;
  double step() const;  ///< [mm]

  const MeshModel& model_;
  Further one_, two_;
};

/// Which point of the further position each point of a position is, by its place in its line; -1 where it is none of them.
std::vector<Eigen::Index> same_points(const MeshPosition& at, const MeshPosition& further);

/// Values of further points that are those of a position, by the position's numbers; 0 where there is none.
Eigen::VectorXd as_at(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values);
/// The other way round.
/// @param points  how many the further position has
Eigen::VectorXd as_further(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values, Eigen::Index points);

/// The slope at the first of three values, one step apart.
template <class T>
T first_slope(const T& here, const T& one, const T& two, double step) {
  return (4.0 * (one - here) - (two - here)) / (2.0 * step);
}

}  // namespace flankwright
