#include "studies/study_file/study_life.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/rating/sliding_loss.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/spectrum_file.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_file/life_texts.hpp"

namespace flankwright::studies {
namespace {

const std::string two_bins = "[load]\nspectrum = [{ torque = 300, speed = 1000, hours = 10 }, { torque = 150, cycles = 3e8 }]\n";

Study life_study(const std::string& text, const std::vector<Override>& overrides = {}) { return parse_study(text, "life.toml", overrides); }

/// The first problem of a study; empty fields where it has none.
StudyProblem life_problem(const std::string& text) {
  try {
    life_study(text);
  } catch (const StudyErrors& errors) {
    return errors.problems().front();
  }
  return {};
}

}  // namespace

TEST_CASE("A spectrum gives every scene its torques and their load cycles", "[studies][life]") {
  const Study study = life_study(life_pair + two_bins + life_strength + "[[scenes]]\nname = \"a\"\n[[scenes]]\nname = \"b\"\n");
  REQUIRE(study.spectrum.size() == 2);
  CHECK(study.spectrum[0].cycles == Approx(10 * 60 * 1000).epsilon(1e-12));
  CHECK(study.spectrum[1].cycles == 3e8);
  REQUIRE(study.scenes.size() == 2);
  for (const Scene& scene : study.scenes) CHECK(scene.torques == std::vector<double>{3e5, 1.5e5});
  const auto life = life_model(study);
  REQUIRE(life);
  CHECK(life->strength.pinion.contact->limit == 900.0);
  CHECK(life->strength.wheel.contact->knee == 5e7);
  CHECK_FALSE(life->strength.pinion.root);
  CHECK(life_model(life_study(life_pair + "[load]\ntorque = 300\n")) == nullptr);
}

TEST_CASE("Materials and lubricant are read, one gear's own before both gears'", "[studies][life]") {
  const Study study = life_study(life_pair + two_bins + R"(
[material]
contact_endurance_limit = 1500
contact_sn_curve = { exponent = 12, knee = 2e7 }
root_endurance_limit = 430
[wheel.material]
contact_sn_curve = "nitrided"
root_endurance_limit = 300
[lubricant]
viscosity_40 = 220
viscosity_100 = 19
temperature = "80 °C"
roughness = 0.4
)");
  const auto life = life_model(study);
  CHECK(life->strength.pinion.contact->exponent == 12.0);
  CHECK(life->strength.pinion.contact->exponent_beyond == 12.0);
  CHECK(life->strength.pinion.contact->knee == 2e7);
  CHECK(life->strength.wheel.contact->knee == 2e6);
  CHECK(life->strength.pinion.root->limit == 860.0);  // Y_ST = 2
  CHECK(life->strength.wheel.root->limit == 600.0);
  CHECK(life->roughness == Approx(0.4).epsilon(1e-14));  // round-off
  CHECK(life->lubricant->temperature == 80.0);
}

TEST_CASE("What is wrong with a spectrum is told with place, key, value and what is allowed", "[studies][life]") {
  const auto with = [](const std::string& bins) { return life_problem(life_pair + "[load]\nspectrum = " + bins + "\n"); };
  CHECK(with("[{ torque = 100, speed = 1000, hours = -3 }]").key == "load.spectrum.0.hours");
  CHECK(with("[{ torque = 100, speed = 1000, hours = -3 }]").value == "-3");
  CHECK(with("[{ torque = 100, speed = 1000, hours = -3 }]").line > 0);
  CHECK(with("[{ torque = 100, speed = 0, hours = 3 }]").key == "load.spectrum.0.speed");
  CHECK(with("[{ torque = 100, hours = 3 }]").key == "load.spectrum.0.speed");
  CHECK(with("[{ torque = 100 }]").key == "load.spectrum.0.hours");
  CHECK(with("[{ torque = 100, speed = 1, hours = 3, cycles = 4 }]").key == "load.spectrum.0.cycles");
  CHECK(with("[{ hours = 3, speed = 100 }]").key == "load.spectrum.0.torque");
  CHECK(with("[{ torque = 100, cycles = 3, hour = 1 }]").key == "load.spectrum.0.hour");
  CHECK(with("[]").key == "load.spectrum");
  CHECK(with("3").key == "load.spectrum");
  CHECK(with("{ files = \"x.csv\" }").key == "load.spectrum");
  const StudyProblem missing = with("{ file = \"no such file.csv\" }");
  CHECK(missing.key == "load.spectrum");
  CHECK(missing.allowed.find("cannot be read") != std::string::npos);
  CHECK(life_problem(life_pair + "[load]\ntorque = 3\nspectrum = [{ torque = 1, cycles = 3 }]\n").key == "load.spectrum");
  CHECK(life_problem(life_pair + two_bins + "[[scenes]]\nload.torque = 30\n").key == "scenes.0.load.torque");
  CHECK(with("[{ torque = 100, cycles = 3 }]").key.empty());
}

TEST_CASE("A torque of a spectrum below 0 loads the other flank, in scenes that rate that one", "[studies][life]") {
  const std::string bins = "[load]\nspectrum = [{ torque = 300, cycles = 1e6 }, { torque = -200, cycles = 3e6 }]\n";
  const std::string coast = "[[scenes]]\nname = \"drive\"\n[[scenes]]\nname = \"coast\"\nworking_flank = \"left\"\n";
  const Study both = life_study(life_pair + bins + life_strength + coast);
  REQUIRE(both.scenes.size() == 2);
  CHECK(both.scenes[0].torques == std::vector<double>{3e5, 0.0});
  CHECK(both.scenes[1].torques == std::vector<double>{0.0, 2e5});
  const StudyResults results = run_study(both);
  REQUIRE(results.life);
  REQUIRE(results.life->cases.size() == 2);
  for (const CaseLife& of : results.life->cases) {
    const LoadedResult& loaded = results.loaded[of.loaded];
    CHECK(loaded.torque == (loaded.scene == "drive" ? 3e5 : 2e5));
    CHECK(loaded.operation.revolutions == (loaded.scene == "drive" ? 1e6 : 3e6));
    CHECK(of.contact_damage.pinion > 0.0);
  }
  CHECK(results.life->spectra.size() == 2);
  const auto says_reversed = [](const StudyResults& of) {
    return std::ranges::any_of(of.notes, [](const std::string& note) { return note.find("75 % of the revolutions") != std::string::npos; });
  };
  CHECK_FALSE(says_reversed(results));
  CHECK(says_reversed(run_study(life_study(life_pair + bins + life_strength))));
  // Where no torque has a direction, the other flank is loaded as much.
  for (const Scene& scene : life_study(life_pair + two_bins + life_strength + coast).scenes) CHECK(scene.torques == std::vector<double>{3e5, 1.5e5});
}

TEST_CASE("A value of a spectrum that is given but wrong is not called missing as well", "[studies][life]") {
  const auto problems = [](const std::string& text) {
    try {
      life_study(life_pair + text);
    } catch (const StudyErrors& errors) {
      return errors.problems();
    }
    return std::vector<StudyProblem>{};
  };
  const std::string bin = GENERATE("{ torque = 100, speed = 1000, hours = -5 }", "{ torque = 100, speed = 1000, hours = \"2 days\" }",
                                   "{ torque = 100, speed = 1000, cycles = -5 }", "{ torque = 100, speed = 0, hours = 3 }");
  CAPTURE(bin);
  const std::vector<StudyProblem> found = problems("[load]\nspectrum = [" + bin + ", { torque = 50, cycles = 3 }]\n");
  REQUIRE(found.size() == 1);
  CHECK(found.front().value != "(not given)");
  const std::vector<StudyProblem> of_both = problems("[load]\nspeed = -1\nspectrum = [{ torque = 100, hours = 3 }]\n");
  REQUIRE(of_both.size() == 1);
  CHECK(of_both.front().key == "load.speed");
}

TEST_CASE("Damage that is asked for without a spectrum is told with both keys", "[studies][life]") {
  try {
    life_study("task = \"optimise\"\n" + life_pair + life_strength + R"(
[load]
torque = 150
[optimise]
objective = "peak_contact_stress"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 10]
[optimise.constraints]
contact_damage = { max = 1 }
)");
    FAIL("nothing was refused");
  } catch (const StudyErrors& errors) {
    REQUIRE(errors.problems().size() == 1);
    const StudyProblem& problem = errors.problems().front();
    CHECK(problem.key == "optimise.constraints.contact_damage");
    CHECK(problem.value == "{ max = 1 }");
    CHECK(problem.allowed == "contact_damage is asked for and needs load.spectrum, which is not given");
  }
}

