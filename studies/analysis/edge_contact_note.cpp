#include "studies/analysis/edge_contact_note.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

double share_of_torque(const LoadedResult& loaded) { return loaded.edge_contact->torque / loaded.torque; }

/// The load case whose edges touch at the least part of its torque, before an optimisation or else; null where none does.
const LoadedResult* first_edge_contact(const std::vector<LoadedResult>& all, bool before) {
  const LoadedResult* first = nullptr;
  for (const LoadedResult& loaded : all) {
    if (!loaded.edge_contact || (loaded.design == "before") != before) continue;
    if (first == nullptr || share_of_torque(loaded) < share_of_torque(*first)) first = &loaded;
  }
  return first;
}

std::string words_of(const LoadedResult& first) {
  const std::string reached =
      fmt::format("contact reaches the tip edge of the {} at {:.0f} % of {:.4g} N·m (scene \"{}\"); ", name_of(first.edge_contact->gear),
                  100.0 * share_of_torque(first), first.torque / units::newton_metre, first.scene);
  if (std::isnan(first.summary.edge_stress)) return reached + "the edge is sharp, its pressure has no bound and is not part of the contact stress";
  return reached + fmt::format("at all of it tip edges have up to {:.4g} MPa and {:.3g} % of the force", first.summary.edge_stress,
                               100.0 * first.summary.tip_edge_share);
}

}  // namespace

std::string edge_contact_note(const std::vector<LoadedResult>& all) {
  const LoadedResult* const before = first_edge_contact(all, true);
  const LoadedResult* const after = first_edge_contact(all, false);
  const auto words = [](const LoadedResult* first) { return first == nullptr ? "contact reaches no tip edge" : words_of(*first); };
  const bool is_optimised = std::ranges::any_of(all, [](const LoadedResult& loaded) { return loaded.design == "before"; });
  return is_optimised ? "before the optimisation " + words(before) + "; after it " + words(after) : words(after);
}

}  // namespace flankwright::studies
