#include "studies/tasks/optimise/edge_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "optimize/design/outputs/design_output.hpp"

namespace flankwright::studies {

namespace {

bool sees_edges(const ObjectiveTerm& term) { return design_output(term.output).sees_edges; }

}  // namespace

std::optional<std::string> edge_advice(const OptimiseTable& asked, const std::vector<LoadedResult>& all) {
  const auto any_sees = [](const std::vector<ObjectiveTerm>& terms) { return std::ranges::any_of(terms, sees_edges); };
  const bool objective_sees =
      any_sees(asked.objective) || std::ranges::any_of(asked.later_objectives, [&](const Objective& later) { return any_sees(later.terms); });
  if (objective_sees || std::ranges::any_of(asked.constraints, [](const OutputConstraint& c) { return sees_edges(c.output); })) return std::nullopt;
  const LoadedResult* highest = nullptr;
  for (const LoadedResult& loaded : all) {
    if (loaded.design != "after" || std::isnan(loaded.summary.peak_contact_stress)) continue;
    if (highest == nullptr || loaded.summary.peak_contact_stress > highest->summary.peak_contact_stress) highest = &loaded;
  }
  // Part of the contact stress, the stress on an edge is equal to it where it is the highest.
  if (highest == nullptr || highest->summary.edge_stress != highest->summary.peak_contact_stress) return std::nullopt;
  return fmt::format(
      "the highest contact stress of the design found, {:.4g} MPa in the scene \"{}\" at {:.4g} N·m, is on a tip edge: neither the objective nor a constraint has "
      "contact stress in it; optimise.constraints.edge_stress or peak_contact_stress keeps edges from carrying",
      highest->summary.edge_stress, highest->scene, highest->torque / units::newton_metre);
}

}  // namespace flankwright::studies
