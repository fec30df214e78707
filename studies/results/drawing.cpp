#include "studies/results/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/flank/flank.hpp"
#include "core/flank/natural_twist.hpp"

namespace flankwright::studies {

namespace {

constexpr int stations = 41;  // of a trace

double part(int i) { return static_cast<double>(i) / (stations - 1); }

FlankTrace profile_at(const GearPair& pair, Member member, const Flank& flank, double z) {
  const Gear& gear = pair[member];
  FlankTrace trace{.at = z, .along = {}, .deviation = {}};
  for (int i = 0; i < stations; ++i) {
    const double r = gear.active_root_radius + (gear.tip_form_radius - gear.active_root_radius) * part(i);
    trace.along.push_back(std::sqrt(std::max(0.0, r * r - gear.base_radius * gear.base_radius)));
    trace.deviation.push_back(-flank.deviation(flank.roll_at(r), z, 0));
  }
  return trace;
}

FlankTrace helix_at(const GearPair& pair, Member member, const Flank& flank, double r) {
  FlankTrace trace{.at = r, .along = {}, .deviation = {}};
  for (int i = 0; i < stations; ++i) {
    const double z = (part(i) - 0.5) * pair[member].data.face_width;
    trace.along.push_back(z);
    trace.deviation.push_back(-flank.deviation(flank.roll_at(r), z, 0));
  }
  return trace;
}

std::string tolerance_line(const char* symbol, double tolerance, bool either_way) {
  return fmt::format("{} = {}{:g} µm", symbol, either_way ? "± " : "", in_um(rounded_tolerance(tolerance)));
}

/// A length with the decimals that it has, from `least` to 3; one that needs more with the least: it is no multiple of a grinder's step.
std::string in_decimals(double value, int least) {
  for (int places = least; places <= 3; ++places) {
    const double scaled = value * std::pow(10.0, places);
    if (std::abs(scaled - std::round(scaled)) < 1e-6) return fmt::format("{:.{}f}", value, places);  // 1e-6 of a place is round-off
  }
  return fmt::format("{:.{}f}", value, least);
}

std::string value_in_words(const ModificationDescriptor& d, double value) {
  switch (d.kind) {
    case ParameterKind::Amount:
      return in_decimals(value, 1) + " µm";
    case ParameterKind::Extent:
      return in_decimals(value, 2) + " mm";
    default:
      return fmt::format("{:.3g} {}", value, unit_of(d.kind));
  }
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

std::vector<std::string> lines_of(const GearPair& pair, Member member, const Modification& modification, const FlankTolerances& t,
                                  int tolerance_class) {
  std::vector<std::string> lines{"Modifications, material removed:"};
  const auto in_reach = [&](const ModificationDescriptor& d) {
    if (d.get(modification) == 0.0) return false;
    if (!d.half.empty()) return find_parameter(d.half)->get(modification) == find_parameter(d.other_half)->get(modification);
    // Of halves that are alike the whole is said.
    return std::ranges::none_of(modification_parameters, [&](const ModificationDescriptor& whole) {
      return (whole.half == d.key || whole.other_half == d.key) && whole.get(modification) != 0.0 &&
             find_parameter(whole.half)->get(modification) == find_parameter(whole.other_half)->get(modification);
    });
  };
  for (const ModificationDescriptor& d : modification_parameters) {
    const bool is_extent = d.kind == ParameterKind::Extent;
    // The extent of a relief that is not ground says nothing.
    const bool is_idle = is_extent && std::ranges::none_of(modification_parameters, [&](const ModificationDescriptor& amount) {
                           return amount.extent == d.key && amount.get(modification) != 0.0;
                         });
    if (is_idle || !in_reach(d)) continue;
    const std::string symbol = d.symbol.empty() ? "" : std::string(d.symbol) + ", ";
    lines.push_back(
        fmt::format("{}{} = {}{}", symbol, d.name, value_in_words(d, d.get(modification) * outside_factor(d.kind)), shape_in_words(d, modification)));
  }
  if (lines.size() == 1) lines.emplace_back("none");
  const double twist = natural_twist(pair, member, modification);
  if (twist != 0.0) lines.push_back(fmt::format("S, natural twist of the grinding = {:.1f} µm", in_um(twist)));
  lines.push_back(fmt::format("ISO 1328-1:2013, class {}:", tolerance_class));
  for (const auto& [symbol, tolerance, either_way] :
       {std::tuple{"f_HαT", t.profile_slope, true}, std::tuple{"f_fαT", t.profile_form, false}, std::tuple{"F_αT", t.profile_total, false},
        std::tuple{"f_HβT", t.helix_slope, true}, std::tuple{"f_fβT", t.helix_form, false}, std::tuple{"F_βT", t.helix_total, false},
        std::tuple{"f_pT", t.single_pitch, true}, std::tuple{"F_pT", t.cumulative_pitch, false}}) {
    lines.push_back(tolerance_line(symbol, tolerance, either_way));
  }
  return lines;
}

/// A chart's window: mm and um to the picture.
struct Window {
  double left, top, width, height;  // of the picture
  double low, high, lowest_um, highest_um;

  double x(double along) const { return left + width * (along - low) / (high - low); }
  double y(double um) const { return top + height * (highest_um - um) / (highest_um - lowest_um); }
};

std::string points(const Window& window, const FlankTrace& trace, double shift_um) {
  std::string text;
  for (std::size_t i = 0; i < trace.along.size(); ++i) {
    text += fmt::format("{}{:.2f},{:.3f}", i == 0 ? "" : " ", window.x(trace.along[i]), window.y(in_um(trace.deviation[i]) + shift_um));
  }
  return text;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor = "start") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

/// A K-chart: the band about the middle trace, the traces, and axes.
std::string chart(const std::string& name, const std::vector<FlankTrace>& traces, double total, double top, const char* title, const char* axis,
                  const char* at) {
  const FlankTrace& middle = traces[1];
  const double half = 0.5 * in_um(total);
  Window window{60.0, top + 30.0, 420.0, 200.0, middle.along.front(), middle.along.back(), INFINITY, -INFINITY};
  for (const FlankTrace& trace : traces) {
    for (const double d : trace.deviation) {
      window.lowest_um = std::min(window.lowest_um, in_um(d) - half);
      window.highest_um = std::max(window.highest_um, in_um(d) + half);
    }
  }
  const double room = 0.05 * (window.highest_um - window.lowest_um);
  window.lowest_um -= room;
  window.highest_um += room;
  std::string out = fmt::format("<g id=\"{}\" data-um-per-unit=\"{:.9g}\">\n", name, (window.highest_um - window.lowest_um) / window.height);
  out += text_at(window.left, top + 18.0, fmt::format("{}, + = metal added; band {:g} µm", title, in_um(rounded_tolerance(total))));
  FlankTrace back = middle;
  std::reverse(back.along.begin(), back.along.end());
  std::reverse(back.deviation.begin(), back.deviation.end());
  out += fmt::format("<polygon class=\"band\" points=\"{} {}\"/>\n", points(window, middle, half), points(window, back, -half));
  constexpr const char* styles[]{"side", "middle", "other"};
  for (std::size_t i = 0; i < traces.size(); ++i) {
    out += fmt::format("<polyline class=\"{}\" points=\"{}\"><title>{} {:.2f} mm</title></polyline>\n", styles[i], points(window, traces[i], 0.0), at,
                       traces[i].at);
  }
  out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", window.left, window.top, window.width, window.height);
  for (const double um : {window.lowest_um + room, window.highest_um - room})
    out += text_at(54.0, window.y(um) + 4.0, fmt::format("{:.1f}", um), "end");
  if (window.lowest_um < 0.0 && window.highest_um > 0.0) {
    out +=
        fmt::format("<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.2f}\" y2=\"{2:.2f}\"/>\n", window.left, window.left + window.width, window.y(0.0));
  }
  const double below = window.top + window.height + 16.0;
  out += text_at(window.left, below, fmt::format("{:.2f}", window.low));
  out += text_at(window.left + window.width, below, fmt::format("{:.2f}", window.high), "end");
  out += text_at(window.left + 0.5 * window.width, below, axis, "middle");
  std::vector<std::string> places;
  for (const FlankTrace& trace : traces) places.push_back(fmt::format("{:.2f}", trace.at));
  out += text_at(window.left, below + 16.0, fmt::format("{} = {} (dashed), {} (thick), {} mm (thin)", at, places[0], places[1], places[2]));
  return out + "</g>\n";
}

constexpr const char* style = R"(<style>
.sheet { font: 12px sans-serif; fill: #222; }
.sheet polygon { fill: #9ecae1; fill-opacity: 0.5; stroke: #3182bd; stroke-width: 0.7; }
.sheet polyline { fill: none; stroke: #08306b; }
.sheet .middle { stroke-width: 2; } .sheet .side { stroke-dasharray: 5 3; } .sheet .other { stroke-width: 0.8; }
.sheet rect, .sheet line { fill: none; stroke: #888; stroke-width: 0.7; }
</style>
)";

Json traces_json(const std::vector<FlankTrace>& traces, const char* at, const char* along) {
  return list(traces, [&](const FlankTrace& trace) -> Json {
    return {{at, trace.at}, {along, trace.along}, {"deviation_um", list(trace.deviation, in_um)}};
  });
}

}  // namespace

FlankDrawing make_drawing(const GearPair& pair, Member member, const Modification& modification, int tolerance_class) {
  const Gear& gear = pair[member];
  const Flank flank = make_flank(pair, member, modification, {});
  FlankDrawing drawing;
  drawing.gear = std::string(name_of(member));
  drawing.tolerance_class = tolerance_class;
  drawing.tolerances = flank_tolerances(ToleranceData::of(pair, member), tolerance_class);
  for (const double share : {-0.4, 0.0, 0.4}) drawing.profiles.push_back(profile_at(pair, member, flank, share * gear.data.face_width));
  for (const double share : {0.1, 0.5, 0.9}) {
    drawing.helices.push_back(helix_at(pair, member, flank, gear.active_root_radius + share * (gear.tip_form_radius - gear.active_root_radius)));
  }
  drawing.lines = lines_of(pair, member, modification, drawing.tolerances, tolerance_class);
  return drawing;
}

std::vector<FlankDrawing> drawings_of(const StudyResults& results) {
  const Study& study = results.study;
  const std::optional<int> tolerance_class = study.drawing_class ? study.drawing_class : study.optimise.scatter.iso_1328_class;
  std::vector<FlankDrawing> drawings;
  if (!tolerance_class) return drawings;
  const PerGear<Modification>& ground = results.design ? results.design->after.analysis.modification : study.modification;
  for (const Member member : {Member::Pinion, Member::Wheel})
    drawings.push_back(make_drawing(results.pair, member, ground[member], *tolerance_class));
  return drawings;
}

std::string drawing_svg(const FlankDrawing& drawing) {
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sheet\" width=\"820\" height=\"580\" viewBox=\"0 0 820 580\">\n";
  svg += style;
  svg += text_at(60.0, 16.0, fmt::format("Flank of the {}: what to write on the drawing", drawing.gear));
  svg += chart("profile", drawing.profiles, drawing.tolerances.profile_total, 20.0, "Profile", "roll length [mm], root to tip", "z");
  svg += chart("helix", drawing.helices, drawing.tolerances.helix_total, 300.0, "Helix", "z [mm]", "radius");
  double y = 54.0;
  for (const std::string& line : drawing.lines) {
    svg += text_at(520.0, y, line);
    y += 18.0;
  }
  return svg + "</svg>\n";
}

Json drawing_json(const FlankDrawing& drawing) {
  return {{"gear", drawing.gear},
          {"iso_1328_class", drawing.tolerance_class},
          {"profile_band_um", in_um(drawing.tolerances.profile_total)},
          {"helix_band_um", in_um(drawing.tolerances.helix_total)},
          {"profiles", traces_json(drawing.profiles, "z_mm", "roll_length_mm")},
          {"helices", traces_json(drawing.helices, "radius_mm", "z_mm")},
          {"lines", drawing.lines},
          {"sheet", drawing_svg(drawing)}};
}

}  // namespace flankwright::studies
