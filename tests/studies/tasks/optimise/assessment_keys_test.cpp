#include <catch2/catch.hpp>

#include "core/gear/flank_tolerances.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_texts.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using study_texts::problem_of;
using study_texts::read;

const SceneTolerance& tolerance(const Study& study, const std::string& path, bool added = false) {
  for (const SceneTolerance& t : study.tolerances) {
    if (t.path == path && t.added == added) return t;
  }
  FAIL("no tolerance " << path);
  return study.tolerances.front();
}

TEST_CASE("By default an optimum is compared with rules of thumb alone", "[studies][assessment]") {
  const Study study = read();
  const AssessmentTable& by_default = study.table<OptimiseTable>().assessment;
  CHECK(by_default.rules);
  CHECK(by_default.variants == 0.0);
  CHECK(by_default.validation.samples == 0);
  CHECK(by_default.scenes.samples == 0);
  CHECK(study.tolerances.empty());
  CHECK(by_default.validation.seed != by_default.scenes.seed);  // afresh: not the scenes that the optimiser saw
  const AssessmentTable asked = read("[optimise.comparison]\nrules = \"off\"\nvariants = 10\n").table<OptimiseTable>().assessment;
  CHECK_FALSE(asked.rules);
  CHECK(asked.variants == 10.0);
}

TEST_CASE("Tolerances are read in the unit of their key, classes as that gear's tolerances", "[studies][assessment]") {
  const Study study = read(R"(
[optimise.tolerances]
"misalignment.mesh_misalignment" = { normal = [0, "0.006 mm"] }
"pinion.error" = { iso_1328_class = 6 }
"load.torque" = { values = [500, "1 kN·m"] }
)");
  CHECK(tolerance(study, "misalignment.mesh_misalignment").distribution == Distribution::normal(0.0, 6.0));
  CHECK(tolerance(study, "load.torque").distribution == Distribution::values({500.0, 1000.0}));
  const FlankTolerances pinion = flank_tolerances(ToleranceData::of(make_gear_pair(study.pair), Member::Pinion), 6);
  CHECK(tolerance(study, "pinion.error.helix_slope").distribution == Distribution::within_tolerance(pinion.helix_slope / units::um));
  CHECK(tolerance(study, "pinion.error.profile_slope").distribution == Distribution::within_tolerance(pinion.profile_slope / units::um));
  CHECK(tolerance(study, "pinion.error.pitch").pitch == PitchTolerance{study.pair.pinion.teeth, pinion.single_pitch, pinion.cumulative_pitch});
  CHECK(study.tolerances.size() == 5);
}

TEST_CASE("A bearing clearance tilts by up to clearance over span, after all that replaces values", "[studies][assessment]") {
  const Study study = read(R"(
[optimise.tolerances]
"wheel.bearing_clearance" = { clearance = 30, span = "0.2 m" }
"misalignment.crossing" = { uniform = [-1, 1] }
)");
  const std::vector<SceneTolerance>& tolerances = study.tolerances;
  REQUIRE(tolerances.size() == 3);
  CHECK_FALSE(tolerances.front().added);
  const double tilt = 0.030 / 200.0 / units::arcmin;
  constexpr double round_off = 1e-12;
  for (const char* axis : {"misalignment.crossing", "misalignment.intersecting"}) {
    CHECK(tolerance(study, axis, true).distribution.quantile(0.75) == Approx(0.5 * tilt).epsilon(round_off));
  }
}

TEST_CASE("Tolerances that cannot be drawn are refused at their line", "[studies][assessment]") {
  const auto allowed = [](const std::string& line) { return problem_of("[optimise.tolerances]\n" + line + "\n").allowed; };
  CHECK_THAT(allowed("\"misalignment.crosing\" = { normal = [0, 1] }"), Contains("did you mean"));
  CHECK_THAT(allowed("\"pinion.modification.tip_relief.height\" = { normal = [0, 1] }"), Contains("bearing_clearance"));
  CHECK_THAT(allowed("\"misalignment.crossing\" = { iso_1328_class = 6 }"), Contains("helix_slope"));
  CHECK_THAT(allowed("\"misalignment.crossing\" = { normal = [0, -1] }"), Contains("deviation"));
  CHECK_THAT(allowed("\"pinion.bearing_clearance\" = { clearance = 30 }"), Contains("span"));
  CHECK_THAT(allowed("\"pinion.bearing_clearance\" = { clearance = -30, span = 100 }"), Contains("above 0"));
  CHECK_THAT(allowed("\"pinion.error\" = { iso_1328_class = 6 }\n\"pinion.error.pitch\" = { normal = [0, 1] }"), Contains("given twice"));
  CHECK(problem_of("[optimise.tolerances]\n\"misalignment.crossing\" = 3\n").line == 14);
}

TEST_CASE("Scenes cannot be drawn from nothing", "[studies][assessment]") {
  const StudyProblem problem = problem_of("[optimise.validation]\nsamples = 100\n");
  CHECK(problem.key == "optimise.validation.samples");
  CHECK_THAT(problem.allowed, Contains("optimise.tolerances"));
}

}  // namespace
}  // namespace flankwright::studies
