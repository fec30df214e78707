#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact/path/contact_points.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// The part of the plane of action in which undisturbed flanks touch: between A and E, on the common face.
struct LineRegion {
  static constexpr double round_off = 1e-9;  ///< of phases [base pitches], sums of a few numbers near 1

  explicit LineRegion(const MeshModel& model)
      : path(model.pair),
        face_start(model.face_start()),
        face_end(model.face_end()),
        first(path.before),
        last(path.path_end()),
        longest(path.slope == 0.0 ? model.face_width : std::min(model.face_width, (last - first) / std::abs(path.slope))) {}

  /// The part of a line between A and E, its ends there (not those on the faces) moved inwards along the axis by
  /// `distance` [mm]; begin > end where nothing is left. A spur line is whole or not there, whatever the distance.
  LineInterval line(double line_phase, double distance = 0.0) const {
    const double start = path.phase_at(line_phase, 0.0);
    if (path.slope == 0.0) {
      const bool inside = start >= first - round_off && start <= last + round_off;
      return inside ? LineInterval{face_start, face_end} : LineInterval{face_end, face_start};
    }
    const auto [low, high] = std::minmax({(first - start) / path.slope, (last - start) / path.slope});
    return {std::max(face_start, low + distance), std::min(face_end, high - distance)};
  }

  PathOfContact path;
  double face_start, face_end;  ///< z [mm]
  double first, last;           ///< phases of A and E [base pitches]
  double longest;               ///< that a line can be, along the axis [mm]
};

}  // namespace flankwright
