#include "core/compliance/fitted/correction_library.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/fitted/shipped_corrections.hpp"

namespace flankwright {
namespace {

constexpr double kRoundOff = 1e-9;  // of ranges' ends computed from degrees or millimetres

/// Root radii this much beyond those of the entries are known, too: ISO 53 has 0.38 and 0.39 for the same rack.
constexpr double kRootRadius = 0.01;

/// A property's value and the range that it has in the library.
struct Property {
  std::string name;
  double value, low, high;
  std::string unit{};

  bool is_inside() const { return value >= low - kRoundOff && value <= high + kRoundOff; }
  std::string text() const {
    std::ostringstream text;
    text << name << ' ' << value << unit << ", in the library " << low;
    if (high > low) text << " .. " << high;
    text << unit;
    return text.str();
  }
};

/// Lowest and highest of every property.
std::pair<ReferenceProfile, ReferenceProfile> range(const std::vector<ReferenceProfile>& profiles) {
  ReferenceProfile low = profiles.front(), high = low;
  for (const ReferenceProfile& p : profiles) {
    const auto widen = [](double& least, double& most, double value) {
      least = std::min(least, value);
      most = std::max(most, value);
    };
    widen(low.rack.addendum, high.rack.addendum, p.rack.addendum);
    widen(low.rack.dedendum, high.rack.dedendum, p.rack.dedendum);
    widen(low.rack.root_radius, high.rack.root_radius, p.rack.root_radius);
    widen(low.pressure_angle, high.pressure_angle, p.pressure_angle);
  }
  return {low, high};
}

/// Departures of a rack from the standard one.
Eigen::Vector3d departure(const RackProfile& rack) {
  const RackProfile standard;
  return {rack.addendum - standard.addendum, rack.dedendum - standard.dedendum, rack.root_radius - standard.root_radius};
}

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("library", what, "a grid of the standard profile, of none or three other racks, and of other pressure angles");
}

}  // namespace

GearProportions facts_of(const GearToMesh& gear) {
  return {gear.gear.teeth, gear.helix_angle, gear.gear.face_width / gear.normal_module, gear.gear.profile_shift};
}

ReferenceProfile profile_of(const GearToMesh& gear) { return {gear.gear.rack, gear.pressure_angle}; }

CorrectionLibrary::CorrectionLibrary(const std::vector<CorrectionEntry>& entries) {
  const ReferenceProfile standard;
  profiles_.push_back(standard);
  std::vector<ReferenceProfile> angles;
  for (const CorrectionEntry& entry : entries) {
    const ReferenceProfile& p = entry.profile;
    if (std::ranges::find(profiles_, p) != profiles_.end() || std::ranges::find(angles, p) != angles.end()) continue;
    const bool other_angle = p.pressure_angle != standard.pressure_angle;
    if (other_angle && !departure(p.rack).isZero(0)) refuse("rack and pressure angle differ at once");
    (other_angle ? angles : profiles_).push_back(p);
  }
  racks_ = profiles_.size() - 1;
  profiles_.insert(profiles_.end(), angles.begin(), angles.end());
  if (racks_ != 0 && racks_ != 3) refuse(std::to_string(racks_) + " other racks");
  for (const ReferenceProfile& profile : profiles_) {
    std::vector<CorrectionEntry> of_profile;
    std::ranges::copy_if(entries, std::back_inserter(of_profile), [&](const CorrectionEntry& entry) { return entry.profile == profile; });
    grids_.emplace_back(std::move(of_profile));
    entries_.insert(entries_.end(), grids_.back().entries().begin(), grids_.back().entries().end());
  }
  if (racks_ == 3) {
    Eigen::Matrix3d departures;
    for (int i = 0; i < 3; ++i) departures.col(i) = departure(profiles_[static_cast<std::size_t>(1 + i)].rack);
    if (!Eigen::FullPivLU<Eigen::Matrix3d>(departures).isInvertible()) refuse("racks whose departures are not independent");
  }
}

