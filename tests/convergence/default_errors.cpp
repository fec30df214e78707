// How far the defaults are from the answer, and whether the errors that they state hold, on random pairs of industry:
//
//   flankwright_default_errors --pairs 200 --seed 1 [--first 0] [--keep FOLDER]
//
// Every pair is analysed as a study that leaves out what has a default, and again with four times the positions (at most 256) and 48 intervals, at least twice those of the defaults. A line a
// pair, then a table. Pairs depend on seed and index alone, so that a run goes on at --first where another one ended. Finite elements of the gears come from
// the user's cache where they are known. Exit code 1 where the median of a figure is off by more than 0.5 %, 95 % of the pairs by more than 2 %, or a
// stated error holds in less than 95 % of the pairs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "core/base/error.hpp"
#include "core/load/cycle/cycle_figures.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/convergence/industrial_study.hpp"

using namespace flankwright;

namespace {

constexpr int kFewestFineIntervals = 48, kMostPositions = 256;

/// A figure of one load case, at the defaults and finely.
struct Compared {
  double error{not_given}, stated{not_given};  ///< as fractions, see figure_errors(); NaN: the pair has no such figure
  bool known() const { return std::isfinite(error) && std::isfinite(stated); }
  bool holds() const { return error <= stated; }
};

constexpr int kFigures = 4;
constexpr const char* kNames[kFigures] = {"peak to peak", "first harmonic", "contact stress", "stress on tip edges"};

struct PairErrors {
  Compared figures[kFigures];
  int intervals{0}, positions{0};
  double stress{not_given};  ///< [MPa]
};

Compared compared(Figure figure, const CycleFigures& fine, const CycleFigures& shown, const CycleErrors& stated) {
  const auto at = static_cast<std::size_t>(figure);
  return {figure_errors(shown, fine)[at], error_shares(stated, fine)[at]};
}

PairErrors errors_of(const std::string& text, const std::string& name) {
  const studies::StudyResults defaults = studies::run_study(studies::parse_study(text, name));
  const studies::LoadedResult& shown = defaults.loaded.front();
  PairErrors found;
  found.intervals = defaults.study.fidelity.quadrature.intervals;
  found.positions = static_cast<int>(shown.cycle.positions.size());
  const int positions = std::min(4 * found.positions, kMostPositions), intervals = std::max(2 * found.intervals, kFewestFineIntervals);
  const studies::StudyResults finer =
      studies::run_study(studies::parse_study(text, name,
                                              {{"fidelity.quadrature", "{ rule = \"graded\", intervals = " + std::to_string(intervals) + " }"},
                                               {"cycle.positions", std::to_string(positions)}}));
  const studies::LoadedResult& fine = finer.loaded.front();
  found.stress = fine.summary.peak_contact_stress;
  const CycleFigures shown_figures = figures_of(shown.cycle, shown.summary), fine_figures = figures_of(fine.cycle, fine.summary);
  const Figure of[] = {Figure::TePeakToPeak, Figure::TeHarmonic1, Figure::PeakContactStress};
  for (int f = 0; f < 3; ++f) found.figures[f] = compared(of[f], fine_figures, shown_figures, shown.resolved.errors);
  const double edge = fine.summary.edge_stress;
  if (edge > 0.0) found.figures[3] = {std::abs(shown.summary.edge_stress - edge) / edge, shown.resolved.errors.edge_stress / edge};
  return found;
}

/// Of nearest rank.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return not_given;
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

/// One row of the table; true where the figure is as accurate as it should be.
bool summarise(const std::vector<PairErrors>& pairs, int figure) {
  std::vector<double> errors;
  int holds = 0;
  for (const PairErrors& pair : pairs) {
    const Compared& at = pair.figures[figure];
    if (!at.known()) continue;
    errors.push_back(at.error);
    holds += at.holds() ? 1 : 0;
  }
  if (errors.empty()) return true;
  const double median = quantile(errors, 0.5), most = quantile(errors, 0.95);
  std::printf("%-20s %6zu %9.3f %9.3f %9.3f %9d\n", kNames[figure], errors.size(), 100 * median, 100 * most, 100 * quantile(errors, 1.0), holds);
  return median <= 0.005 && most <= 0.02 && holds >= 0.95 * static_cast<double>(errors.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t pairs = 10, seed = 1, first = 0;
  std::string folder;
  CLI::App app{"Compares the defaults with a fine run on random pairs of industry.", "flankwright_default_errors"};
  app.add_option("--pairs", pairs, "how many that can be built");
  app.add_option("--seed", seed, "another seed, other pairs");
  app.add_option("--first", first, "index of the first");
  app.add_option("--keep", folder, "folder that receives the studies");
  CLI11_PARSE(app, argc, argv);

  std::vector<PairErrors> all;
  for (std::uint64_t index = first; all.size() < pairs; ++index) {
    const std::string text = convergence::industrial_study(seed, index),
                      name = "pair-" + std::to_string(seed) + "-" + std::to_string(index) + ".toml";
    if (!folder.empty()) {
      std::filesystem::create_directories(folder);
      studies::write_whole(std::filesystem::path(folder) / name, text);
    }
    try {
      all.push_back(errors_of(text, name));
    } catch (const InvalidInput& refused) {
      std::printf("%llu refused: %s\n", static_cast<unsigned long long>(index), refused.what());
      continue;
    }
    const PairErrors& pair = all.back();
    std::printf("%llu: %d intervals, %d positions, %.0f MPa;", static_cast<unsigned long long>(index), pair.intervals, pair.positions, pair.stress);
    for (int f = 0; f < kFigures; ++f) {
      const Compared& at = pair.figures[f];
      if (at.known()) std::printf(" %s %.3f of %.3f %%%s;", kNames[f], 100 * at.error, 100 * at.stated, at.holds() ? "" : " (exceeded)");
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  std::printf("\nerror [%%]             pairs    median      95 %%   largest    within\n");
  bool accurate = true;
  for (int f = 0; f < kFigures; ++f) accurate = summarise(all, f) && accurate;
  return accurate ? 0 : 1;
}
