#include "studies/base/unit_of_name.hpp"

#include <array>

namespace flankwright::studies {

namespace {

struct Ending {
  std::string_view ending, unit;
};

/// The longest first: what ends in "_N_per_mm_um" ends in "_um" too.
constexpr std::array endings{Ending{"_arcsec_per_deg2", "arcsec/deg^2"},
                             Ending{"_arcsec_per_deg", "arcsec/deg"},
                             Ending{"_N_per_mm_um", "N/(mm um)"},
                             Ending{"_N_per_um", "N/um"},
                             Ending{"_N_per_mm", "N/mm"},
                             Ending{"_N_per_m", "N/m"},
                             Ending{"_per_mm", "1/mm"},
                             Ending{"_um", "um"},
                             Ending{"_mm", "mm"},
                             Ending{"_deg", "deg"},
                             Ending{"_arcsec", "arcsec"},
                             Ending{"_arcmin", "arcmin"},
                             Ending{"_mrad", "mrad"},
                             Ending{"_MPa", "MPa"},
                             Ending{"_Nm_per_rad", "N·m/rad"},
                             Ending{"_Nm", "N·m"},
                             Ending{"_N", "N"},
                             Ending{"_W", "W"},
                             Ending{"_rpm", "rpm"},
                             Ending{"_urad", "urad"},
                             Ending{"_degC", "degC"},
                             Ending{"_K", "K"},
                             Ending{"_percent", "%"},
                             Ending{"_bytes", "byte"},
                             Ending{"milliseconds_per_cycle", "ms"},
                             Ending{"seconds", "s"},
                             Ending{"hours", "h"},
                             Ending{"c_prime", "N/(mm um)"},
                             Ending{"c_gamma", "N/(mm um)"}};

}  // namespace

std::string_view unit_of_name(std::string_view name) {
  constexpr std::string_view error = "_error";
  if (name.ends_with(error)) name.remove_suffix(error.size());
  // The entry of a list: te_harmonics_um.0.
  while (!name.empty() && name.find_last_not_of("0123456789") != std::string_view::npos && name[name.find_last_not_of("0123456789")] == '.') {
    name = name.substr(0, name.find_last_not_of("0123456789"));
  }
  for (const Ending& known : endings) {
    if (name.ends_with(known.ending)) return known.unit;
  }
  return "-";
}

}  // namespace flankwright::studies
