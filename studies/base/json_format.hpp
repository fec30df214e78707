#pragma once

#include <nlohmann/json.hpp>

#include "core/base/units.hpp"

/// Instantiated once, in json_format.cpp: a fifth of the compile time of whoever reads or writes it.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

/// Helpers for the sections of results.json: values in the units that keys name, and lists.
namespace flankwright::studies {

using Json = nlohmann::ordered_json;

constexpr double percent = 100.0;  ///< of a share of one

inline double in_um(double mm) { return mm / units::um; }
inline double in_Nm(double torque) { return torque / units::newton_metre; }
inline double in_arcsec(double rad) { return rad / units::arcsec; }
inline double in_deg(double rad) { return rad / units::deg; }
/// Slope of the transmission error: arcsec of the wheel per degree of the pinion.
inline double in_arcsec_per_deg(double slope) { return slope * units::deg / units::arcsec; }
inline double in_arcsec_per_deg2(double a) { return a / units::arcsec_per_square_deg; }

template <class Range, class Convert>
Json list(const Range& values, const Convert& convert) {
  Json array = Json::array();
  for (const auto& value : values) array.push_back(convert(value));
  return array;
}

}  // namespace flankwright::studies
