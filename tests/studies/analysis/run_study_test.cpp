#include "studies/analysis/run_study.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::results_of;

/// Every path that leads to something, entries of lists as "[]": "loaded[].cycle[].phase".
void collect_paths(const json& node, const std::string& path, std::set<std::string>& paths, std::set<std::string>& nulls) {
  paths.insert(path);
  if (node.is_null()) nulls.insert(path);
  if (node.is_array()) {
    for (const json& entry : node) collect_paths(entry, path + "[]", paths, nulls);
  } else if (node.is_object()) {
    for (const auto& [key, value] : node.items()) {
      collect_paths(value, path.empty() ? key : path + "." + key, paths, nulls);
    }
  }
}

/// Checks that each of the words is there below the prefix.
void check_keys(const json& results, const std::string& prefix, const std::string& words) {
  std::set<std::string> paths, nulls;
  collect_paths(results, "", paths, nulls);
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    CAPTURE(prefix, word);
    CHECK(paths.count(prefix.empty() ? word : prefix + "." + word) == 1);
  }
}

/// Nulls that are meant: not computed in this version, not asked for, or not told apart.
void check_nulls(const json& results) {
  const std::set<std::string> meant{"loaded[].summary.peak_root_stress_MPa_error",
                                    "loaded[].summary.peak_root_stress_MPa",
                                    "loaded[].summary.edge_stress_MPa",
                                    "loaded[].summary.tip_edge_share",
                                    "loaded[].summary.edge_contact",
                                    "loaded[].summary.pinion_root_stress_MPa",
                                    "loaded[].summary.wheel_root_stress_MPa",
                                    "loaded[].summary.pinion_root_stress",
                                    "loaded[].summary.wheel_root_stress",
                                    "effects[].seconds",
                                    "effects[].estimate",
                                    "effects[].exact",
                                    "used.fidelity.accuracy",
                                    "optimise.finished_by",
                                    "optimise.starts[].finished_by"};
  const std::set<std::string> meant_sampled{"loaded[].summary.peaks", "loaded[].summary.load_factors"};
  // Edges have no ellipse, lines one without end; not every point of a flank meets the mate.
  const std::set<std::string> meant_unloaded{"pairs[].positions[].ellipse", "pairs[].positions[].ellipse.semi_major_mm",
                                             "bearing_pattern.pinion.separation_um[][]", "bearing_pattern.wheel.separation_um[][]"};
  std::set<std::string> paths, nulls;
  collect_paths(results, "", paths, nulls);
  for (const std::string& path : nulls) {
    CAPTURE(path);
    const std::size_t dot = path.find('.');
    const bool is_unloaded = path.starts_with("unloaded.") || path.starts_with("unloaded_scenes[].");
    const bool is_sampled = results["used"]["cycle"]["peaks"] == "sampled" && meant_sampled.contains(path);
    CHECK((is_unloaded ? meant_unloaded.count(path.substr(dot + 1)) : meant.count(path) + is_sampled) == 1);
  }
}

void remove_seconds(json& node) {
  if (node.is_object()) {
    for (const char* time : {"seconds", "proof_seconds", "milliseconds_per_cycle"}) node.erase(time);
    if (node.contains("message")) node.erase("message");  // may quote a time
  }
  if (node.is_structured()) {
    for (json& child : node) remove_seconds(child);
  }
}

}  // namespace

