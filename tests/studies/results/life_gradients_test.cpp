#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "studies/analysis/run_study.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_file/life_texts.hpp"

namespace flankwright::studies {

namespace {

const std::string shape = "[pinion.modification]\nlead_crowning = 4.3\ntip_relief = { amount = 8, height = 2 }\n";

Json life_of(const std::string& text, const std::vector<Override>& overrides) {
  return results_document(run_study(parse_study(text, "life.toml", overrides))).at("life");
}

/// By a central difference over steps of a key either way.
double difference(const std::string& text, const std::string& key, double at, double step, const Json::json_pointer& number) {
  const auto moved = [&](double to) { return life_of(text, {{key, fmt::format("{}", to)}}).at(number).get<double>(); };
  return (moved(at + step) - moved(at - step)) / (2.0 * step);
}

/// Differences have errors of the step's square, and of the loads' convergence over the step.
constexpr double by_difference = 1e-5;

}  // namespace

TEST_CASE("Damages over a spectrum have exact derivatives", "[studies][life][gradients]") {
  const std::string strength = "[material]\ncontact_endurance_limit = 900\nroot_endurance_limit = 300\n";
  const std::string text = life_pair + life_load + strength + shape;
  const Json life = life_of(text, {{"analyse.gradients", R"(["pinion.modification.lead_crowning", "pinion.modification.tip_relief.amount"])"}});
  REQUIRE(life.at("spectra").size() == 2);
  for (const std::string of : {"/spectra/0/pinion/contact", "/spectra/1/wheel/contact"}) {
    const Json& gradient = life.at(Json::json_pointer(of + "/gradient"));
    REQUIRE(gradient.size() == 2);
    const Json::json_pointer damage(of + "/damage");
    CAPTURE(of);
    const double by_crowning = difference(text, "pinion.modification.lead_crowning", 4.3, 0.002, damage);
    CHECK(gradient[0].get<double>() == Approx(by_crowning).epsilon(by_difference).margin(by_difference * life.at(damage).get<double>()));
    const double by_relief = difference(text, "pinion.modification.tip_relief.amount", 8.0, 0.002, damage);
    CHECK(gradient[1].get<double>() == Approx(by_relief).epsilon(by_difference).margin(by_difference * life.at(damage).get<double>()));
  }
}

}  // namespace flankwright::studies
