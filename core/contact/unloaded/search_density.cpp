#include "core/contact/unloaded/search_density.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr int pieces_per_stretch = 4;
constexpr double absorbed = 0.5;   // of the relative curvature that a hollow may take away, see search_density()
constexpr double sampled = 3.0;    // times the largest curvature on the grid bounds it
constexpr double straight = 1e-9;  // 1/mm: a curvature up to this has no sign; over a face of 300 mm it is 10 nm

/// Counts stretches of one sign along a row of numbers.
class Stretches {
 public:
  void add(double curvature) {
    if (std::abs(curvature) <= straight) return;
    const bool hollow = curvature < 0.0;
    if (count_ == 0 || hollow != last_hollow_) ++count_;
    last_hollow_ = hollow;
  }
  int count() const { return count_; }

 private:
  int count_{0};
  bool last_hollow_{false};
};

bool has_field(const Flank& flank) { return !flank.fields.empty() || !flank.error.topographies.empty(); }

bool adds_metal_in_relief(const Flank& flank) {
  return std::ranges::any_of(modification_parameters,
                             [&](const ModificationDescriptor& d) { return !d.extent.empty() && d.get(flank.modification) < 0.0; });
}

/// Second derivatives of both flanks' deviations together, with respect to rho1 and z, and over the arc lengths.
struct Curvatures {
  double along_line{0.0};  ///< of D along the line of contact, per mm^2 of z times mm
  double profile{0.0};     ///< D_ss [1/mm]
};

/// d2D/ds2 with the arc length ds = (rho/r_b) d(rho) of the involute.
double over_arc_length(const Jet& d, double rho, double base_radius) {
  const double stretch = base_radius / rho;
  return stretch * stretch * (d.uu - d.u / rho);
}

}  // namespace

SearchDensity search_density(const FlankAssembly& assembly) {
  const Flank &pinion = assembly.pinion, &wheel = assembly.wheel;
  const bool fields = has_field(pinion) || has_field(wheel);
  const int rows = fields ? 33 : 7, columns = fields ? 33 : 3;
  const double distance = assembly.wheel_centre.head<2>().norm(), bases = pinion.base_radius + wheel.base_radius;
  const double path = std::sqrt(std::max(0.0, distance * distance - bases * bases));
  // The stretch of the line of action that both flanks cover ...
  const double lowest = std::max(pinion.lowest_roll(), path - wheel.highest_roll());
  const double highest = std::min(pinion.highest_roll(), path - wheel.lowest_roll());
  // ... and the one that either does: where edges touch, and a section runs on from there.
  const double outer_lowest = std::min(pinion.lowest_roll(), path - wheel.highest_roll());
  const double outer_highest = std::max(pinion.highest_roll(), path - wheel.lowest_roll());
  const double rate = pinion.base_radius * pinion.helix_rate;  // d(rho1)/dz along a line of contact

  SearchDensity density;
  bool hollow = adds_metal_in_relief(pinion) || adds_metal_in_relief(wheel);
  int along_profile = 1, along_face = 1;
  const auto at = [&](double along_path, double z) {
    const double rho1 = std::clamp(along_path, pinion.lowest_roll(), pinion.highest_roll());
    const double rho2 = std::clamp(path - along_path, wheel.lowest_roll(), wheel.highest_roll());
    const Jet one = pinion.deviation(Jet::variable_u(rho1), Jet::variable_v(z), 0);
    const Jet two = wheel.deviation(Jet::variable_u(rho2), Jet::variable_v(z - assembly.wheel_centre.z()), 0);
    Curvatures c;
    c.profile = over_arc_length(one, rho1, pinion.base_radius) + over_arc_length(two, rho2, wheel.base_radius);
    c.along_line = one.vv + two.vv + rate * (2.0 * (one.uv - two.uv) + rate * (one.uu + two.uu));
    hollow = hollow || c.profile < -absorbed * (1.0 / rho1 + 1.0 / rho2);
    return c;
  };
  const auto z_at = [&](int j) { return pinion.face.middle() + pinion.face.half() * (2.0 * j / (columns - 1) - 1.0); };
  for (int j = 0; j < columns; ++j) {
    Stretches stretches;
    for (int i = 0; i < rows; ++i) {
      stretches.add(at(outer_lowest + (outer_highest - outer_lowest) * i / (rows - 1), z_at(j)).profile);
    }
    along_profile = std::max(along_profile, stretches.count());
  }
  for (int i = 0; lowest < highest && i < rows; ++i) {
    // The line of contact through the middle of the face at this height; off the profile it is not looked at.
    const double at_mid_face = lowest + (highest - lowest) * i / (rows - 1);
    Stretches stretches;
    for (int j = 0; j < columns; ++j) {
      const double rho = at_mid_face + rate * z_at(j);
      if (rho < lowest || rho > highest) continue;
      const double curvature = at(rho, z_at(j)).along_line;
      density.hollow_curvature = std::max(density.hollow_curvature, -sampled * curvature);
      stretches.add(curvature);
    }
    along_face = std::max(along_face, stretches.count());
  }
  density.cells = hollow ? std::clamp(2 * pieces_per_stretch * along_profile, 32, 64) : 1;
  density.sections = hollow   ? std::clamp(2 * pieces_per_stretch * along_face + 1, 33, 129)
                     : fields ? std::clamp(pieces_per_stretch * along_face + 1, 17, 129)
                              : 9;
  return density;
}

}  // namespace flankwright
