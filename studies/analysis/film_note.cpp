#include "studies/analysis/film_note.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.hpp"
#include "core/rating/edge_contact_start.hpp"

namespace flankwright::studies {

namespace {

std::string load_case(const LoadedResult& loaded) {
  return fmt::format("(scene \"{}\", {:.4g} N·m)", loaded.scene, loaded.torque / units::newton_metre);
}

}  // namespace

std::string film_note(const StudyResults& results) {
  const CaseLife *thinnest = nullptr, *hottest = nullptr;
  for (const CaseLife& of : results.life->cases) {
    const LoadedResult& loaded = results.loaded[of.loaded];
    if (loaded.design == "before" || std::isnan(of.contact_temperature)) continue;
    if (std::isnan(loaded.summary.edge_stress) && reaches_tip_edge(results.models[loaded.model], loaded.cycle))
      return fmt::format(
          "contact reaches a sharp tip edge {}, where no pressure is known: film and contact temperature have the pressure of the flank there and are too favourable; "
          "edges.tip_rounding of both gears gives the edges a radius",
          load_case(loaded));
    if (of.film < of.film_of_flanks && (thinnest == nullptr || of.film < thinnest->film)) thinnest = &of;
    if (of.contact_temperature > of.flank_temperature && (hottest == nullptr || of.contact_temperature > hottest->contact_temperature)) hottest = &of;
  }
  std::string note;
  if (thinnest != nullptr)
    note = fmt::format("the film is thinnest on a tip edge, lambda_GF {:.3g} {}; the flanks have about {:.2g} there", thinnest->film,
                       load_case(results.loaded[thinnest->loaded]), thinnest->film_of_flanks);
  if (hottest != nullptr)
    note +=
        fmt::format("{}contact is hottest on a tip edge, theta_B {:.0f} degC {}; the flanks have about {:.0f} degC there", note.empty() ? "" : "; ",
                    hottest->contact_temperature, load_case(results.loaded[hottest->loaded]), hottest->flank_temperature);
  return note;
}

}  // namespace flankwright::studies