TEST_CASE("What is wrong with strength or lubricant is told by its key", "[studies][life]") {
  const auto with = [](const std::string& rest) { return life_problem(life_pair + two_bins + rest).key; };
  CHECK(with("[material]\ncontact_endurance_limit = 0\n") == "material.contact_endurance_limit");
  CHECK(with("[material]\nroot_endurance_limit = 500\nroot_sn_curve = { exponent = 9 }\n") == "material.root_sn_curve.knee");
  CHECK(with("[material]\nroot_endurance_limit = 500\nroot_sn_curve = { exponent = 9, knee = 3e6, exponent_beyond = 4 }\n") ==
        "material.root_sn_curve.exponent_beyond");
  CHECK(with("[material]\nroot_sn_curve = \"nitrided\"\n") == "material.root_sn_curve");
  CHECK(with("[material]\ncontact_endurance_limit = 500\ncontact_sn_curve = \"hard\"\n") == "material.contact_sn_curve");
  CHECK(with("[lubricant]\nviscosity_40 = 100\ntemperature = 80\nroughness = 0.5\n") == "lubricant.viscosity_100");
  CHECK(with("[lubricant]\nviscosity_40 = 10\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\n") == "lubricant.viscosity_40");
  CHECK(with("[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\n").empty());
  const std::string oil = "[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\n";
  CHECK(with(oil + "scuffing_temperature = 81\nbulk_temperature = 80\n").empty());
  CHECK(with(oil + "scuffing_temperature = 80\n") == "lubricant.scuffing_temperature");
  CHECK(with(oil + "bulk_temperature = 79\n") == "lubricant.bulk_temperature");
  const std::string hot_bin = "[load]\nspectrum = [{ torque = 300, cycles = 1e6, temperature = 120 }]\n";
  CHECK(life_problem(life_pair + hot_bin + oil + "scuffing_temperature = 110\n").key == "lubricant.scuffing_temperature");
  CHECK(life_problem(life_pair + "[load]\nspectrum = [{ torque = 0, cycles = 1e6 }]\n").key == "load.spectrum");
  // Through both viscosities the relation with temperature gives some 1e10 mm2/s at -40 deg C: no oil.
  const std::string thick = "[lubricant]\nviscosity_40 = 10000\nviscosity_100 = 100\nroughness = 0.5\n";
  CHECK(with(thick + "temperature = 80\n").empty());
  CHECK(with(thick + "temperature = -40\n") == "lubricant.temperature");
  CHECK(with(thick + "temperature = 80\nbulk_temperature = -40\n") == "lubricant.bulk_temperature");
}

