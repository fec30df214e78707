#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "core/flank/natural_twist.hpp"
#include "studies/results/drawing.hpp"
#include "studies/results/drawing_sheet.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"

namespace flankwright::studies {
namespace {

/// Points "x,y x,y" of the first element of a class behind a place.
std::vector<std::pair<double, double>> points_of(const std::string& svg, const std::string& element, std::size_t from) {
  const std::string mark = "points=\"";
  const std::size_t at = svg.find(mark, svg.find(element, from)) + mark.size();
  std::istringstream text(svg.substr(at, svg.find('"', at) - at));
  std::vector<std::pair<double, double>> points;
  double x = 0.0, y = 0.0;
  for (char comma = 0; text >> x >> comma >> y;) points.emplace_back(x, y);
  return points;
}

FlankDrawing crowned(int tolerance_class) {
  const Study study = study_texts::read();
  Modification m;
  set(m, parameter_of("lead_crowning"), 8.0 * units::um);
  set(m, parameter_of("profile_crowning"), 5.0 * units::um);
  return make_drawing(make_gear_pair(study.pair), Member::Pinion, m, {.tolerance_class = tolerance_class});
}

TEST_CASE("The band of a K-chart is as wide as the total tolerance of the class", "[studies][drawing]") {
  for (const int tolerance_class : {4, 7}) {
    const FlankDrawing drawing = crowned(tolerance_class);
    const std::string svg = drawing_svg(drawing);
    for (const auto& [chart, total] : {std::pair{"profile", drawing.tolerances.profile_total}, std::pair{"helix", drawing.tolerances.helix_total}}) {
      CAPTURE(tolerance_class, chart);
      const std::size_t at = svg.find("<g id=\"" + std::string(chart) + "\"");
      REQUIRE(at != std::string::npos);
      const std::string mark = "data-um-per-unit=\"";
      const double um_per_unit = std::stod(svg.substr(svg.find(mark, at) + mark.size()));
      const auto band = points_of(svg, "class=\"band\"", at);
      const std::size_t n = band.size() / 2;
      REQUIRE(n == drawing.profiles[1].along.size());
      for (std::size_t i = 0; i < n; ++i) {
        const double width = (band[band.size() - 1 - i].second - band[i].second) * um_per_unit;
        CHECK(width == tests::about(total / units::um, 2.0 * 0.001 * um_per_unit));  // coordinates have three decimals
      }
    }
  }
}

TEST_CASE("Traces of a crowned flank are its parabolas, metal added", "[studies][drawing][closed-form]") {
  const FlankDrawing drawing = crowned(6);
  constexpr double round_off = 1e-12;  // mm
  // The middle helix deviates from its middle by C_beta (2z/b)^2.
  const FlankTrace& helix = drawing.helices[1];
  const double middle = helix.deviation[helix.deviation.size() / 2], b = helix.along.back() - helix.along.front();
  for (std::size_t i = 0; i < helix.along.size(); ++i) {
    CHECK(helix.deviation[i] - middle == tests::about(-8.0 * units::um * std::pow(2.0 * helix.along[i] / b, 2), round_off));
  }
}

TEST_CASE("A drawing has the amounts that were set, and the shape of a relief", "[studies][drawing]") {
  const Study study = study_texts::read();
  Modification m;
  set(m, parameter_of("tip_relief.amount"), 7.25 * units::um);
  set(m, parameter_of("tip_relief.height"), 2.0);
  set(m, parameter_of("lead_crowning"), 5.831724 * units::um);
  const auto line_with = [&](const std::string& name) {
    for (const std::string& line : make_drawing(make_gear_pair(study.pair), Member::Pinion, m, {.tolerance_class = 6}).lines) {
      if (line.find(name) != std::string::npos) return line;
    }
    return std::string("no line with " + name);
  };
  CHECK(line_with("tip relief =").ends_with("tip relief = 7.25 µm"));  // a step of 0.25 um
  CHECK(line_with("tip relief height").ends_with("= 2.00 mm"));
  CHECK_THAT(line_with("lead crowning"), Catch::Contains("= 5.8 ± "));  // no multiple of a grinder's step
  m.tip_relief.shape = ReliefShape::Parabolic;
  CHECK(line_with("tip relief =").ends_with("tip relief = 7.25 µm, parabolic"));
}

TEST_CASE("A drawing of a generated flank names the tool instead of no removal", "[studies][drawing]") {
  const auto lines_of = [](const std::string& generation) {
    std::string all;
    const Study study = study_texts::read(generation);
    for (const std::string& line : make_drawing(make_gear_pair(study.pair), Member::Pinion, {}, {.tolerance_class = 6}).lines) all += line + "\n";
    return all;
  };
  CHECK_THAT(lines_of(""), Catch::Contains("\nnone\n"));
  const std::string generated = lines_of("[pinion.generation]\nkind = \"parabolic_rack\"\ncoefficient = 0.0005\n");
  CHECK_THAT(generated, Catch::Contains("parabolic rack, a_c = 0.0005 1/mm"));
  CHECK(generated.find("none") == std::string::npos);
}

/// A helical pair, 25:61, of 45 mm of face.
GearPair helical() {
  PairData data;
  data.normal_module = 3.5;
  data.helix_angle = 22.0 * units::deg;
  data.pinion.teeth = 25;
  data.pinion.face_width = 45.0;
  data.wheel.teeth = 61;
  data.wheel.face_width = 45.0;
  return make_gear_pair(data);
}

/// Ground by generating, with a lead slope and crowning [um].
Modification ground(double slope, double crowning) {
  Modification m;
  set(m, parameter_of("lead_slope"), slope * units::um);
  set(m, parameter_of("lead_crowning"), crowning * units::um);
  m.process.kind = GrindingKind::GeneratingGrinding;
  return m;
}

/// The first line that contains a text, and the one below it.
std::pair<std::string, std::string> lines_with(const FlankDrawing& drawing, const std::string& text) {
  const auto at = std::ranges::find_if(drawing.lines, [&](const std::string& line) { return line.find(text) != std::string::npos; });
  if (at == drawing.lines.end()) return {"no line with " + text, ""};
  return {*at, at + 1 == drawing.lines.end() ? "" : *(at + 1)};
}

double number_behind(const std::string& line, const std::string& mark) { return std::stod(line.substr(line.find(mark) + mark.size())); }

TEST_CASE("Each trace of a flank that its process twists lies in the middle of its own band", "[studies][drawing]") {
  const std::string svg = drawing_svg(make_drawing(helical(), Member::Pinion, ground(0.0, 20.0), {.tolerance_class = 6}));
  std::vector<double> tips;  // of the profile traces [px]
  std::size_t at = svg.find("<g id=\"profile\"");
  for (int trace = 0; trace < 6; ++trace) {
    CAPTURE(trace);
    at = svg.find("class=\"band\"", at);
    REQUIRE(at != std::string::npos);
    const auto band = points_of(svg, "class=\"band\"", at), line = points_of(svg, "class=\"trace\"", at);
    REQUIRE(band.size() == 2 * line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
      // Coordinates have three decimals.
      CHECK(0.5 * (band[i].second + band[band.size() - 1 - i].second) == tests::about(line[i].second, 0.0015));
      CHECK(band[i].second < line[i].second);
    }
    if (trace < 3) tips.push_back(line.back().second - line.front().second);
    ++at;
  }
  // The twist is seen: the end traces slope to opposite sides, each as much as the other.
  CHECK(tips[0] * tips[2] < 0.0);
  CHECK(tips[0] == Approx(-tips[2]).epsilon(0.02));  // what crowning adds at the ends is even
}

TEST_CASE("A drawing states what grinding brings with a lead slope and with crowning, by the formulae of generating grinding",
          "[studies][drawing][closed-form]") {
  const GearPair pair = helical();
  const double shift = std::tan(pair.base_helix_angle) *
                       (pair.pinion.roll_length_at(pair.pinion.tip_form_radius) - pair.pinion.roll_length_at(pair.pinion.active_root_radius)) / 45.0;
  constexpr double decimal = 0.051;  // um: amounts have one decimal
  const FlankDrawing sloped = make_drawing(pair, Member::Pinion, ground(14.0, 0.0), {.tolerance_class = 6});
  const auto [slope, why] = lines_with(sloped, "C_Hα, profile slope");
  // C_Hbeta tan(beta_b) g_alpha/b
  CHECK(std::abs(number_behind(slope, "= ")) == tests::about(14.0 * shift, decimal));
  CHECK_THAT(slope, Catch::Contains("+ removes at the tip"));
  CHECK_THAT(why, Catch::Contains("grinding process"));
  CHECK(number_behind(lines_with(sloped, "C_Hβ, lead slope").first, "= ") == tests::about(14.0, decimal));

  const FlankDrawing crowned = make_drawing(pair, Member::Pinion, ground(0.0, 20.0), {.tolerance_class = 6});
  const auto twist = lines_with(crowned, "S_α, twist").first;
  // 8 C_beta tan(beta_b) g_alpha/b, and a profile crowning of C_beta (tan(beta_b) g_alpha/b)^2
  CHECK(std::abs(number_behind(twist, "= ")) == tests::about(8.0 * 20.0 * shift, decimal));
  CHECK(number_behind(twist, "= ") == tests::about(natural_twist(pair, Member::Pinion, ground(0.0, 20.0)) / units::um, decimal));
  CHECK(number_behind(lines_with(crowned, "C_α, profile crowning").first, "= ") == tests::about(20.0 * shift * shift, decimal));

  // The helix in the middle of the profile is the crowning alone; those beside it lean.
  const auto lean = [&](std::size_t trace) { return crowned.helices[trace].deviation.back() - crowned.helices[trace].deviation.front(); };
  constexpr double round_off = 1e-9;  // mm: the middle of the profile from two roots
  CHECK(lean(1) == tests::about(0.0, round_off));
  CHECK(lean(0) * lean(2) < 0.0);

  // A profile slope that is set against it leaves nothing of it.
  Modification corrected = ground(14.0, 0.0);
  set(corrected, parameter_of("profile_slope"), -number_behind(slope, "= ") * units::um);
  const auto rest = lines_with(make_drawing(pair, Member::Pinion, corrected, {.tolerance_class = 6}), "C_Hα, profile slope");
  CHECK(number_behind(rest.first, "= ") == tests::about(0.0, decimal));
  CHECK_THAT(rest.second, Catch::Contains("set ") && Catch::Contains("brings "));
}

TEST_CASE("The band of an amount is written beside it and widens the K-chart where the amount removes", "[studies][drawing]") {
  const GearPair pair = helical();
  Modification m;
  set(m, parameter_of("tip_relief.amount"), 22.0 * units::um);
  set(m, parameter_of("tip_relief.height"), 2.0);
  const DrawingTerms terms{.tolerance_class = 6, .amounts = {{"tip_relief.amount", -3.0 * units::um, 3.0 * units::um}}};
  const FlankDrawing drawing = make_drawing(pair, Member::Pinion, m, terms);
  CHECK_THAT(lines_with(drawing, "tip relief =").first, Catch::Contains("C_αa, tip relief = 22.0 ± 3.0 µm"));
  const FlankTrace& profile = drawing.profiles[1];
  constexpr double round_off = 1e-12;  // mm
  CHECK(profile.high.front() - profile.low.front() == tests::about(drawing.tolerances.profile_total, round_off));
  CHECK(profile.high.back() - profile.low.back() == tests::about(drawing.tolerances.profile_total + 6.0 * units::um, round_off));
  // More may be removed than added.
  const DrawingTerms uneven{.tolerance_class = 6, .amounts = {{"tip_relief.amount", -1.0 * units::um, 4.0 * units::um}}};
  const FlankDrawing other = make_drawing(pair, Member::Pinion, m, uneven);
  CHECK_THAT(lines_with(other, "tip relief =").first, Catch::Contains("22.0 +4.0 -1.0 µm"));
  CHECK(other.profiles[1].deviation.back() - other.profiles[1].low.back() ==
        tests::about(0.5 * other.tolerances.profile_total + 4.0 * units::um, round_off));
}

TEST_CASE("The tolerance of a relief ends at 0, and the drawing says so", "[studies][drawing]") {
  const GearPair pair = helical();
  Modification m;
  set(m, parameter_of("tip_relief.amount"), 2.0 * units::um);
  set(m, parameter_of("tip_relief.height"), 1.5);
  constexpr double round_off = 1e-12;  // mm
  const FlankDrawing amount =
      make_drawing(pair, Member::Pinion, m, {.tolerance_class = 6, .amounts = {{"tip_relief.amount", -3.0 * units::um, 3.0 * units::um}}});
  const auto [line, below] = lines_with(amount, "tip relief =");
  CHECK_THAT(line, Catch::Contains("= 2.0 +3.0 -2.0 µm"));
  CHECK_THAT(below, Catch::Contains("goes down to -1.0 µm; the least that can be ground is 0"));
  // At the tip the band reaches the flank without relief, not one with metal added.
  const FlankTrace& tip = amount.profiles[1];
  CHECK(tip.high.back() - tip.deviation.back() == tests::about(0.5 * amount.tolerances.profile_total + 2.0 * units::um, round_off));
  const FlankDrawing height = make_drawing(pair, Member::Pinion, m, {.tolerance_class = 6, .amounts = {{"tip_relief.height", -2.0, 0.5}}});
  CHECK_THAT(lines_with(height, "tip relief height").first, Catch::Contains("= 1.50 +0.50 -1.50 mm"));
  CHECK_THAT(lines_with(height, "goes down to").first, Catch::Contains("-0.50 mm"));
  // A relief over no height removes nothing: nowhere does the band leave that of the design by more than the relief.
  const FlankTrace& profile = height.profiles[1];
  for (std::size_t i = 0; i < profile.along.size(); ++i) {
    CAPTURE(i);
    const double added = profile.high[i] - profile.deviation[i] - 0.5 * height.tolerances.profile_total;
    CHECK(added >= -round_off);
    CHECK(added <= 2.0 * units::um + round_off);
  }
  // The least amount of a relief that is not ground is 0, and a slope has either sign.
  set(m, parameter_of("tip_relief.amount"), 0.0);
  const DrawingTerms terms{.tolerance_class = 6,
                           .amounts = {{"tip_relief.amount", -3.0 * units::um, 3.0 * units::um}, {"lead_slope", -3.0 * units::um, 3.0 * units::um}}};
  CHECK_THAT(lines_with(make_drawing(pair, Member::Pinion, m, terms), "tip relief =").first, Catch::Contains("= 0.0 +3.0 0 µm"));
  CHECK_THAT(lines_with(make_drawing(pair, Member::Pinion, m, terms), "lead slope =").first, Catch::Contains("= 0.0 ± 3.0 µm"));
}

TEST_CASE("A relief begins at a diameter and a roll length that are the same point", "[studies][drawing]") {
  const GearPair pair = helical();
  Modification m;
  set(m, parameter_of("tip_relief.amount"), 22.0 * units::um);
  set(m, parameter_of("tip_relief.height"), 2.0);
  const auto [height, start] = lines_with(make_drawing(pair, Member::Pinion, m, {.tolerance_class = 6}), "tip relief height");
  const double diameter = number_behind(start, "d_Ca = "), roll = number_behind(start, "roll length ");
  constexpr double written = 1e-3;  // mm: three decimals of either
  CHECK(diameter == tests::about(2.0 * (pair.pinion.tip_form_radius - 2.0), written));
  CHECK(std::hypot(roll, pair.pinion.base_radius) == tests::about(0.5 * diameter, written));
}

TEST_CASE("A triangular relief begins on the face end at a diameter whose roll is as far from the tip as it says", "[studies][drawing]") {
  const GearPair pair = helical();
  Modification m;
  set(m, parameter_of("triangular_tip_relief.amount"), 22.0 * units::um);
  set(m, parameter_of("triangular_tip_relief.height"), 2.0);
  const auto [height, start] = lines_with(make_drawing(pair, Member::Pinion, m, {.tolerance_class = 6}), "triangular tip relief height");
  const double radius = 0.5 * number_behind(start, "d_Ea = "), extent = number_behind(start, "L_Ea = ");
  constexpr double written = 1e-3;  // mm: three decimals of either
  CHECK(radius == tests::about(pair.pinion.tip_form_radius - 2.0, written));
  CHECK(pair.pinion.roll_length_at(pair.pinion.tip_form_radius) - pair.pinion.roll_length_at(radius) == tests::about(extent, 2.0 * written));
}

TEST_CASE("Where one tool grinds both flanks the drawing has the other one's slope and twist, with the opposite sign", "[studies][drawing]") {
  const FlankDrawing drawing = make_drawing(helical(), Member::Pinion, ground(14.0, 20.0), {.tolerance_class = 6, .ties_flanks = true});
  const auto other = std::ranges::find_if(drawing.lines, [](const std::string& line) { return line.starts_with("The left flank"); });
  REQUIRE(other != drawing.lines.end());
  const auto behind = [&](const char* name) {
    const auto line = std::find_if(other, drawing.lines.end(), [&](const std::string& text) { return text.find(name) != std::string::npos; });
    return line == drawing.lines.end() ? std::nan("") : number_behind(*line, "= ");
  };
  CHECK(behind("C_Hβ, lead slope") == tests::about(-14.0, 0.05));
  CHECK(behind("S_α, twist") == tests::about(-number_behind(lines_with(drawing, "S_α, twist").first, "= "), 0.05));
  // The helix angle brings the same profile slope to both, and crowning is even.
  CHECK(std::isnan(behind("C_Hα, profile slope")));
  CHECK(std::isnan(behind("C_β, lead crowning")));
}

TEST_CASE("A class for a gear that ISO 1328-1 does not cover is refused where it is given", "[studies][drawing][input]") {
  const auto problem = study_texts::problem_of("[drawing]\niso_1328_class = 6\n", {{"pinion.face_width", "3.5"}});
  CHECK(problem.key == "drawing.iso_1328_class");
  CHECK_THAT(problem.allowed, Catch::Contains("face_width of the pinion is 3.5") && Catch::Contains("4 .. 1200 mm"));
}

TEST_CASE("The sheet of a flank is well formed: every element that opens closes", "[studies][drawing]") {
  const std::string svg = drawing_svg(crowned(6));
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    REQUIRE(end != std::string::npos);
    const std::string tag = svg.substr(at + 1, end - at - 1);
    if (tag.back() == '/') continue;
    if (tag.front() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
      continue;
    }
    REQUIRE_FALSE(open.empty());
    CHECK(open.back() == tag.substr(1));
    open.pop_back();
  }
  CHECK(open.empty());
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("C_β") != std::string::npos);
}

}  // namespace
}  // namespace flankwright::studies
