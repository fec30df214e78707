#include "studies/base/version.hpp"
#include "studies/command_line/library_command.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <ranges>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/compliance/fitted/correction_fit.hpp"
#include "studies/base/progress.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/command_line/standard_output.hpp"
#include "studies/compliance/disk_store.hpp"

namespace flankwright::studies {
namespace {

/// Start of a fit without an earlier one.
enum Start { Flat = -1, StandardProfile = -2 };

/// A gear of the library and the one whose fit it starts from, or a Start: from a flat one, or from what the standard profile's fits
/// are for that gear.
struct Step {
  GearProportions gear;
  ReferenceProfile profile{};
  int start{Flat};
};

/// Departures from the standard profile: racks with the largest addendum, the smallest root radius, the largest dedendum (with what
/// root radius a tool for it has room for), and pressure angles on either side.
std::vector<ReferenceProfile> other_profiles() {
  const RackProfile standard;
  std::vector<ReferenceProfile> profiles;
  for (const RackProfile& rack : {RackProfile{1.4, standard.dedendum, standard.root_radius}, RackProfile{standard.addendum, standard.dedendum, 0.2},
                                  RackProfile{standard.addendum, 1.6, 0.25}}) {
    profiles.push_back({.rack = rack});
  }
  for (const double angle : {17.5, 22.5}) profiles.push_back({.pressure_angle = angle * units::deg});
  return profiles;
}

/// From the middle outwards: each gear starts from its neighbour towards the middle, a helical one from the same gear
/// with less helix.
std::vector<Step> steps() {
  constexpr std::array<int, 3> kTeeth{30, 12, 150}, kTeethFrom{Flat, 0, 0};
  constexpr std::array<double, 3> kShifts{0.1, 0.6, -0.4};
  constexpr std::array<double, 2> kAngles{0, 35};
  constexpr double kFace = 8;
  constexpr int kTeethCount = std::ssize(kTeeth), kRow = kTeethCount * std::ssize(kShifts);
  std::vector<Step> list;
  for (std::size_t b = 0; b < kAngles.size(); ++b) {
    for (std::size_t x = 0; x < kShifts.size(); ++x) {
      for (std::size_t z = 0; z < kTeeth.size(); ++z) {
        const int here = static_cast<int>(list.size());
        const int start = b > 0 ? here - kRow : x > 0 ? static_cast<int>(z) : kTeethFrom[z];
        list.push_back({{kTeeth[z], kAngles[b] * units::deg, kFace, kShifts[x]}, {}, start});
      }
    }
  }
  // Fewer teeth than 25 with addendum 1.4 are pointed.
  for (const ReferenceProfile& profile : other_profiles()) {
    for (const double angle : kAngles) {
      for (const int teeth : {25, 100}) list.push_back({{teeth, angle * units::deg, kFace, kShifts[0]}, profile, StandardProfile});
    }
  }
  return list;
}

std::string mesh_line(const char* name, const GearMeshOptions& mesh) {
  return fmt::format(
      "# {} mesh: flank {} fillet {} half_thickness {} adjacent_flank {} adjacent_fillet {} end {} growth {} largest {} "
      "most_layers {} body_growth {} shaft {} layer_share {}\n",
      name, mesh.flank_elements, mesh.fillet_elements, mesh.half_thickness_elements, mesh.adjacent_flank_elements, mesh.adjacent_fillet_elements,
      mesh.end_element, mesh.axial_growth, mesh.largest_element, mesh.most_layers, mesh.body_growth, mesh.shaft_elements, mesh.layer_share);
}

/// Settings that a file must have been made with to be continued.
std::string settings_text() {
  return fmt::format(
      "# What a fine mesh adds to the tooth compliance E m_n K by a coarse one, fitted: coefficients of gears,\n"
      "# nu = 0.3. Made by `flankwright library`, version {}.\n"
      "{}{}"
      "# columns: teeth, helix angle [deg], x, b/m_n, addendum, dedendum and root radius of the rack [m_n], pressure angle [deg],\n"
      "# converged, steps, pairs, seconds, then pairs and median, 95 % and worst relative residual [-] of the places fitted and of others, then the coefficients of KernelForm::refinement()\n"
      "# and the lower triangle of their covariance.\n",
      version(), mesh_line("fine", {}), mesh_line("coarse", coarse_mesh()));
}

std::vector<CorrectionEntry> entries_so_far(const std::filesystem::path& path, const std::vector<Step>& list) {
  std::error_code no_status;
  if (!std::filesystem::exists(path, no_status)) return {};
  const std::string text = read_whole(path);
  std::vector<CorrectionEntry> entries = entries_in(text);
  const bool same = std::ranges::equal(entries, list | std::views::take(std::ssize(entries)), [](const CorrectionEntry& entry, const Step& step) {
    return entry.gear == step.gear && entry.profile == step.profile;
  });
  if (!text.starts_with(settings_text()) || !same) {
    throw InvalidInput("library", path.string(), "a file that this program began with the same gears and meshes, or none");
  }
  return entries;
}

/// The correction of a tooth by a finer mesh does not reach its neighbours: one on either side suffices. Runs are kept, so that
/// another form is fitted, or an interrupted library gone on with, without solving them again.
InfluenceTableRun run_by(const GearMeshOptions& mesh, const Step& step) {
  const InfluenceTableTask task{
      .gear = standard_gear(step.gear, step.profile), .teeth_apart = 1, .mesh = mesh, .grid = station_grid(step.gear.relative_face)};
  DiskStore store;  // of a folder that cannot be used nothing is said: the run is made anew
  if (auto kept = store.find(task)) return std::move(kept->value);
  InfluenceTableRun run = solve_influence_table(task, std::numeric_limits<double>::infinity());
  if (!run.table) throw std::runtime_error("finite elements of the library could not be solved");
  store.keep(task, run);
  return run;
}

CorrectionEntry fit(const CorrectionSamples& samples, const Step& step, const std::vector<CorrectionEntry>& entries) {
  std::vector<double> start;
  if (step.start == StandardProfile) {
    std::vector<CorrectionEntry> standard;
    std::ranges::copy_if(entries, std::back_inserter(standard), [](const CorrectionEntry& e) { return e.profile == ReferenceProfile{}; });
    start = CorrectionGrid(std::move(standard)).coefficients(step.gear);
  } else if (step.start != Flat) {
    start = entries[static_cast<std::size_t>(step.start)].coefficients;
  }
  CorrectionEntry entry = fit_correction(samples, start);
  entry.profile = step.profile;
  return entry;
}

}  // namespace

int library_command(const std::string& path) {
  const std::vector<Step> list = steps();
  std::vector<CorrectionEntry> entries = entries_so_far(path, list);
  Progress progress;
  const auto show = [&] { progress.show("library of fits", static_cast<int>(entries.size()), static_cast<int>(list.size()), {}); };
  const auto write = [&] {
    std::string text = settings_text();
    for (const CorrectionEntry& entry : entries) text += to_text(entry);
    write_whole(path, text);
  };
  write();  // a place that cannot be written is refused before anything is solved
  show();
  const auto abreast = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  while (entries.size() < list.size()) {
    const std::size_t begin = entries.size(), count = std::min(abreast, list.size() - begin);
    std::vector<CorrectionSamples> samples(count);
    std::vector<double> seconds(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const Step& step = list[begin + i];
      const InfluenceTableRun fine = run_by({}, step), coarse = run_by(coarse_mesh(), step);
      samples[i] = correction_samples(step.gear, *fine.table, *coarse.table);
      for (const InfluenceTableRun* run : {&fine, &coarse}) {
        seconds[i] += run->statistics.model_seconds + run->statistics.solve_seconds;  // when it was solved
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto start = std::chrono::steady_clock::now();
      CorrectionEntry entry = fit(samples[i], list[begin + i], entries);
      entry.seconds = seconds[i] + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (entry.coefficients.empty()) throw std::runtime_error("a fit of the library has failed");
      entries.push_back(std::move(entry));
    }
    write();
    show();
  }
  const auto missed = std::ranges::count_if(entries, [](const CorrectionEntry& entry) { return entry.status != FitStatus::Converged; });
  print(fmt::format("{}: {} gears, {} fits that did not converge\n", path, entries.size(), missed));
  return missed == 0 ? 0 : 1;
}

}  // namespace flankwright::studies
