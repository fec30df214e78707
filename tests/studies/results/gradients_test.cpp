#include <catch2/catch.hpp>
#include <set>

#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::problem_of;

/// With sharp edges: derivatives on rounded ones have tests of their own, and a peak that runs over an edge bends within the steps taken here.
const std::string loaded_study = study_texts::small_study + R"(
[pinion.edges]
tip_rounding = 0
end_rounding = 0
[wheel.edges]
tip_rounding = 0
end_rounding = 0
[pinion.modification]
lead_crowning = 6
tip_relief = { amount = 5, height = 2 }
[misalignment]
crossing = "0.3 arcmin"
centre_distance = 0.05
axial_offset = 0.05
mesh_misalignment = 4
[load]
torque = 300
[cycle]
positions = 7
peaks = "sampled"
[fidelity]
compliance = "thin_slice"
quadrature = { rule = "gauss2", intervals = 4 }
)";

/// Numbers that no parameter moves by a derivative: places and counts, what a solver says of itself, what geometry and errors alone decide.
bool has_no_derivative(const std::string& key) {
  static const std::set<std::string> keys{"torque_Nm",
                                          "axial_offset_mm",
                                          "phase",
                                          "tooth",
                                          "z_mm",
                                          "pinion_radius_mm",
                                          "wheel_radius_mm",
                                          "length_mm",
                                          "along_fillet",
                                          "edge_contact",  // where
                                          "kkt_residual",
                                          "condition",
                                          "iterations",
                                          "intervals",
                                          "worst_kkt_residual",
                                          "worst_condition",
                                          "positions",
                                          "phase_tolerance",  // how well
                                          "harmonic_change_um",
                                          "peak_to_peak_change_um",
                                          "line_share",
                                          "end_distance_mm",
                                          "errors_from_intervals",  // how finely
                                          "c_prime",
                                          "c_gamma",
                                          "K_Halpha_limit",
                                          "f_pe_um",
                                          "y_alpha_um"};                      // ISO's own
  return keys.contains(key) || key.ends_with("_error") || key == "extremes";  // what the calculation says of itself; where extremes lie
}

/// Every number of a result below a place, and its list of derivatives at the same place of the other tree.
struct Differentiated {
  std::string place;
  double value;
  json derivatives;
};
void pair_up(const json& result, const json& gradients, const std::string& place, std::vector<Differentiated>& all) {
  if (result.is_number()) {
    all.push_back({place, result.get<double>(), gradients});
  } else if (result.is_array()) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      const bool known = gradients.is_array() && gradients.size() == result.size();
      pair_up(result.at(i), known ? gradients.at(i) : json(), place + "/" + std::to_string(i), all);
    }
  } else if (result.is_object()) {
    for (const auto& [key, value] : result.items()) {
      if (key == "gradients" || has_no_derivative(key)) continue;
      pair_up(value, gradients.is_object() && gradients.contains(key) ? gradients.at(key) : json(), place + "/" + key, all);
    }
  }
}

json loaded(const std::vector<Override>& overrides) {
  return json::parse(results_json(run_study(parse_study(loaded_study, "small.toml", overrides)))).at("loaded").at(0);
}

}  // namespace