TEST_CASE("results.json of an analysis has every key that it promises", "[studies][results][slow]") {
  const json results = results_of(small::analysis());
  check_keys(results, "", "unloaded loaded effects given used version units title task file seconds");
  check_keys(results, "unloaded.pairs[]",
             "tooth positions[].phi1_deg positions[].phi2_deg positions[].te_arcsec positions[].contact "
             "positions[].pinion.radius_mm positions[].pinion.z_mm positions[].wheel.radius_mm positions[].wheel.z_mm "
             "sequence positions[].te_slope_arcsec_per_deg positions[].carries positions[].ellipse.semi_major_mm "
             "positions[].ellipse.semi_minor_mm positions[].ellipse.major.pinion.radius positions[].ellipse.major.pinion.z "
             "positions[].ellipse.minor.wheel.radius positions[].ellipse.minor.wheel.z");
  check_keys(results, "unloaded", "scene sequence carrying_sequence");
  check_keys(results, "unloaded.mesh", "phi1_deg te_arcsec te_um peak_to_peak_arcsec harmonics_arcsec");
  check_keys(results, "unloaded.mesh.transfers[]",
             "phi1_deg te_arcsec from_tooth to_tooth slope_before_arcsec_per_deg slope_after_arcsec_per_deg "
             "slope_jump_arcsec_per_deg");
  check_keys(results, "unloaded.bearing_pattern",
             "marking_thickness_um pinion.radius_mm pinion.z_mm pinion.separation_um[][] pinion.covered_percent "
             "wheel.radius_mm wheel.z_mm wheel.separation_um[][] wheel.covered_percent");
  check_keys(results, "used", "unloaded.marking_thickness_um pair.pinion.generation.kind pair.wheel.grid");
  check_keys(results, "loaded[].cycle[]",
             "phase te_um te_base_tangent_um stiffness_N_per_mm_um kkt_residual teeth[].tooth teeth[].points[].z_mm "
             "teeth[].points[].pinion_radius_mm teeth[].points[].load_N_per_mm teeth[].points[].contact_stress_MPa "
             "teeth[].points[].contact_deflection_um teeth[].points[].structural_deflection_um "
             "teeth[].points[].gap_um teeth[].points[].error_um teeth[].share teeth[].line_ends[].z_mm "
             "teeth[].line_ends[].load_N_per_mm teeth[].line_ends[].contact_stress_MPa");
  check_keys(results, "loaded[].summary",
             "te_peak_to_peak_um te_harmonics_um te_mean_um peak_load_N_per_mm peak_contact_stress_MPa "
             "peak_root_stress_MPa mean_stiffness_N_per_mm_um least_stiffness_N_per_mm_um largest_stiffness_N_per_mm_um "
             "stiffness_variation load_factor iso6336.c_prime iso6336.c_gamma iso6336.K_Hbeta iso6336.K_Halpha iso6336.K_H "
             "iso6336.F_beta_y_um iso6336.f_pe_um te_convergence.harmonic_change_um "
             "peaks.without_spikes.contact_stress_MPa peaks.with_spikes.contact_stress_at.phase peaks.spike_rule.end_distance_mm "
             "load_factors.without_spikes.K_Hbeta load_factors.with_spikes.K_H "
             "load_factors.without_spikes.K_Hbeta_times_K_Halpha");
  check_keys(results, "effects[]", "name on why seconds estimate exact");
  check_keys(results, "steps[]", "name why seconds");
  check_nulls(results);
  CHECK(results["loaded"].size() == 2);
  CHECK(results["unloaded_scenes"].size() == 2);
  const std::set<std::string> kinds{"line", "surface", "pinion_tip", "wheel_tip", "pinion_root", "wheel_root", "face_end", "corner"};
  for (const json& pair : results["unloaded"]["pairs"]) {
    for (const json& position : pair["positions"]) CHECK(kinds.count(position["contact"]) == 1);
  }
}

TEST_CASE("Positions chosen automatically, and peaks sampled, are said in the results", "[studies][results][slow]") {
  const json chosen = results_of(small::analysis(), {{"cycle.positions", "auto"}, {"cycle.peaks", "sampled"}});
  const json& cycle = chosen["used"]["cycle"];
  CHECK(cycle["peaks"] == "sampled");
  CHECK(cycle["positions"] >= 32);
  CHECK(cycle["automatic"] == true);
  CHECK(chosen["loaded"][0]["cycle"].size() == cycle["positions"]);
  CHECK(chosen["loaded"][0]["summary"]["peaks"].is_null());
  CHECK(chosen["loaded"][0]["summary"]["load_factors"].is_null());
  CHECK(chosen["loaded"][0]["summary"]["iso6336"]["K_Hbeta"] == 1.0);
  CHECK(chosen["loaded"][1]["summary"]["iso6336"]["F_beta_y_um"] == Approx(12).epsilon(1e-10));  // round-off of the gap at both ends
}

