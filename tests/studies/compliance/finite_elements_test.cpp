#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/compliance/fitted/correction_library.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/reference/eigenvalues.hpp"
#include "tests/reference/iso_6336_root_stress.hpp"
#include "tests/studies/command_line.hpp"

namespace flankwright::studies {
namespace {

using json = Json;

/// Keeps runs in a folder of its own while it lives, never in the user's.
class ScratchCache {
 public:
  ScratchCache() { ::setenv("FLANKWRIGHT_CACHE", folder_.path().c_str(), 1); }
  ~ScratchCache() { ::unsetenv("FLANKWRIGHT_CACHE"); }
  ScratchCache(const ScratchCache&) = delete;
  ScratchCache& operator=(const ScratchCache&) = delete;
  std::vector<std::string> files() const { return folder_.names(); }

 private:
  command_line::ScratchFolder folder_;
};

/// Two equal narrow spur gears with sharp edges: one small finite-element run.
const std::string twins = R"(
[pair]
normal_module = 4
[pinion]
teeth = 12
profile_shift = 0.3
face_width = 4
edges = { tip_rounding = 0, end_rounding = 0 }
[wheel]
teeth = 12
profile_shift = 0.3
face_width = 4
edges = { tip_rounding = 0, end_rounding = 0 }
[load]
torque = 20
[cycle]
positions = 8
[fidelity]
compliance = "fe"
effect_sizes = "off"
)";

StudyResults run_twins(const std::string& text, const std::vector<Override>& overrides = {}) {
  return run_study(parse_study(text, "twins.toml", overrides));
}

std::string twins_refusal(const std::vector<Override>& overrides) {
  try {
    parse_study(twins, "twins.toml", overrides);
  } catch (const InvalidInput& problem) {
    return problem.what();
  }
  return "";
}

}  // namespace

namespace {

/// The least eigenvalue of what structure and contact yield together under a position's loads [mm/N].
double least_compliance(const MeshPosition& at, const LoadDistribution& load) {
  constexpr double least_load = 1.0;  // N/mm: without load contact yields without bound
  Eigen::MatrixXd compliance = at.influence;
  for (Eigen::Index i = 0; i < at.weight.size(); ++i) {
    compliance(i, i) += at.laws[static_cast<std::size_t>(i)].slope(std::max(least_load, load.line_load[i])) / at.weight[i];
  }
  return symmetric_eigenvalues(compliance)[0];
}

}  // namespace

TEST_CASE("A study by finite elements: equal gears are solved once, kept, and balance the load", "[studies][fe]") {
  const ScratchCache cache;
  const StudyResults solved = run_twins(twins);
  const json results = json::parse(results_json(solved));
  const json& compliance = results["compliance"];
  CHECK(compliance["pinion"]["source"] == "solved");
  CHECK(compliance["pinion"]["file"] == compliance["wheel"]["file"]);
  CHECK(cache.files().size() == 1);
  CHECK(compliance["pinion"]["unknowns"] > 1000);
  CHECK(compliance["pinion"]["projection"] < 1e-12);  // round-off
  CHECK(results["used"]["pair"]["wheel"]["body"]["shaft_diameter_mm"] > 0);
  CHECK(results["notes"].empty());
  bool told = false;
  for (const json& effect : results["steps"]) told = told || (effect["name"] == "finite_elements" && effect["seconds"] > 0);
  CHECK(told);

  // What acts is what is passed on, at every position; and no load does negative work.
  for (std::size_t i = 0; i < solved.models[0].positions.size(); ++i) {
    const MeshPosition& at = solved.models[0].positions[i];
    const LoadDistribution& load = solved.loaded[0].cycle.positions[i].load;
    CHECK(at.weight.dot(load.line_load) == Approx(solved.loaded[0].cycle.force).epsilon(1e-10));  // round-off
    CHECK(at.influence == at.influence.transpose());
    CHECK(least_compliance(at, load) > 0.0);
  }

  // The next study finds the run; gears of another size and modulus are the same in modules.
  const StudyResults kept = run_twins(twins);
  const json kept_results = json::parse(results_json(kept));
  CHECK(kept_results["compliance"]["wheel"]["source"] == "cache");
  CHECK(kept_results["loaded"] == results["loaded"]);
  const StudyResults doubled = run_twins(twins, {{"pair.normal_module", "8"},
                                                 {"pinion.face_width", "8"},
                                                 {"wheel.face_width", "8"},
                                                 {"load.torque", "160"},
                                                 {"material.youngs_modulus", "206000"}});
  CHECK(doubled.structures.finite_elements->gears.pinion.from_cache);
  CHECK(doubled.loaded[0].summary.te_mean == Approx(2 * kept.loaded[0].summary.te_mean).epsilon(1e-9));  // same stress

  // Teeth that do not know of each other yield less: their loads push on their neighbours' flanks.
  const StudyResults alone =
      run_twins(twins, {{"fidelity.effects", R"(["bending", "gear_body_compliance", "hertzian_contact", "tip_corner", "extended_contact_region"])"}});
  CHECK(alone.loaded[0].summary.te_mean < kept.loaded[0].summary.te_mean);
  CHECK(alone.structures.finite_elements->gears.pinion.from_cache);  // a run that tells more will do
  CHECK(std::isnan(alone.loaded[0].summary.peak_root_stress));
}

