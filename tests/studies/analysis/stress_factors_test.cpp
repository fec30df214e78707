#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "studies/analysis/run_study.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// A helical pair by thin slices whose reliefs raise the stress more than its crowning lowers it at the ends of the face.
const std::string relieved_pair = R"([pair]
normal_module = 3
helix_angle = 18
[pinion]
teeth = 18
face_width = 30
modification = { lead_crowning = 8, tip_relief = { amount = 15, height = 1.2 } }
[wheel]
teeth = 45
face_width = 26
modification.tip_relief = { amount = 15, height = 1.2 }
[misalignment]
mesh_misalignment = 10
[material]
strength = { kind = "case_hardened", quality = "MQ", hardness = 700 }
[fidelity]
compliance = "thin_slice"
)";

StudyResults rated(const std::string& load) { return run_study(parse_study(relieved_pair + load, "rated.toml")); }

bool says(const StudyResults& results, const std::string& words) {
  return std::ranges::any_of(results.notes, [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("Neither load factor of a rating is below 1, nor makes up for the other", "[studies][life]") {
  const Json document = results_document(rated("[load]\ntorque = [60, 300]\nspeed = 1000\n"));
  for (std::size_t k = 0; k < 2; ++k) {
    const Json &factors = document.at("loaded")[k].at("summary").at("load_factors"), &rating = document.at("life").at("cases")[k].at("iso6336");
    const double K_H = rating.at("K_H"), K_F = rating.at("K_F");
    const auto of = [&](const char* by, const char* factor) { return factors.at(by).at(factor).get<double>(); };
    CAPTURE(k, K_H, K_F, of("without_spikes", "K_Hbeta"), of("without_spikes", "K_Halpha"), of("line_load", "K_Halpha"));
    CHECK(K_H >= 1.0);
    CHECK(K_H >= of("without_spikes", "K_H") * (1.0 - 1e-12));  // round-off
    const double lead = of("without_spikes", "K_Hbeta");
    if (lead < 1.0) CHECK(K_H >= of("without_spikes", "K_Halpha"));
    // Of roots by line loads: K_Fbeta is between 1 and K_Hbeta.
    const double by_load = std::max(1.0, of("line_load", "K_Hbeta"));
    CHECK(K_F >= std::max(1.0, of("line_load", "K_H") / by_load) * (1.0 - 1e-12));
    CHECK(K_F <= by_load * std::max({1.0, of("line_load", "K_H") / by_load, of("line_load", "K_Halpha")}) * (1.0 + 1e-12));
  }
}

TEST_CASE("A flank of a load spectrum that no scene rates has a note, and roots bent both ways another", "[studies][life]") {
  const std::string both = "[load]\nspeed = 1000\nspectrum = [{ torque = 300, hours = 30 }, { torque = -200, hours = 10 }]\n";
  const StudyResults own = rated(both), other = rated(both + "[[scenes]]\nname = \"back\"\nworking_flank = \"left\"\n");
  CHECK(says(own, "for 25 % of the revolutions the torque is below 0"));
  CHECK_FALSE(says(own, "is above 0 and loads"));
  CHECK(says(other, "for 75 % of the revolutions the torque is above 0"));
  const StudyResults all = rated(both + "[[scenes]]\nname = \"ahead\"\n[[scenes]]\nname = \"back\"\nworking_flank = \"left\"\n");
  CHECK_FALSE(says(all, "counts as time without load"));
  for (const StudyResults* results : {&own, &other, &all})
    CHECK(says(*results, "the wheel's teeth are loaded on both flanks over the load spectrum"));
  const StudyResults one_way = rated("[load]\nspeed = 1000\nspectrum = [{ torque = 300, hours = 30 }]\n");
  CHECK_FALSE(says(one_way, "on both flanks"));
}

TEST_CASE("A list of effects without shafts says that what is given of them counts nowhere", "[studies][effects]") {
  const std::string shaft = R"([load]
torque = 100
[pinion.shaft]
sections = [{ length = 150, outer_diameter = 45 }]
bearings = [{ position = 10 }, { position = 140 }]
gear_position = 60
torque_position = 0
)";
  const auto with = [&](const std::vector<Override>& overrides) { return run_study(parse_study(relieved_pair + shaft, "shaft.toml", overrides)); };
  const char* const words = "leaves \"shafts\" out";
  CHECK(says(with({{"fidelity.effects", R"(["bending", "hertzian_contact", "modifications", "misalignment"])"}}), words));
  CHECK_FALSE(says(with({}), words));
}