const CorrectionLibrary& CorrectionLibrary::shipped() {
  static const CorrectionLibrary library(entries_in(shipped_corrections));
  return library;
}

std::string CorrectionLibrary::unknown(const GearToMesh& gear, double poissons_ratio) const {
  const GearData& data = gear.gear;
  const double module = gear.normal_module, radians = 1 / units::deg;
  const double tip = data.teeth / std::cos(gear.helix_angle) + 2 * (data.rack.addendum + data.profile_shift);
  const auto [low, high] = range(profiles_);
  const std::array<Property, 10> properties{{
      {"pressure angle", gear.pressure_angle * radians, low.pressure_angle * radians, high.pressure_angle * radians, " deg"},
      {"helix angle", gear.helix_angle * radians, 0, standard().helix_angles().back() * radians, " deg"},
      {"teeth", static_cast<double>(data.teeth), static_cast<double>(standard().teeth().front()), static_cast<double>(standard().teeth().back())},
      {"profile shift", data.profile_shift, standard().profile_shifts().front(), standard().profile_shifts().back()},
      {"face width", data.face_width / module, 2, 30, " modules"},
      {"rack addendum", data.rack.addendum, low.rack.addendum, high.rack.addendum},
      {"rack dedendum", data.rack.dedendum, low.rack.dedendum, high.rack.dedendum},
      {"rack root radius", data.rack.root_radius, low.rack.root_radius - kRootRadius, high.rack.root_radius + kRootRadius},
      {"Poisson's ratio", poissons_ratio, 0.25, 0.35},
      {"tip diameter", std::isnan(data.tip_diameter) ? tip : data.tip_diameter / module, tip - 0.2, tip + 0.02, " modules"},
  }};
  const auto outside = std::ranges::find_if_not(properties, &Property::is_inside);
  return outside == properties.end() ? "" : outside->text();
}

ReferenceProfile CorrectionLibrary::nearest(ReferenceProfile profile) const {
  const auto [low, high] = range(profiles_);
  profile.rack.addendum = std::clamp(profile.rack.addendum, low.rack.addendum, high.rack.addendum);
  profile.rack.dedendum = std::clamp(profile.rack.dedendum, low.rack.dedendum, high.rack.dedendum);
  profile.rack.root_radius = std::clamp(profile.rack.root_radius, low.rack.root_radius, high.rack.root_radius);
  profile.pressure_angle = std::clamp(profile.pressure_angle, low.pressure_angle, high.pressure_angle);
  return profile;
}

std::vector<double> CorrectionLibrary::weights(const ReferenceProfile& profile) const {
  std::vector<double> result;
  if (racks_ == 3) {
    Eigen::Matrix3d departures;
    for (int i = 0; i < 3; ++i) departures.col(i) = departure(profiles_[static_cast<std::size_t>(1 + i)].rack);
    const Eigen::Vector3d of_racks = departures.fullPivLu().solve(departure(profile.rack));
    result.assign(of_racks.begin(), of_racks.end());
  }
  std::vector<double> angles{profiles_.front().pressure_angle};
  for (std::size_t i = 1 + racks_; i < profiles_.size(); ++i) angles.push_back(profiles_[i].pressure_angle);
  const std::vector<double> of_angles = cardinal_polynomials(angles, profile.pressure_angle);
  result.insert(result.end(), of_angles.begin() + 1, of_angles.end());
  return result;
}

std::vector<double> CorrectionLibrary::coefficients(const GearProportions& gear, const ReferenceProfile& profile) const {
  std::vector<double> sum = standard().coefficients(standard().nearest(gear));
  const std::vector<double> of_grids = weights(nearest(profile));
  for (std::size_t k = 0; k < of_grids.size(); ++k) {
    if (of_grids[k] == 0) continue;
    const CorrectionGrid& grid = grids_[k + 1];
    const GearProportions there = grid.nearest(standard().nearest(gear));
    const std::vector<double> departs = grid.coefficients(there), from = standard().coefficients(there);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += of_grids[k] * (departs[i] - from[i]);
  }
  return sum;
}

}  // namespace flankwright