TEST_CASE("A named material has the limits and life factors of ISO 6336, below what the study gives itself", "[studies][life]") {
  const Study study = life_study(life_pair + two_bins + R"(
[material]
strength = { kind = "case_hardened", quality = "MQ", hardness = 700 }
root_endurance_limit = 461
[wheel.material]
strength = { kind = "nitrided_nitriding_steel", hardness = 750 }
contact_sn_curve = "nitrocarburised"
)");
  const auto life = life_model(study);
  REQUIRE(life);
  CHECK(life->strength.pinion.contact->limit == 1500.0);
  CHECK(life->strength.pinion.contact->knee == 5e7);
  CHECK(life->strength.pinion.root->limit == 922.0);  // Y_ST = 2
  CHECK(life->strength.wheel.contact->limit == 1250.0);
  CHECK(life->strength.wheel.contact->exponent == contact_sn_curve(LifeFactors::Nitrocarburised, 1250.0).exponent);
  CHECK(life->strength.wheel.root->exponent == root_sn_curve(LifeFactors::Nitrided, 922.0).exponent);

  const Json json = results_document(run_study(study)).at("life");
  const Json &pinion = json.at("pinion").at("strength"), &wheel = json.at("wheel").at("strength");
  CHECK(pinion.at("kind") == "case_hardened");
  CHECK(pinion.at("hardness_scale") == "HV");
  CHECK(pinion.at("sigma_Hlim_MPa") == 1500.0);
  CHECK(pinion.at("contact_limit_from") == "ISO 6336-5");
  CHECK(wheel.at("sigma_Flim_MPa") == 420.0);  // of the table; used is the study's own
  CHECK(wheel.at("root_limit_from") == "endurance limit of the study");
  CHECK(json.at("wheel").at("root_sn_curve").at("limit_MPa") == 922.0);
}

