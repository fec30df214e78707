#include "studies/results/drawing_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

// Lengths of the sheet [px].
constexpr double left = 60.0, panel_width = 180.0, panel_height = 200.0, between_panels = 14.0;
constexpr double lines_left = left + 3.0 * panel_width + 2.0 * between_panels + 36.0, sheet_width = lines_left + 440.0;
constexpr double lines_top = 54.0, line_height = 18.0, least_height = 620.0;
constexpr double profile_top = 24.0, helix_top = 326.0;  // of the charts

/// A panel's window: mm and um to the picture.
struct Window {
  double left, top, width, height;  // of the picture
  double low, high, lowest_um, highest_um;

  double x(double along) const { return left + width * (along - low) / (high - low); }
  double y(double um) const { return top + height * (highest_um - um) / (highest_um - lowest_um); }
};

std::string points(const Window& window, const std::vector<double>& along, const std::vector<double>& deviation) {
  std::string text;
  for (std::size_t i = 0; i < along.size(); ++i) {
    text += fmt::format("{}{:.2f},{:.3f}", i == 0 ? "" : " ", window.x(along[i]), window.y(in_um(deviation[i])));
  }
  return text;
}

std::string text_at(double x, double y, const std::string& text, const char* anchor = "start") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" xml:space=\"preserve\">{}</text>\n", x, y, anchor, text);
}

/// The step of about six ticks over a range: 1, 2 or 5 of a decade.
double tick_step(double range) {
  const double rough = range / 6.0, decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * decade >= rough) return digit * decade;
  }
  return 10.0 * decade;
}

/// One trace within its band, with the lines of the common scale.
std::string panel(const Window& window, const FlankTrace& trace, const std::string& at, const std::function<std::string(double)>& below) {
  std::string out = text_at(window.left + 0.5 * window.width, window.top - 6.0, at, "middle");
  const double step = tick_step(window.highest_um - window.lowest_um);
  for (double tick = std::ceil(window.lowest_um / step) * step; tick < window.highest_um; tick += step) {
    const bool is_zero = std::abs(tick) < 0.5 * step;
    out += fmt::format("<line class=\"{3}\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.2f}\" y2=\"{2:.2f}\"/>\n", window.left, window.left + window.width,
                       window.y(tick), is_zero ? "zero" : "tick");
  }
  const std::vector<double> back(trace.along.rbegin(), trace.along.rend()), low(trace.low.rbegin(), trace.low.rend());
  out += fmt::format("<polygon class=\"band\" points=\"{} {}\"/>\n", points(window, trace.along, trace.high), points(window, back, low));
  out += fmt::format("<polyline class=\"trace\" points=\"{}\"><title>{}</title></polyline>\n", points(window, trace.along, trace.deviation), at);
  out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", window.left, window.top, window.width, window.height);
  const double line = window.top + window.height + 16.0;
  out += text_at(window.left, line, fmt::format("{:.2f}", window.low));
  out += text_at(window.left + window.width, line, fmt::format("{:.2f}", window.high), "end");
  if (below) {
    out += text_at(window.left, line + 15.0, below(window.low));
    out += text_at(window.left + window.width, line + 15.0, below(window.high), "end");
  }
  return out;
}

/// What distinguishes the two charts of a sheet.
struct ChartText {
  const char* name;
  std::string title, axis;
  std::function<std::string(double)> at;     ///< of a trace
  std::function<std::string(double)> below;  ///< a second line at the ends of the axis; empty: none
};

/// A K-chart: the traces side by side, each within its own band, on one scale.
std::string chart(const std::vector<FlankTrace>& traces, double top, const ChartText& text) {
  double lowest = INFINITY, highest = -INFINITY;
  for (const FlankTrace& trace : traces) {
    lowest = std::min(lowest, in_um(*std::ranges::min_element(trace.low)));
    highest = std::max(highest, in_um(*std::ranges::max_element(trace.high)));
  }
  const double room = 0.05 * (highest - lowest);
  Window window{left, top + 38.0, panel_width, panel_height, 0.0, 0.0, lowest - room, highest + room};
  std::string out = fmt::format("<g id=\"{}\" data-um-per-unit=\"{:.9g}\">\n", text.name, (window.highest_um - window.lowest_um) / window.height);
  out += text_at(left, top + 12.0, text.title);
  const double step = tick_step(window.highest_um - window.lowest_um);
  for (double tick = std::ceil(window.lowest_um / step) * step; tick < window.highest_um; tick += step) {
    out += text_at(left - 6.0, window.y(tick) + 4.0, fmt::format("{:g}", std::abs(tick) < 0.5 * step ? 0.0 : tick), "end");
  }
  for (const FlankTrace& trace : traces) {
    window.low = trace.along.front();
    window.high = trace.along.back();
    out += panel(window, trace, text.at(trace.at), text.below);
    window.left += panel_width + between_panels;
  }
  out += text_at(left + 1.5 * panel_width + between_panels, window.top + window.height + (text.below ? 47.0 : 32.0), text.axis, "middle");
  return out + "</g>\n";
}

constexpr const char* style = R"(<style>
.sheet { font: 12px sans-serif; fill: #222; background: #fff; }
.sheet polygon { fill: #9ecae1; fill-opacity: 0.5; stroke: #3182bd; stroke-width: 0.7; }
.sheet polyline { fill: none; stroke: #08306b; stroke-width: 1.6; }
.sheet rect, .sheet line { fill: none; stroke: #888; stroke-width: 0.7; }
.sheet .tick { stroke: #ddd; }
</style>
)";

}  // namespace

std::string drawing_svg(const FlankDrawing& drawing) {
  const double height = std::max(least_height, lines_top + line_height * static_cast<double>(drawing.lines.size()) + 10.0);
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sheet\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\">\n",
                  sheet_width, height);
  svg += style;
  svg += text_at(left, 16.0, fmt::format("Flank of the {}: what to write on the drawing", drawing.gear));
  const FlankTolerances& t = drawing.tolerances;
  const auto band = [](double total) { return fmt::format("{:g} µm", in_um(rounded_tolerance(total))); };
  const auto diameter = [&](double roll) { return fmt::format("d {:.2f}", 2.0 * std::hypot(roll, drawing.base_radius)); };
  svg += chart(
      drawing.profiles, profile_top,
      {"profile", fmt::format("Profile [µm], + = metal added; design traces within F_αT = {} and the tolerances of amounts", band(t.profile_total)),
       "roll length and diameter [mm]", [](double z) { return fmt::format("z = {:.2f} mm", z); }, diameter});
  svg += chart(drawing.helices, helix_top,
               {"helix",
                fmt::format("Helix [µm], + = metal added; design traces within F_βT = {} and the tolerances of amounts", band(t.helix_total)),
                "z [mm]",
                [](double radius) { return fmt::format("d = {:.2f} mm", 2.0 * radius); },
                {}});
  double y = lines_top;
  for (const std::string& line : drawing.lines) {
    svg += text_at(lines_left, y, line);
    y += line_height;
  }
  return svg + "</svg>\n";
}

}  // namespace flankwright::studies
