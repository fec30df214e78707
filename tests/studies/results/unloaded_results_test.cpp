#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/results/tables.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::results_of;

/// A helical pair with a predesigned parabola, its scenes within and beyond what lead crowning takes up.
const std::string parabola_study = R"(
[pair]
normal_module = 3
helix_angle = 15
[pinion]
teeth = 25
face_width = 30
[wheel]
teeth = 60
face_width = 30
[pinion.modification]
parabolic_te = 0.1
lead_crowning = 20
[cycle]
positions = 32
[[scenes]]
name = "aligned"
[[scenes]]
name = "within"
misalignment.crossing = 3
[[scenes]]
name = "beyond"
misalignment.crossing = 12
)";

/// The grid of a flank that is too thin everywhere: -10 um normal to it, for Haddad's 18-tooth pinion.
std::string thin_grid() {
  std::string csv = "radius_mm;z_mm;deviation_um\n";
  for (const int radius : {98, 102, 106, 110, 113}) {
    for (const int z : {-55, -20, 20, 55}) csv += std::to_string(radius) + ";" + std::to_string(z) + ";-10\n";
  }
  return csv;
}

json run_with_thin_pinion(const std::string& study) {
  const command_line::ScratchFolder folder;
  folder.file("thin.csv", thin_grid());
  const std::string path = folder.file("thin.toml", study);
  return json::parse(results_json(run_study(read_study(path, {{"pinion.modification.grid", "thin.csv"}}))));
}

bool is_edge(const json& position) {
  static const std::set<std::string> faces{"line", "surface"};
  return faces.count(position["contact"]) == 0;
}

}  // namespace

TEST_CASE("The pairs that carry are the mesh's curve, at every position some pair does", "[studies][results][physics]") {
  const json results = results_of(small::analysis());
  for (const json& unloaded : results["unloaded_scenes"]) {
    const json& mesh = unloaded["mesh"];
    constexpr double shared = 1e-12 / units::arcsec;  // what counts as sharing the lead
    for (std::size_t i = 0; i < mesh["phi1_deg"].size(); ++i) {
      int carrying = 0;
      for (const json& pair : unloaded["pairs"]) {
        for (const json& position : pair["positions"]) {
          if (position["phi1_deg"] != mesh["phi1_deg"][i]) continue;
          const double lag = mesh["te_arcsec"][i].get<double>() - position["te_arcsec"].get<double>();
          CHECK(position["carries"].get<bool>() == (lag <= 1.01 * shared));
          carrying += position["carries"].get<bool>() ? 1 : 0;
        }
      }
      CHECK(carrying >= 1);
    }
  }
}

TEST_CASE("At a transfer point the pair that enters is the faster one, and the slopes are those of the curves", "[studies][results][physics]") {
  const json results = results_of(parabola_study);
  for (const json& unloaded : results["unloaded_scenes"]) {
    for (const json& transfer : unloaded["mesh"]["transfers"]) {
      const double before = transfer["slope_before_arcsec_per_deg"], after = transfer["slope_after_arcsec_per_deg"];
      CHECK(transfer["slope_jump_arcsec_per_deg"].get<double>() == Approx(after - before).epsilon(1e-12));
      CHECK(after > before);  // the mesh's curve is a maximum
      CHECK(transfer["from_tooth"] != transfer["to_tooth"]);
    }
  }
  // TE = -a phi1^2, slope -2 a phi1: 0.1 arcsec/deg^2 at half a pitch of 14.4 deg gives a jump of 4 a 7.2 deg.
  const json& transfers = results["unloaded_scenes"][0]["mesh"]["transfers"];
  REQUIRE(transfers.size() == 1);
  constexpr double model = 1e-4;  // second order of the lead crowning beside the parabola
  CHECK(transfers[0]["slope_jump_arcsec_per_deg"].get<double>() == Approx(4.0 * 0.1 * 7.2).epsilon(model));
  for (const json& pair : results["unloaded_scenes"][0]["pairs"]) {
    for (const json& position : pair["positions"]) {
      if (!position["carries"].get<bool>()) continue;
      const double turned = position["phi1_deg"].get<double>() + 14.4 * pair["tooth"].get<int>();
      CHECK(position["te_slope_arcsec_per_deg"].get<double>() == Approx(-2.0 * 0.1 * turned).epsilon(model).margin(model));
    }
  }
}

