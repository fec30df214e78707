#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "core/contact/gap/condition_gap.hpp"
#include "core/load/solve/load_problem.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

/// Step between a mesh and its perturbed ones, for derivatives by a parameter that moves the mesh [m_n]: lengths by
/// this, angles by this over half the common face width, so that the flanks' ends move alike. The slope of a smooth f
/// over three of them is wrong by step^2 f'''/3, and by about four times the round-off of f over the step; that of
/// points of the whole surface is some 1e-10 mm. A point that comes to a tip edge or to the start of a linear relief
/// within two steps has a kink there, and its slope is then off by between -1/2 and all of the slope's jump: the
/// shorter the step, the fewer do. This was measured over 40,000 positions of a worked pair, against differences over
/// 2.5e-6 of a change that turns loads over, in parts of the peak load over that change: 20 are off by more than 1e-4,
/// of these 16 with a loaded point that near to a tip edge, by up to 0.16, and one on the start of an end relief, 0.31.
inline constexpr double mesh_step = 3e-5;
/// The same for one parameter [mm or rad].
double mesh_step_of(const GearPair& pair, MisalignmentParameter parameter);

/// The mesh at a placement.
using MeshPlaced = std::function<MeshModel(const MeshPlacement&)>;
/// A mesh with its perturbed ones, two for each of the parameters that move it, see MeshModel::perturbed.
/// @param mesh  builds a mesh like `model` at any placement
MeshModel with_perturbed_meshes(MeshModel model, const MeshPlaced& mesh, const std::vector<MeshParameter>& parameters);

/// @throws InvalidInput  where the model has no perturbed meshes along this parameter
const PerturbedMeshes& perturbed_meshes(const MeshModel& model, MisalignmentParameter parameter);
/// A condition with the wheel where a mesh has it.
FlankCondition placed_as(const MeshModel& mesh, MisalignmentParameter parameter, FlankCondition condition);

/// Slopes of one mesh position with a parameter that moves the mesh, at held loads, per mm or rad, following each point
/// of the mesh.
struct MeshSlope {
  Eigen::VectorXd gap;              ///< g [mm per unit]
  Eigen::VectorXd deflection;       ///< K a w + c(w) [mm per unit]
  double carried_force{0.0};        ///< a'w [N per unit]
  Eigen::VectorXd contact_stress;   ///< sigma_H [MPa per unit]
  Eigen::VectorXd peak_load;        ///< LoadedPosition::peak_load [N/mm per unit]
  Eigen::VectorXd edge_stress;      ///< on tip edges [MPa per unit]
  double edge_force{0.0};           ///< that tip roundings carry [N per unit]
  Eigen::VectorXd root_components;  ///< RootStressInfluence::components a w [MPa per unit]; empty without
};

/// Some parameters move the mesh itself (moves_mesh()): the axial offset cuts the common face elsewhere, and with GapModel::WholeSurface any misalignment
/// takes the points to where the flanks are then nearest. With the points go their weights, influence and contact laws: unlike other
/// parameters these change more than the gap. How, is read off three meshes, at the parameter itself and one and two steps beyond (second-order
/// one-sided difference); what loads then do follows exactly, by the same factorisation as for any other parameter (LoadSensitivity).
///
/// It is the derivative as the parameter grows: where two end faces are flush (as of equal gears without an offset) another end would be
/// cut off as the offset falls, and loads have a kink there. Points that enter or leave the extended region within two steps stay as they are: they carry
/// nothing, unless the study leaves that region out.
class MeshSlopes {
 public:
  /// @param model      must outlive this; made by with_perturbed_meshes()
  /// @throws InvalidInput  where the model has no perturbed meshes along the parameter
  MeshSlopes(const MeshModel& model, const FlankCondition& condition, MisalignmentParameter parameter);
  MeshSlopes(const MeshSlopes&) = delete;  // its gaps have its condition

  /// @param position  index into MeshModel::positions
  MeshSlope at(std::size_t position, const LoadDistribution& load) const;
  /// Of MeshModel::face_width, by the axial offset -1, 0, or 1 where it is negative and shrinks [mm per unit].
  double face_width() const;

 private:
  /// A perturbed mesh, in its own condition.
  struct Perturbed {
    Perturbed(const MeshModel& mesh, MisalignmentParameter parameter, const FlankCondition& of);
    const MeshModel& model;
    FlankCondition condition;
    ConditionGap gaps;
  };

  /// Their points that correspond to those of a position.
  struct Same {
    std::vector<Eigen::Index> one, two;
    Eigen::VectorXd known;  ///< 1 where both have the point, else 0
  };
  Same same(std::size_t position) const;

  const MeshModel& model_;
  ConditionGap gaps_;
  const PerturbedMeshes& perturbed_;
  Perturbed one_, two_;
};

/// For each point of a position its index in the perturbed position, by its order in its line; -1 where it has none.
std::vector<Eigen::Index> same_points(const MeshPosition& at, const MeshPosition& perturbed);

/// Values of perturbed points in the order of the position's points; 0 where there is none.
Eigen::VectorXd as_at(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values);
/// The other way round.
/// @param points  how many the perturbed position has
Eigen::VectorXd as_perturbed(const std::vector<Eigen::Index>& same, const Eigen::VectorXd& values, Eigen::Index points);

/// The slope at the first of three values, one step apart.
template <class T>
T forward_difference(const T& here, const T& one, const T& two, double step) {
  return (4.0 * (one - here) - (two - here)) / (2.0 * step);
}

}  // namespace flankwright
