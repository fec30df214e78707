#include "studies/study_file/study_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <tuple>

#include "studies/study_file/study_bodies.hpp"
#include "studies/study_file/study_checks.hpp"
#include "studies/study_file/study_document.hpp"
#include "studies/study_file/study_flanks.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/study_file/study_reading.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/study_file/study_shafts.hpp"
#include "studies/study_file/study_tables.hpp"

namespace flankwright::studies {

namespace {

/// In the order of the file; what has no line there (the command line) comes last.
void sort_by_line(std::vector<StudyProblem>& problems) {
  const auto order = [](const StudyProblem& p) { return std::tuple(p.line == 0, p.line, p.column); };
  std::ranges::stable_sort(problems, [&](const auto& a, const auto& b) { return order(a) < order(b); });
}

/// Reads the keys with fixed names, common before particular ones.
void read_keys(StudyReading& reading) {
  reading.matches = match_keys(reading, reading.document.root(), study_keys(), "");
  for (const SchemaKey& key : study_schema()) {
    if (const Match* match = reading.find(key.path)) read_into(reading, *match, reading.builder.base);
  }
}

/// Copies the base working condition into the study's own tables.
void settle_base(StudyBuilder& builder) {
  builder.study.misalignment = builder.base.misalignment;
  builder.study.torques = builder.base.torques;
  builder.study.error = builder.base.error;
}

/// Gives the edges of which the file says nothing the usual radius: a sharp edge is what no gear has.
void settle_edges(StudyReading& reading) {
  PairData& pair = reading.builder.study.pair;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    GearData& gear = pair[m];
    const std::string edges = std::string(name_of(m)) + ".edges.";
    const double usual = usual_edge_radius(m, pair);
    const auto settle = [&](const std::string& edge, double& rounding, EdgeChamfer& chamfer) {
      const bool chamfered = chamfer.amount > 0.0;
      double& radius = chamfered ? chamfer.radius : rounding;
      if (reading.find(edges + edge + (chamfered ? "_chamfer.radius" : "_rounding")) == nullptr) radius = usual;
    };
    settle("tip", gear.tip_rounding, gear.tip_chamfer);
    settle("end", gear.end_rounding, gear.end_chamfer);
  }
}

}  // namespace

Study parse_study(std::string_view text, const std::string& name, const std::vector<Override>& overrides) {
  std::vector<StudyProblem> problems;
  const StudyDocument document(text, name, overrides, problems);
  StudyReading reading{document, problems};
  store_defaults(reading.builder);
  read_keys(reading);
  read_spectrum(reading);
  settle_base(reading.builder);
  check_presence(reading);
  settle_edges(reading);
  read_generation(reading);
  read_scenes(reading);
  check_life(reading);
  for (const Task* task : registered_tasks()) {
    if (task->read != nullptr) task->read(reading);
  }
  read_expectations(reading);
  check_pair(reading);
  if (const Task& task = *reading.builder.study.task; task.check != nullptr) task.check(reading);
  read_shafts(reading);
  check_bodies(reading);
  check_flanks(reading);
  read_grids(reading);
  if (!problems.empty()) {
    sort_by_line(problems);
    throw StudyErrors(std::move(problems));
  }
  Study study = std::move(reading.builder.study);
  study.file = name;
  if (study.title.empty()) study.title = std::filesystem::path(name).stem().string();
  study.given = document.given();
  study.text = document.text();
  return study;
}

Study read_study(const std::string& path, const std::vector<Override>& overrides) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  std::error_code no_status;
  if (!file || std::filesystem::is_directory(path, no_status)) {
    throw StudyErrors({{path, 0, 0, "", "", "the file cannot be read"}});
  }
  return parse_study(text.str(), path, overrides);
}

}  // namespace flankwright::studies
