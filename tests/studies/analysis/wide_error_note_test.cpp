#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "studies/analysis/refine_resolution.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// A pair by thin slices, at two torques.
StudyResults small_pair(const std::string& fidelity) {
  return run_study(parse_study(small::crowned_pair() + R"([load]
torque = [100, 250]
[fidelity]
compliance = "thin_slice"
)" + fidelity,
                               "pair.toml"));
}

/// The note that the load cases get where their errors are to be within an accuracy; empty: none.
std::string note_of(StudyResults results, double accuracy) {
  const std::size_t before = results.notes.size();
  results.study.fidelity.resolution_accuracy = accuracy;
  note_what_stays_wide(judged_cases(results), results);
  return results.notes.size() > before ? results.notes.back() : std::string();
}

}  // namespace

TEST_CASE("The load case with the widest error is named where no resolution keeps the accuracy", "[studies][accuracy]") {
  const StudyResults results = small_pair("");
  double widest = 0.0, torque = 0.0;
  for (const JudgedCase& of : judged_cases(results)) {
    const double error = headline_error(of.resolved->errors, of.resolved->summary, *of.cycle);
    if (error > widest) torque = of.torque / units::newton_metre;
    widest = std::max(widest, error);
  }
  REQUIRE(widest > 0.0);
  CHECK(note_of(results, 1.001 * widest).empty());
  const std::string note = note_of(results, 0.999 * widest);
  CHECK_THAT(note, Catch::Contains(fmt::format("at {:.5g} N·m is known to {:.3g} % only", torque, 100.0 * widest)));
  CHECK_THAT(note, Catch::Contains(fmt::format("{} intervals", results.study.fidelity.quadrature.intervals)));
}

TEST_CASE("No note on wide errors where the study gives what causes them", "[studies][accuracy]") {
  const StudyResults given = small_pair("quadrature = { rule = \"graded\", intervals = 4 }\n[cycle]\npositions = 8\n");
  CHECK(note_of(given, 1e-9).empty());
}