TEST_CASE("The estimate of a size takes no run with rigid bodies, and reports it", "[studies][fe][slow]") {
  const ScratchCache cache;
  const StudyResults elastic = run_twins(twins, {{"fidelity.effect_sizes", "estimated"}});
  CHECK(cache.files().size() == 1);
  CHECK(!elastic.structures.pair->knows_rigid_bodies());
  const json results = json::parse(results_json(elastic));
  int told = 0;
  for (const json& effect : results["effects"]) {
    const bool of_body = effect["name"] == "gear_body_compliance";
    if (of_body) CHECK_THAT(effect["estimate"]["why_no_size"].get<std::string>(), Catch::Contains("exact"));
    if (effect["name"] == "hertzian_contact") CHECK(effect["estimate"]["share_percent"].is_number());
    told += of_body;
  }
  CHECK(told == 1);
}

TEST_CASE("A study on rigid gear bodies: stiffer, by a run of its own, and sized beside the elastic ones", "[studies][fe][slow]") {
  const ScratchCache cache;
  const StudyResults elastic = run_twins(twins, {{"fidelity.effect_sizes", "exact"}});
  CHECK(cache.files().size() == 2);
  const json results = json::parse(results_json(elastic));
  const json& compliance = results["compliance"]["pinion"];
  CHECK(compliance["rigid_body"]["unknowns"] < compliance["unknowns"]);
  CHECK(compliance["rigid_body"]["projection"] < 1e-12);  // round-off

  const StudyResults rigid = run_twins(
      twins, {{"fidelity.effects",
               R"(["bending", "adjacent_teeth", "free_ends", "hertzian_contact", "contact_coupling", "tip_corner", "extended_contact_region"])"}});
  CHECK(rigid.structures.finite_elements->rigid_body.wheel->from_cache);
  const double less = elastic.loaded[0].summary.te_mean - rigid.loaded[0].summary.te_mean;
  CHECK(less > 0.02 * elastic.loaded[0].summary.te_mean);
  const SizeInStudy* size = size_of(elastic.effect_sizes.exact, "gear_body_compliance");
  REQUIRE(size != nullptr);
  CHECK(size->size.influence.te_mean == Approx(less).epsilon(1e-9));  // the same two analyses
  for (std::size_t i = 0; i < rigid.models[0].positions.size(); ++i) {
    CHECK(least_compliance(rigid.models[0].positions[i], rigid.loaded[0].cycle.positions[i].load) > 0.0);
  }

  // The kernels that complete a coarse mesh are the tooth's: fitted teeth lose as much by a rigid body.
  const StudyResults fitted = run_twins(twins, {{"fidelity.compliance", "fitted"}, {"fidelity.effect_sizes", "exact"}});
  const SizeInStudy* of_fitted = size_of(fitted.effect_sizes.exact, "gear_body_compliance");
  REQUIRE(of_fitted != nullptr);
  CHECK(of_fitted->size.influence.te_mean == Approx(less).epsilon(0.1));  // discretisation of the body
}