TEST_CASE("results.json of an optimisation has every key that it promises", "[studies][results]") {
  const json results = results_of(small::optimisation());
  check_keys(results, "optimise",
             "solver finisher finished_by status evaluations gradient_evaluations seconds before.variables before.objective "
             "before.constraints after.variables after.objective after.constraints scenes[].name scenes[].before "
             "scenes[].after history[].evaluation history[].objective history[].constraint_violation");
  check_nulls(results);
  const json& optimise = results["optimise"];
  CHECK(optimise["status"] == "converged");
  CHECK(optimise["scenes"].size() == 3);
  CHECK(results["loaded"].size() == 6);  // before and after
  CHECK(optimise["after"]["objective"] < optimise["before"]["objective"]);
  CHECK(optimise["after"]["variable_units"]["pinion.modification.lead_crowning"] == "um");
  CHECK(optimise["after"]["variable_units"]["pinion.modification.end_relief.length"] == "mm");
  CHECK(optimise["after"]["constraints"]["te_peak_to_peak"]["max"] == 5.0);
  // What is said of the optimum and the loaded contact shown with it are one analysis.
  double worst = 0.0;
  for (const json& loaded : results["loaded"]) {
    if (loaded["design"] == "after") worst = std::max(worst, loaded["summary"]["peak_contact_stress_MPa"].get<double>());
  }
  CHECK(worst == optimise["after"]["objective"].get<double>());
}

TEST_CASE("Loaded results keep the identities of equilibrium, compatibility and units", "[studies][results][physics][slow]") {
  const json results = results_of(small::analysis());
  const double base_helix = results["geometry"]["base_helix_angle_deg"].get<double>() * units::deg;
  const double base_radius = 0.5 * results["geometry"]["pinion"]["base_diameter_mm"].get<double>();
  constexpr double round_off = 1e-10,
                   solver = 1e-9;  // solver: the load distribution's own residual, 1e-12, conditioned
  for (const json& loaded : results["loaded"]) {
    const double force = loaded["normal_force_N"];
    CHECK(force * base_radius * std::cos(base_helix) == Approx(1e3 * loaded["torque_Nm"].get<double>()).epsilon(round_off));
    double least_te = INFINITY, most_te = -INFINITY, peak_load = 0.0, peak_stress = 0.0, mean_te = 0.0;
    for (const json& position : loaded["cycle"]) {
      const double te = position["te_um"];
      least_te = std::min(least_te, te);
      most_te = std::max(most_te, te);
      mean_te += te / static_cast<double>(loaded["cycle"].size());
      CHECK(position["te_base_tangent_um"].get<double>() == Approx(te / std::cos(base_helix)).epsilon(round_off));
      double total = 0.0;
      for (const json& tooth : position["teeth"]) {
        for (const json& point : tooth["points"]) {
          const double load = point["load_N_per_mm"];
          total += load * point["length_mm"].get<double>();
          peak_load = std::max(peak_load, load);
          peak_stress = std::max(peak_stress, point["contact_stress_MPa"].get<double>());
          const double reach =
              point["contact_deflection_um"].get<double>() + point["structural_deflection_um"].get<double>() + point["gap_um"].get<double>();
          if (load > 0.0) {
            CHECK(reach == Approx(te).epsilon(solver));
          } else {
            CHECK(reach >= te * (1.0 - solver));  // not in contact: a gap is left
          }
        }
      }
      CHECK(total == Approx(force).epsilon(solver));
    }
    for (const json& extreme : loaded["extremes"]) {
      least_te = std::min(least_te, extreme["te_um"].get<double>());
      most_te = std::max(most_te, extreme["te_um"].get<double>());
      peak_load = std::max(peak_load, extreme["peak_load_N_per_mm"].get<double>());
      peak_stress = std::max(peak_stress, extreme["peak_contact_stress_MPa"].get<double>());
    }
    const json& summary = loaded["summary"];
    CHECK(summary["te_peak_to_peak_um"].get<double>() == Approx(most_te - least_te).epsilon(round_off));
    CHECK(summary["te_mean_um"].get<double>() == Approx(mean_te).epsilon(round_off));
    CHECK(summary["peak_load_N_per_mm"].get<double>() == peak_load);
    CHECK(summary["peak_contact_stress_MPa"].get<double>() == peak_stress);
  }
}

TEST_CASE("Unloaded results keep the identities of transmission error and units", "[studies][results][physics][slow]") {
  const json results = results_of(small::analysis());
  const double wheel_base_radius = 0.5 * results["geometry"]["wheel"]["base_diameter_mm"].get<double>();
  for (const json& unloaded : results["unloaded_scenes"]) {
    const json& mesh = unloaded["mesh"];
    for (std::size_t i = 0; i < mesh["te_um"].size(); ++i) {
      constexpr double round_off = 1e-12;
      const double te_um = mesh["te_arcsec"][i].get<double>() * units::arcsec * wheel_base_radius * 1e3;
      CHECK(mesh["te_um"][i].get<double>() == Approx(te_um).epsilon(round_off).margin(round_off));
    }
    for (const json& pair : unloaded["pairs"]) {
      for (const json& position : pair["positions"]) {
        // delta phi2 = phi2 - N1/N2 phi1; round-off of angles of some degrees, seen in arcsec.
        const double te = (position["phi2_deg"].get<double>() - 18.0 / 54.0 * position["phi1_deg"].get<double>()) * 3600.0;
        CHECK(position["te_arcsec"].get<double>() == tests::about(te, 1e-9));
      }
    }
  }
}

