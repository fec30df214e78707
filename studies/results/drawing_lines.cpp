#include "studies/results/drawing_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/flank/natural_twist.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

constexpr double smallest_written = 0.05 * units::um;  // of what a process brings: less is 0.0 um

/// What the process brings to the numbers of a flank [mm].
struct ProcessPart {
  double slope{0.0}, crowning{0.0}, twist{0.0};

  ProcessPart(const GearPair& pair, Member member, const Modification& modification) {
    const auto field = make_natural_twist_field(pair, member, modification);
    if (!field) return;
    const Gear& gear = pair[member];
    const double start = gear.roll_length_at(gear.active_root_radius), tip = gear.roll_length_at(gear.tip_form_radius);
    const auto removed = [&](double rho) { return field->at(rho, 0.0).value; };
    slope = removed(tip) - removed(start);
    crowning = 0.5 * (removed(tip) + removed(start)) - removed(0.5 * (start + tip));
    twist = natural_twist(pair, member, modification);
  }

  /// Of the parameter with this key; 0 where it is too little to be written.
  double of(std::string_view key) const {
    const double part = key == "profile_slope" ? slope : key == "profile_crowning" ? crowning : key == "twist" ? twist : 0.0;
    return std::abs(part) < smallest_written ? 0.0 : part;
  }
};

/// The decimals that values have, from `least` to 3; `least` where one needs more: it is no multiple of a grinder's step.
int decimals_of(std::initializer_list<double> values, int least) {
  for (int places = least; places <= 3; ++places) {
    const double scale = std::pow(10.0, places);
    // 1e-6 of a place is round-off.
    if (std::ranges::all_of(values, [&](double value) { return std::abs(value * scale - std::round(value * scale)) < 1e-6; })) return places;
  }
  return least;
}

std::string unit_in_words(ParameterKind kind) { return kind == ParameterKind::Amount ? "µm" : unit_of(kind); }

/// Tolerance of a number, and the tolerance of the class that it is.
struct StatedTolerance {
  double low, high;
  const char* symbol;  ///< null: given by the study
};

std::optional<StatedTolerance> tolerance_of(const ModificationDescriptor& d, double design, const FlankTolerances& t, const DrawingTerms& terms) {
  const std::string_view key = d.key;
  const auto given = std::ranges::find(terms.amounts, key, &AmountTolerance::key);
  if (given != terms.amounts.end()) {
    return StatedTolerance{allowed_deviation(d, design, given->low), allowed_deviation(d, design, given->high), nullptr};
  }
  struct OfClass {
    std::string_view key;
    double FlankTolerances::*tolerance;
    const char* symbol;
  };
  // A crowning that deviates by f_f is a form deviation of f_f.
  constexpr OfClass of_class[]{{"lead_slope", &FlankTolerances::helix_slope, "f_HβT"},
                               {"profile_slope", &FlankTolerances::profile_slope, "f_HαT"},
                               {"lead_crowning", &FlankTolerances::helix_form, "f_fβT"},
                               {"profile_crowning", &FlankTolerances::profile_form, "f_fαT"}};
  for (const auto& [of, tolerance, symbol] : of_class) {
    if (of != key) continue;
    const double rounded = rounded_tolerance(t.*tolerance);
    return StatedTolerance{-rounded, rounded, symbol};
  }
  return std::nullopt;
}

