#include "studies/base/csv.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "studies/base/plain_names.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/tasks/sweep/sweep_statistics.hpp"
#include "studies/tasks/sweep/worst_study.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace fs = std::filesystem;

namespace {

/// "peak contact stress [MPa]".
std::string labelled(const SweepOutput& output) {
  const std::string& unit = output.unit;
  return plain_name(output.name) + (unit == "-" ? "" : " [" + unit + "]");
}

std::string statistics_csv(const SweepStatistics& statistics) {
  std::string csv = "output,unit,samples,mean,std,min,max";
  for (const double share : quantile_shares) csv += fmt::format(",{:.0f} %", 100.0 * share);
  csv += ",worst_sample\n";
  for (const OutputStatistics& of : statistics.outputs) {
    csv += fmt::format("{},{},{},{},{},{},{}", of.output.name, of.output.unit, of.count, csv_field(of.mean), csv_field(of.deviation),
                       csv_field(of.smallest), csv_field(of.largest));
    for (const double quantile : of.quantiles) csv += fmt::format(",{}", csv_field(quantile));
    csv += fmt::format(",{}\n", of.worst);
  }
  return csv;
}

/// Of a sweep that has run.
const SweepStatistics& statistics_of(const StudyResults& results) { return *results.found<SweepStatistics>(); }

std::string indices_csv(const StudyResults& results) {
  std::string csv = "output,parameter,first,first_error,total,total_error\n";
  for (const OutputStatistics& of : statistics_of(results).outputs) {
    for (std::size_t j = 0; j < of.indices.size(); ++j) {
      const SobolIndex& index = of.indices[j];
      csv += fmt::format("{},{},{},{},{},{}\n", of.output.name, results.study.table<SweepTable>().parameters[j].path, csv_field(index.first),
                         csv_field(index.first_error), csv_field(index.total), csv_field(index.total_error));
    }
  }
  return csv;
}

void write_samples(const StudyResults& results, const fs::path& file, SweepStore& store) {
  const fs::path temporary = file.string() + ".tmp";
  std::ofstream csv(temporary, std::ios::binary);
  csv << "sample,failure";
  for (const SweepParameter& p : results.study.table<SweepTable>().parameters) csv << ',' << csv_field(fmt::format("{} [{}]", p.path, p.unit));
  for (const OutputStatistics& of : statistics_of(results).outputs) csv << ',' << of.output.name;
  csv << '\n';
  const std::string no_outputs(statistics_of(results).outputs.size(), ',');
  store.for_each(results.study.table<SweepTable>().samples, [&](const StoredSample& sample) {
    csv << sample.id << ',' << csv_field(sample.result.failure);
    for (const double value : sample.values) csv << ',' << csv_field(value);
    for (const double value : sample.result.outputs) csv << ',' << csv_field(value);
    csv << (sample.result.failure.empty() ? "" : no_outputs) << '\n';
  });
  csv.close();
  std::error_code error;
  if (csv) fs::rename(temporary, file, error);
  if (csv && !error) return;
  fs::remove(temporary, error);
  throw InvalidInput("output folder", file.string(), "a place that can be written");
}

}  // namespace

std::string worst_study_name(const SweepOutput& output) { return fmt::format("worst/{}.toml", output.name); }

std::vector<NamedText> sweep_tables(const StudyResults& results) {
  const SweepStatistics* found = results.found<SweepStatistics>();
  if (found == nullptr) return {};
  std::vector<NamedText> tables{{"sweep_statistics.csv", statistics_csv(*found)}};
  if (!found->outputs.front().indices.empty()) tables.push_back({"sweep_indices.csv", indices_csv(results)});
  return tables;
}

std::string sweep_summary(const StudyResults& results) {
  const SweepStatistics& s = statistics_of(results);
  std::string out =
      fmt::format("{:<36}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}  {:>12}\n", "over the samples", "mean", "std", "1 %", "99 %", "worst", "of sample");
  if (s.failed == s.samples) out.clear();  // nothing to tell of any output
  for (const OutputStatistics& of : s.outputs) {
    if (of.count == 0) continue;
    const std::string deviation = std::isnan(of.deviation) ? "-" : fmt::format("{:.4g}", of.deviation);  // of one sample there is none
    out += fmt::format("{:<36}  {:>11.5g}  {:>11}  {:>11.5g}  {:>11.5g}  {:>11.5g}  {:>12}\n", labelled(of.output), of.mean, deviation,
                       of.quantiles.front(), of.quantiles.back(), of.output.smaller_is_worse ? of.smallest : of.largest, of.worst);
  }
  out += fmt::format("\n{} {} in {:.1f} s", s.samples, s.samples == 1 ? "sample" : "samples", s.seconds);
  if (s.failed > 0) out += fmt::format(", {} failed: {}", s.failed, s.failures.front().reason);
  return out + "\n";
}

void write_sweep_files(const StudyResults& results, const fs::path& folder, SweepStore& store) {
  const SweepStatistics& found = statistics_of(results);
  write_samples(results, folder / "samples.csv", store);
  make_folder(folder / "worst");
  for (std::size_t k = 0; k < found.outputs.size(); ++k) {
    const OutputStatistics& of = found.outputs[k];
    if (of.worst < 0) continue;
    const std::string title = fmt::format("{}: sample {}, the worst of {} {}", results.study.title, of.worst, found.samples, of.output.name);
    write_whole(folder / worst_study_name(of.output), sample_study(results.study, title, found.worst[k].values));
  }
}

}  // namespace flankwright::studies
