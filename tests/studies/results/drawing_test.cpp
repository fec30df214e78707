#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "studies/results/drawing.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_texts.hpp"

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
  return make_drawing(make_gear_pair(study.pair), Member::Pinion, m, tolerance_class);
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
        CHECK(width == Approx(total / units::um).margin(2.0 * 0.001 * um_per_unit));  // coordinates have three decimals
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
    CHECK(helix.deviation[i] - middle == Approx(-8.0 * units::um * std::pow(2.0 * helix.along[i] / b, 2)).margin(round_off));
  }
}

TEST_CASE("A drawing has the amounts that were set, and the shape of a relief", "[studies][drawing]") {
  const Study study = study_texts::read();
  Modification m;
  set(m, parameter_of("tip_relief.amount"), 7.25 * units::um);
  set(m, parameter_of("tip_relief.height"), 2.0);
  set(m, parameter_of("lead_crowning"), 5.831724 * units::um);
  const auto line_with = [&](const std::string& name) {
    for (const std::string& line : make_drawing(make_gear_pair(study.pair), Member::Pinion, m, 6).lines) {
      if (line.find(name) != std::string::npos) return line;
    }
    return std::string("no line with " + name);
  };
  CHECK(line_with("tip relief =").ends_with("tip relief = 7.25 µm"));  // a step of 0.25 um
  CHECK(line_with("tip relief height").ends_with("= 2.00 mm"));
  CHECK(line_with("lead crowning").ends_with("= 5.8 µm"));  // no multiple of a grinder's step
  m.tip_relief.shape = ReliefShape::Parabolic;
  CHECK(line_with("tip relief =").ends_with("tip relief = 7.25 µm, parabolic"));
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
