#pragma once

#include <array>
#include <concepts>
#include <vector>

#include "core/load/cycle/mesh_motion.hpp"
#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// A solved position, and the same one with the mesh perturbed by one and two steps of a parameter that moves it
/// (MeshModel::perturbed). Points, curvature and compliance are those of the perturbed meshes; line loads and f_t follow
/// by their derivatives. The derivative of anything read from a loaded position is the forward difference over all
/// three, as in MeshSlopes and with its error. A falling load may end below 0.
class PerturbedPosition {
 public:
  struct Stage {
    const MeshModel& model;
    const MeshPosition& at;
    FlankCondition condition;
    LoadedPosition loaded;  ///< phase, line loads, structural deflection and f_t only
  };

  /// @param model, condition  as for analyse_cycle(); the model must outlive this
  /// @param loaded            position number `position` of the cycle, solved under some force
  /// @param column            index of the parameter among the cycle's
  PerturbedPosition(const MeshModel& model, const FlankCondition& condition, const LoadedPosition& loaded, std::size_t position,
                    MisalignmentParameter parameter, Eigen::Index column);

  /// Derivative of read(stage), a number or a vector; NaN throughout where the stages' vectors differ in size [per mm
  /// or rad].
  template <class Read>
  auto slope(const Read& read) const {
    const auto here = read(stages_[0]), one = read(stages_[1]), two = read(stages_[2]);
    if constexpr (std::floating_point<decltype(read(stages_[0]))>) {
      return forward_difference(here, one, two, step_);
    } else {
      if (one.size() != here.size() || two.size() != here.size()) return Eigen::VectorXd(Eigen::VectorXd::Constant(here.size(), not_given));
      return Eigen::VectorXd(forward_difference<Eigen::VectorXd>(here, one, two, step_));
    }
  }
  /// The same where read(stage) has one value per point, following each point; 0 for points that a stage lacks.
  template <class Read>
  Eigen::VectorXd point_slope(const Read& read) const {
    const Eigen::VectorXd slopes =
        forward_difference<Eigen::VectorXd>(read(stages_[0]), as_at(same_[0], read(stages_[1])), as_at(same_[1], read(stages_[2])), step_);
    return slopes.cwiseProduct(known_);
  }

 private:
  double step_;  ///< [mm or rad]
  std::array<std::vector<Eigen::Index>, 2> same_;
  Eigen::VectorXd known_;  ///< 1 where all stages have the point, else 0
  std::vector<Stage> stages_;
};

}  // namespace flankwright
