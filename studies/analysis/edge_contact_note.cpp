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

/// The load case of the largest value, NaN apart, among those of the same design as another one.
const LoadedResult& largest(const std::vector<LoadedResult>& all, const LoadedResult& of_design, double CycleSummary::*value) {
  const LoadedResult* found = &of_design;
  for (const LoadedResult& loaded : all) {
    if ((loaded.design == "before") == (of_design.design == "before") && loaded.summary.*value > found->summary.*value) found = &loaded;
  }
  return *found;
}

std::string words_of(const std::vector<LoadedResult>& all, const LoadedResult& first) {
  const std::string reached =
      fmt::format("contact reaches the tip edge of the {} at {:.0f} % of {:.4g} N·m (scene \"{}\"); ", name_of(first.edge_contact->gear),
                  100.0 * share_of_torque(first), first.torque / units::newton_metre, first.scene);
  if (std::isnan(first.summary.edge_stress)) return reached + "the edge is sharp, its pressure has no bound and is not part of the contact stress";
  const LoadedResult& stress = largest(all, first, &CycleSummary::edge_stress);
  const LoadedResult& share = largest(all, first, &CycleSummary::tip_edge_share);
  const auto other_case = [&](const LoadedResult& of) {
    return &of == &first ? std::string() : fmt::format(" (scene \"{}\", {:.4g} N·m)", of.scene, of.torque / units::newton_metre);
  };
  return reached + fmt::format("under full load tip edges have up to {:.4g} MPa{} and {:.3g} % of the force{}", stress.summary.edge_stress,
                               other_case(stress), 100.0 * share.summary.tip_edge_share, &share == &stress ? "" : other_case(share));
}

}  // namespace

std::string edge_contact_note(const std::vector<LoadedResult>& all) {
  const LoadedResult* const before = first_edge_contact(all, true);
  const LoadedResult* const after = first_edge_contact(all, false);
  const auto words = [&](const LoadedResult* first) { return first == nullptr ? "contact reaches no tip edge" : words_of(all, *first); };
  const bool is_optimised = std::ranges::any_of(all, [](const LoadedResult& loaded) { return loaded.design == "before"; });
  return is_optimised ? "before the optimisation " + words(before) + "; after it " + words(after) : words(after);
}

}  // namespace flankwright::studies
