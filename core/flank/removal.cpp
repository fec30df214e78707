#include "core/flank/removal.hpp"

namespace flankwright {

double removal_derivative(const Modification& m, const FlankFrame& frame, ModificationParameter parameter, double r,
                          double z) {
  // Amounts enter linearly: the derivative is the removal of a unit amount with the same extents.
  Modification unit;
  unit.tip_relief = {0.0, m.tip_relief.height, m.tip_relief.shape};
  unit.root_relief = {0.0, m.root_relief.height, m.root_relief.shape};
  unit.end_relief = {0.0, m.end_relief.length};

  const auto extent = [](double amount, double height, ReliefShape shape, double beyond_start) {
    // t = 1 - d/h with d the distance from the end of the relief: dt/dh = d/h^2 = (1 - t)/h.
    if (amount == 0.0 || beyond_start <= 0.0) return 0.0;
    const double t = beyond_start / height;
    const double slope = amount * (1.0 - t) / height;
    return shape == ReliefShape::Linear ? slope : 2.0 * t * slope;
  };
  switch (parameter) {
    case ModificationParameter::TipReliefHeight:
      return extent(m.tip_relief.amount, m.tip_relief.height, m.tip_relief.shape,
                    r - (frame.tip_radius - m.tip_relief.height));
    case ModificationParameter::RootReliefHeight:
      return extent(m.root_relief.amount, m.root_relief.height, m.root_relief.shape,
                    frame.active_root_radius + m.root_relief.height - r);
    case ModificationParameter::EndReliefLength:
      return extent(m.end_relief.amount, m.end_relief.length, ReliefShape::Linear,
                    std::abs(z) - (0.5 * frame.face_width - m.end_relief.length));
    default: break;
  }
  set(unit, parameter, 1.0);
  return removal(unit, frame, r, z);
}

double pitch_deviation(const ManufacturingError& error, int tooth) {
  if (error.cumulative_pitch.empty()) return error.pitch_step * tooth;
  const int size = static_cast<int>(error.cumulative_pitch.size());
  return error.cumulative_pitch[static_cast<std::size_t>(((tooth % size) + size) % size)];
}

}  // namespace flankwright