TEST_CASE("A study's root stress: by finite elements, whatever the compliance", "[studies][fe][root-stress][slow]") {
  const ScratchCache cache;
  const StudyResults solved = run_twins(twins);
  const CycleSummary& summary = solved.loaded[0].summary;
  const json results = json::parse(results_json(solved));
  CHECK(results["loaded"][0]["summary"]["peak_root_stress_MPa"] == summary.peak_root_stress);
  CHECK(results["loaded"][0]["summary"]["wheel_root_stress"]["z_mm"].is_number());
  CHECK(results["loaded"][0]["cycle"][3]["teeth"][0]["pinion_root_stress_MPa"].is_number());
  CHECK(summary.peak_root_stress == std::max(summary.pinion_root_stress.stress, summary.wheel_root_stress.stress));
  // Equal gears, whose loads run towards each other's tips: alike to the mesh positions' distance (discretisation).
  CHECK(summary.pinion_root_stress.stress == Approx(summary.wheel_root_stress.stress).epsilon(0.05));
  // The whole force at the tip would be ISO's worst; it acts lower down, or shared (model).
  const GearPair& pair = solved.pair;
  const double at_tip = test::iso_6336_root(pair.pinion.data, pair.data.pressure_angle).stress * solved.loaded[0].cycle.force /
                        (pair.face_width * pair.data.normal_module);
  CHECK(summary.peak_root_stress < at_tip);
  CHECK(summary.peak_root_stress > 0.5 * at_tip);

  const StudyResults doubled =
      run_twins(twins, {{"pair.normal_module", "8"}, {"pinion.face_width", "8"}, {"wheel.face_width", "8"}, {"load.torque", "160"}});
  CHECK(doubled.loaded[0].summary.peak_root_stress == Approx(summary.peak_root_stress).epsilon(1e-9));  // same stress

  // Asked for by an expectation, with slices for the loads.
  const StudyResults slices =
      run_twins(twins + "[expect]\n\"loaded.summary.peak_root_stress_MPa\" = { max = 1000 }\n", {{"fidelity.compliance", "\"thin_slice\""}});
  CHECK(slices.structures.finite_elements->gears.pinion.from_cache);
  CHECK(!slices.structures.pair);
  CHECK(slices.loaded[0].summary.peak_root_stress == Approx(summary.peak_root_stress).epsilon(0.25));  // model: the loads
  const StudyResults without = run_twins(twins, {{"fidelity.compliance", "\"thin_slice\""}});
  CHECK(!without.structures.finite_elements);
  CHECK(json::parse(results_json(without))["loaded"][0]["summary"]["peak_root_stress_MPa"].is_null());

  // Minimised: a slope takes load off the face end that a misalignment stresses.
  const StudyResults designed = run_twins("task = \"optimise\"\n" + twins + R"(
[misalignment]
mesh_misalignment = 15
[optimise]
objective = "peak_root_stress"
variables = { "pinion.modification.lead_slope" = [-30, 30] }
constraints = { "peak_contact_stress" = { max = 5000 } }
)",
                                          {{"fidelity.compliance", "\"thin_slice\""}});
  REQUIRE(designed.found<OptimiseResults>() != nullptr);
  CHECK(designed.structures.finite_elements->gears.wheel.from_cache);
  CHECK(optimised(designed).design.after.objective < optimised(designed).design.before.objective);
}

TEST_CASE("Root stress cannot be minimised where it is switched off", "[studies][root-stress]") {
  const std::string text = "task = \"optimise\"\n" + twins + R"(
[optimise]
objective = "peak_root_stress"
variables = { "pinion.modification.lead_slope" = [-30, 30] }
)";
  CHECK_NOTHROW(parse_study(text, "twins.toml", {}));
  CHECK_THROWS_WITH(parse_study(text, "twins.toml", {{"fidelity.effects", R"(["bending"])"}}), Catch::Contains("root_stress"));
}

