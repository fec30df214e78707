#include <catch2/catch.hpp>

#include "studies/report/report.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/sweep/run_sweep.hpp"
#include "tests/studies/tasks/sweep/small_sweep.hpp"
#include "studies/analysis/run_study.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;

Json results_of(const std::string& settings) {
  StudyResults results = run_study(parse_study(small::sweep(settings), "sweep.toml"));
  run_sweep(results, {}, {});
  return results_document(results);
}

TEST_CASE("The report of a sweep has sections of its own; that of an analysis has not", "[studies][sweep][report]") {
  const std::string with_indices = render_report(results_of("samples = 50"));
  CHECK_THAT(with_indices, Contains("<section id=\"scatter\">") && Contains("<section id=\"indices\">") &&
                               Contains("<section id=\"response-maps\">") && Contains("<section id=\"transmission-error\">"));
  const std::string without = render_report(results_of("samples = 50\nindices = \"off\""));
  CHECK_THAT(without, Contains("<section id=\"scatter\">") && !Contains("<section id=\"indices\">"));
  const std::string analysis =
      render_report(results_document(run_study(parse_study(small::sweep("samples = 50"), "sweep.toml", {{"task", "analyse"}}))));
  CHECK_THAT(analysis, !Contains("<section id=\"scatter\">"));
}

TEST_CASE("A report does not grow with the samples", "[studies][sweep][report]") {
  // Response maps have at most 12 x 12 parts, reached here; numbers differ in length.
  const auto few = static_cast<double>(render_report(results_of("samples = 3600")).size());
  const auto many = static_cast<double>(render_report(results_of("samples = 7200")).size());
  CHECK(many / few == Approx(1.0).epsilon(0.02));
}

}  // namespace
}  // namespace flankwright::studies