TEST_CASE("What is wrong with a named material is told by its key", "[studies][life]") {
  const auto with = [](const std::string& strength) { return life_problem(life_pair + two_bins + "[material]\nstrength = { " + strength + " }\n"); };
  CHECK(with("kind = \"case_hardened\", hardness = 700").key.empty());
  CHECK(with("kind = \"case_hardened\"").key == "material.strength.hardness");
  CHECK(with("hardness = 700").key == "material.strength.kind");
  CHECK(with("kind = \"hardened\", hardness = 700").key == "material.strength.kind");
  CHECK(with("kind = \"case_hardened\", quality = \"MX\", hardness = 700").key == "material.strength.quality");
  const StudyProblem soft = with("kind = \"case_hardened\", hardness = 580");
  CHECK(soft.key == "material.strength.hardness");
  CHECK(soft.value == "580");
  CHECK(soft.allowed == "allowed is 660 .. 800 HV for sigma_Hlim of case_hardened MQ");
  CHECK(with("kind = \"induction_hardened\", hardness = 550, core_hardness = 30").key == "material.strength.core_hardness");
  const StudyProblem of_wheel = life_problem(life_pair + two_bins + R"(
[material]
strength = { kind = "case_hardened", hardness = 700 }
[wheel.material]
strength.hardness = 900
)");
  CHECK(of_wheel.key == "wheel.material.strength.hardness");
}

TEST_CASE("An optimisation says what damage and film need", "[studies][life]") {
  const std::string optimise = "task = \"optimise\"\n" + life_pair;
  const std::string variables = "[optimise.variables]\n\"pinion.modification.lead_crowning\" = [0, 20]\n";
  const auto with = [&](const std::string& load, const std::string& objective, const std::string& rest = "") {
    return life_problem(optimise + load + "[optimise]\nobjective = " + objective + "\n" + variables + rest).key;
  };
  CHECK(with("[load]\ntorque = 100\n" + life_strength, "\"contact_damage\"") == "optimise.objective");
  CHECK(with(two_bins, "\"contact_damage\"") == "optimise.objective");
  CHECK(with(two_bins + life_strength, "{ contact_damage = 1, te_harmonic_1 = 1 }") == "optimise.objective");
  CHECK(with(two_bins + life_strength, "\"specific_film_thickness\"") == "optimise.objective");
  CHECK(with(two_bins + life_strength, "\"contact_damage\"", "[optimise.constraints]\nspecific_film_thickness = { min = 0.5 }\n") ==
        "optimise.constraints.specific_film_thickness");
  for (const std::string temperature : {"contact_temperature", "flash_temperature"}) {
    CHECK(with("[load]\ntorque = 100\nspeed = 1000\n", "\"" + temperature + "\"") == "optimise.objective");
    const std::string oil = "[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\n";
    CHECK(with("[load]\ntorque = 100\n", "\"" + temperature + "\"", oil) == "optimise.objective");
    CHECK(with("[load]\ntorque = 100\nspeed = 1000\n", "\"" + temperature + "\"", oil).empty());
  }
  CHECK(with(two_bins + life_strength, "[\"contact_damage\", \"te_harmonic_1\"]").empty());
}

