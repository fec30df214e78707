#include <catch2/catch.hpp>

#include "studies/study_file/study_file.hpp"
#include "studies/tasks/study_template.hpp"
#include "tests/studies/study_texts.hpp"
#include "studies/tasks/accuracy/accuracy_table.hpp"

using namespace flankwright;
using namespace flankwright::studies;

TEST_CASE("An accuracy is a percentage above 0 and at most half", "[studies][accuracy]") {
  const auto with = [](const std::string& value) { return parse_study(study_template("analyse"), "analyse.toml", {{"fidelity.accuracy", value}}); };
  CHECK(with("\"1 %\"").fidelity.accuracy == Approx(0.01).epsilon(1e-14));
  CHECK(with("\"0.1%\"").fidelity.accuracy == Approx(0.001).epsilon(1e-14));
  CHECK_FALSE(parse_study(study_template("analyse"), "analyse.toml").fidelity.accuracy.has_value());
  for (const std::string value : {"1", "\"1\"", "\"0 %\"", "\"-1 %\"", "\"51 %\"", "\"one per cent\"", "[1]"}) {
    CAPTURE(value);
    CHECK_THROWS_WITH(with(value), Catch::Contains("fidelity.accuracy"));
  }
}

TEST_CASE("The study gives the finest level", "[studies][accuracy]") {
  const Study study =
      parse_study(study_template("accuracy"), "accuracy.toml", {{"accuracy.finest.compliance", "fe"}, {"accuracy.finest.positions", "256"}});
  CHECK(study.task == &find_task("accuracy"));
  CHECK(study.table<AccuracyTable>().compliance == ComplianceModel::Fe);
  CHECK(study.table<AccuracyTable>().gap == GapModel::WholeSurface);
  CHECK(study.table<AccuracyTable>().intervals == 16);
  CHECK(study.table<AccuracyTable>().positions == 256);
}

TEST_CASE("The cost of accuracy is that of a loaded contact", "[studies][accuracy]") {
  CHECK_THROWS_WITH(parse_study(study_template("accuracy"), "accuracy.toml", {{"load.torque", "0"}}), Catch::Contains("needs a torque above 0"));
}

TEST_CASE("A curve from outside has values, and a study with one load case", "[studies][accuracy]") {
  using Overrides = std::vector<Override>;
  const std::string key = "accuracy.outside.transmission_error";
  const auto with = [](Overrides overrides) {
    overrides.push_back({"task", "\"accuracy\""});
    overrides.push_back({"load.torque", "100"});
    return study_texts::read("", overrides);
  };
  const Study study = with({{key, "[12, 13.5, 12.5]"}});
  CHECK(study.table<AccuracyTable>().outside.transmission_error == std::vector<double>{12e-3, 13.5e-3, 12.5e-3});
  CHECK(study.table<AccuracyTable>().outside.name == "outside");
  CHECK_THROWS_WITH(with({{key, "[12, 13.5]"}}), Catch::Contains(key) && Catch::Contains("3 to 1024 values"));
  CHECK_THROWS_WITH(parse_study(study_template("accuracy"), "accuracy.toml", {{key, "[12, 13.5, 12.5]"}}),
                    Catch::Contains(key) && Catch::Contains("this one has 2"));
  CHECK_THROWS_WITH(with({{"accuracy.outside.name", "\"rig\""}}), Catch::Contains("accuracy.outside.name") && Catch::Contains("needs " + key));
}
