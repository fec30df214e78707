#include "tests/convergence/industrial_study.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "tests/common/random.hpp"
#include "tests/common/study_text.hpp"

namespace flankwright::convergence {

namespace {

using tests::Random;
using tests::StudyText;

struct Rack {
  double addendum, dedendum, root_radius;  // [m_n]
};

void gear(StudyText& study, const std::string& name, int teeth, double face_width, double profile_shift, const Rack& rack) {
  study.table(name);
  study.line("teeth", teeth);
  study.line("face_width", face_width);
  study.line("profile_shift", profile_shift);
  study.line("rack.addendum", rack.addendum);
  study.line("rack.dedendum", rack.dedendum);
  study.line("rack.root_radius", rack.root_radius);
}

void modification(StudyText& study, const std::string& name, double module, Random& random) {
  study.table(name + ".modification");
  study.line("lead_crowning", random(0.0, 10.0));
  study.line("profile_crowning", random(0.0, 6.0));
  study.line("tip_relief.amount", random(0.0, 25.0) * std::min(1.0, 0.3 + module / 8.0));
  study.line("tip_relief.height", module * random(0.3, 1.0));
}

/// Torque on the pinion [N·m] for a nominal contact stress [MPa], after ISO 6336-2 with zone factors of usual size.
double torque_for(double stress, double face_width, double pinion_diameter, double ratio) {
  constexpr double elasticity = 190.0, zone = 2.4, contact_ratio = 0.9;  // Z_E [sqrt(MPa)], Z_H, Z_eps
  const double root = stress / (elasticity * zone * contact_ratio);
  const double force = root * root * face_width * pinion_diameter * ratio / (ratio + 1.0);
  return 0.5 * force * pinion_diameter / 1000.0;
}

}  // namespace

std::string industrial_study(std::uint64_t seed, std::uint64_t index) {
  Random random(tests::mixed(seed, index));
  const double module = random.log_uniform(1.0, 12.0), helix = random.chance(0.3) ? 0.0 : random(5.0, 35.0);
  const int pinion_teeth = random.integer(12, 45), wheel_teeth = random.integer(pinion_teeth, std::min(120, 5 * pinion_teeth));
  const double face_width = module * random(6.0, 14.0);
  const Rack racks[] = {{1.0, 1.25, 0.3}, {1.0, 1.25, 0.38}, {1.25, 1.6, 0.25}, {1.4, 1.6, 0.2}};
  const Rack rack = racks[random.integer(0, 3)];
  const double least_shift = std::max(0.0, rack.addendum * (17.0 - pinion_teeth) / 17.0);  // against undercut

  StudyText study;
  study.table("pair");
  study.line("normal_module", module);
  study.line("helix_angle", helix);
  gear(study, "pinion", pinion_teeth, face_width, random(least_shift, least_shift + 0.4), rack);
  gear(study, "wheel", wheel_teeth, face_width, random(-0.1, 0.2), rack);
  modification(study, "pinion", module, random);
  modification(study, "wheel", module, random);
  study.table("misalignment");
  study.line("mesh_misalignment", random(-20.0, 20.0));
  study.table("load");
  const double diameter = module * pinion_teeth / std::cos(helix * units::deg);
  study.line("torque", torque_for(random(300.0, 1500.0), face_width, diameter, static_cast<double>(wheel_teeth) / pinion_teeth));
  return study.text();
}

}  // namespace flankwright::convergence