TEST_CASE("A spectrum is read from columns of any order, each with its unit", "[studies][life]") {
  const auto rows = parse_spectrum("# fleet\nhours; torque [N·m]; speed_rpm ;temperature\n10;300;1000;\n\n2.5; 150 ;500; 90 # warm\n", "fleet.csv");
  REQUIRE(rows.size() == 2);
  REQUIRE(rows[0].size() == 3);
  CHECK(rows[0][1].key == "torque");
  CHECK(rows[0][1].text == "300 N·m");
  CHECK(rows[1][3].text == "90");
  CHECK(rows[1][3].line == 5);
  const auto problem_of = [](const std::string& text) {
    try {
      parse_spectrum(text, "fleet.csv");
    } catch (const StudyErrors& errors) {
      return errors.problems().front();
    }
    return StudyProblem{};
  };
  CHECK(problem_of("torque,hourz\n1,2\n").column == 8);
  CHECK(problem_of("torque,hourz\n1,2\n").line == 1);
  CHECK(problem_of("torque,torque_Nm\n1,2\n").column == 8);
  CHECK(problem_of("torque,hours\n1\n").line == 2);
  CHECK(problem_of("torque,hours\n").line == 1);
  CHECK(problem_of("").allowed.find("at least one line") != std::string::npos);
}

TEST_CASE("Results have the damage of each load case and its sum, by hand", "[studies][life]") {
  const std::string lubricant =
      "[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\nscuffing_temperature = 250\n";
  const std::string bins = "[load]\nspectrum = [{ torque = 300, speed = 1000, hours = 10 }, { torque = 150, speed = 1500, hours = 2000 }]\n";
  const StudyResults results = run_study(life_study(life_pair + bins + life_strength + lubricant));
  const Json document = results_document(results);
  const Json& life = document.at("life");
  REQUIRE(life.at("cases").size() == 2);
  REQUIRE(life.at("spectra").size() == 1);
  const Json& spectrum = life.at("spectra")[0];
  constexpr double round_off = 1e-12;
  for (const char* gear : {"pinion", "wheel"}) {
    double sum = 0.0;
    for (const Json& of : life.at("cases")) sum += of.at(gear).at("contact_damage").get<double>();
    CHECK(spectrum.at(gear).at("contact").at("damage").get<double>() == Approx(sum).epsilon(round_off));
    CHECK(sum > 0.0);
    CHECK(spectrum.at(gear).at("root").is_null());
  }
  // Aligned gears of thin slices: the point of the largest stress is the same under both loads.
  const SnCurve curve = contact_sn_curve(LifeFactors::CaseHardened, 900.0);
  for (const Json& of : life.at("cases")) {
    const double cycles = of.at("cycles"), stress = of.at("peak_contact_stress_MPa"), loss = of.at("loss_factor");
    CHECK(of.at("pinion").at("contact_safety").get<double>() == Approx(curve.stress_for(cycles) / stress).epsilon(round_off));
    CHECK(of.at("loss_power_W").get<double>() ==
          Approx(loss * of.at("friction").get<double>() * of.at("torque_Nm").get<double>() * of.at("speed_rpm").get<double>() * units::pi / 30.0)
              .epsilon(round_off));
    CHECK(loss < 1.5 * life.at("ohlendorf_loss_factor").get<double>());
    CHECK(of.at("specific_film_thickness").get<double>() > 0.0);
    // theta_M of ISO/TS 6336-22, by the coefficient of friction that is shown.
    const Json& pair = document.at("used").at("pair");
    const auto usable = [&](const char* gear) { return pair.at(gear).at("usable_face_width_mm").get<double>(); };
    const double width = std::min(usable("pinion"), usable("wheel")), distance = document.at("geometry").at("centre_distance_mm");
    const double kilowatts = of.at("power_W").get<double>() / 1e3, friction = of.at("film_friction");
    const double heat = kilowatts * friction * life.at("ohlendorf_loss_factor").get<double>() / (distance * width);
    CHECK(of.at("bulk_temperature_degC").get<double>() == Approx(80.0 + 7400.0 * std::pow(heat, 0.72)).epsilon(round_off));
    const double hottest = of.at("contact_temperature_degC");
    CHECK(hottest == Approx(of.at("bulk_temperature_degC").get<double>() + of.at("flash_temperature_K").get<double>()).epsilon(round_off));
    CHECK(of.at("scuffing_safety").get<double>() == Approx((250.0 - 80.0) / (hottest - 80.0)).epsilon(round_off));
  }
  // The largest flash temperature and the thinnest film are those of points of the cycle.
  for (std::size_t k = 0; k < 2; ++k) {
    double largest = 0.0, thinnest = std::numeric_limits<double>::infinity();
    for (const Json& position : document.at("loaded")[k].at("cycle")) {
      for (const Json& tooth : position.at("teeth")) {
        for (const Json& point : tooth.at("points")) {
          largest = std::max(largest, point.at("flash_temperature_K").get<double>());
          const bool is_loaded = point.at("load_N_per_mm").get<double>() > 0.0;
          CHECK(is_loaded == point.at("specific_film_thickness").is_number());
          if (is_loaded) thinnest = std::min(thinnest, point.at("specific_film_thickness").get<double>());
        }
      }
    }
    CHECK(largest == life.at("cases")[k].at("flash_temperature_K").get<double>());
    CHECK(thinnest == life.at("cases")[k].at("specific_film_thickness").get<double>());
    CHECK(largest > 0.0);
  }
  double largest = 0.0;
  for (const Json& value : spectrum.at("map").at("pinion_damage")) largest = std::max(largest, value.get<double>());
  CHECK(largest == spectrum.at("pinion").at("contact").at("damage").get<double>());
}

