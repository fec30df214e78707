#include <catch2/catch.hpp>

#include "core/fidelity/resolution_level.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

std::string key(const std::string& name, double value) { return name + " = " + std::to_string(value) + "\n"; }

/// The case of which an accuracy of 1 % stated 0.018 % and left 1.15 % in the second harmonic: teeth that touch before and after the theoretical path
/// were left out.
const std::string relieved_pinion = R"([pair]
normal_module = 3.649
helix_angle = 10.97
[pinion]
teeth = 28
face_width = 21.56
profile_shift = 0.211
modification.tip_relief = { amount = 4.32, height = 1.306, shape = "linear" }
[wheel]
teeth = 71
face_width = 21.56
profile_shift = -0.019
modification.lead_crowning = 6.94
modification.profile_crowning = 9.58
[load]
torque = 126.45
)";

/// Pairs, flanks, misalignments and torques of all sorts; a quarter of the pairs are spur gears.
std::string random_scene(unsigned seed) {
  tests::Random32 random(seed);
  const double module = random(1.0, 6.0), helix = random.chance(0.25) ? 0.0 : random(5.0, 30.0), face = module * random(4.0, 10.0);
  const int pinion = static_cast<int>(random(17.0, 45.0)), wheel = static_cast<int>(pinion * random(1.0, 3.0));
  const double shift = random(-0.2, 0.3), height = module * random(0.25, 0.5), load = random(5.0, 25.0);  // load: N/mm^2, force over face and module
  const double lead = random(0.0, 12.0), relief = random(0.0, 25.0), profile = random(0.0, 10.0), tilt = random(-20.0, 20.0);
  std::string text = "[pair]\n" + key("normal_module", module) + key("helix_angle", helix);
  text += "[pinion]\nteeth = " + std::to_string(pinion) + "\n" + key("face_width", face) + key("profile_shift", shift);
  text += key("modification.lead_crowning", lead);
  text += "modification.tip_relief = { amount = " + std::to_string(relief) + ", height = " + std::to_string(height) + " }\n";
  text += "[wheel]\nteeth = " + std::to_string(wheel) + "\n" + key("face_width", face) + key("profile_shift", -shift);
  text += key("modification.profile_crowning", profile) + "[misalignment]\n" + key("mesh_misalignment", tilt);
  return text + "[load]\n" + key("torque", load * module * face * 0.5 * module * pinion / 1000.0);
}

CycleFigures shown(const StudyResults& results) {
  const LoadedResult& loaded = results.loaded.front();
  return figures_of(loaded.cycle, loaded.summary);
}

struct Honesty {
  PerFigure stated, found;
  bool kept;
};

/// A run with an accuracy of 1 % beside one with everything on, resolved as finely as one could wish.
Honesty honesty(const std::string& scene, const std::string& compliance, const std::string& finest) {
  const std::string sizes = "[fidelity]\neffect_sizes = \"off\"\n";
  const StudyResults chosen = run_study(parse_study(scene + sizes + "accuracy = \"1 %\"\n" + compliance, "chosen.toml"));
  const StudyResults fine = run_study(parse_study(
      scene + sizes + finest + "gap = \"whole_surface\"\nquadrature = { rule = \"graded\", intervals = 48 }\n" + "[cycle]\npositions = 128\n",
      "fine.toml"));
  REQUIRE(chosen.fidelity_choice);
  const Honesty found{chosen.fidelity_choice->error(), figure_differences(shown(chosen), shown(fine)), chosen.fidelity_choice->kept};
  const FidelityChoice& choice = *chosen.fidelity_choice;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Figure::PeakContactStress); ++i) {
    UNSCOPED_INFO(name_of(static_cast<Figure>(i)) << ": stated " << 100 * found.stated[i] << " %, found " << 100 * found.found[i] << " %");
  }
  UNSCOPED_INFO(to_string(choice.fidelity.compliance)
                << ", " << to_string(choice.fidelity.gap) << ", " << choice.fidelity.quadrature.intervals << " x " << choice.positions << ", "
                << choice.left_out.names.size() << " effects left out, " << (choice.kept ? "kept" : "not kept"));
  return found;
}

constexpr int judged = static_cast<int>(Figure::PeakContactStress) + 1;

/// How many of the figures by which a mesh is judged are within what was stated of each.
int within(const Honesty& of) {
  int count = 0;
  for (std::size_t i = 0; i < judged; ++i) count += of.found[i] <= of.stated[i] ? 1 : 0;
  return count;
}

const std::string slices = "compliance = \"thin_slice\"\n";

}  // namespace

TEST_CASE("The error of harmonics is within the stated one where an effect acts at few positions", "[studies][accuracy][fidelity-choice]") {
  const Honesty of = honesty(relieved_pinion, slices, slices);
  CHECK(of.kept);
  CHECK(headline(of.stated) <= 0.01);
  CHECK(headline(of.found) <= 0.01);
  CHECK(within(of) == judged);
}

namespace {

/// Each figure holds in 95 %, as estimates that may cancel by chance do; the worst of a scene never exceeds what was asked where that was kept.
void check_random_scenes(unsigned first, unsigned drawn, const std::string& compliance, const std::string& finest) {
  int figures = 0, worst_holds = 0;
  for (unsigned seed = first; seed < first + drawn; ++seed) {
    UNSCOPED_INFO("seed " << seed);
    const Honesty of = honesty(random_scene(seed), compliance, finest);
    figures += within(of);
    worst_holds += headline(of.found) <= headline(of.stated) ? 1 : 0;
    if (of.kept) CHECK(headline(of.found) <= 0.01);
  }
  INFO("each figure within what was stated of it: " << figures << " of " << judged * drawn << ", the worst of a scene: " << worst_holds << " of "
                                                    << drawn);
  CHECK(figures >= 0.95 * judged * drawn);
  CHECK(worst_holds >= 0.95 * drawn);
}

}  // namespace

TEST_CASE("Stated accuracies hold on random scenes by slices", "[studies][accuracy][.soak]") { check_random_scenes(0, 10, slices, slices); }

TEST_CASE("Stated accuracies hold on random scenes beside finite elements", "[studies][accuracy][fe][.soak]") {
  check_random_scenes(50, 3, "", "compliance = \"fe\"\n");
}
