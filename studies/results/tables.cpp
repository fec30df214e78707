#include "studies/base/csv.hpp"
#include "studies/results/drawing.hpp"
#include "studies/results/drawing_sheet.hpp"
#include "studies/results/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/results/fidelity_choice_json.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/bodies_json.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/results/life_tables.hpp"
#include "studies/results/load_case_fields.hpp"
#include "studies/results/load_rating_tables.hpp"
#include "studies/results/shafts_json.hpp"
#include "studies/results/unloaded_tables.hpp"

namespace flankwright::studies {

namespace {

std::string cycle_csv(const StudyResults& results) {
  std::string csv = std::string(load_case_columns) +
                    ",phase,te_um,te_base_tangent_um,stiffness_N_per_mm_um,kkt_residual,pinion_root_stress_MPa,wheel_root_stress_MPa\n";
  const double cos_base_helix = std::cos(results.pair.base_helix_angle);
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    const std::string load_case = load_case_fields(loaded);
    for (std::size_t k = 0; k < loaded.cycle.positions.size(); ++k) {
      const LoadedPosition& p = loaded.cycle.positions[k];
      const double te = in_um(p.load.transmission_error);
      csv += fmt::format("{},{},{},{},{},{},{},{}\n", load_case, p.phase, te, te / cos_base_helix, p.stiffness, p.load.kkt_residual,
                         csv_field(root_stress_peak(model.positions[k], p, Member::Pinion).stress),
                         csv_field(root_stress_peak(model.positions[k], p, Member::Wheel).stress));
    }
  }
  return csv;
}

std::string points_csv(const StudyResults& results) {
  std::string csv = std::string(load_case_columns) +
                    ",phase,tooth,z_mm,pinion_radius_mm,wheel_radius_mm,load_N_per_mm,contact_stress_MPa,"
                    "contact_deflection_um,structural_deflection_um,gap_um,error_um,edge_stress_MPa,flash_temperature_K,specific_film_thickness\n";
  const std::vector<bool> with_points = cases_with_points(results);
  for (std::size_t l = 0; l < results.loaded.size(); ++l) {
    const LoadedResult& loaded = results.loaded[l];
    const MeshModel& model = results.models[loaded.model];
    const std::string load_case = load_case_fields(loaded);
    const CaseLife* life = results.life ? results.life->find(l) : nullptr;
    for (std::size_t k = 0; k < loaded.cycle.positions.size() && with_points[l]; ++k) {
      const LoadedPosition& p = loaded.cycle.positions[k];
      if (!p.load.usable()) continue;
      for (std::size_t j = 0; j < model.positions[k].points.size(); ++j) {
        const ContactPoint& c = model.positions[k].points[j];
        const auto i = static_cast<Eigen::Index>(j);
        const double on_edge = p.edge_stress.size() > 0 ? p.edge_stress[i] : not_given;
        const bool has_film = life != nullptr && !life->flash.empty();
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", load_case, p.phase, c.tooth, c.z, c.pinion_radius, c.wheel_radius,
                           p.load.line_load[i], p.contact_stress[i], in_um(p.load.contact_deflection[i]), in_um(p.load.structural_deflection[i]),
                           in_um(p.gap.total[i]), in_um(p.gap.error[i]), csv_field(on_edge), csv_field(has_film ? life->flash[k][i] : not_given),
                           csv_field(has_film ? life->film_at_points[k][i] : not_given));
      }
    }
  }
  return csv;
}

/// The entries of cycle_quantities() that have a column, as far as any load case has them; below each case how well it is known.
std::string loaded_table(const std::vector<LoadedResult>& cases, std::size_t width) {
  std::vector<CycleEntry> columns;
  for (const CycleEntry& entry : cycle_entries()) {
    const bool is_known = std::ranges::any_of(cases, [&](const LoadedResult& l) { return !std::isnan(entry.value(l.summary)); });
    if (!entry.quantity->heading.empty() && entry.order <= 1 && is_known) columns.push_back(entry);
  }
  const auto line = [&](const std::string& name, const std::string& torque, const auto& cell) {
    std::string text = fmt::format("{:<{}}  {:>10}", name, width, torque);
    for (const CycleEntry& column : columns) text += fmt::format("  {:>10}", cell(column));
    return text + "\n";
  };
  std::string out = line("loaded", "torque", [](const CycleEntry& column) { return std::string(column.quantity->heading); }) +
                    line("", "N·m", [](const CycleEntry& column) { return std::string(column.quantity->unit); });
  for (const LoadedResult& l : cases) {
    out += line(l.scene, fmt::format("{:.6g}", in_Nm(l.torque)),
                [&](const CycleEntry& column) { return fmt::format("{:.{}f}", column.value(l.summary), column.quantity->decimals); });
    const CycleErrors& errors = l.resolved.errors;
    if (std::isnan(errors.te_peak_to_peak)) continue;
    out += line("  known to", "", [&](const CycleEntry& column) { return known_to(column.error(errors, l.summary)); });
  }
  std::vector<std::string> unknown;
  for (const CycleEntry& column : columns) {
    const auto is_lost = [&](const LoadedResult& l) { return is_unknown(column.value(l.summary), column.error(l.resolved.errors, l.summary)); };
    if (std::ranges::any_of(cases, is_lost)) unknown.emplace_back(column.quantity->heading);
  }
  return out + unknown_line(unknown);
}

}  // namespace

std::size_t widest(const std::vector<std::string>& names, std::size_t least) {
  std::size_t width = least;
  for (const std::string& name : names) width = std::max(width, name.size());
  return width;
}

std::string analysis_table(const StudyResults& results) {
  std::string out;
  std::vector<std::string> names;
  for (const LoadedResult& l : results.loaded) names.push_back(l.scene);
  for (const UnloadedResult& u : results.unloaded) names.push_back(u.scene);
  const std::size_t width = widest(names, 12);
  if (!results.loaded.empty()) out += loaded_table(results.loaded, width);
  return out + load_factors_table(results, width) + life_table(results, width) + shaft_table(results, width) + rim_table(results, width) +
         unloaded_summary(results, width);
}

std::vector<NamedText> csv_tables(const StudyResults& results) {
  std::vector<NamedText> tables;
  if (!results.loaded.empty()) {
    tables.push_back({"cycle.csv", cycle_csv(results)});
    tables.push_back({"points.csv", points_csv(results)});
    tables.push_back({"load_factors.csv", load_factors_csv(results)});
    tables.push_back({"load_sharing.csv", load_sharing_csv(results)});
    if (results.life) tables.push_back({"life.csv", life_csv(results)});
  }
  if (!results.unloaded.empty()) {
    tables.push_back({"unloaded.csv", unloaded_csv(results)});
    tables.push_back({"transfers.csv", transfers_csv(results)});
    tables.push_back({"bearing_pattern.csv", bearing_pattern_csv(results)});
  }
  for (const FlankDrawing& drawing : drawings_of(results)) tables.push_back({"drawing-" + drawing.gear + ".svg", drawing_svg(drawing)});
  if (results.study.task->tables == nullptr) return tables;
  for (NamedText& table : results.study.task->tables(results)) tables.push_back(std::move(table));
  return tables;
}

std::string summary_table(const StudyResults& results) {
  const std::string chosen = results.fidelity_choice ? fidelity_choice_summary(*results.fidelity_choice) : std::string();
  return chosen + results.study.task->summary(results);
}

}  // namespace flankwright::studies