TEST_CASE("Every number of a loaded result has its derivatives at the same path of its gradients", "[studies][gradient]") {
  constexpr double kDifference = 5e-5;  // step^2 times curvature of central differences, and loads' round-off over the step, relative
  struct Key {
    std::string path;
    double value, step;
    std::string unit;
  };
  const std::vector<Key> keys{{"pinion.modification.lead_crowning", 6, 0.01, "um"},
                              {"pinion.modification.tip_relief.amount", 5, 0.01, "um"},
                              {"misalignment.crossing", 0.3, 0.0005, "arcmin"},
                              {"misalignment.centre_distance", 0.05, 0.0005, "mm"},
                              {"misalignment.mesh_misalignment", 4, 0.01, "um"},
                              {"misalignment.axial_offset", 0.05, 0.0005, "mm"},
                              {"load.torque", 300, 0.05, "N·m"}};
  const std::string gap = GENERATE("plane_of_action", "whole_surface");
  const auto with_gap = [&](std::vector<Override> overrides) {
    overrides.push_back({"fidelity.gap", '"' + gap + '"'});
    return loaded(overrides);
  };
  std::string asked;
  for (const Key& key : keys) asked += (asked.empty() ? "[\"" : ", \"") + key.path + "\"";
  const json result = with_gap({{"analyse.gradients", asked + "]"}});
  const json& gradients = result.at("gradients");
  REQUIRE(gradients.at("parameters").size() == keys.size());
  std::vector<Differentiated> outputs;
  pair_up(result, gradients, "", outputs);
  CHECK(outputs.size() > 800);
  for (const Differentiated& output : outputs) {
    CAPTURE(output.place);
    CHECK((output.derivatives.is_array() && output.derivatives.size() == keys.size()));
  }
  for (std::size_t p = 0; p < keys.size(); ++p) {
    CHECK(gradients.at("parameters").at(p) == keys[p].path);
    CHECK(gradients.at("units").at(p) == keys[p].unit);
    const auto moved = [&](double by) { return with_gap({{keys[p].path, std::to_string(keys[p].value + by)}}); };
    const json up = moved(keys[p].step), down = moved(-keys[p].step);
    double worst = 0.0;
    std::string worst_place;
    for (const Differentiated& output : outputs) {
      const auto at = [&](const json& tree) { return tree.at(json::json_pointer(output.place)).get<double>(); };
      const double exact = output.derivatives.at(p).get<double>(), difference = (at(up) - at(down)) / (2 * keys[p].step);
      const double error = std::abs(exact - difference) / (std::abs(difference) + 0.1 * (std::abs(output.value) + 1e-2) / keys[p].value);
      if (error > worst) worst_place = output.place;
      worst = std::max(worst, error);
    }
    CAPTURE(gap, keys[p].path, worst_place);
    CHECK(worst <= kDifference);
  }
  CHECK(gradients.at("summary").at("peak_root_stress_MPa").is_null());  // thin slices have none
  CHECK(gradients.at("summary").at("peaks").is_null());                 // nor were peaks refined
  CHECK_FALSE(loaded({}).contains("gradients"));                        // nobody asked
}

TEST_CASE("Derivatives keep what the loads keep", "[studies][gradient]") {
  constexpr double kRoundOff = 1e-9;
  const json result = loaded({{"analyse.gradients", R"(["pinion.modification.lead_crowning", "misalignment.crossing", "load.torque"])"}});
  const json& gradients = result.at("gradients");
  const double force = result.at("normal_force_N");
  int on_several = 0;
  for (std::size_t k = 0; k < result.at("cycle").size(); ++k) {
    const json &teeth = result.at("cycle").at(k).at("teeth"), &slopes = gradients.at("cycle").at(k).at("teeth");
    REQUIRE(slopes.size() == teeth.size());
    on_several += teeth.size() > 1 ? 1 : 0;
    for (std::size_t p = 0; p < 3; ++p) {
      double by_force = 0.0, by_share = 0.0;
      for (std::size_t t = 0; t < teeth.size(); ++t) {
        CHECK(slopes.at(t).at("tooth") == teeth.at(t).at("tooth"));
        by_share += slopes.at(t).at("share").at(p).get<double>();
        for (std::size_t i = 0; i < teeth.at(t).at("points").size(); ++i) {
          const json &point = teeth.at(t).at("points").at(i), &slope = slopes.at(t).at("points").at(i);
          by_force += point.at("length_mm").get<double>() * slope.at("load_N_per_mm").at(p).get<double>();
          if (point.at("load_N_per_mm").get<double>() == 0.0) continue;
          // Where load is borne the flanks stay together: gap and deflections make up f_t.
          const double together = slope.at("gap_um").at(p).get<double>() + slope.at("contact_deflection_um").at(p).get<double>() +
                                  slope.at("structural_deflection_um").at(p).get<double>();
          CHECK(together == tests::about(gradients.at("cycle").at(k).at("te_um").at(p).get<double>(), kRoundOff));
        }
      }
      CHECK(std::abs(by_share) <= kRoundOff);
      CHECK(std::abs(by_force - gradients.at("normal_force_N").at(p).get<double>()) <= kRoundOff * force);
    }
  }
  CHECK(on_several == 7);
  CHECK(gradients.at("normal_force_N").at(0) == 0.0);
  CHECK(gradients.at("normal_force_N").at(2).get<double>() * 300 == Approx(force).epsilon(kRoundOff));
}

