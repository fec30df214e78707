#include "studies/exchange/dynamics/dynamics_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "studies/analysis/run_study.hpp"
#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/version.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies {

namespace {

constexpr int revolution_positions = 16;  ///< over one pitch
constexpr int positions_at_a_time = 64;   ///< of a revolution, so that memory does not grow with the number of teeth
constexpr int harmonic_orders = 10;
constexpr double si_stiffness = 1e3;  ///< N/m in one N/mm

/// The study at the resolution that its results have.
/// @param modifications  of its flanks, in place of its own
Study study_to_analyse(const Json& results, const std::vector<Override>& modifications) {
  const Json& used = results.at("used");
  std::vector<Override> overrides{
      {"task", "analyse"}, {"analyse.gradients", "[\"load.torque\"]"}, {"fidelity.effect_sizes", "off"}, {"cycle.peaks", "sampled"}};
  overrides.insert(overrides.end(), modifications.begin(), modifications.end());
  Study study = parse_study(results.at("study").get<std::string>(), results.at("file").get<std::string>(), overrides);
  study.expect.clear();
  study.fidelity.accuracy.reset();
  const Json &fidelity = used.at("fidelity"), &cycle = used.at("cycle");
  study.fidelity.compliance = compliance_model(fidelity.at("compliance").get<std::string>());
  study.fidelity.gap = fidelity.at("gap") == "whole_surface" ? GapModel::WholeSurface : GapModel::PlaneOfAction;
  study.fidelity.quadrature.intervals = fidelity.at("quadrature").at("intervals");
  study.fidelity.automatic_intervals = study.cycle.automatic_positions = false;
  study.cycle.positions = cycle.at("positions");
  if (!cycle.at("phases").empty()) throw InvalidInput("cycle.phases", "given", "a study of a whole mesh cycle, without explicit phases");
  return study;
}

/// Whether teeth have errors of their own, beside a pitch step that is the same everywhere.
bool has_single_teeth(ManufacturingError error) {
  error.pitch_step = 0.0;
  return teeth_differ(error);
}

MeshExcitation::Position position_of(const LoadedPosition& position, const LoadedCycle& cycle, double face_width, double cos_base_helix) {
  MeshExcitation::Position at;
  at.phase = position.phase;
  if (!position.load.usable()) return at;
  at.transmission_error = position.load.transmission_error;
  // Of [N/(mm um)] and transverse: see LoadedPosition::stiffness.
  at.secant_stiffness = position.stiffness * face_width / (cos_base_helix * cos_base_helix) / units::um;
  at.tangent_stiffness = cycle.force_derivative[0] / position.transmission_error_derivative[0];
  return at;
}

std::vector<MeshExcitation> excitation_of(const StudyResults& results) {
  std::vector<MeshExcitation> all;
  const double cos_base_helix = std::cos(results.pair.base_helix_angle);
  for (const LoadedResult& loaded : results.loaded) {
    MeshExcitation of{.scene = loaded.scene, .torque = loaded.torque, .normal_force = loaded.cycle.force, .cycle = {}, .revolution = {}};
    const double face_width = results.models[loaded.model].face_width;
    for (const LoadedPosition& position : loaded.cycle.positions) of.cycle.push_back(position_of(position, loaded.cycle, face_width, cos_base_helix));
    all.push_back(std::move(of));
  }
  return all;
}

void add_revolution(Study study, std::vector<MeshExcitation>& cases, const ProgressReport& progress) {
  const int teeth = study.pair.wheel.teeth, positions = teeth * revolution_positions;
  for (int begin = 0; begin < positions; begin += positions_at_a_time) {
    if (progress) progress("wheel revolution", begin, positions, "");
    study.cycle.phases.clear();
    for (int i = begin; i < std::min(begin + positions_at_a_time, positions); ++i)
      study.cycle.phases.push_back(static_cast<double>(i) / revolution_positions);
    const std::vector<MeshExcitation> part = excitation_of(run_study(study));
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].revolution.insert(cases[i].revolution.end(), part[i].cycle.begin(), part[i].cycle.end());
  }
  if (progress) progress("wheel revolution", positions, positions, "");
}

template <class Value>
std::vector<double> values_of(const std::vector<MeshExcitation::Position>& positions, const Value& value) {
  std::vector<double> values;
  for (const auto& position : positions) values.push_back(value(position));
  return values;
}

