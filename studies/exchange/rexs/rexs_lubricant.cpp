#include "studies/exchange/rexs/rexs_lubricant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

/// The oil of a stage, the nearest one that is related to it; null where there is none, or several and none is related.
const Component* lubricant_of(const Reading& reading, const StageParts& parts) {
  std::vector<const Component*> of{parts.stage}, all;
  for (const char* type : {"gear_casing", "gear_unit"}) {
    for (const Component& component : reading.model().components) {
      if (component.type == type) of.push_back(&component);
    }
  }
  for (const Component* component : of) {
    const auto lubricants = reading.related(*component, {"lubricant"});
    if (!lubricants.empty()) return lubricants.front();
  }
  for (const Component& component : reading.model().components) {
    if (component.type == "lubricant") all.push_back(&component);
  }
  return all.size() == 1 ? all.front() : nullptr;
}

/// The base oil as a study names it; empty where the file does not say, or names one that a study does not know.
std::string base_of(Reading& reading, const Component& oil) {
  for (const char* attribute : {"lubricant_type_iso_6336_2019", "lubricant_type_iso_6336_2006"}) {
    const std::string type = reading.word(&oil, attribute);
    if (type == "mineral_oil") return "mineral";
    if (type == "polyalfaolefin") return "polyalphaolefin";
    if (type == "water_soluble_polyglycol" || type == "non_water_soluble_polyglycol") return "polyglycol";
    if (!type.empty())
      reading.warn(fmt::format("{}: {} = \"{}\" names no oil of a study, and mineral oil is taken", Reading::name_of(oil), attribute, type));
  }
  const std::string basis = reading.word(&oil, "basis");
  if (!basis.empty() && basis != "mineral")
    reading.warn(fmt::format("{}: basis = \"{}\" names no oil of a study, and mineral oil is taken", Reading::name_of(oil), basis));
  return basis == "mineral" ? basis : "";
}

/// Ra, the mean of the gears that have one.
std::optional<Taken> roughness_of(Reading& reading, const StageParts& parts) {
  double sum = 0.0;
  std::string sources;
  int count = 0;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const auto roughness =
        reading.first_of(parts[m].gear, {"arithmetic_mean_roughness_flank_iso_4287_1997", "arithmetic_average_roughness_flank"}, Dimension::Length);
    if (!roughness || !(roughness->value > 0.0)) continue;
    sum += roughness->value;
    sources += (count++ > 0 ? ", " : "") + roughness->source;
  }
  if (count == 0) return std::nullopt;
  return Taken{sum / count, sources};
}

}  // namespace

void write_lubricant(Reading& reading, const StageParts& parts, const std::optional<Taken>& temperature, StudyText& text) {
  const Component* oil = lubricant_of(reading, parts);
  if (oil == nullptr) return;
  const auto leave_out = [&](const std::string& why) { reading.leave_out(*oil, why); };
  if (const std::string kind = reading.word(oil, "kind"); !kind.empty() && kind != "oil")
    return leave_out(fmt::format("kind = \"{}\", and a study knows oils (kind = \"oil\")", kind));
  const auto thin = reading.number(oil, "viscosity_at_100_degree_celsius", Dimension::Viscosity);
  const auto thick = reading.number(oil, "viscosity_at_40_degree_celsius", Dimension::Viscosity);
  if (!thin || !thick) return leave_out("it lacks a viscosity at 40 or 100 deg C");
  constexpr double thinnest = 1.0, thickest_cold = 10000.0, thickest_hot = 1000.0;  // mm^2/s, as a study allows
  if (thick->value < thinnest || thick->value > thickest_cold) {
    reading.refuse_attribute(*oil, "viscosity_at_40_degree_celsius", fmt::format("{:.6g} mm^2/s", thick->value), "1 .. 10000 mm^2/s");
  }
  if (thin->value < thinnest || thin->value > thickest_hot || thin->value >= thick->value) {
    reading.refuse_attribute(*oil, "viscosity_at_100_degree_celsius", fmt::format("{:.6g} mm^2/s", thin->value),
                             fmt::format("1 .. 1000 mm^2/s, and below the {:.6g} mm^2/s at 40 deg C", thick->value));
  }
  if (!temperature) return leave_out("the file has no temperature_lubricant");
  text.table("lubricant");
  if (const std::string base = base_of(reading, *oil); !base.empty()) text.key("base", quoted(base), Reading::name_of(*oil));
  text.key("viscosity_40", number_text(thick->value), thick->source);
  text.key("viscosity_100", number_text(thin->value), thin->source);
  if (const auto density = reading.number(oil, "density_at_15_degree_celsius", Dimension::Density)) {
    constexpr double lightest = 500.0, heaviest = 2000.0;  // kg/m^3, as a study allows
    if (density->value < lightest || density->value > heaviest)
      reading.refuse_attribute(*oil, "density_at_15_degree_celsius", fmt::format("{:.6g} kg/m^3", density->value), "500 .. 2000 kg/m^3");
    text.key("density", number_text(density->value), density->source);
  }
  text.key("temperature", number_text(temperature->value), temperature->source);
  const auto roughness = roughness_of(reading, parts);
  constexpr double ground = 0.4 * units::um;  // Ra of ground flanks
  if (!roughness) {
    reading.warn(fmt::format("{}: the file has no roughness of the flanks, and Ra = {:.6g} um of ground ones is taken", Reading::name_of(*oil),
                             ground / units::um));
  }
  text.key("roughness", number_text((roughness ? roughness->value : ground) / units::um), roughness ? roughness->source : "not in the file");
}

}  // namespace flankwright::studies::rexs