/// "22.0 ± 3.0 µm", "14.0 ± 9.0 µm (f_HβT)", "8.0 +2.0 -1.0 µm", "0.0 +3.0 0 µm".
std::string value_in_words(const ModificationDescriptor& d, double value, const std::optional<StatedTolerance>& tolerance) {
  const double factor = outside_factor(d.kind);
  if (d.kind == ParameterKind::TeParabola) return fmt::format("{:.3g} {}", value * factor, unit_of(d.kind));
  const int least = d.kind == ParameterKind::Extent ? 2 : 1;
  const std::string unit = unit_in_words(d.kind);
  const auto written = [&](double number, int places) { return fmt::format("{:.{}f}", number * factor, places); };
  if (!tolerance) return written(value, decimals_of({value * factor}, least)) + " " + unit;
  const auto& [low, high, symbol] = *tolerance;
  const int places = symbol ? decimals_of({value * factor}, least) : decimals_of({value * factor, low * factor, high * factor}, least);
  const auto limit = [&](double difference) { return difference == 0.0 ? std::string("0") : fmt::format("{:+.{}f}", difference * factor, places); };
  const std::string band = std::abs(high + low) < 1e-9 * std::abs(high) ? "± " + written(high, places) : limit(high) + " " + limit(low);
  return fmt::format("{} {} {}{}", written(value, places), band, unit, symbol ? fmt::format(" ({})", symbol) : std::string());
}

/// What is said where the study's tolerance of a relief goes below 0; empty where it does not.
std::string cut_tolerance(const ModificationDescriptor& d, double design, const DrawingTerms& terms) {
  const auto given = std::ranges::find(terms.amounts, d.key, &AmountTolerance::key);
  if (given == terms.amounts.end() || allowed_deviation(d, design, given->low) == given->low) return "";
  const int places = d.kind == ParameterKind::Extent ? 2 : 1;
  return fmt::format("    the study's tolerance goes down to {:.{}f} {}; the least that can be ground is 0",
                     (design + given->low) * outside_factor(d.kind), places, unit_in_words(d.kind));
}

/// ", parabolic" of the amount of a relief that is not of the usual shape.
std::string shape_in_words(const ModificationDescriptor& d, const Modification& modification) {
  for (const ModificationChoice& choice : modification_choices) {
    const std::string_view table = choice.key.substr(0, choice.key.find('.'));
    if (d.key != std::string(table) + ".amount") continue;
    for (std::size_t word = 1; word < choice.words.size(); ++word) {
      Modification other = modification;
      choice.set(other, word);
      if (other == modification) return ", " + std::string(choice.words[word]);
    }
  }
  return "";
}

/// Whether a number of a modification is one that a drawing states: of halves that are alike the whole, else both.
bool is_stated(const ModificationDescriptor& d, const Modification& modification) {
  if (d.get(modification) == 0.0) return false;
  if (!d.half.empty()) return find_parameter(d.half)->get(modification) == find_parameter(d.other_half)->get(modification);
  // The extent of a relief that is not ground says nothing.
  const auto is_ground = [&](const ModificationDescriptor& amount) { return amount.extent == d.key && amount.get(modification) != 0.0; };
  if (d.kind == ParameterKind::Extent && std::ranges::none_of(modification_parameters, is_ground)) return false;
  return std::ranges::none_of(modification_parameters, [&](const ModificationDescriptor& whole) {
    return (whole.half == d.key || whole.other_half == d.key) && whole.get(modification) != 0.0 &&
           find_parameter(whole.half)->get(modification) == find_parameter(whole.other_half)->get(modification);
  });
}

/// Where a profile relief begins, as diameter and roll length; nothing for other numbers.
std::vector<std::string> relief_start(const Gear& gear, const FlankFrame& frame, const ModificationDescriptor& d, const Modification& modification) {
  const double height = d.get(modification), start_at_tip = gear.tip_form_radius - height, start_at_root = gear.active_root_radius + height;
  const auto roll = [&](double radius) { return gear.roll_length_at(std::max(radius, gear.base_radius)); };
  if (d.key == "tip_relief.height") {
    return {fmt::format("from d_Ca = {:.3f} mm to the tip: roll length {:.3f} to {:.3f} mm", 2.0 * start_at_tip, roll(start_at_tip),
                        roll(gear.tip_form_radius))};
  }
  if (d.key == "root_relief.height") {
    return {fmt::format("from d_Nf up to d_Cf = {:.3f} mm: roll length {:.3f} to {:.3f} mm", 2.0 * start_at_root, roll(gear.active_root_radius),
                        roll(start_at_root))};
  }
  const bool at_tip = d.key == "triangular_tip_relief.height", at_root = d.key == "triangular_root_relief.height";
  if (!at_tip && !at_root) return {};
  const ContactLineCorner corner(frame, at_tip ? ContactLineCorner::At::Tip : ContactLineCorner::At::Root, height);
  return {fmt::format("from {} = {:.3f} mm at z = {:+g} mm, {} = {:.3f} mm", at_tip ? "d_Ea" : "d_Ef", 2.0 * (at_tip ? start_at_tip : start_at_root),
                      corner.face_end(), at_tip ? "L_Ea" : "L_Ef", corner.extent()),
          fmt::format("along a line of contact, {:.2f} mm along the {}", corner.reach_along_face(), at_tip ? "tip" : "start of active profile")};
}