TEST_CASE("K_A and K_v of the load, or K_v of one load of a spectrum, count in the ratings by ISO 6336 and are shown", "[studies][life]") {
  const auto cases_of = [](const std::string& load) {
    const StudyResults results = run_study(life_study(life_pair + load + life_strength));
    return Json(results_document(results).at("life").at("cases"));
  };
  const std::string bins = "spectrum = [{ torque = 300, cycles = 1e7 }, { torque = 150, cycles = 1e8";
  const Json nominal = cases_of("[load]\n" + bins + " }]\n");
  const Json factored = cases_of("[load]\napplication_factor = 1.25\ndynamic_factor = 1.1\n" + bins + ", dynamic_factor = 1.3 }]\n");
  constexpr double round_off = 1e-12;
  for (std::size_t k = 0; k < 2; ++k) {
    const double K_v = k == 0 ? 1.1 : 1.3, K = 1.25 * K_v;
    const Json &before = nominal[k], &after = factored[k];
    CHECK(after.at("iso6336").at("K_A") == 1.25);
    CHECK(after.at("iso6336").at("K_v") == K_v);
    CHECK(after.at("peak_contact_stress_MPa") == before.at("peak_contact_stress_MPa"));
    for (const char* gear : {"pinion", "wheel"}) {
      const auto rise = [&](const char* key) { return after.at(gear).at(key).get<double>() / before.at(gear).at(key).get<double>(); };
      CHECK(rise("sigma_H_MPa") == Approx(std::sqrt(K)).epsilon(round_off));
      CHECK(rise("sigma_F_MPa") == Approx(K).epsilon(round_off));
      CHECK(rise("S_H") == Approx(1.0 / std::sqrt(K)).epsilon(round_off));
      CHECK(rise("contact_safety") == Approx(1.0 / std::sqrt(K)).epsilon(round_off));
      CHECK(rise("contact_damage") > 1.0);
    }
  }
  // Without a spectrum too, and where nothing else asks for a rating.
  const StudyResults alone = run_study(life_study(life_pair + "[load]\ntorque = 300\napplication_factor = 1.25\n"));
  CHECK(results_document(alone).at("life").at("cases")[0].at("iso6336").at("K_A") == 1.25);
}

