#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/path_of_contact.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/sweep/run_sweep.hpp"
#include "tests/core/load/load_cases.hpp"

/// Laws that a study keeps whatever it asks for: it does not matter which gear is called the pinion, and the mirror image of a pair is as good as
/// the pair. The tasks "accuracy" and "fit" make the same analyses at other settings, and of single gears.
namespace flankwright::studies {
namespace {

using load_cases::Random;

struct LawGear {
  int teeth;
  double shift, lead_crowning, lead_slope, profile_crowning, profile_slope, tip_relief, twist, helix_error;  ///< [-; um]
};

/// A pair with what acts on it.
struct LawPair {
  double module, helix, face;  ///< [mm, deg, mm]
  bool right_hand;             ///< of the pinion
  LawGear pinion, wheel;
  double pitch_error;        ///< of the pinion, step from tooth to tooth [um]
  double mesh_misalignment;  ///< [um]
  double torque;             ///< on the pinion [N·m]
  std::vector<double> phases;

  double last_phase() const { return PathOfContact(make_gear_pair(parse_study(text("analyse"), "law").pair)).last_line_phase(); }

  std::string text(const std::string& task, const std::string& more = "") const {
    std::string out = fmt::format("task = \"{}\"\n[pair]\nnormal_module = {}\nhelix_angle = {}\n", task, module, helix);
    const auto gear = [&](const char* name, const LawGear& g, const char* hand, double pitch) {
      out += fmt::format(
          "[{0}]\nteeth = {1}\nface_width = {2}\nprofile_shift = {3}\n{4}[{0}.modification]\nlead_crowning = {5}\nlead_slope = {6}\n"
          "profile_crowning = {7}\nprofile_slope = {8}\ntip_relief = {{ amount = {9}, height = {10} }}\ntwist = {11}\n[{0}.error]\n"
          "helix_slope = {12}\npitch = {13}\n",
          name, g.teeth, face, g.shift, hand, g.lead_crowning, g.lead_slope, g.profile_crowning, g.profile_slope, g.tip_relief, 0.6 * module, g.twist,
          g.helix_error, pitch);
    };
    gear("pinion", pinion, right_hand ? "hand = \"right\"\n" : "hand = \"left\"\n", pitch_of_pinion ? pitch_error : 0.0);
    gear("wheel", wheel, "", pitch_of_pinion ? 0.0 : pitch_error);
    out += fmt::format("[misalignment]\nmesh_misalignment = {}\n[load]\ntorque = {}\n[cycle]\npeaks = \"sampled\"\n", mesh_misalignment, torque);
    if (!phases.empty()) out += fmt::format("phases = [{}]\n", fmt::join(phases, ", "));
    return out + "[fidelity]\ncompliance = \"thin_slice\"\nquadrature = { rule = \"gauss2\", intervals = 7 }\n" + more;
  }
  bool pitch_of_pinion{true};
};

LawPair random_pair(Random& random) {
  const auto gear = [&](int fewest, int most) {
    return LawGear{random.integer(fewest, most),
                   random(0.0, 0.3),
                   random(0.0, 15.0),
                   random(-8.0, 8.0),
                   random(0.0, 8.0),
                   random(-4.0, 4.0),
                   random(0.0, 20.0),
                   random(-6.0, 6.0),
                   random(-6.0, 6.0)};
  };
  LawPair pair{random.log_uniform(1.5, 8.0),
               random.integer(0, 2) == 0 ? 0.0 : random(5.0, 30.0),
               0.0,
               random.integer(0, 1) == 1,
               gear(18, 30),
               gear(25, 90),
               random(-4.0, 4.0),
               random(-15.0, 15.0),
               0.0,
               {}};
  pair.face = pair.module * random(5.0, 14.0);
  pair.torque = 150.0 * pair.face * 0.5e-3 * pair.module * pair.pinion.teeth;  // 150 N/mm at the reference circle
  const double last = pair.last_phase();
  for (int k = 0; k < 5; ++k) pair.phases.push_back(std::fmod(random(0.3, 0.7) * last, last));
  return pair;
}

/// The same pair with the other gear called the pinion: it runs backwards, and what was ahead is behind.
LawPair swapped(LawPair pair) {
  const double last = pair.last_phase();
  for (double& phase : pair.phases) phase = last - phase;
  pair.torque *= static_cast<double>(pair.wheel.teeth) / pair.pinion.teeth;
  std::swap(pair.pinion, pair.wheel);
  pair.right_hand = !pair.right_hand;
  pair.pitch_of_pinion = !pair.pitch_of_pinion;
  pair.pitch_error = -pair.pitch_error;
  return pair;
}

/// The same in a mirror at the mid-face plane.
LawPair mirrored(LawPair pair) {
  pair.right_hand = !pair.right_hand;
  pair.mesh_misalignment = -pair.mesh_misalignment;
  for (LawGear* gear : {&pair.pinion, &pair.wheel}) {
    gear->lead_slope = -gear->lead_slope;
    gear->twist = -gear->twist;
    gear->helix_error = -gear->helix_error;
  }
  return pair;
}

StudyResults results_of_law(const LawPair& pair, const std::string& task, const std::string& more = "") {
  StudyResults results = run_study(parse_study(pair.text(task, more), "law.toml"));
  if (results.study.task->run_in_folder != nullptr) results.study.task->run_in_folder(results, {}, {});
  return results;
}

constexpr double solver_tolerance = 1e-8;  // of the load solver times the condition, and of the conversion of phases

void check_same_load(const StudyResults& a, const StudyResults& b) {
  REQUIRE(a.loaded.size() == b.loaded.size());
  for (std::size_t i = 0; i < a.loaded.size(); ++i) {
    const LoadedResult &one = a.loaded[i], &other = b.loaded[i];
    REQUIRE(one.cycle.usable());
    REQUIRE(other.cycle.usable());
    CHECK(one.summary.peak_contact_stress == Approx(other.summary.peak_contact_stress).epsilon(solver_tolerance));
    CHECK(one.summary.peak_line_load == Approx(other.summary.peak_line_load).epsilon(solver_tolerance));
    for (std::size_t k = 0; k < one.cycle.positions.size(); ++k) {
      CHECK(one.cycle.positions[k].load.transmission_error == Approx(other.cycle.positions[k].load.transmission_error).epsilon(solver_tolerance));
    }
    CHECK(one.iso.lead == Approx(other.iso.lead).epsilon(solver_tolerance));
  }
}

TEST_CASE("It makes no difference to an analysis which gear is called the pinion, nor in which mirror a pair is seen", "[studies][laws]") {
  Random random(20261124);
  for (int run = 0; run < 12; ++run) {
    const LawPair pair = random_pair(random);
    CAPTURE(pair.text("analyse"));
    const StudyResults as_given = results_of_law(pair, "analyse");
    check_same_load(as_given, results_of_law(swapped(pair), "analyse"));
    check_same_load(as_given, results_of_law(mirrored(pair), "analyse"));
    // And only the true image is the same: the test can fail.
    LawPair other = mirrored(pair);
    other.mesh_misalignment = pair.mesh_misalignment;
    const StudyResults not_mirrored = results_of_law(other, "analyse");
    CHECK(std::abs(not_mirrored.loaded[0].summary.peak_contact_stress / as_given.loaded[0].summary.peak_contact_stress - 1.0) > 1e-5);
  }
}

TEST_CASE("Without load too either gear may be called the pinion", "[studies][laws]") {
  Random random(5);
  for (int run = 0; run < 6; ++run) {
    LawPair pair = random_pair(random);
    pair.torque = 0.0;
    pair.phases.clear();
    CAPTURE(pair.text("analyse"));
    // The swing of the base tangent: extremes are sought between the positions. With sharp edges: a rounded one touches at its start alone.
    const auto swing = [](const StudyResults& r) { return r.unloaded.at(0).mesh.peak_to_peak * r.pair.wheel.base_radius; };
    const std::string sharp = "[pinion.edges]\ntip_rounding = 0\nend_rounding = 0\n[wheel.edges]\ntip_rounding = 0\nend_rounding = 0\n";
    const double as_given = swing(results_of_law(pair, "analyse", sharp));
    constexpr double discretisation = 1e-2;  // between transfer points extremes are those of positions, which lie elsewhere for the swapped pair
    constexpr double round_off = 1e-10;      // 1e-12 rad at a base radius of 100 mm [mm]
    CHECK(std::abs(swing(results_of_law(mirrored(pair), "analyse", sharp)) - as_given) < round_off);
    // The error of the pitch counts once in a pitch, at the same transfer points. Angles of the swapped pair are those of the other gear.
    CHECK(std::abs(swing(results_of_law(swapped(pair), "analyse", sharp)) - as_given) < discretisation * as_given + round_off);
  }
}

TEST_CASE("The sizes of a mesh are those of the swapped one", "[studies][laws]") {
  Random random(7);
  for (int run = 0; run < 6; ++run) {
    const LawPair pair = random_pair(random);
    const StudyResults a = results_of_law(pair, "geometry"), b = results_of_law(swapped(pair), "geometry");
    constexpr double round_off = 1e-12;
    CHECK(a.pair.centre_distance == Approx(b.pair.centre_distance).epsilon(round_off));
    CHECK(a.pair.transverse_contact_ratio == Approx(b.pair.transverse_contact_ratio).epsilon(round_off));
    CHECK(a.pair.overlap_ratio == Approx(b.pair.overlap_ratio).epsilon(round_off));
    CHECK(a.pair.pinion.tip_radius == Approx(b.pair.wheel.tip_radius).epsilon(round_off));
    CHECK(a.pair.wheel.active_root_radius == Approx(b.pair.pinion.active_root_radius).epsilon(round_off));
  }
}

TEST_CASE("A sweep of a pair gives each sample's results whichever gear is called the pinion", "[studies][laws]") {
  Random random(9);
  const LawPair pair = random_pair(random);
  const auto samples = [](const LawPair& p, double sign) {
    const Study study = parse_study(
        p.text("sweep", fmt::format("[sweep]\nsampler = \"grid\"\n[sweep.parameters]\n\"misalignment.mesh_misalignment\" = {{ values = [{}, {}] }}\n",
                                    sign * -10, sign * 6)),
        "law.toml");
    const StudyResults nominal = run_study(study);
    const SampleAnalysis analysis(nominal);
    std::vector<std::vector<double>> outputs;
    for (const double value : {sign * -10.0, sign * 6.0}) outputs.push_back(analysis.analyse({value}).outputs);
    return outputs;
  };
  const auto as_given = samples(pair, 1.0), other = samples(swapped(pair), 1.0), mirror = samples(mirrored(pair), -1.0);
  for (std::size_t i = 0; i < as_given.size(); ++i) {
    REQUIRE_FALSE(as_given[i].empty());
    for (std::size_t k = 0; k < as_given[i].size(); ++k) {
      CHECK(other[i][k] == Approx(as_given[i][k]).epsilon(1e-6).margin(1e-9));  // residuals of the solver are outputs too
      CHECK(mirror[i][k] == Approx(as_given[i][k]).epsilon(1e-6).margin(1e-9));
    }
  }
}

TEST_CASE("An optimum is the same whichever gear is called the pinion", "[studies][laws]") {
  Random random(11);
  const LawPair pair = random_pair(random);
  const auto optimum_of = [](const LawPair& p, const char* gear, double sign) {
    return results_of_law(
        p, "optimise",
        fmt::format("[optimise]\nobjective = \"peak_contact_stress\"\n[optimise.comparison]\nrules = \"off\"\n[optimise.variables]\n"
                    "\"{0}.modification.lead_crowning\" = [0, 40]\n\"{0}.modification.lead_slope\" = [{1}, {2}]\n",
                    gear, sign > 0 ? -30 : -20, sign > 0 ? 20 : 30));
  };
  const StudyResults as_given = optimum_of(pair, "pinion", 1.0), other = optimum_of(swapped(pair), "wheel", 1.0),
                     mirror = optimum_of(mirrored(pair), "pinion", -1.0);
  for (const StudyResults* same : {&other, &mirror}) {
    CHECK(optimised(*same).design.before.objective == Approx(optimised(as_given).design.before.objective).epsilon(solver_tolerance));
    CHECK(optimised(*same).design.after.objective ==
          Approx(optimised(as_given).design.after.objective).epsilon(1e-4));  // of a search that ends on a kink
  }
}

}  // namespace
}  // namespace flankwright::studies