TEST_CASE("Ellipses belong to contact inside both flanks and lie in their common tangent plane", "[studies][results][physics]") {
  const json results = results_of(parabola_study);
  int ellipses = 0;
  for (const json& unloaded : results["unloaded_scenes"]) {
    for (const json& pair : unloaded["pairs"]) {
      for (const json& position : pair["positions"]) {
        const json& ellipse = position["ellipse"];
        CAPTURE(position);
        CHECK(ellipse.is_null() == is_edge(position));
        if (ellipse.is_null() || ellipse["semi_major_mm"].is_null()) continue;
        ++ellipses;
        CHECK(ellipse["semi_major_mm"] >= ellipse["semi_minor_mm"]);
        for (const char* axis : {"major", "minor"}) {
          for (const char* gear : {"pinion", "wheel"}) {
            const double up = ellipse[axis][gear]["radius"], along = ellipse[axis][gear]["z"];
            CHECK(std::hypot(up, along) <= 1.0 + 1e-12);  // parts of a unit vector
          }
          // Gear axes are parallel to 12 arcmin, so both see the same axial part; where one goes up the other goes down.
          CHECK(ellipse[axis]["pinion"]["z"].get<double>() == tests::about(ellipse[axis]["wheel"]["z"].get<double>(), 4e-3));
          CHECK(ellipse[axis]["pinion"]["radius"].get<double>() * ellipse[axis]["wheel"]["radius"].get<double>() <= 0.0);
        }
      }
    }
  }
  CHECK(ellipses > 50);
}

TEST_CASE("A sequence names each kind once for every time it is met", "[studies][results]") {
  const json results = results_of(parabola_study);
  for (const json& unloaded : results["unloaded_scenes"]) {
    for (const json& pair : unloaded["pairs"]) {
      std::string expected, last;
      for (const json& position : pair["positions"]) {
        if (position["contact"].get<std::string>() == last) continue;
        last = position["contact"];
        expected += (expected.empty() ? "" : ", ") + last;
      }
      CHECK(pair["sequence"] == expected);
    }
  }
  // Aligned and crowned, a pair comes in by the wheel's tip, passes over the surface and leaves by the pinion's tip.
  const std::string whole = results["unloaded_scenes"][0]["sequence"];
  CHECK(whole.find("wheel_tip, surface, pinion_tip") != std::string::npos);
  CHECK(results["unloaded_scenes"][0]["carrying_sequence"] == "surface");
}

TEST_CASE("A designed parabola is judged in every scene; where it does not hold is a note, not a requirement", "[studies][results][physics]") {
  const StudyResults results = run_study(parse_study(parabola_study, "parabola.toml", {{"pinion.process", "topological"}}));
  CHECK(results.requirements.empty());
  const json found = json::parse(results_json(results));
  const auto check = [&](int scene) { return found["unloaded_scenes"][scene]["parabolic_te"]; };
  CHECK(check(0)["holds"] == true);
  CHECK(check(0)["why"] == "");
  CHECK(check(0)["wanted_arcsec_per_deg2"].get<double>() == Approx(0.1).epsilon(1e-12));  // round-off
  CHECK(check(0)["found_arcsec_per_deg2"].get<double>() == Approx(0.1).epsilon(1e-4));    // model, as above
  CHECK(std::abs(check(0)["shift_deg"].get<double>()) < 1e-3);
  CHECK(check(1)["holds"] == true);
  CHECK(check(1)["found_arcsec_per_deg2"].get<double>() == Approx(0.1).epsilon(0.01));  // model: second order in the misalignment
  CHECK(check(2)["holds"] == false);
  REQUIRE(found["notes"].size() == 1);
  CHECK_THAT(found["notes"][0].get<std::string>(), Catch::Contains("\"beyond\"") && Catch::Contains(check(2)["why"].get<std::string>()));
  const std::string summary = summary_table(results);
  CHECK_THAT(summary, Catch::Contains("parabola holds") && Catch::Contains("parabola does not hold: "));

  CHECK_FALSE(results_of(small::analysis())["unloaded"].contains("parabolic_te"));
  // Three positions do not determine a parabola.
  CHECK(results_of(parabola_study, {{"cycle.positions", "3"}})["unloaded"]["parabolic_te"]["holds"] == false);
}

TEST_CASE("The arc of a surface of revolution designs a parabola", "[studies][results][physics]") {
  const std::vector<Override> crowned{{"pair.helix_angle", "0"},
                                      {"pinion.modification.parabolic_te", "0"},
                                      {"pinion.generation", "{ kind = \"revolution\", half_apex = 80, distance = 15, arc_radius = 2000 }"}};
  const json results = results_of(parabola_study, crowned);
  const json& parabola = results["unloaded"]["parabolic_te"];
  CHECK(parabola["found_arcsec_per_deg2"].get<double>() ==
        Approx(parabola["wanted_arcsec_per_deg2"].get<double>()).epsilon(0.05));  // a parabola near the vertex only
  CHECK(results["used"]["pair"]["pinion"]["generation"]["kind"] == "revolution");
  CHECK(results["used"]["pair"]["wheel"]["generation"]["kind"] == "rack");
}