/// A quantity of a position in the unit that its name says.
struct Column {
  const char* name;
  double (*value)(const MeshExcitation::Position&, const GearPair&);
};
double cos_beta_b(const GearPair& pair) { return std::cos(pair.base_helix_angle); }
constexpr Column excitation_columns[] = {
    {"phase", [](const auto& p, const GearPair&) { return p.phase; }},
    {"pinion_angle_deg", [](const auto& p, const GearPair& pair) { return 360.0 * p.phase / pair.pinion.data.teeth; }},
    {"wheel_angle_deg", [](const auto& p, const GearPair& pair) { return 360.0 * p.phase / pair.wheel.data.teeth; }},
    {"te_um", [](const auto& p, const GearPair&) { return in_um(p.transmission_error); }},
    {"te_base_tangent_um", [](const auto& p, const GearPair& pair) { return in_um(p.transmission_error) / cos_beta_b(pair); }},
    {"te_wheel_arcsec",
     [](const auto& p, const GearPair& pair) { return in_arcsec(p.transmission_error / cos_beta_b(pair) / pair.wheel.base_radius); }},
    {"secant_stiffness_N_per_m", [](const auto& p, const GearPair&) { return si_stiffness * p.secant_stiffness; }},
    {"tangent_stiffness_N_per_m", [](const auto& p, const GearPair&) { return si_stiffness * p.tangent_stiffness; }},
    {"tangent_stiffness_base_tangent_N_per_m",
     [](const auto& p, const GearPair& pair) { return si_stiffness * p.tangent_stiffness * cos_beta_b(pair) * cos_beta_b(pair); }},
};

std::string positions_csv(const DynamicsRun& run, bool revolution) {
  std::string csv = "scene,torque_Nm";
  for (const Column& column : excitation_columns) csv += fmt::format(",{}", column.name);
  csv += "\n";
  for (const MeshExcitation& of : run.cases) {
    for (const MeshExcitation::Position& position : revolution ? of.revolution : of.cycle) {
      csv += fmt::format("{},{}", csv_field(of.scene), in_Nm(of.torque));
      for (const Column& column : excitation_columns) csv += fmt::format(",{}", csv_field(column.value(position, run.pair)));
      csv += "\n";
    }
  }
  return csv;
}

/// Harmonics of the cycle: the transmission error along the flank normal [um], and the tangent stiffness along it [N/m].
struct CaseHarmonics {
  std::vector<ExcitationHarmonic> te, stiffness;
};
CaseHarmonics harmonics_of(const MeshExcitation& of) {
  const std::vector<double> phases = values_of(of.cycle, [](const auto& p) { return p.phase; });
  return {excitation_harmonics(phases, values_of(of.cycle, [](const auto& p) { return in_um(p.transmission_error); }), harmonic_orders),
          excitation_harmonics(phases, values_of(of.cycle, [](const auto& p) { return si_stiffness * p.tangent_stiffness; }), harmonic_orders)};
}

std::string harmonics_csv(const DynamicsRun& run) {
  std::string csv = "scene,torque_Nm,order,te_um,te_angle_deg,tangent_stiffness_N_per_m,tangent_stiffness_angle_deg\n";
  for (const MeshExcitation& of : run.cases) {
    const auto [te, stiffness] = harmonics_of(of);
    for (std::size_t k = 0; k < te.size(); ++k) {
      csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(of.scene), in_Nm(of.torque), k + 1, csv_field(te[k].amplitude),
                         csv_field(in_deg(te[k].angle)), csv_field(stiffness[k].amplitude), csv_field(in_deg(stiffness[k].angle)));
    }
  }
  return csv;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

Json null_for_nan(double value) { return std::isnan(value) ? Json() : Json(value); }

Json positions_json(const std::vector<MeshExcitation::Position>& positions, const GearPair& pair) {
  Json json = Json::object();
  for (const Column& column : excitation_columns) {
    json[column.name] = list(positions, [&](const MeshExcitation::Position& position) { return null_for_nan(column.value(position, pair)); });
  }
  return json;
}

Json harmonics_json(const std::vector<ExcitationHarmonic>& harmonics) {
  return list(harmonics, [](const ExcitationHarmonic& h) -> Json {
    return {{"amplitude", null_for_nan(h.amplitude)}, {"angle_deg", null_for_nan(in_deg(h.angle))}};
  });
}

