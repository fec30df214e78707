#include "tests/hard_cases/random_study.hpp"

#include <algorithm>
#include <cmath>

#include "tests/common/random.hpp"
#include "tests/common/study_text.hpp"

namespace flankwright::hard_cases {

namespace {

using tests::mixed;
using tests::Random;
using tests::StudyText;

class Drawing {
 public:
  explicit Drawing(Random& random) : random_(random) {}

  std::string study() {
    module_ = one_in(20) ? random_.log_uniform(0.001, 1000.0) : random_.log_uniform(0.3, 30.0);
    pair();
    gear("pinion", 8.0, 120.0);
    gear("wheel", 8.0, 500.0);
    misalignment();
    material();
    load();
    return out_.text();
  }

 private:
  bool one_in(int n) { return random_.integer(1, n) == 1; }
  /// Of either sign and any size up to the largest; 0 half of the time.
  double signed_amount(double largest) {
    if (one_in(2)) return 0.0;
    return (one_in(2) ? 1.0 : -1.0) * random_.log_uniform(1e-9 * largest, largest);
  }
  void amount(const std::string& key, double largest) {
    const double value = signed_amount(largest);
    if (value != 0.0) out_.line(key, value);
  }
  std::string choice(const char* one, const char* other) { return one_in(2) ? one : other; }

  void pair() {
    out_.table("pair");
    out_.line("normal_module", module_);
    helix_ = one_in(3) ? 0.0 : one_in(10) ? 1e-6 : random_(0.0, 45.0);
    out_.line("helix_angle", helix_);
    if (one_in(4)) out_.line("pressure_angle", random_(14.5, 30.0));
    if (one_in(2)) out_.line("working_flank", choice("\"left\"", "\"right\""));
  }

  void gear(const std::string& name, double fewest, double most) {
    out_.table(name);
    const int teeth = static_cast<int>(random_.log_uniform(fewest, most + 1.0));
    if (name == "pinion") {
      face_ = module_ * random_.log_uniform(0.5, 60.0);
      radius_ = 0.5 * module_ * teeth;
      if (one_in(2)) out_.line("hand", choice("\"left\"", "\"right\""));
    }
    out_.line("teeth", teeth);
    out_.line("face_width", std::clamp(one_in(2) ? face_ : face_ * random_(0.8, 1.3), 0.001, 10000.0));
    // Few teeth want a positive shift lest their involute be cut away.
    if (one_in(2) || teeth < 17) out_.line("profile_shift", teeth < 17 ? random_(0.0, 0.6) : random_(-0.4, 0.8));
    if (one_in(6)) {
      const double addendum = random_(0.7, 1.3);
      out_.line("rack.addendum", addendum);
      out_.line("rack.dedendum", addendum + random_(0.15, 0.35));
      out_.line("rack.root_radius", random_(0.0, 0.2));
    }
    // Sharp, and from nearly sharp to nearly the whole tip, and beyond.
    if (one_in(2)) out_.line("edges.tip_rounding", one_in(4) ? 0.0 : std::min(100.0, module_ * random_.log_uniform(1e-5, 0.5)));
    out_.table(name + ".modification");
    // Up to 80 um at 3 mm of module and in proportion to it, within what is allowed.
    const double largest = std::min(1000.0, 27.0 * module_);
    for (const char* key : {"lead_crowning", "lead_slope", "addendum_crowning", "dedendum_crowning", "profile_slope", "twist"}) amount(key, largest);
    if (one_in(3)) relief("tip_relief", largest, module_ * random_(0.05, 1.5));
    if (one_in(4)) relief("root_relief", largest, module_ * random_(0.05, 1.0));
    if (one_in(4)) {
      out_.line("end_relief.amount", random_.log_uniform(1e-9 * largest, largest));
      out_.line("end_relief.length", std::clamp(face_ * random_(0.01, 0.4), 1e-6, 10000.0));
    }
    if (helix_ > 0.0 && one_in(5)) relief("triangular_tip_relief", largest, module_ * random_(0.05, 1.5));
    if (helix_ > 0.0 && one_in(5)) relief("triangular_root_relief", largest, module_ * random_(0.05, 1.0));
    if (one_in(8)) out_.line("parabolic_te", random_.log_uniform(1e-12, 1.0));
    if (one_in(4)) amount("topography.profile_2_face_2", largest);
    out_.table(name + ".error");
    for (const char* key : {"pitch", "helix_slope", "profile_slope", "twist"}) {
      if (one_in(2)) amount(key, 0.3 * largest);
    }
  }

  void relief(const std::string& key, double largest, double height) {
    const double value = random_.log_uniform(1e-9 * largest, largest);
    out_.line(key + ".amount", one_in(10) ? -0.1 * value : value);
    out_.line(key + ".height", height);
    out_.line(key + ".shape", choice("\"linear\"", "\"parabolic\""));
  }

  void misalignment() {
    out_.table("misalignment");
    for (const char* key : {"crossing", "intersecting", "pinion_lead_angle", "pinion_pressure_angle"}) {
      if (one_in(2)) amount(key, 20.0);
    }
    if (one_in(3)) out_.line("centre_distance", module_ * random_(-0.02, 0.1));
    if (one_in(3)) amount("axial_offset", 0.2 * face_);
    amount("mesh_misalignment", std::min(1000.0, 27.0 * module_));
  }

  void material() {
    out_.table("material");
    out_.line("poissons_ratio", one_in(8) ? 0.0 : one_in(8) ? 0.499 : random_(0.2, 0.35));
    if (one_in(4)) out_.line("youngs_modulus", random_.log_uniform(1e3, 1e6));
  }

  void load() {
    out_.table("load");
    const double design = 300.0 * face_ * radius_ / 1000.0;  // N·m
    out_.line("torque", std::min(1e9, design * random_.log_uniform(1e-6, 1e6)));
    out_.table("cycle");
    out_.line("positions", random_.integer(1, 3));
    out_.line("peaks", std::string(R"("sampled")"));
    out_.table("fidelity");
    out_.line("compliance", std::string(R"("thin_slice")"));
    if (one_in(16)) out_.line("gap", std::string(R"("whole_surface")"));
    const char* rules[] = {R"("gauss2")", R"("gauss3")", R"("midpoint")", R"("graded")"};
    out_.line("quadrature.rule", std::string(rules[random_.integer(0, 3)]));
    out_.line("quadrature.intervals", random_.integer(1, 8));
    if (one_in(8)) {
      out_.table("analyse");
      out_.line(
          "gradients",
          std::string(
              R"(["pinion.modification.lead_crowning", "load.torque", "misalignment.mesh_misalignment", "misalignment.crossing", "misalignment.axial_offset"])"));
    }
  }

  Random& random_;
  StudyText out_;
  double module_{1.0}, helix_{0.0}, face_{1.0}, radius_{1.0};
};

}  // namespace

std::string random_study(std::uint64_t seed, std::uint64_t index) {
  Random random(mixed(seed, index));
  return Drawing(random).study();
}

}  // namespace flankwright::hard_cases
