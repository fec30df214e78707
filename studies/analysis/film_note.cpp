#include "studies/analysis/film_note.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

std::string load_case(const LoadedResult& loaded) {
  return fmt::format("(scene \"{}\", {:.4g} N·m)", loaded.scene, loaded.torque / units::newton_metre);
}

}  // namespace

std::string film_note(const StudyResults& results) {
  const CaseLife *thinnest = nullptr, *hottest = nullptr;
  for (const CaseLife& of : results.life->cases) {
    if (results.loaded[of.loaded].design == "before") continue;
    if (of.film < of.film_of_flanks && (thinnest == nullptr || of.film < thinnest->film)) thinnest = &of;
    if (of.contact_temperature > of.flank_temperature && (hottest == nullptr || of.contact_temperature > hottest->contact_temperature)) hottest = &of;
  }
  std::string note;
  if (thinnest != nullptr)
    note = fmt::format("the film is thinnest on a tip edge, lambda_GF {:.3g} {}; the flanks have {:.3g} there", thinnest->film,
                       load_case(results.loaded[thinnest->loaded]), thinnest->film_of_flanks);
  if (hottest != nullptr)
    note += fmt::format("{}contact is hottest on a tip edge, theta_B {:.0f} degC {}; the flanks have {:.0f} degC there", note.empty() ? "" : "; ",
                        hottest->contact_temperature, load_case(results.loaded[hottest->loaded]), hottest->flank_temperature);
  return note;
}

}  // namespace flankwright::studies