TEST_CASE("A load of the spectrum that misaligns an aligned scene acts as a scene with that misalignment", "[studies][life]") {
  const std::string of_load = "[load]\nspectrum = [{ torque = 300, cycles = 1e7, mesh_misalignment = 25 }]\n";
  const std::string of_scene = "[load]\nspectrum = [{ torque = 300, cycles = 1e7 }]\n[misalignment]\nmesh_misalignment = 25\n";
  const auto summary_of = [](const std::string& text) { return run_study(life_study(life_pair + text)).loaded.front().summary; };
  const CycleSummary one = summary_of(of_load), other = summary_of(of_scene);
  CHECK(one.peak_contact_stress == other.peak_contact_stress);
  CHECK(one.te_peak_to_peak == other.te_peak_to_peak);
  CHECK(one.peak_contact_stress > 1.1 * summary_of("[load]\nspectrum = [{ torque = 300, cycles = 1e7 }]\n").peak_contact_stress);
}

TEST_CASE("Loss, film and temperatures carry errors that hold beside a cycle four times finer both ways", "[studies][life][cycle-error]") {
  const std::string oil =
      "[lubricant]\nviscosity_40 = 100\nviscosity_100 = 11\ntemperature = 80\nroughness = 0.5\nscuffing_temperature = 250\npermissible_film = 0.2\n";
  const std::string load = "[load]\ntorque = [60, 300]\nspeed = 1500\n";
  const std::string shape =
      "[pinion.modification]\nlead_crowning = 5\ntip_relief = { amount = 8, height = 2 }\n[misalignment]\nmesh_misalignment = 6\n";
  const std::string helix = GENERATE("0", "18");
  const auto cases_with = [&](const char* intervals, const char* positions) {
    const std::vector<Override> resolution{
        {"pair.helix_angle", helix}, {"fidelity.quadrature.intervals", intervals}, {"cycle.positions", positions}, {"cycle.peaks", "\"refined\""}};
    return results_document(run_study(life_study(life_pair + load + shape + oil, resolution))).at("life").at("cases");
  };
  const Json coarse = cases_with("8", "32"), fine = cases_with("32", "128");
  REQUIRE(coarse.size() == 2);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    for (const char* figure : {"loss_factor", "loss_power_W", "specific_film_thickness", "micropitting_safety", "flash_temperature_K",
                               "contact_temperature_degC", "scuffing_safety"}) {
      const double value = coarse[k].at(figure), stated = coarse[k].at(std::string(figure) + "_error");
      const double found = std::abs(value - fine[k].at(figure).get<double>());
      CAPTURE(helix, k, figure, value, stated, found);
      CHECK(found <= stated);
      CHECK(stated < 0.3 * std::abs(value));  // and says something
      CHECK(fine[k].at(std::string(figure) + "_error").get<double>() < stated);
    }
    const double micropitting = coarse[k].at("micropitting_safety_error");
    CHECK(micropitting == Approx(coarse[k].at("specific_film_thickness_error").get<double>() / 0.2).epsilon(1e-12));
  }
}

TEST_CASE("Given phases leave loss and film without an error", "[studies][life][cycle-error]") {
  const Json life =
      results_document(run_study(life_study(life_pair + "[load]\ntorque = 100\nspeed = 1500\n", {{"cycle.phases", "[0.1, 0.6]"}}))).at("life");
  CHECK(life.at("cases")[0].at("loss_factor").get<double>() > 0.0);
  CHECK(life.at("cases")[0].at("loss_factor_error").is_null());
}

TEST_CASE("A study without a spectrum, strength, speed or lubricant has no section of life", "[studies][life]") {
  const StudyResults results = run_study(life_study(life_pair + "[load]\ntorque = 100\n"));
  CHECK_FALSE(results.life);
  CHECK_FALSE(results_document(results).contains("life"));
}

}  // namespace flankwright::studies