Json pair_json(const GearPair& pair) {
  const auto gear = [](const Gear& of) -> Json {
    return {{"teeth", of.data.teeth},
            {"base_radius_m", of.base_radius / 1e3},
            {"working_pitch_radius_m", of.working_pitch_radius / 1e3},
            {"hand", of.hand == Hand::Right ? "right" : "left"}};
  };
  return {{"pinion", gear(pair.pinion)},
          {"wheel", gear(pair.wheel)},
          {"working_transverse_pressure_angle_deg", in_deg(pair.working_transverse_pressure_angle)},
          {"base_helix_angle_deg", in_deg(pair.base_helix_angle)},
          {"mesh_orders_per_pinion_revolution", pair.pinion.data.teeth}};
}

Json case_json(const MeshExcitation& of, const GearPair& pair) {
  const auto [te, stiffness] = harmonics_of(of);
  const double tangent = mean_of(values_of(of.cycle, [](const auto& p) { return si_stiffness * p.tangent_stiffness; }));
  Json json{
      {"scene", of.scene},
      {"torque_Nm", in_Nm(of.torque)},
      {"normal_force_N", of.normal_force},
      {"mean_te_um", null_for_nan(mean_of(values_of(of.cycle, [](const auto& p) { return in_um(p.transmission_error); })))},
      {"mean_tangent_stiffness_N_per_m", null_for_nan(tangent)},
      {"mean_secant_stiffness_N_per_m", null_for_nan(mean_of(values_of(of.cycle, [](const auto& p) { return si_stiffness * p.secant_stiffness; })))},
      {"te_harmonics_um", harmonics_json(te)},
      {"tangent_stiffness_harmonics_N_per_m", harmonics_json(stiffness)},
      {"cycle", positions_json(of.cycle, pair)}};
  if (!of.revolution.empty()) json["revolution"] = positions_json(of.revolution, pair);
  return json;
}

}  // namespace

std::vector<ExcitationHarmonic> excitation_harmonics(const std::vector<double>& phases, const std::vector<double>& values, int orders) {
  const auto n = static_cast<double>(values.size());
  std::vector<ExcitationHarmonic> harmonics;
  for (int k = 1; k <= orders && 2 * k < std::ssize(values); ++k) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * std::polar(1.0, -2.0 * std::numbers::pi * k * phases[i]);
    harmonics.push_back({2.0 * std::abs(sum) / n, std::arg(sum)});
  }
  return harmonics;
}

DynamicsRun mesh_excitation(const Json& results, const std::string& file, StoredFlanks flanks, const ProgressReport& progress) {
  Study study;
  std::vector<Override> modifications;
  try {
    if (flanks == StoredFlanks::Final) modifications = final_modifications(results);
    study = study_to_analyse(results, modifications);
  } catch (const Json::exception& error) {
    throw InvalidInput(file, error.what(), "results.json of a study that this version has run");
  }
  StudyResults analysed = run_study(study, progress);
  if (analysed.loaded.empty()) throw InvalidInput("load.torque", "0", "a torque above 0: without load there is no mesh stiffness");
  DynamicsRun run{analysed.pair, modifications.empty() ? "given" : "after", excitation_of(analysed), {}};
  const bool single_teeth = std::ranges::any_of(
      study.scenes, [](const Scene& scene) { return has_single_teeth(scene.error.pinion) || has_single_teeth(scene.error.wheel); });
  if (single_teeth) {
    add_revolution(study, run.cases, progress);
  } else {
    run.notes.push_back("the teeth of each gear are alike: every pitch is as the first one, and there is no table of a revolution");
  }
  return run;
}

std::vector<NamedText> dynamics_files(const DynamicsRun& run) {
  Json json{{"version", version()}, {"design", run.design}, {"pair", pair_json(run.pair)}};
  json["cases"] = list(run.cases, [&](const MeshExcitation& of) { return case_json(of, run.pair); });
  std::vector<NamedText> files{
      {"dynamics.json", json.dump(1) + "\n"}, {"dynamics-cycle.csv", positions_csv(run, false)}, {"dynamics-harmonics.csv", harmonics_csv(run)}};
  if (!run.cases.front().revolution.empty()) files.push_back({"dynamics-revolution.csv", positions_csv(run, true)});
  return files;
}

}  // namespace flankwright::studies