TEST_CASE("A gear that finite elements refuse is refused when the study is read, under its key", "[studies][fe]") {
  CHECK(twins_refusal({}).empty());
  CHECK(twins_refusal({{"pinion.body.shaft_diameter", "30"}, {"wheel.body.bore_diameter", "5"}}).empty());
  CHECK_THAT(twins_refusal({{"pinion.body.shaft_diameter", "40"}}), Catch::Contains("pinion.body.shaft_diameter"));
  CHECK_THAT(twins_refusal({{"wheel.body.shaft_diameter", "20"}, {"wheel.body.bore_diameter", "19"}}), Catch::Contains("wheel.body.bore_diameter"));
  CHECK_THAT(twins_refusal({{"wheel.body.shaft_overhang", "-1"}}), Catch::Contains("wheel.body.shaft_overhang"));
  CHECK_THAT(twins_refusal({{"pair.helix_angle", "40"}, {"pinion.face_width", "120"}, {"wheel.face_width", "120"}}),
             Catch::Contains("pitches apart touch at once"));
}

TEST_CASE("A gear body that the compliance does not model is reported as left out", "[studies][fe]") {
  const StudyResults results = run_twins(twins, {{"fidelity.compliance", "thin_slice"}, {"pinion.body.shaft_diameter", "20"}});
  REQUIRE(results.notes.size() == 1);
  CHECK_THAT(results.notes[0], Catch::Contains("does not know of it"));
  CHECK(!results.structures.finite_elements);
}

TEST_CASE("A study by fitted compliance: a coarse mesh of its gears and the library of fits come close to fe", "[studies][fitted][slow]") {
  const ScratchCache cache;
  const std::vector<Override> wider{{"pinion.face_width", "8"}, {"wheel.face_width", "8"}, {"pair.helix_angle", "15"}};
  auto fitted = wider;
  fitted.push_back({"fidelity.compliance", "fitted"});
  const StudyResults ours = run_twins(twins, fitted);
  const json results = json::parse(results_json(ours));
  const json& compliance = results["compliance"];
  CHECK(compliance["model"] == "fitted");
  CHECK(compliance["fits"]["gears"] == CorrectionLibrary::shipped().entries().size());
  CHECK(compliance["fits"]["largest_residual_percent"]["median"] < 0.5);
  CHECK(compliance["pinion"]["source"] == "solved");
  CHECK(compliance["pinion"]["file"] == compliance["wheel"]["file"]);

  for (std::size_t i = 0; i < ours.models[0].positions.size(); ++i) {
    const MeshPosition& at = ours.models[0].positions[i];
    CHECK(at.influence == at.influence.transpose());
    CHECK(least_compliance(at, ours.loaded[0].cycle.positions[i].load) > 0.0);
  }

  const StudyResults fe = run_twins(twins, wider);
  CHECK(json::parse(results_json(fe))["compliance"]["pinion"]["unknowns"] > 1.5 * compliance["pinion"]["unknowns"].get<double>());
  CHECK(cache.files().size() == 2);                                                              // coarse and fine runs are not taken for each other
  CHECK(ours.loaded[0].summary.te_mean == Approx(fe.loaded[0].summary.te_mean).epsilon(0.005));  // model, as asked of the fits
  // Discretisation: fewer elements across the tooth and along the face.
  CHECK(ours.loaded[0].summary.peak_root_stress == Approx(fe.loaded[0].summary.peak_root_stress).epsilon(0.06));
}

