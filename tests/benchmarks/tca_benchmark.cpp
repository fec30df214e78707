#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "core/flank/measured_grid.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

// Time of tooth contact analysis on one thread: microseconds per contact of a solver that stands, milliseconds per analysis of one
// pitch at 64 positions, all pairs; medians of repeated runs, processor time and elapsed time. An argument sets how often
// (default 15).

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::um;

namespace {

constexpr int positions = 64;

struct Milliseconds {
  double processor{0.0}, elapsed{0.0};
};

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

template <class Work>
Milliseconds time_of(int repetitions, const Work& work) {
  std::vector<double> processor, elapsed;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const double processor_start = processor_ms();
    work();
    processor.push_back(processor_ms() - processor_start);
    elapsed.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return {median(processor), median(elapsed)};
}

/// Prints one line; returns the processor time of one analysis [ms].
double report(const char* name, const GearPair& pair, const FlankAssembly& scene, int repetitions) {
  const ToothContactSolver solver(scene);
  const double pitch = 2 * units::pi / scene.pinion_teeth;
  constexpr int contacts = 200;
  double sum = 0.0;  // keeps the work from being optimised away
  const Milliseconds per_contact = time_of(repetitions, [&] {
    for (int i = 0; i < contacts; ++i) sum += solver.find(0, pitch * (2.0 * i / contacts - 1.0)).phi2;
  });
  UnloadedMesh mesh;
  const Milliseconds analysis = time_of(repetitions, [&] { mesh = analyse_unloaded_mesh(pair, scene, positions); });
  std::printf("%-36s %8.2f us/contact %8.3f ms/TCA (elapsed %8.3f)   TE %9.4f arcsec%s\n", name, 1e3 * per_contact.processor / contacts,
              analysis.processor, analysis.elapsed, mesh.peak_to_peak / units::arcsec, std::isnan(sum) ? " (no contact)" : "");
  return analysis.processor;
}

/// A flank of the pinion as measured at 15 x 15 points: crowned by 8 um over the face, with a wave of 1 um.
MeasuredGrid measured_flank(const GearPair& pair) {
  constexpr int lines = 15;
  const FlankFrame frame = pair.flank_frame(Member::Pinion);
  MeasuredGrid grid;
  grid.deviation.resize(lines, lines);
  for (int i = 0; i < lines; ++i) {
    const double up = static_cast<double>(i) / (lines - 1), along = 2.0 * i / (lines - 1) - 1.0;
    grid.radii.push_back(frame.active_root_radius + up * (frame.tip_radius - frame.active_root_radius));
    grid.z.push_back(0.5 * frame.face_width * along);
  }
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const double along = 2.0 * j / (lines - 1) - 1.0;
      grid.deviation(i, j) = -8 * um * along * along + 1 * um * std::sin(0.9 * i + 0.7 * j);
    }
  }
  return grid;
}

}  // namespace

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  const GearPair nasa = make_gear_pair(reference::nasa_tm_107451::pair_data());
  const GearPair haddad = make_gear_pair(reference::haddad_18_54::pair_data());
  const GearPair spur = make_gear_pair(pair_data(25, 50, 0.0));

  report("NASA 30/100, aligned", nasa, scene_of(nasa), repetitions);
  Misalignment crossed;
  crossed.crossing = 3 * arcmin;
  report("NASA 30/100, crossing 3'", nasa, scene_of(nasa, crossed), repetitions);

  PairData cut = reference::nasa_tm_107451::pair_data();
  cut.pinion.generation = ParabolicRack{0.002};
  const GearPair generated = make_gear_pair(cut);
  report("NASA 30/100, parabolic rack, 3'", generated, scene_of(generated, crossed), repetitions);

  Modification predesigned;
  predesigned.parabolic_te = 0.2 * units::arcsec_per_square_deg;
  report("NASA 30/100, parabolic TE, 3'", nasa, scene_of(nasa, crossed, predesigned), repetitions);

  Modification pinion, wheel;
  pinion.lead_crowning = 0.0077;
  pinion.lead_slope = 0.0005;
  pinion.addendum_crowning = pinion.dedendum_crowning = 0.0024;
  pinion.twist = 0.004;
  wheel.tip_relief = {0.010, 3.0, ReliefShape::Linear};
  Misalignment housing;
  housing.crossing = housing.intersecting = 1 * arcmin;
  housing.mesh_misalignment = 0.008;
  const double analytic = report("18/54 modified, misaligned", haddad, scene_of(haddad, housing, pinion, wheel), repetitions);
  const MeasuredGrid grid = measured_flank(haddad);
  pinion.topography = make_grid_field(grid, haddad.pinion.base_radius, haddad.base_helix_angle).field;
  const double with_grid = report("18/54 the same, pinion 15 x 15 grid", haddad, scene_of(haddad, housing, pinion, wheel), repetitions);

  Modification relieved;
  relieved.tip_relief = {0.020, 1.5, ReliefShape::Linear};
  Modification crowned = relieved;
  crowned.lead_crowning = 0.005;
  report("spur 25/50, tip relief, crossing 3'", spur, scene_of(spur, crossed, relieved, crowned), repetitions);
  std::printf("with a grid / without: %.2f\n", with_grid / analytic);
}
