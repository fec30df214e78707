#include "studies/tasks/optimise/life_error.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "studies/base/json_format.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_file/life_texts.hpp"
#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {
namespace {

/// A pair under two loads in two scenes, with oil; no task.
const std::string two_loads = life_pair + life_strength + life_load + R"(
[lubricant]
viscosity_40 = 100
viscosity_100 = 11
temperature = 80
roughness = 0.5
[pinion.modification]
lead_crowning = 6
tip_relief = { amount = 25, height = 2 }
[wheel.modification]
tip_relief = { amount = 25, height = 2 }
)";

const std::string search = R"(
[optimise]
objective = "contact_damage"
max_evaluations = 3
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
[optimise.constraints]
loss_factor = { max = 0.5 }
specific_film_thickness = { min = 0.01 }
flash_temperature = { max = 500 }
)";

/// The largest over gears and scenes, and over the two loads of a case's figure.
struct Finely {
  double damage{0.0}, loss_factor{0.0}, film{INFINITY}, flash{0.0};
};

Finely seen_finely(const std::string& text) {
  const Json life =
      study_texts::results_of("task = \"analyse\"\n" + text, {{"fidelity.quadrature.intervals", "32"}, {"cycle.positions", "128"}}).at("life");
  Finely found;
  for (const Json& spectrum : life.at("spectra")) {
    for (const char* gear : {"pinion", "wheel"}) found.damage = std::max(found.damage, spectrum.at(gear).at("contact").at("damage").get<double>());
  }
  for (const Json& of : life.at("cases")) {
    found.loss_factor = std::max(found.loss_factor, of.at("loss_factor").get<double>());
    found.film = std::min(found.film, of.at("specific_film_thickness").get<double>());
    found.flash = std::max(found.flash, of.at("flash_temperature_K").get<double>());
  }
  return found;
}

}  // namespace

TEST_CASE("Outputs of life that an optimisation shows carry errors that hold beside a finer analysis", "[studies][life][cycle-error]") {
  const Json before =
      study_texts::results_of("task = \"optimise\"\n" + two_loads + search, {{"fidelity.quadrature.intervals", "8"}, {"cycle.positions", "32"}})
          .at("optimise")
          .at("before");
  const Finely truth = seen_finely(two_loads);
  const auto check = [](const char* figure, double shown, double stated, double finely) {
    CAPTURE(figure, shown, stated, finely);
    CHECK(std::abs(shown - finely) <= stated);
    CHECK(stated < 0.5 * std::abs(shown));  // and says something; damage has a power of stress
  };
  check("contact_damage", before.at("objective"), before.at("objective_error"), truth.damage);
  const auto bounded = [&](const char* name, double finely) {
    check(name, before.at("constraints").at(name).at("value"), before.at("constraints_error").at(name), finely);
  };
  bounded("loss_factor", truth.loss_factor);
  bounded("specific_film_thickness", truth.film);
  bounded("flash_temperature", truth.flash);
}

TEST_CASE("The error of a damage is the excess of the worst gear, errors included, and NaN where a gear's is not known", "[studies][life]") {
  StudyLife life;
  life.cases.resize(2);
  life.cases[1].loaded = 1;
  life.spectra.push_back({"scene", "given", {0, 1}, {}, {}, {}});
  const auto with = [](double damage, double error) {
    DamagedPoint point;
    point.damage = damage;
    point.damage_error = error;
    return point;
  };
  life.spectra[0].contact = {with(0.5, 0.1), with(0.4, 0.3)};  // 0.5 is shown, 0.7 may be true
  life.spectra[0].root.wheel = with(0.2, 0.05);                // the pinion's root has no curve
  for (const std::size_t loaded : {std::size_t{0}, std::size_t{1}}) {
    CHECK(life_error(life, loaded, Output::ContactDamage) == Approx(0.2).epsilon(1e-12));
    CHECK(life_error(life, loaded, Output::RootDamage) == Approx(0.05).epsilon(1e-12));
  }
  life.spectra[0].contact.pinion->damage_error = not_given;
  CHECK(std::isnan(life_error(life, 0, Output::ContactDamage)));
  CHECK(std::isnan(life_error(life, 2, Output::ContactDamage)));  // no such load case
  CHECK(std::isnan(life_error(life, 0, Output::PeakContactStress)));
}

}  // namespace flankwright::studies