TEST_CASE("A gear outside the library of fits has its own fit, to the run that fe takes", "[studies][fitted]") {
  const ScratchCache cache;
  const std::vector<Override> by_fit{{"fidelity.compliance", "fitted"}, {"pair.pressure_angle", "17"}};
  const StudyResults ours = run_twins(twins, by_fit);
  const json results = json::parse(results_json(ours));
  CHECK(results["compliance"].count("fits") == 1);
  CHECK(results["used"]["fidelity"]["fits"]["wheel"] == "own fit");
  const json& fit = results["compliance"]["pinion"]["fit"];
  CHECK(fit["source"] == "own fit");
  CHECK(fit["why"] == "pressure angle 17 deg, in the library 17.5 .. 22.5 deg");
  CHECK(fit["status"] == "converged");
  CHECK_THAT(results["notes"].dump(),
             Catch::Contains("the pinion is outside the library of fits (pressure angle 17 deg") && Catch::Contains("two finite-element models"));
  bool told = false;
  for (const json& effect : results["steps"])
    told = told || (effect["name"] == "fit_of_pinion" && effect["why"] == "own fit: pressure angle 17 deg, in the library 17.5 .. 22.5 deg");
  CHECK(told);
  // Model, as asked of a gear's own fit; own tooth first, then its neighbours by the coarse mesh.
  const json& unseen = fit["residual_percent"]["unseen"];
  REQUIRE(unseen.size() == 3);
  CHECK(unseen[0]["median"] < 0.5);
  CHECK(unseen[0]["share_95"] < 2.5);
  CHECK(unseen[0]["worst"] < 8);
  for (const std::size_t apart : {1, 2}) {
    CHECK(unseen[apart]["teeth_apart"] == apart);
    // One module of face: little is in common between teeth. Asked of wider gears: 1.5.
    CHECK(unseen[apart]["median"] < 4);
    CHECK(unseen[apart]["share_95"] < 7);
  }
  CHECK(cache.files().size() == 3);  // coarse, fine, fit; the gears are equal

  const json again = json::parse(results_json(run_twins(twins, by_fit)));
  CHECK(again["compliance"]["wheel"]["fit"]["from_cache"] == true);
  CHECK(again["compliance"]["wheel"]["fine_mesh"]["source"] == "cache");
  CHECK(again["loaded"] == results["loaded"]);
  CHECK(cache.files().size() == 3);

  const StudyResults fe = run_twins(twins, {{"pair.pressure_angle", "17"}});
  CHECK(fe.structures.finite_elements->gears.pinion.from_cache);
  CHECK(ours.loaded[0].summary.te_mean == Approx(fe.loaded[0].summary.te_mean).epsilon(0.005));                    // model
  CHECK(ours.loaded[0].summary.peak_root_stress == Approx(fe.loaded[0].summary.peak_root_stress).epsilon(0.005));  // by its loads
}

TEST_CASE("A damaged fit is made anew from the runs that are kept", "[studies][fitted][slow]") {
  const ScratchCache cache;
  const std::vector<Override> by_fit{{"fidelity.compliance", "fitted"}, {"pair.pressure_angle", "17"}};
  const StudyResults first = run_twins(twins, by_fit);
  const std::string file = first.structures.corrections[Member::Pinion]->file;
  std::ofstream(file, std::ios::app) << "more";
  const StudyResults second = run_twins(twins, by_fit);
  CHECK(!second.structures.corrections[Member::Pinion]->from_cache);
  CHECK(second.structures.finite_elements->gears.pinion.from_cache);
  CHECK(second.structures.corrections[Member::Pinion]->fit.coefficients == first.structures.corrections[Member::Pinion]->fit.coefficients);
  CHECK_THAT(second.structures.notes.back(), Catch::Contains("is not used"));
}

TEST_CASE("A gear that cannot be meshed is refused by fitted compliance under the study's key", "[studies][fitted]") {
  const auto refused = [](const std::string& key, const std::string& value) {
    return twins_refusal({{"fidelity.compliance", "fitted"}, {key, value}});
  };
  CHECK(refused("pair.pressure_angle", "17").empty());
  CHECK_THAT(refused("pinion.body.shaft_diameter", "50"), Catch::Contains("pinion.body.shaft_diameter"));
  CHECK_THAT(refused("pinion.profile_shift", "1.2"), Catch::Contains("pinion"));
}

}  // namespace flankwright::studies
