#pragma once

#include <array>
#include <type_traits>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// One of each main figure of a loaded mesh cycle: its value, its error, or its derivatives. What is done with all of them goes over single().
/// @tparam Single    of a figure that is one number
/// @tparam PerOrder  of one with a number for each order of the mesh frequency, 1 .. 10
template <class Single, class PerOrder>
struct CycleValues {
  Single te_peak_to_peak = nothing();      ///< of f_t over the positions [mm]; NaN of one
  PerOrder te_harmonics{};                 ///< amplitudes [mm]; empty: none
  Single te_mean = nothing();              ///< [mm]
  Single peak_line_load = nothing();       ///< [N/mm]
  Single peak_contact_stress = nothing();  ///< on edges included [MPa]
  Single edge_stress = nothing();          ///< on tip edges alone, 0 where contact does not reach one [MPa]; none without the effect edge_contact
  Single tip_edge_share = nothing();       ///< largest part of the force that tip roundings carry at a position [-], 0 .. 1; none as edge_stress
  Single mean_stiffness = nothing();       ///< Haddad eq. 2.17b [N/(mm um)]
  Single least_stiffness = nothing(), largest_stiffness = nothing();  ///< eq. 2.16b over the positions [N/(mm um)]
  Single load_factor = nothing();                                     ///< peak line load over MeshModel::mean_line_load() [-]
  Single peak_root_stress = nothing();  ///< of both gears, the largest principal stress [MPa]; none where the model has no root stress

  /// All but the harmonics.
  static constexpr auto single() {
    using V = CycleValues;
    return std::array{&V::te_peak_to_peak,   &V::te_mean,        &V::peak_line_load,  &V::peak_contact_stress,
                      &V::edge_stress,       &V::tip_edge_share, &V::mean_stiffness,  &V::least_stiffness,
                      &V::largest_stiffness, &V::load_factor,    &V::peak_root_stress};
  }

 private:
  /// A number that was not computed is NaN, a row of derivatives is empty.
  static Single nothing() {
    if constexpr (std::is_floating_point_v<Single>) return not_given;
    return Single{};
  }
};

}  // namespace flankwright
