#pragma once

#include <array>
#include <concepts>
#include <vector>

#include "core/load/cycle/mesh_motion.hpp"
#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// A solved position and the same one with the mesh one and two steps further along a parameter that moves it (MeshModel::further): points and what they rest
/// on are those of the further meshes, line loads and f_t go there by their derivatives. Whatever can be read off a
/// loaded position has its own derivative by reading it off all three: that of MeshSlopes, with its error. A load that falls may end below 0.
class MeshWay {
 public:
  struct Stage {
    const MeshModel& model;
    const MeshPosition& at;
    FlankCondition condition;
    LoadedPosition loaded;  ///< phase, line loads, structural deflection and f_t only
  };

  /// @param model, condition  as analyse_cycle() had them; the model must outlive this
  /// @param loaded            position number `position` of the cycle, solved under some force
  /// @param column            where the parameter stands among the cycle's
  MeshWay(const MeshModel& model, const FlankCondition& condition, const LoadedPosition& loaded, std::size_t position,
          MisalignmentParameter parameter, Eigen::Index column);

  /// Derivative of what read(stage) gives: a number, or as many as a vector has at every stage, else NaN throughout [per mm or rad].
  template <class Read>
  auto slope(const Read& read) const {
    const auto here = read(stages_[0]), one = read(stages_[1]), two = read(stages_[2]);
    if constexpr (std::floating_point<decltype(read(stages_[0]))>) {
      return first_slope(here, one, two, step_);
    } else {
      if (one.size() != here.size() || two.size() != here.size()) return Eigen::VectorXd(Eigen::VectorXd::Constant(here.size(), not_given));
      return Eigen::VectorXd(first_slope<Eigen::VectorXd>(here, one, two, step_));
    }
  }
  /// The same for what read(stage) gives for each of the stage's points, following each; 0 for points that some stage is without.
  template <class Read>
  Eigen::VectorXd point_slope(const Read& read) const {
    const Eigen::VectorXd slopes = first_slope<Eigen::VectorXd>(read(stages_[0]), as_at(same_[0], read(stages_[1])), as_at(same_[1], read(stages_[2])), step_);
    return slopes.cwiseProduct(known_);
  }

 private:
  double step_;  ///< [mm or rad]
  std::array<std::vector<Eigen::Index>, 2> same_;
  Eigen::VectorXd known_;  ///< 1 where all stages have the point, else 0
  std::vector<Stage> stages_;
};

}  // namespace flankwright
