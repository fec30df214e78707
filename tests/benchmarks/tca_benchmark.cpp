#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/haddad_18_54.hpp"
#include "tests/reference/nasa_tm_107451.hpp"

// Time of tooth contact analysis: us per contact of a solver that stands, ms per analysis of one pitch at 64 positions, one
// thread, medians of repeated runs. An argument sets how often (default 15).

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;

namespace {

constexpr int positions = 64;

template <class Work>
double median_ms(int repetitions, const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repetitions / 2, times.end());
  return times[static_cast<std::size_t>(repetitions) / 2];
}

double report(const char* name, const GearPair& pair, const MeshScene& scene, int repetitions) {
  const ToothContactSolver solver(scene);
  const double pitch = 2 * units::pi / scene.pinion_teeth;
  constexpr int contacts = 200;
  double sum = 0.0;  // keeps the work from being optimised away
  const double per_contact = median_ms(repetitions, [&] {
    for (int i = 0; i < contacts; ++i) sum += solver.find(0, pitch * (2.0 * i / contacts - 1.0)).phi2;
  });
  UnloadedMesh mesh;
  const double analysis = median_ms(repetitions, [&] { mesh = analyse_unloaded_mesh(pair, scene, positions); });
  std::printf("%-34s %8.2f us/contact %8.3f ms/TCA   TE %9.4f arcsec%s\n", name, 1e3 * per_contact / contacts, analysis,
              mesh.peak_to_peak / units::arcsec, std::isnan(sum) ? " (no contact)" : "");
  return analysis;
}

/// A smooth topography of 5 um, as costly to evaluate as a wavy one.
class SmoothTopography : public DeviationField {
 public:
  Jet at(double rho, double z) const override {
    return 0.005 * sin(0.1 * Jet::variable_u(rho)) * cos(0.05 * Jet::variable_v(z));
  }
};

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

  Modification pinion, wheel;
  pinion.lead_crowning = 0.0077;
  pinion.lead_slope = 0.0005;
  pinion.addendum_crowning = pinion.dedendum_crowning = 0.0024;
  pinion.twist = 0.004;
  wheel.tip_relief = {0.010, 3.0, ReliefShape::Linear};
  Misalignment housing;
  housing.crossing = housing.intersecting = 1 * arcmin;
  housing.mesh_misalignment = 0.008;
  const double analytic =
      report("18/54 modified, misaligned", haddad, scene_of(haddad, housing, pinion, wheel), repetitions);
  pinion.topography = std::make_shared<SmoothTopography>();
  const double with_field =
      report("18/54 the same with a field", haddad, scene_of(haddad, housing, pinion, wheel), repetitions);

  Modification relieved;
  relieved.tip_relief = {0.020, 1.5, ReliefShape::Linear};
  Modification crowned = relieved;
  crowned.lead_crowning = 0.005;
  report("spur 25/50, tip relief, crossing 3'", spur, scene_of(spur, crossed, relieved, crowned), repetitions);
  std::printf("with a field / without: %.2f\n", with_field / analytic);
}