TEST_CASE("Two runs differ in their times only", "[studies][results][determinism][slow]") {
  const std::string text = GENERATE(small::analysis(), small::optimisation());
  json first = results_of(text), second = results_of(text);
  remove_seconds(first);
  remove_seconds(second);
  CHECK(first.dump() == second.dump());
}

TEST_CASE("Given repeats the study's keys, and used has all settings", "[studies][results][slow]") {
  const json results = results_of(small::analysis(), {{"cycle.positions", "5"}});
  bool has_positions = false;
  for (const json& given : results["given"]) has_positions = has_positions || given["key"] == "cycle.positions";
  CHECK(has_positions);
  CHECK(results["used"]["cycle"]["positions"] == 5);
  CHECK(results["used"]["pair"]["pressure_angle_deg"].get<double>() == Approx(20.0).epsilon(1e-14));  // round-off
  CHECK(results["loaded"][0]["cycle"].size() == 5);
}

TEST_CASE("Misaligned over the whole surface, a pair without errors has load factors of its face alone", "[studies][run]") {
  const json results = results_of(
      "task = \"analyse\"\n[pair]\nnormal_module = 4\nhelix_angle = 15\n[pinion]\nteeth = 24\nface_width = 30\n[wheel]\nteeth = 36\n"
      "face_width = 30\n[pinion.modification]\nlead_crowning = 6\n[misalignment]\ncrossing = \"1 arcmin\"\naxial_offset = 0.5\n[load]\n"
      "torque = 300\n[cycle]\npositions = 8\n[fidelity]\ngap = \"whole_surface\"\ncompliance = \"thin_slice\"\nquadrature = { intervals = 4 }\n");
  const json& factors = results["loaded"][0]["summary"]["load_factors"]["without_spikes"];
  CHECK(factors["K_Hbeta"].get<double>() > 1.05);
  constexpr double of_two_cycles = 1e-5;  // solver: the same loads found once more, and their peak
  CHECK(factors["K_Halpha"].get<double>() == Approx(1.0).epsilon(of_two_cycles));
  CHECK(factors["K_H"].get<double>() == Approx(factors["K_Hbeta"].get<double>()).epsilon(of_two_cycles));
}

TEST_CASE("A rigid study ignores its torques, with a note", "[studies][run]") {
  const json results = results_of(small::analysis(), {{"fidelity.compliance", "rigid"}});
  CHECK(results["loaded"].empty());
  CHECK(results["unloaded_scenes"].size() == 2);
  CHECK_THAT(results["notes"].dump(), Catch::Contains("torques are ignored"));
}

TEST_CASE("A bound that cannot be met is a requirement that was not met", "[studies][run]") {
  const std::vector<Override> impossible{{"optimise.constraints.te_peak_to_peak.max", "0.0001"}, {"optimise.max_evaluations", "30"}};
  const StudyResults results = run_study(parse_study(small::optimisation(), "small.toml", impossible));
  REQUIRE(!results.requirements.empty());
  CHECK_THAT(results.requirements.back(), Catch::Contains("te_peak_to_peak") && Catch::Contains("violated"));
}

TEST_CASE("A harmonic that the positions do not resolve is bad input", "[studies][run]") {
  const auto asks_for = [](const char* harmonic) { return parse_study(small::optimisation(), "small.toml", {{"optimise.objective", harmonic}}); };
  CHECK_NOTHROW(asks_for("te_harmonic_2"));  // 6 positions
  CHECK_THROWS_WITH(asks_for("te_harmonic_3"), Catch::Contains("cycle.positions = 6: allowed is at least 7 for te_harmonic_3"));
}

TEST_CASE("A name that is not UTF-8 does not stop the results", "[studies][results]") {
  Study study = parse_study(small::analysis(), "small.toml");
  study.file = "small\xff.toml";
  CHECK_NOTHROW(json::parse(results_json(run_study(study))));
}

}  // namespace flankwright::studies
