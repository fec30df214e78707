#include <catch2/catch.hpp>

#include "studies/tasks/fit/fit_choice.hpp"
#include "studies/tasks/fit/fit_gears.hpp"
#include "studies/tasks/study_template.hpp"
#include "tests/studies/study_texts.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::studies {

using Catch::Contains;

namespace {

Study fit_study(const std::vector<Override>& overrides = {}) { return parse_study(study_template("fit"), "fit.toml", overrides); }

}  // namespace

TEST_CASE("By default the task fit takes both gears, one tooth and a test grid", "[studies][fit]") {
  const FitChoice usual = study_texts::read("", {{"task", "fit"}}).table<FitChoice>();
  CHECK((usual.gears.pinion && usual.gears.wheel && !usual.several_teeth && usual.test_grid));
  CHECK(usual.max_iterations == 300);
  const FitChoice other =
      fit_study({{"fit.gear", "wheel"}, {"fit.form", "several_teeth"}, {"fit.test_grid", "off"}, {"fit.max_iterations", "7"}}).table<FitChoice>();
  CHECK((!other.gears.pinion && other.gears.wheel && other.several_teeth && !other.test_grid));
  CHECK(other.max_iterations == 7);
}

TEST_CASE("A fit's keys refuse what they do not know", "[studies][fit]") {
  for (const auto& [key, value] :
       {std::pair{"fit.gear", "rack"}, {"fit.form", "thesis"}, {"fit.test_grid", "perhaps"}, {"fit.max_iterations", "0"}}) {
    CAPTURE(key);
    const std::vector<StudyProblem> problems = study_texts::problems_of(study_template("fit"), {{key, value}});
    REQUIRE(problems.size() == 1);
    CHECK(problems.front().key == key);
  }
  const std::vector<StudyProblem> body = study_texts::problems_of(study_template("fit"), {{"pinion.body.shaft_diameter", "79"}});
  REQUIRE(body.size() == 1);  // the root circle has 74.4 mm
  CHECK(body.front().key == "pinion.body.shaft_diameter");
}

TEST_CASE("A gear is fitted as the study describes it", "[studies][fit]") {
  const Study study = fit_study({{"wheel.body.shaft_diameter", "50"},
                                 {"wheel.material.poissons_ratio", "0.25"},
                                 {"fit.form", "one_tooth_accurate"},
                                 {"fit.max_iterations", "7"}});
  const GearPair pair = make_gear_pair(study.pair);
  const GearFitTask task = gear_fit_task(study, pair, Member::Wheel);
  CHECK(task.gear.gear.teeth == 40);
  CHECK(task.gear.gear.tip_diameter == 2 * pair.wheel.tip_radius);
  CHECK(task.gear.helix_angle == pair.data.helix_angle);
  CHECK(task.gear.body.shaft_diameter == 50);
  CHECK(task.gear.body.bore_diameter == Approx(2.5).epsilon(1e-14));  // round-off
  CHECK(task.material.poissons_ratio == 0.25);
  CHECK(task.form == KernelForm::one_tooth_accurate());
  CHECK(task.fit.solver.max_iterations == 7);
}

TEST_CASE("A fit that did not end well is a requirement not met, said in one line", "[studies][fit]") {
  GearFit fit{Member::Wheel, {}, true};
  CHECK_THAT(unmet_requirement(fit), Contains("wheel") && Contains("finite elements could not be solved"));
  fit.result.status = FactorStatus::Factorised;
  fit.result.fit.status = FitStatus::IterationLimit;
  fit.result.fit.iterations = 300;
  CHECK_THAT(unmet_requirement(fit), Contains("wheel") && Contains("did not converge") && Contains("300"));
  fit.result.fit.status = FitStatus::Converged;
  CHECK(unmet_requirement(fit).empty());
}

}  // namespace flankwright::studies
