#include "tests/studies/sample_results.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/units.hpp"

namespace flankwright::studies::sample {
namespace {

using json = Json;
using units::deg;
using units::pi;

// Haddad's pair: 18:54, m_n 10, alpha_n 20 deg, beta 30 deg, without profile shift.
constexpr double face_width = 120.0;  // mm
const double beta = 30 * deg;
const double alpha_t = std::atan(std::tan(20 * deg) / std::cos(beta));
const double transverse_module = 10 / std::cos(beta);                  // mm
const double base_pitch = pi * transverse_module * std::cos(alpha_t);  // mm
const double tan_base_helix = std::tan(beta) * std::cos(alpha_t);

struct Gear {
  int teeth;
  double r{transverse_module * teeth / 2};
  double r_b{r * std::cos(alpha_t)};
  double r_a{r + 10};
  double r_f{r - 12.5};
};
const Gear pinion{18}, wheel{54};

double involute(double angle) { return std::tan(angle) - angle; }

json profile(const Gear& gear) {
  json x = json::array(), y = json::array();
  constexpr int steps = 24;
  const double start = std::max(gear.r_b, gear.r_f);
  std::vector<std::pair<double, double>> side;  // radius, half angle
  const double half_pitch = pi / gear.teeth;
  side.emplace_back(gear.r_f, half_pitch);
  const auto half_angle = [&](double r) { return half_pitch / 2 + involute(alpha_t) - involute(std::acos(std::min(1.0, gear.r_b / r))); };
  side.emplace_back(gear.r_f, std::min(half_pitch, half_angle(start) * 1.08));
  for (int i = 0; i <= steps; ++i) {
    const double r = start + (gear.r_a - start) * i / steps;
    side.emplace_back(r, half_angle(r));
  }
  for (const auto& [r, angle] : side) {
    x.push_back(r * std::sin(angle));
    y.push_back(r * std::cos(angle));
  }
  for (auto at = side.rbegin(); at != side.rend(); ++at) {
    x.push_back(-at->first * std::sin(at->second));
    y.push_back(at->first * std::cos(at->second));
  }
  return {{"x_mm", x}, {"y_mm", y}};
}

json gear_entry(const Gear& gear, const char* hand) {
  return {{"teeth", gear.teeth},
          {"hand", hand},
          {"reference_diameter_mm", 2 * gear.r},
          {"base_diameter_mm", 2 * gear.r_b},
          {"tip_diameter_mm", 2 * gear.r_a},
          {"root_diameter_mm", 2 * gear.r_f},
          {"form_diameter_mm", 2 * gear.r_b + 1.5},
          {"active_root_diameter_mm", 2 * gear.r_b + 2.5},
          {"tip_thickness_mm", 5.6},
          {"undercut", false},
          {"profile", profile(gear)}};
}

/// Ends of the path of contact, from the pinion's base tangent point [mm].
double path_start() { return (pinion.r + wheel.r) * std::sin(alpha_t) - std::sqrt(wheel.r_a * wheel.r_a - wheel.r_b * wheel.r_b); }
double path_end() { return std::sqrt(pinion.r_a * pinion.r_a - pinion.r_b * pinion.r_b); }

json geometry() {
  const double epsilon_alpha = (path_end() - path_start()) / base_pitch;
  const double epsilon_beta = face_width * tan_base_helix / base_pitch;
  return {{"centre_distance_mm", pinion.r + wheel.r},
          {"backlash_um", 0.0},
          {"transverse_contact_ratio", epsilon_alpha},
          {"overlap_ratio", epsilon_beta},
          {"total_contact_ratio", epsilon_alpha + epsilon_beta},
          {"working_transverse_pressure_angle_deg", alpha_t / deg},
          {"base_helix_angle_deg", std::atan(tan_base_helix) / deg},
          {"transverse_base_pitch_mm", base_pitch},
          {"pinion", gear_entry(pinion, "right")},
          {"wheel", gear_entry(wheel, "left")}};
}

/// One mesh cycle: `tilt` is the misalignment left in the mesh, `relief` how much of it the flanks take up (0 .. 1).
json loaded_entry(const std::string& scene, double torque, const char* design, double tilt, double relief, int positions) {
  constexpr int points_a_line = 10;
  const double mean_load = torque * 1e3 / pinion.r_b / (1.6 * face_width);
  double peak_load = 0, peak_stress = 0, te_low = 1e9, te_high = -1e9;
  json cycle = json::array();
  for (int p = 0; p < positions; ++p) {
    const double phase = static_cast<double>(p) / positions;
    json teeth = json::array();
    for (int tooth = -3; tooth <= 3; ++tooth) {
      json points = json::array();
      for (int i = 0; i < points_a_line; ++i) {
        const double z = face_width * ((i + 0.5) / points_a_line - 0.5);
        const double s = path_start() + (phase + tooth + 1.0) * base_pitch + z * tan_base_helix;
        if (s < path_start() || s > path_end()) continue;
        const double along = (s - path_start()) / (path_end() - path_start());
        const double edge = (1 - relief) * 0.5 * std::exp(-12 * std::min(along, 1 - along));
        const double bow = relief * (0.35 - 1.2 * (2 * z / face_width) * (2 * z / face_width) - std::pow(2 * along - 1, 6));
        const double load = std::max(0.0, mean_load * (1 + (1 - 0.6 * relief) * tilt * 2 * z / face_width + edge + 0.4 * bow));
        const double rho = s * ((pinion.r + wheel.r) * std::sin(alpha_t) - s) / ((pinion.r + wheel.r) * std::sin(alpha_t));
        const double stress = 190 * std::sqrt(load / std::max(rho, 1.0));
        peak_load = std::max(peak_load, load);
        peak_stress = std::max(peak_stress, stress);
        points.push_back({{"z_mm", z},
                          {"pinion_radius_mm", std::hypot(pinion.r_b, s)},
                          {"wheel_radius_mm", std::hypot(wheel.r_b, (pinion.r + wheel.r) * std::sin(alpha_t) - s)},
                          {"load_N_per_mm", load},
                          {"contact_stress_MPa", stress},
                          {"contact_deflection_um", 0.012 * load},
                          {"structural_deflection_um", 0.03 * load},
                          {"gap_um", load > 0 ? 0.0 : 1.3},
                          {"error_um", tilt * z / 10}});
      }
      if (!points.empty()) teeth.push_back({{"tooth", tooth}, {"points", points}, {"share", static_cast<double>(points.size()) / 20}});
    }
    const double wave = (1 - 0.7 * relief) * (std::sin(2 * pi * phase) + 0.4 * std::sin(4 * pi * phase + 1));
    const double te = 14 + 3 * relief + 0.01 * torque / 10 + (1 + tilt) * 0.6 * wave;
    te_low = std::min(te_low, te);
    te_high = std::max(te_high, te);
    cycle.push_back({{"phase", phase},
                     {"te_um", te},
                     {"te_base_tangent_um", te / std::cos(std::atan(tan_base_helix))},
                     {"stiffness_N_per_mm_um", 19 - 2 * relief + wave},
                     {"kkt_residual", 1e-12 * (1 + p)},
                     {"teeth", teeth}});
  }
  json harmonics = json::array();
  for (int n = 1; n <= 10; ++n) harmonics.push_back((1 - 0.7 * relief) * (1 + tilt) * 0.6 / (n * n));
  return {
      {"scene", scene},
      {"torque_Nm", torque},
      {"design", design},
      {"cycle", cycle},
      {"summary",
       {{"te_peak_to_peak_um", te_high - te_low},
        {"te_harmonics_um", harmonics},
        {"te_mean_um", (te_high + te_low) / 2},
        {"peak_load_N_per_mm", peak_load},
        {"peak_contact_stress_MPa", peak_stress},
        {"peak_root_stress_MPa", nullptr},
        {"mean_stiffness_N_per_mm_um", 19 - 2 * relief},
        {"load_factor", peak_load / mean_load},
        {"peaks", {{"without_spikes", {{"contact_stress_MPa", 0.9 * peak_stress}}}, {"with_spikes", {{"contact_stress_MPa", peak_stress}}}}},
        {"load_factors",
         {{"without_spikes", {{"K_Hbeta", 1 + tilt / 3}, {"K_Halpha", 1.02}, {"K_H", 1.01 + tilt / 3}, {"K_Hbeta_times_K_Halpha", 1.02 + tilt / 3}}},
          {"with_spikes", {{"K_Hbeta", 1 + tilt / 2}, {"K_Halpha", nullptr}, {"K_H", nullptr}, {"K_Hbeta_times_K_Halpha", nullptr}}}}},
        {"iso6336", {{"c_prime", 13.9}, {"c_gamma", 20.1}, {"K_Hbeta", 1 + tilt / 2}, {"K_Halpha", nullptr}}}}}};
}

json topography(const char* gear, const Gear& g, const char* design, double crowning, double relief) {
  json z = json::array(), radius = json::array(), removal = json::array();
  for (int i = 0; i <= 24; ++i) z.push_back(face_width * (i / 24.0 - 0.5));
  for (int j = 0; j <= 16; ++j) {
    const double u = j / 16.0;
    radius.push_back(g.r_b + 1 + u * (g.r_a - g.r_b - 1));
    json row = json::array();
    for (int i = 0; i <= 24; ++i) {
      const double s = i / 12.0 - 1;
      row.push_back(crowning * s * s + relief * std::max(0.0, (u - 0.7) / 0.3));
    }
    removal.push_back(row);
  }
  return {{"gear", gear}, {"design", design}, {"z_mm", z}, {"radius_mm", radius}, {"removal_um", removal}};
}

/// Separation of crowned flanks over a grid, in um: none along a line that tilts across the flank.
json pattern(const Gear& gear, double covered) {
  json radius = json::array(), z = json::array(), separation = json::array();
  for (int i = 0; i <= 16; ++i) z.push_back(face_width * (i / 16.0 - 0.5));
  for (int j = 0; j <= 8; ++j) {
    radius.push_back(gear.r_b + 1 + (gear.r_a - gear.r_b - 1) * j / 8.0);
    json row = json::array();
    for (int i = 0; i <= 16; ++i) {
      const double off = i / 8.0 - 1 - 0.3 * (j / 4.0 - 1);
      row.push_back(i == 16 && j == 0 ? json() : json(14 * off * off));  // one place that never faces the mate
    }
    separation.push_back(row);
  }
  return {{"radius_mm", radius}, {"z_mm", z}, {"separation_um", separation}, {"covered_percent", covered}};
}

json ellipse(const char* contact) {
  if (std::string(contact) != "surface") return nullptr;
  const auto axis = [](double up, double along) {
    return json{{"pinion", {{"radius", up}, {"z", along}}}, {"wheel", {{"radius", -up}, {"z", along}}}};
  };
  return {{"semi_major_mm", 30.0}, {"semi_minor_mm", 0.6}, {"major", axis(0.1, 0.97)}, {"minor", axis(0.9, -0.1)}};
}

json unloaded_part() {
  const double pitch_angle = 360.0 / pinion.teeth;
  json pairs = json::array(), phi = json::array(), te = json::array(), te_um = json::array(), transfers = json::array();
  const auto pair_te = [](double x) { return -0.055 * x * x - 2.4 * std::pow(std::max(0.0, std::abs(x) - 14), 2); };
  for (int tooth = -1; tooth <= 1; ++tooth) {
    json positions = json::array();
    for (int i = -36; i <= 36; ++i) {
      const double x = 0.5 * i;
      const char* kind = x > 14 ? "pinion_tip" : x < -14 ? "wheel_tip" : "surface";
      const double s = std::clamp(x / 14, -1.0, 1.0);
      positions.push_back({{"phi1_deg", x + tooth * pitch_angle},
                           {"phi2_deg", (x + tooth * pitch_angle) / 3},
                           {"te_arcsec", pair_te(x)},
                           {"te_slope_arcsec_per_deg", -0.11 * x},
                           {"contact", kind},
                           {"carries", std::abs(x) <= pitch_angle / 2},
                           {"pinion", {{"radius_mm", pinion.r + (s > 0 ? 10 : 5.5) * s}, {"z_mm", 2 * s + (x - 14 * s) * 4}}},
                           {"wheel", {{"radius_mm", wheel.r - 9 * s}, {"z_mm", 2 * s + (x - 14 * s) * 4}}},
                           {"ellipse", ellipse(kind)}});
    }
    pairs.push_back({{"tooth", tooth}, {"sequence", "wheel_tip, surface, pinion_tip"}, {"positions", positions}});
  }
  for (int i = 0; i <= 120; ++i) {
    const double x = 1.5 * pitch_angle * (i / 60.0 - 1);
    const double folded = x - pitch_angle * std::round(x / pitch_angle);
    phi.push_back(x);
    te.push_back(pair_te(folded));
    te_um.push_back(pair_te(folded) * units::arcsec * wheel.r_b * 1e3);
  }
  for (int k = -1; k <= 0; ++k) {
    transfers.push_back({{"phi1_deg", (k + 0.5) * pitch_angle},
                         {"te_arcsec", pair_te(pitch_angle / 2)},
                         {"from_tooth", k},
                         {"to_tooth", k + 1},
                         {"slope_before_arcsec_per_deg", -1.1},
                         {"slope_after_arcsec_per_deg", 1.1},
                         {"slope_jump_arcsec_per_deg", 2.2}});
  }
  return {{"scene", "aligned"},
          {"sequence", "wheel_tip, surface, pinion_tip"},
          {"carrying_sequence", "surface"},
          {"pairs", pairs},
          {"bearing_pattern", {{"marking_thickness_um", 6.35}, {"pinion", pattern(pinion, 71.0)}, {"wheel", pattern(wheel, 70.0)}}},
          {"parabolic_te",
           {{"wanted_arcsec_per_deg2", 0.055},
            {"found_arcsec_per_deg2", 0.0551},
            {"shift_deg", 0.2},
            {"residual_arcsec", 0.003},
            {"holds", true},
            {"why", ""}}},
          {"mesh",
           {{"phi1_deg", phi},
            {"te_arcsec", te},
            {"te_um", te_um},
            {"peak_to_peak_arcsec", -pair_te(pitch_angle / 2)},
            {"peak_to_peak_um", -pair_te(pitch_angle / 2) * units::arcsec * wheel.r_b * 1e3},
            {"harmonics_arcsec", {2.2, 0.56, 0.25, 0.14, 0.09}},
            {"transfers", transfers}}}};
}

json frame(const char* task) {
  const json given = json::array({{{"key", "pair.normal_module"}, {"value", "10"}, {"unit", "mm"}},
                                  {{"key", "pair.helix_angle"}, {"value", "30"}, {"unit", "deg"}},
                                  {{"key", "misalignment.crossing"}, {"value", "\"3 arcmin\""}}});
  const json effects = json::array({{{"name", "tooth_bending"}, {"on", true}, {"why", "a torque is given"}, {"seconds", 0.42}},
                                    {{"name", "hertzian_contact"}, {"on", true}, {"why", "a torque is given"}, {"seconds", 0.13}},
                                    {{"name", "misalignment"}, {"on", true}, {"why", "crossing is not zero"}, {"seconds", 0.004}},
                                    {{"name", "shaft_deflection"}, {"on", false}, {"why", "no shaft data"}, {"seconds", 0.0}}});
  const json used = {{"pair", {{"normal_module_mm", 10.0}, {"pinion", {{"face_width_mm", face_width}}}, {"wheel", {{"face_width_mm", face_width}}}}},
                     {"fidelity", {{"compliance", "thin_slice"}, {"gap", "plane_of_action"}}},
                     {"cycle", {{"phases", {0.0, 0.25, 0.5, 0.75}}}}};
  return {{"title", "Haddad 18:54"},
          {"task", task},
          {"version", "0.1.0"},
          {"file", "haddad.toml"},
          {"units", {{"length", "mm"}}},
          {"given", given},
          {"used", used},
          {"notes", {"No backlash: the centre distance follows from the profile shifts."}},
          {"effects", effects},
          {"geometry", geometry()}};
}

}  // namespace

json unloaded_results() {
  json results = frame("analyse");
  results["unloaded"] = unloaded_part();
  json broken = unloaded_part();
  broken["scene"] = "crossed";
  broken["parabolic_te"]["holds"] = false;
  broken["parabolic_te"]["why"] = "contact runs on a face end";
  results["unloaded_scenes"] = {results["unloaded"], broken};
  return results;
}

json loaded_results(int scenes) {
  json results = frame("analyse");
  results["loaded"] = json::array();
  for (int k = 0; k < scenes; ++k) {
    results["loaded"].push_back(loaded_entry("misaligned " + std::to_string(3 * k) + " µm", 1014.868, "given", 0.25 * k, 0.2, 32));
  }
  results["modifications"] = {topography("pinion", pinion, "given", 8, 8), topography("wheel", wheel, "given", 0, 0)};
  return results;
}

json optimise_results(int scenes, int positions) {
  json results = frame("optimise");
  results["loaded"] = json::array();
  json objectives = json::array(), history = json::array();
  double worst_before = 0, worst_after = 0;
  for (int k = 0; k < scenes; ++k) {
    const std::string name = "F_beta " + std::to_string(4 * k) + " µm";
    const double torque = k % 3 == 0 ? 500.0 : 1014.868;
    const double tilt = 0.12 * k;
    double stress[2];
    for (const bool after : {false, true}) {
      json entry = loaded_entry(name, torque, after ? "after" : "before", tilt, after ? 0.8 : 0.0, positions);
      stress[after] = entry["summary"]["peak_contact_stress_MPa"];
      results["loaded"].push_back(std::move(entry));
    }
    objectives.push_back({{"name", name}, {"torque_Nm", torque}, {"before", stress[0]}, {"after", stress[1]}});
    worst_before = std::max(worst_before, stress[0]);
    worst_after = std::max(worst_after, stress[1]);
  }
  for (int i = 0; i < 40; ++i) {
    history.push_back({{"evaluation", i + 1},
                       {"objective", worst_after + (worst_before - worst_after) * std::exp(-i / 6.0) * (1 + 0.2 * std::sin(i))},
                       {"constraint_violation", i < 6 ? 0.3 * (6 - i) : 0.0}});
  }
  const auto design = [](double crowning, double relief, double objective, double te) {
    return json{{"variables", {{"pinion.modification.lead_crowning", crowning}, {"pinion.modification.tip_relief.amount", relief}}},
                {"variable_units", {{"pinion.modification.lead_crowning", "um"}, {"pinion.modification.tip_relief.amount", "um"}}},
                {"objective", objective},
                {"constraints", {{"te_peak_to_peak", {{"value", te}, {"max", 1.5}, {"unit", "um"}}}}}};
  };
  results["optimise"] = {{"objective_name", "peak_contact_stress"},
                         {"objective_unit", "MPa"},
                         {"over", "worst"},
                         {"solver", "ipopt"},
                         {"status", "converged"},
                         {"message", "the first-order conditions hold"},
                         {"evaluations", 40},
                         {"gradient_evaluations", 31},
                         {"seconds", 18.4},
                         {"before", design(0, 0, worst_before, 2.31)},
                         {"after", design(13.42, 21.7, worst_after, 1.12)},
                         {"scenes", objectives},
                         {"history", history}};
  results["modifications"] = {topography("pinion", pinion, "before", 0, 0), topography("pinion", pinion, "after", 13.42, 21.7)};
  results["unloaded"] = unloaded_part();
  return results;
}

}  // namespace flankwright::studies::sample