/// The lines of one flank, each with those that explain it.
std::vector<std::vector<std::string>> amounts_of(const GearPair& pair, Member member, const Modification& modification, const FlankTolerances& t,
                                                 const DrawingTerms& terms) {
  std::vector<std::vector<std::string>> all;
  const ProcessPart process(pair, member, modification);
  for (const ModificationDescriptor& d : modification_parameters) {
    const bool stated = is_stated(d, modification);
    const double brought = process.of(d.key), set = stated ? d.get(modification) : 0.0;
    const auto tolerance = tolerance_of(d, set, t, terms);
    const bool has_own_tolerance = tolerance && tolerance->symbol == nullptr && d.kind != ParameterKind::Extent;  // an extent says nothing by itself
    if (!stated && brought == 0.0 && !has_own_tolerance) continue;
    const std::string symbol = d.symbol.empty() ? "" : std::string(d.symbol) + ", ", sense = d.sense.empty() ? "" : "; " + std::string(d.sense);
    std::vector<std::string> lines{
        fmt::format("{}{} = {}{}{}", symbol, d.name, value_in_words(d, set + brought, tolerance), shape_in_words(d, modification), sense)};
    if (brought != 0.0) {
      lines.push_back(set == 0.0 ? fmt::format("    brought by the grinding process{}", d.key == "twist" ? "" : ", at mid face")
                                 : fmt::format("    set {:.1f} µm, the grinding process brings {:.1f} µm", in_um(set), in_um(brought)));
    }
    if (const std::string cut = cut_tolerance(d, set, terms); !cut.empty()) lines.push_back(cut);
    if (stated && d.key.ends_with("_crowning") && d.flank_class == ModificationClass::Profile) {
      lines.push_back(fmt::format("    parabola with its vertex at the pitch circle, d_w = {:.3f} mm", 2.0 * pair[member].working_pitch_radius));
    }
    if (d.key == "twist") lines.push_back(fmt::format("    {} = C_Hα at z = +b/2 less C_Hα at z = -b/2", d.symbol));
    for (const std::string& start : relief_start(pair[member], pair.flank_frame(member), d, modification)) lines.push_back("    " + start);
    all.push_back(std::move(lines));
  }
  return all;
}

/// What the same tool leaves on the opposite flank in the same setting: amounts that differ from those of this one.
void add_opposite_flank(std::vector<std::string>& lines, const GearPair& pair, Member member, const Modification& modification,
                        const FlankTolerances& t, const DrawingTerms& terms) {
  const auto here = amounts_of(pair, member, modification, t, terms);
  const auto there = amounts_of(pair.on_other_flanks(), member, on_opposite_flank(modification), t, terms);
  lines.push_back(fmt::format("The {} flank, by the same tool in the same setting, z as here:", name_of(opposite(pair.data.working_flank))));
  bool differs = false;
  for (const std::vector<std::string>& amount : there) {
    if (std::ranges::find(here, amount) != here.end()) continue;
    lines.push_back(amount.front());
    differs = true;
  }
  lines.emplace_back(differs ? "    all others as above" : "    the same amounts");
}

