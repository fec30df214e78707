#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>
#include <vector>

#include "core/contact/gap/flank_touch_search.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// A parameter of the modification of one gear, or of its process [mm; parabolic_te 1/rad; twist_compensation -].
struct GearParameter {
  Member member{Member::Pinion};
  ModificationParameter parameter{};
};

/// The torque on the pinion [N mm].
struct PinionTorque {};

/// The parameters of derivatives of loaded contact: modifications, misalignment, torque.
using MeshParameter = std::variant<GearParameter, MisalignmentParameter, PinionTorque>;

/// How parameters enter the load problem of one mesh position.
struct ParameterSlopes {
  Eigen::MatrixXd gap;       ///< dg/dp, points x parameters; 0 for what moves the mesh, see MeshSlope
  Eigen::MatrixXd edge;      ///< d(distance of the tip edge)/dp likewise, see edge_moved_by(); of the points asked for, else 0; empty: of none
  Eigen::RowVectorXd force;  ///< dF/dp
};

/// The slopes of a condition at one position after another.
class ConditionSlopes {
 public:
  /// What is constant over the positions is computed once.
  /// @param model, gaps, parameters  must outlive this
  ConditionSlopes(const MeshModel& model, const ConditionGap& gaps, const std::vector<MeshParameter>& parameters);
  /// @param gap       as gaps has it at this position
  /// @param on_edges  the points whose edge matters
  ParameterSlopes at(const MeshPosition& at, const Gap& gap, const std::vector<Eigen::Index>& on_edges = {}) const;
  const std::vector<MeshParameter>& parameters() const { return parameters_; }

 private:
  const MeshModel& model_;
  const ConditionGap& gaps_;
  const std::vector<MeshParameter>& parameters_;
  std::vector<std::optional<TouchDerivative>> touches_;  ///< of gear parameters
};

/// Whether a parameter changes more than gap and force: it moves the mesh, see MeshPlacement.
bool moves_mesh(GapModel gap, const MeshParameter& parameter);
/// Their indices among the parameters.
std::vector<Eigen::Index> moving_among(GapModel gap, const std::vector<MeshParameter>& parameters);

}  // namespace flankwright
