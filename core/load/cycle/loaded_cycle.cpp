#include "core/load/cycle/loaded_cycle.hpp"

namespace flankwright {

Eigen::VectorXd LoadedCycle::transmission_error() const {
  Eigen::VectorXd te(static_cast<Eigen::Index>(positions.size()));
  for (Eigen::Index i = 0; i < te.size(); ++i) te[i] = positions[static_cast<std::size_t>(i)].load.transmission_error;
  return te;
}

}  // namespace flankwright