TEST_CASE("Losses, film, temperatures and their safeties have derivatives beside them", "[studies][gradient][life]") {
  constexpr double kDifference = 5e-5;  // step^2 times curvature, and loads' round-off over the step, relative
  const std::string oil = R"(
[lubricant]
viscosity_40 = 220
viscosity_100 = 19
temperature = 80
permissible_film = 0.3
scuffing_temperature = 250
roughness = 0.4
)";
  const auto case_of = [&](std::vector<Override> overrides) {
    overrides.push_back({"load.speed", "\"1500 rpm\""});
    return json::parse(results_json(run_study(parse_study(loaded_study + oil, "small.toml", overrides)))).at("life").at("cases").at(0);
  };
  struct Key {
    const char* path;
    double value, step;
  };
  const std::vector<Key> keys{
      {"pinion.modification.lead_crowning", 6, 0.01}, {"misalignment.mesh_misalignment", 4, 0.01}, {"load.torque", 300, 0.05}};
  const json here =
      case_of({{"analyse.gradients",
                R"(["pinion.modification.lead_crowning", "misalignment.mesh_misalignment", "load.torque", "misalignment.axial_offset"])"}});
  const json& gradients = here.at("gradients");
  CHECK(gradients.size() == 7);
  for (std::size_t p = 0; p < keys.size(); ++p) {
    const auto moved = [&](double by) { return case_of({{keys[p].path, std::to_string(keys[p].value + by)}}); };
    const json up = moved(keys[p].step), down = moved(-keys[p].step);
    for (const auto& [figure, derivatives] : gradients.items()) {
      CAPTURE(keys[p].path, figure);
      const double difference = (up.at(figure).get<double>() - down.at(figure).get<double>()) / (2 * keys[p].step);
      const double size = 0.1 * std::abs(here.at(figure).get<double>()) / keys[p].value;
      CHECK(std::abs(derivatives.at(p).get<double>() - difference) <= kDifference * (std::abs(difference) + size));
    }
  }
  for (const auto& [figure, derivatives] : gradients.items()) CHECK(derivatives.at(3).is_null());  // it moves the points of contact
  CHECK_FALSE(case_of({}).contains("gradients"));
}

TEST_CASE("Shafts' motion has derivatives beside it", "[studies][gradient][shafts]") {
  constexpr double kDifference = 1e-5;  // step^2 times curvature
  const std::string shafts = R"([pinion.shaft]
sections = [{ length = 150, outer_diameter = 45 }]
bearings = [{ position = 10, radial_stiffness = 800 }, { position = 140, radial_stiffness = 500 }]
gear_position = 60
torque_position = 0
)";
  const auto run_at = [&](const std::string& key, double value, const std::vector<Override>& more = {}) {
    std::vector<Override> overrides{{key, std::to_string(value)}};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return json::parse(results_json(run_study(parse_study(loaded_study + shafts, "small.toml", overrides)))).at("loaded").at(0);
  };
  const std::vector<std::tuple<std::string, double, double>> keys{
      {"misalignment.mesh_misalignment", 4, 0.01}, {"misalignment.axial_offset", 0.05, 0.0005}, {"load.torque", 300, 0.05}};
  const json here =
      run_at("load.torque", 300, {{"analyse.gradients", R"(["misalignment.mesh_misalignment", "misalignment.axial_offset", "load.torque"])"}});
  for (std::size_t p = 0; p < keys.size(); ++p) {
    const auto& [key, value, step] = keys[p];
    const json up = run_at(key, value + step), down = run_at(key, value - step);
    for (const char* place : {"/shafts/3/pinion/displacement_um", "/shafts/3/pinion/misalignment_um", "/shafts/3/mesh_misalignment_um",
                              "/summary/shaft_misalignment_um"}) {
      CAPTURE(key, place);
      const json::json_pointer at(place);
      const double difference = (up.at(at).get<double>() - down.at(at).get<double>()) / (2 * step);
      CHECK(std::abs(here.at("gradients").at(at).at(p).get<double>() - difference) <=
            kDifference * (std::abs(difference) + 0.1 * std::abs(here.at(at).get<double>()) / value));
    }
    CHECK(here.at("gradients").at("shafts").at(3).at("wheel").is_null());
  }
}

TEST_CASE("Refined peaks and load factors have their derivatives", "[studies][gradient]") {
  // Both peaks of a difference are located to 2e-4 base pitches; step^2 times curvature. All parameters move at once, by a step each.
  constexpr double kLocated = 5e-4, kDifference = 0.02;
  const std::vector<std::tuple<std::string, double, double>> keys{
      {"pinion.modification.lead_crowning", 6, 0.2}, {"load.torque", 300, 10}, {"misalignment.axial_offset", 0.5, 0.2}};
  std::string asked;
  for (const auto& [key, value, step] : keys) asked += (asked.empty() ? "[\"" : ", \"") + key + "\"";
  const auto at = [&](double steps) {
    // Without edge_contact: where a sharp edge leaves, factors of the peak's position change within what the peak is located to.
    std::vector<Override> overrides{
        {"cycle.peaks", "\"refined\""},
        {"fidelity.effects",
         R"(["misalignment", "modifications", "extended_contact_region", "bending", "free_ends", "tip_corner", "hertzian_contact"])"}};
    for (const auto& [key, value, step] : keys) overrides.push_back({key, std::to_string(value + steps * step)});
    if (steps == 0.0) overrides.push_back({"analyse.gradients", asked + "]"});
    return loaded(overrides);
  };
  const json here = at(0), up = at(1), down = at(-1);
  std::vector<Differentiated> outputs;
  for (const char* of : {"peaks", "load_factors"})
    pair_up(here.at("summary").at(of), here.at("gradients").at("summary").at(of), std::string("/summary/") + of, outputs);
  CHECK(outputs.size() == 20);
  for (const Differentiated& output : outputs) {
    const auto read = [&](const json& result) { return result.at(json::json_pointer(output.place)).get<double>(); };
    double exact = 0.0, together = 0.0;
    for (std::size_t p = 0; p < keys.size(); ++p) {
      const double change = output.derivatives.at(p).get<double>() * std::get<2>(keys[p]);
      exact += change;
      together += std::abs(change);
    }
    CAPTURE(output.place, exact, together);
    CHECK(std::abs(exact - (read(up) - read(down)) / 2) <= kDifference * together + kLocated * output.value);
  }
}

