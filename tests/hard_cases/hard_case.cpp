#include "tests/hard_cases/hard_case.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/gear/gear_pair.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "studies/base/value_with_unit.hpp"
#include "tests/core/load/load_cases.hpp"
#include "tests/hard_cases/floating_point_traps.hpp"

namespace flankwright::hard_cases {

studies::Study study(const std::string& name, const Settings& settings) {
  return studies::read_study(std::string(FLANKWRIGHT_SOURCE_DIR "/tests/hard_cases/") + name + ".toml", settings);
}

studies::StudyResults run(const std::string& name, const Settings& settings) {
  const FloatingPointTraps traps;
  return studies::run_study(study(name, settings));
}

std::string in_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

void check_balances(const studies::StudyResults& results) {
  constexpr double kRoundOff = 1e-9;  // of sums of up to a thousand terms
  CHECK_FALSE(results.loaded.empty());
  for (const studies::LoadedResult& loaded : results.loaded) {
    CAPTURE(loaded.scene, loaded.torque);
    REQUIRE(loaded.cycle.usable());
    const MeshModel& model = results.models[loaded.model];
    const double arm = results.pair.pinion.base_radius * std::cos(results.pair.base_helix_angle);
    for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
      const MeshPosition& at = model.positions[i];
      const LoadedPosition& position = loaded.cycle.positions[i];
      const std::vector<ContactLaw> moved = laws_with_moved_edges(at, position.gap, loaded.cycle.force * at.weight.cwiseInverse());
      const LoadProblem problem{at.influence, at.weight, position.gap.total, moved.empty() ? at.laws : moved, loaded.torque / arm};
      CAPTURE(position.phase);
      CHECK(position.load.kkt_residual <= LoadOptions{}.tolerance);
      CHECK(load_cases::optimality(problem, position.load.line_load, position.load.transmission_error).worst() <= kRoundOff);
    }
  }
}

std::vector<double> shares(const MeshModel& model, const LoadedCycle& cycle, std::size_t position) {
  const MeshPosition& at = model.positions[position];
  std::map<int, double> by_tooth;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    by_tooth[at.points[i].tooth] += at.weight[row] * cycle.positions[position].load.line_load[row] / cycle.force;
  }
  std::vector<double> all;
  for (const auto& [tooth, share] : by_tooth) all.push_back(share);
  return all;
}

}  // namespace flankwright::hard_cases