/// "by form grinding, wheel of 300 mm, its natural twist compensated by 100 %"; empty where the study names no process.
std::string process_in_words(const GrindingProcess& process, bool helical) {
  if (process.kind == GrindingKind::None) return "";
  if (process.kind == GrindingKind::Topological) return "by topological grinding";
  const std::string kind =
      process.kind == GrindingKind::FormGrinding ? fmt::format("form grinding, wheel of {:g} mm", process.wheel_diameter) : "generating grinding";
  if (!helical) return "by " + kind;
  const double compensated = percent * process.twist_compensation;
  return fmt::format("by {}, its natural twist {}", kind,
                     compensated > 0.0 ? fmt::format("compensated by {:.4g} %", compensated) : "not compensated");
}

/// What the tool leaves that is no straight rack; empty for one.
std::string generated_form(const Generation& generation) {
  if (const auto* rack = std::get_if<ParabolicRack>(&generation))
    return rack->coefficient == 0.0 ? "" : fmt::format("the form cut by a parabolic rack, a_c = {:g} 1/mm", rack->coefficient);
  const auto* tool = std::get_if<RevolutionTool>(&generation);
  if (tool == nullptr) return "";
  const std::string arc = std::isfinite(tool->arc_radius) ? fmt::format(", arc of {:g} mm", tool->arc_radius) : "";
  return fmt::format("the form cut by a surface of revolution, half apex {:g}°, d = {:g} mm{}", in_deg(tool->half_apex), tool->distance, arc);
}

std::string tolerance_line(const char* symbol, double tolerance, bool either_way) {
  return fmt::format("{} = {}{:g} µm", symbol, either_way ? "± " : "", in_um(rounded_tolerance(tolerance)));
}

}  // namespace

std::vector<std::string> drawing_lines(const GearPair& pair, Member member, const Modification& modification, const FlankTolerances& t,
                                       const DrawingTerms& terms) {
  const Gear& gear = pair[member];
  std::vector<std::string> lines{fmt::format("The {} flank as ground, material removed:", name_of(pair.data.working_flank))};
  if (const std::string process = process_in_words(terms.process, pair.data.helix_angle != 0.0); !process.empty()) lines.push_back(process);
  const auto amounts = amounts_of(pair, member, modification, t, terms);
  for (const std::vector<std::string>& amount : amounts) lines.insert(lines.end(), amount.begin(), amount.end());
  const std::string generated = generated_form(gear.data.generation);
  if (amounts.empty() && generated.empty() && !modification.topography) lines.emplace_back("none");
  if (!generated.empty()) lines.push_back(generated);
  if (modification.topography) lines.emplace_back("and the topography of its grid");
  lines.push_back(fmt::format("Evaluated from d_Nf = {:.3f} mm to d_Fa = {:.3f} mm:", 2.0 * gear.active_root_radius, 2.0 * gear.tip_form_radius));
  lines.push_back(
      fmt::format("    roll length {:.3f} to {:.3f} mm", gear.roll_length_at(gear.active_root_radius), gear.roll_length_at(gear.tip_form_radius)));
  if (pair.contact_line_sense() != 0) {
    lines.push_back(
        fmt::format("    z from mid face; the flank makes an acute angle with the face at z = {}b/2", pair.acute_end(member) > 0 ? "+" : "-"));
  }
  if (terms.ties_flanks) add_opposite_flank(lines, pair, member, modification, t, terms);
  lines.push_back(fmt::format("ISO 1328-1:2013, class {}:", terms.tolerance_class));
  for (const auto& [symbol, tolerance, either_way] :
       {std::tuple{"f_HαT", t.profile_slope, true}, std::tuple{"f_fαT", t.profile_form, false}, std::tuple{"F_αT", t.profile_total, false},
        std::tuple{"f_HβT", t.helix_slope, true}, std::tuple{"f_fβT", t.helix_form, false}, std::tuple{"F_βT", t.helix_total, false},
        std::tuple{"f_pT", t.single_pitch, true}, std::tuple{"F_pT", t.cumulative_pitch, false}}) {
    lines.push_back(tolerance_line(symbol, tolerance, either_way));
  }
  return lines;
}

}  // namespace flankwright::studies
