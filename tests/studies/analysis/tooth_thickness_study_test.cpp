#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/gear/gear_pair.hpp"
#include "studies/analysis/study_notes.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using namespace flankwright::studies::study_texts;
using Catch::Contains;

namespace {

const std::vector<Override> thinner{{"pinion.tooth_thickness_allowance", "-120"}, {"wheel.tooth_thickness_allowance", "-180"}};

std::string thickness_notes(const std::vector<Override>& overrides) {
  const Study study = parse_study(small::analysis(), "study", overrides);
  std::string all;
  for (const std::string& note : study_notes(study, make_gear_pair(study.pair))) all += note + "\n";
  return all;
}

/// Largest difference of two documents' numbers, relative to the larger; the same structure is required.
double largest_difference(const Json& a, const Json& b) {
  if (a.is_structured()) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) largest = std::max(largest, largest_difference(*i, *j));
    return largest;
  }
  if (!a.is_number()) return a == b ? 0.0 : 1.0;
  const double x = a.get<double>(), y = b.get<double>(), scale = std::max({std::abs(x), std::abs(y), 1e-6});
  return std::abs(x - y) / scale;
}

}  // namespace

TEST_CASE("An allowance leaves contact path and unloaded transmission error and yields more", "[studies][thickness]") {
  const Json nominal = results_of(small::analysis()), thin = results_of(small::analysis(), thinner);
  // The root circle is another, and with it where the search for contact begins: Newton's last step.
  CHECK(largest_difference(thin["unloaded"]["mesh"]["transfers"], nominal["unloaded"]["mesh"]["transfers"]) < 1e-7);
  CHECK(thin["geometry"]["path_of_contact_mm"] == nominal["geometry"]["path_of_contact_mm"]);
  CHECK(thin["geometry"]["centre_distance_mm"] == nominal["geometry"]["centre_distance_mm"]);
  // j_bn = -(E_sn1 + E_sn2) cos(alpha_n)
  CHECK(thin["geometry"]["normal_backlash_um"].get<double>() == Approx(300 * std::cos(20 * units::deg)).epsilon(1e-12));
  CHECK(nominal["geometry"]["backlash_um"] == 0.0);
  for (std::size_t scene = 0; scene < nominal["loaded"].size(); ++scene) {
    const Json &before = nominal["loaded"][scene], &after = thin["loaded"][scene];
    const Json &where = before["cycle"][0]["teeth"][0]["points"], &there = after["cycle"][0]["teeth"][0]["points"];
    REQUIRE(where.size() == there.size());
    for (std::size_t i = 0; i < where.size(); ++i) {
      CHECK(where[i]["pinion_radius_mm"] == there[i]["pinion_radius_mm"]);
      CHECK(where[i]["gap_um"] == there[i]["gap_um"]);
    }
    // The thinner teeth yield more: by ISO's c', which thin slices are calibrated to, and not at their contact alone.
    const double softer = before["summary"]["iso6336"]["c_prime"].get<double>() / after["summary"]["iso6336"]["c_prime"].get<double>();
    const double more = after["summary"]["te_mean_um"].get<double>() / before["summary"]["te_mean_um"].get<double>();
    CHECK(softer > 1.0);
    CHECK(more > 1.0);
    CHECK(more < 2.0 * softer - 1.0);  // model: the structure is about half the deflection, the rest are gaps and Hertz
  }
}

TEST_CASE("A pair with allowances behaves as the same teeth stated by their generating profile shift", "[studies][thickness]") {
  Json thin = results_of(small::analysis(), thinner);
  const auto digits = [](double value) { return Json(value).dump(); };
  std::vector<Override> restated{{"pair.centre_distance", digits(thin["geometry"]["centre_distance_mm"].get<double>())}};
  for (const std::string gear : {"pinion", "wheel"}) {
    restated.push_back({gear + ".profile_shift", digits(thin["geometry"][gear]["generating_profile_shift"].get<double>())});
    restated.push_back({gear + ".tip_diameter", digits(thin["geometry"][gear]["tip_diameter_mm"].get<double>())});
  }
  Json same = results_of(small::analysis(), restated);
  // Round-off of the centre distance by its pressure angle's cosine, through the Newton steps of the load distribution.
  for (std::size_t i = 0; i < thin["loaded"].size(); ++i) {
    // How many positions a search takes hangs on round-off where a point leaves a tip edge.
    for (Json* of : {&thin, &same}) (*of)["loaded"][i]["summary"]["peaks"].erase("positions");
    CHECK(largest_difference(thin["loaded"][i]["summary"], same["loaded"][i]["summary"]) < 1e-7);
  }
  CHECK(std::abs(thin["geometry"]["backlash_um"].get<double>() - same["geometry"]["backlash_um"].get<double>()) < 1e-9);
}

TEST_CASE("The notes say where a scene takes more than the backlash", "[studies][thickness]") {
  CHECK_THAT(thickness_notes(thinner), !Contains("jam"));
  std::vector<Override> closer = thinner;
  closer.push_back({"scenes.1.misalignment.centre_distance", "-0.5"});
  CHECK_THAT(thickness_notes(closer), Contains("in the scene \"bent\" the axes are closer by 0.5 mm: the teeth overlap by"));
  closer.back().value = "-0.2";
  CHECK_THAT(thickness_notes(closer), !Contains("jam"));
}

TEST_CASE("An allowance above 0 is refused and says what to do instead", "[studies][thickness][input]") {
  const StudyProblem problem = problem_of("", {{"wheel.tooth_thickness_allowance", "20"}});
  CHECK(problem.key == "wheel.tooth_thickness_allowance");
  CHECK_THAT(problem.allowed, Contains("-10000 .. 0") && Contains("larger profile shift"));
  CHECK(problem_of("", {{"pinion.tooth_thickness_allowance", "-5 mm"}}).key == "pinion.tooth_thickness_allowance");
}