TEST_CASE("Peaks on tilted spur flanks have their derivatives", "[studies][gradient]") {
  // Points of a line that is tilted against the flank leave contact one after the other, and derivatives change with each of them.
  const std::string text = small::tilted_spur_pair() + "quadrature = { rule = \"graded\", intervals = 8 }\n[cycle]\npositions = 16\n";
  const auto at = [&](double centre_distance, const char* gradients) {
    return json::parse(
               results_json(run_study(parse_study(
                   text, "spur.toml", {{"misalignment.centre_distance", std::to_string(centre_distance)}, {"analyse.gradients", gradients}}))))
        .at("loaded")
        .at(0);
  };
  constexpr double step = 0.02;  // mm: the search of the peaks is a thousandth of what it changes
  const char* const by_distance = "[\"misalignment.centre_distance\"]";
  const json here = at(0.0, by_distance), apart = at(step, by_distance), together = at(-step, by_distance);
  std::vector<Differentiated> outputs;
  for (const char* of : {"peaks", "load_factors"}) {
    pair_up(here.at("summary").at(of).at("without_spikes"), here.at("gradients").at("summary").at(of).at("without_spikes"),
            std::string("/summary/") + of + "/without_spikes", outputs);
  }
  CHECK(outputs.size() >= 4);
  constexpr double curvature = 0.02;  // step^2 times it
  for (const Differentiated& output : outputs) {
    const auto read = [&](const json& result) { return result.at(json::json_pointer(output.place)).get<double>(); };
    const double difference = (read(apart) - read(together)) / (2.0 * step), exact = output.derivatives.at(0).get<double>();
    CAPTURE(output.place, exact, difference);
    CHECK(std::abs(exact - difference) <= curvature * std::abs(difference) + 1e-4 * output.value);
  }
}

TEST_CASE("What a unit's other forces move grows the gap with the torque, and no deviation of the flanks", "[studies][gradient][unit]") {
  const auto at = [](const char* torque) {
    return json::parse(results_json(run_study(parse_study(small::unit_pair() + small::unit(), "unit.toml",
                                                          {{"load.torque", torque}, {"analyse.gradients", "[\"load.torque\"]"}}))))
        .at("loaded")
        .at(0);
  };
  const json less = at("300"), more = at("301");
  double largest_gap = 0.0, largest_error = 0.0;
  for (const json& position : less.at("gradients").at("cycle")) {
    for (const json& tooth : position.at("teeth")) {
      for (const json& point : tooth.at("points")) {
        largest_gap = std::max(largest_gap, std::abs(point.at("gap_um").at(0).get<double>()));
        largest_error = std::max(largest_error, std::abs(point.at("error_um").at(0).get<double>()));
      }
    }
  }
  CHECK(largest_gap > 1e-3);
  CHECK(largest_error == 0.0);
  const json::json_pointer first("/cycle/0/teeth/0/points/0/error_um");
  CHECK(less.at(first) == more.at(first));
}

TEST_CASE("A parameter without derivatives is refused", "[studies][gradient][input]") {
  CHECK(problem_of("[analyse]\ngradients = [\"pair.helix_angle\"]").key == "analyse.gradients");
  CHECK_THAT(problem_of("[analyse]\ngradients = [\"misalignment.crosing\"]").allowed, Catch::Contains("did you mean crossing?"));
  CHECK(problem_of("[analyse]\ngradients = \"misalignment.crossing\"").key == "analyse.gradients");
  CHECK(problem_of("[analyse]\ngradients = [3]").key == "analyse.gradients");
  // A relief is spread over its height, which must be known.
  CHECK(problem_of("[analyse]\ngradients = [\"wheel.modification.tip_relief.amount\"]").key == "wheel.modification.tip_relief.height");
}

}  // namespace flankwright::studies