TEST_CASE("A thicker marking compound marks more of both flanks", "[studies][results][physics][slow]") {
  double last_pinion = 0.0, last_wheel = 0.0;
  for (const char* thickness : {"2", "6.35", "20"}) {
    const json results = results_of(parabola_study, {{"unloaded.marking_thickness", thickness}});
    const json& pattern = results["unloaded"]["bearing_pattern"];
    CHECK(pattern["marking_thickness_um"].get<double>() == Approx(std::stod(thickness)).epsilon(1e-14));  // round-off
    CHECK(pattern["pinion"]["covered_percent"] > last_pinion);
    CHECK(pattern["wheel"]["covered_percent"] > last_wheel);
    last_pinion = pattern["pinion"]["covered_percent"];
    last_wheel = pattern["wheel"]["covered_percent"];
    CHECK(last_pinion <= 100.0);
    for (const char* gear : {"pinion", "wheel"}) {
      CHECK(pattern[gear]["separation_um"].size() == pattern[gear]["radius_mm"].size());
      CHECK(pattern[gear]["separation_um"][0].size() == pattern[gear]["z_mm"].size());
    }
  }
}

TEST_CASE("A flank that is too thin everywhere shifts the transmission error and changes nothing else", "[studies][results][physics][grid][slow]") {
  const json nominal = results_of(small::analysis()), thin = run_with_thin_pinion(small::analysis());
  const double base_helix = nominal["geometry"]["base_helix_angle_deg"].get<double>() * units::deg;
  // Unloaded: the involute turned by 10 um/(r_b1 cos(beta_b)); a grid of equal numbers is that exactly.
  constexpr double round_off = 1e-6;  // um, angles of some degrees on 160 mm
  const json& te = nominal["unloaded"]["mesh"]["te_um"];
  for (std::size_t i = 0; i < te.size(); ++i) {
    CHECK(thin["unloaded"]["mesh"]["te_um"][i].get<double>() == tests::about(te[i].get<double>() - 10.0 / std::cos(base_helix), round_off));
  }
  // Under load the wheel lags by 10 um more along the normal, with the same loads.
  REQUIRE(thin["loaded"].size() == nominal["loaded"].size());
  constexpr double solver = 1e-7;  // relative, of a load distribution found anew
  for (std::size_t l = 0; l < thin["loaded"].size(); ++l) {
    const json &a = nominal["loaded"][l]["summary"], &b = thin["loaded"][l]["summary"];
    CHECK(b["te_mean_um"].get<double>() == Approx(a["te_mean_um"].get<double>() + 10.0).epsilon(solver));
    CHECK(b["peak_contact_stress_MPa"].get<double>() == Approx(a["peak_contact_stress_MPa"].get<double>()).epsilon(solver));
  }
  // The map of the flank has it on top of the modifications, which leave mid face half-way up alone.
  const auto removed_in_the_middle = [](const json& results) {
    const json& map = results["modifications"][0]["removal_um"];
    return map[map.size() / 2][map[0].size() / 2].get<double>();
  };
  CHECK(removed_in_the_middle(nominal) == tests::about(0.0, round_off));
  CHECK(std::abs(removed_in_the_middle(thin) - 10.0 / std::cos(base_helix)) <= round_off);
  const auto removed_at_the_corner = [](const json& results) { return results["modifications"][0]["removal_um"].back().back().get<double>(); };
  CHECK(std::abs(removed_at_the_corner(thin) - removed_at_the_corner(nominal) - 10.0 / std::cos(base_helix)) <= round_off);

  const json& used = thin["used"]["pair"]["pinion"]["grid"];
  CHECK(used["file"] == "thin.csv");
  CHECK(used["radii"] == 5);
  CHECK(used["axial_positions"] == 4);
  CHECK(used["radius_mm"] == json({98.0, 113.0}));
  CHECK(used["z_mm"] == json({-55.0, 55.0}));
  CHECK(used["residual_largest_um"].get<double>() < 1e-9);
  CHECK(nominal["used"]["pair"]["pinion"]["grid"] == false);
  const auto is_grid = [](const json& given) { return given["key"] == "pinion.modification.grid"; };
  CHECK(std::any_of(thin["given"].begin(), thin["given"].end(), is_grid));
}

TEST_CASE("A crowned generation concentrates the load", "[studies][results][physics][slow]") {
  double last = 0.0;
  for (const char* coefficient : {"0", "0.0002", "0.0005"}) {
    const json results = results_of(small::analysis(), {{"pinion.generation.kind", "parabolic_rack"},
                                                        {"pinion.generation.coefficient", coefficient},
                                                        {"pinion.edges.tip_rounding", "0"},
                                                        {"wheel.edges.tip_rounding", "0"}});  // on edges it lowers the stress
    const double stress = results["loaded"][0]["summary"]["peak_contact_stress_MPa"];
    CHECK(stress > last);
    last = stress;
  }
  // What the tool removes belongs to the map of the flank, as modifications do.
  const json map = results_of(parabola_study, {{"pinion.modification.lead_crowning", "0"},
                                               {"pinion.modification.parabolic_te", "0"},
                                               {"pinion.generation", "{ kind = \"parabolic_rack\", coefficient = 0.001 }"}});
  REQUIRE(map["modifications"].size() == 1);
  CHECK(map["modifications"][0]["removal_um"].back().back() > 1.0);
}

}  // namespace flankwright::studies
