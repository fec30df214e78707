#include "core/load/cycle/perturbed_position.hpp"

namespace flankwright {

PerturbedPosition::PerturbedPosition(const MeshModel& model, const FlankCondition& condition, const LoadedPosition& loaded, std::size_t position,
                                     MisalignmentParameter parameter, Eigen::Index column)
    : step_(perturbed_meshes(model, parameter).step), known_(Eigen::VectorXd::Ones(loaded.load.line_load.size())) {
  const std::vector<MeshModel>& perturbed = perturbed_meshes(model, parameter).meshes;
  const auto add_stage = [&](const MeshModel& mesh, const Eigen::VectorXd& line_load, double steps) {
    const MeshPosition& at = mesh.positions[position];
    LoadedPosition there;
    there.phase = at.phase;
    there.load.status = LoadStatus::Converged;
    there.load.line_load = line_load;
    there.load.structural_deflection = at.influence * at.weight.cwiseProduct(line_load);
    there.load.transmission_error = loaded.load.transmission_error + steps * step_ * loaded.transmission_error_derivative[column];
    stages_.push_back({mesh, at, placed_as(mesh, parameter, condition), std::move(there)});
  };
  for (std::size_t k = 0; k < 2; ++k) {
    same_[k] = same_points(model.positions[position], perturbed[k].positions[position]);
    for (std::size_t i = 0; i < same_[k].size(); ++i) {
      if (same_[k][i] < 0) known_[static_cast<Eigen::Index>(i)] = 0.0;
    }
  }
  add_stage(model, loaded.load.line_load.cwiseProduct(known_), 0.0);
  for (std::size_t k = 0; k < 2; ++k) {
    const MeshModel& mesh = perturbed[k];
    const double steps = static_cast<double>(k) + 1.0;
    const Eigen::VectorXd moved = loaded.load.line_load + steps * step_ * loaded.line_load_derivative.col(column);
    add_stage(mesh, as_perturbed(same_[k], moved.cwiseProduct(known_), mesh.positions[position].weight.size()), steps);
  }
}

}  // namespace flankwright
