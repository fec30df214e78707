#pragma once

#include <complex>
#include <string>
#include <vector>

#include "core/effects/decision.hpp"

namespace flankwright {

/// The outputs of a loaded cycle by which an effect is measured.
struct CycleOutputs {
  double te_mean{not_given};              ///< of f_t [mm]
  double te_peak_to_peak{not_given};      ///< [mm]
  double peak_contact_stress{not_given};  ///< [MPa]
  double mean_approach{not_given};        ///< of LoadedPosition::approach_of_teeth() [mm]
  /// Of f_t, orders 1 .. 5 as far as the positions resolve them; amplitudes are their moduli [mm].
  std::vector<std::complex<double>> te_harmonics{};
};

/// The contribution of an effect: outputs with it less those without. NaN: not known.
struct EffectInfluence {
  double te_mean{not_given};              ///< [mm]
  double te_peak_to_peak{not_given};      ///< [mm]
  double peak_contact_stress{not_given};  ///< [MPa]
  double relative_stress{not_given};      ///< of the peak stress with the effect [-]
  double te_harmonic{not_given};  ///< largest change of a harmonic, amplitude and phase, over the orders 1 .. 5; 0 where none is resolved [mm]
  /// The largest of these as shares [-]: of the mean approach, peak to peak and harmonics of the peak to peak (at least quiet of the mean
  /// approach, since shares of next to nothing mean nothing), and of the peak stress, all with the effect.
  double share{not_given};
  std::string largest_in;  ///< which of them that is, in words

  static constexpr double quiet{0.02};

  static EffectInfluence between(const CycleOutputs& with, const CycleOutputs& without);
};

/// The effect of that name acts on a loaded mesh, its flanks or its loads: it may have a size. Not contact without load, nor what is read off
/// the loads.
bool changes_mesh(std::string_view name);

/// Whether the effect of that name may be left out for being small. This holds for effects on the mesh. Effects of the
/// condition cost nothing and may be what a study varies; the same holds for the gear body.
bool may_be_dropped(std::string_view name);

/// The size of one effect.
struct EffectSize {
  std::string name;
  EffectInfluence influence;  ///< of the load case in which its share is largest
  double seconds{not_given};  ///< that it took to find out
};

/// Switches off effects on the mesh that are too small to matter: in order of rising contribution, as long as these,
/// which add up to first order, stay within the budget together. Effects that may not be dropped stay, and so do those
/// without a contribution.
/// @param budget  relative error [-], > 0
EffectDecisions within_budget(EffectDecisions decisions, std::vector<EffectSize> sizes, double budget);

}  // namespace flankwright
