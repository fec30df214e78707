#include "studies/results/shafts_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/rating/shaft_misalignment.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/results/unit_json.hpp"

namespace flankwright::studies {

namespace {

/// Over which ShaftMotion::misalignment counts, with what end roundings take off [mm].
double common_face_width(const MeshModel& model) {
  const double pinion = 0.5 * model.pair.pinion.data.face_width, wheel = 0.5 * model.pair.wheel.data.face_width;
  return std::min(pinion, model.axial_offset + wheel) - std::max(-pinion, model.axial_offset - wheel);
}

/// One column of shaft_table().
struct ShaftColumn {
  const char *heading, *unit, *form;
  double (*value)(double misalignment, double face_width, const UnitState& unit);  ///< in this unit
};

/// The last one is of a unit only.
constexpr std::array shaft_columns{
    ShaftColumn{"f_sh", "um", "{:.3f}", [](double misalignment, double, const UnitState&) { return in_um(misalignment); }},
    ShaftColumn{"f_sh", "urad", "{:.1f}", [](double misalignment, double face_width, const UnitState&) { return 1e6 * misalignment / face_width; }},
    ShaftColumn{"by others", "um", "{:.3f}", [](double, double, const UnitState& unit) { return in_um(unit.outside_misalignment); }},
};

}  // namespace

std::string shaft_table(const StudyResults& results, std::size_t width) {
  if (!results.shafts || results.loaded.empty()) return {};
  const std::vector<bool> governs = governing_cases(results);
  std::string out = fmt::format("\n{:<{}}  {:>10}", "misalignment", width, "torque"), units = fmt::format("{:<{}}  {:>10}", "", width, "N·m");
  const auto shown = std::span(shaft_columns).first(results.shafts->has_unit() ? shaft_columns.size() : shaft_columns.size() - 1);
  for (const ShaftColumn& column : shown) {
    out += fmt::format("  {:>9}", column.heading);
    units += fmt::format("  {:>9}", column.unit);
  }
  out += "\n" + units + "\n";
  for (std::size_t l = 0; l < results.loaded.size(); ++l) {
    const LoadedResult& loaded = results.loaded[l];
    if (!governs[l] || loaded.design == "before") continue;
    const MeshModel& model = results.models[loaded.model];
    const double misalignment = shaft_misalignment(*results.shafts, loaded.shaft_motions);
    const UnitState unit = shafts_under(*results.shafts, model, loaded.torque).state(loaded.torque, model.axial_offset);
    out += fmt::format("{:<{}}  {:>10.6g}", loaded.scene, width, in_Nm(loaded.torque));
    for (const ShaftColumn& column : shown)
      out += fmt::format("  {:>9}", fmt::format(fmt::runtime(column.form), column.value(misalignment, common_face_width(model), unit)));
    out += "\n";
  }
  return out;
}

void add_shaft_motion(const LoadedResult& loaded, const StudyResults& results, Json& json) {
  const MeshModel& model = results.models[loaded.model];
  const ShaftPair shafts = shafts_under(*results.shafts, model, loaded.torque);
  if (shafts.has_unit() || results.shafts->depends_on_load()) json["unit"] = unit_state_json(shafts.state(loaded.torque, model.axial_offset));
  json["shafts"] = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    if (!loaded.cycle.positions[i].load.usable()) {
      json["shafts"].push_back(nullptr);
      continue;
    }
    const PerGear<ShaftMotion>& motions = loaded.shaft_motions[i];
    Json entry{{"phase", model.positions[i].phase}};
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      entry[name_of(m)] = nullptr;
      if (!shafts.has_shaft(m)) continue;
      entry[name_of(m)] = {{"displacement_um", in_um(motions[m].displacement)}, {"misalignment_um", in_um(motions[m].misalignment)}};
    }
    entry["mesh_misalignment_um"] = in_um(opened_by(shafts, motions));
    json["shafts"].push_back(std::move(entry));
  }
  json["summary"]["shaft_misalignment_um"] = in_um(shaft_misalignment(shafts, loaded.shaft_motions));
}

}  // namespace flankwright::studies
