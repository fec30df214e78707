#include "studies/results/load_case_fields.hpp"
#include "studies/results/life_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/gear/both_gears.hpp"
#include "studies/analysis/life_quantities.hpp"
#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/known_to.hpp"

namespace flankwright::studies {

namespace {

/// The rows of life.csv: damage first, then what else each gear has, then what the pair has.
std::vector<const LifeQuantity*> column_order() {
  std::vector<const LifeQuantity*> rows;
  for (const LifeQuantity& quantity : life_quantities()) {
    if (quantity.is_in_csv) rows.push_back(&quantity);
  }
  std::ranges::stable_sort(rows, {}, [](const LifeQuantity* row) { return row->of_spectrum != nullptr ? 0 : row->of_gears != nullptr ? 1 : 2; });
  return rows;
}

std::string life_number(double value, std::string_view form) { return std::isnan(value) ? std::string("-") : fmt::format(fmt::runtime(form), value); }

/// "2526 + 1.2 over the spectrum", or that an error as large as the value leaves it unknown.
std::string damage_in_words(double damage, double error) {
  constexpr double negligible = 1e-6;  // a damage below this is no damage, however well it is known
  if (is_unknown(damage, error) && damage + error > negligible) {
    return fmt::format(
        "not known at this resolution: {:.4g} over the spectrum with an error of {:.2g} (more cycle.positions or intervals make it smaller),", damage,
        error);
  }
  return fmt::format("{:.4g}{} over the spectrum,", damage, std::isnan(error) ? std::string() : fmt::format(" + {:.2g}", error));
}

std::string sum_line(const SpectrumLife& spectrum, std::size_t width) {
  std::string out;
  for (const auto& [name, points] : {std::pair{"contact damage", &spectrum.contact}, std::pair{"root damage", &spectrum.root}}) {
    for (const Member m : both_gears) {
      const std::optional<DamagedPoint>& point = (*points)[m];
      if (!point) continue;
      const std::string where =
          std::isnan(point->radius) ? fmt::format("z {:.2f} mm", point->z) : fmt::format("z {:.2f} mm, radius {:.3f} mm", point->z, point->radius);
      out += fmt::format("{:<{}}  {} of the {}: {} largest at {}{}\n", spectrum.scene + " " + spectrum.design, width, name, name_of(m),
                         damage_in_words(point->damage, point->damage_error), where,
                         point->exceeds_static_limit ? "; a load case exceeds the static limit" : "");
    }
  }
  return out;
}

/// By which editions S_H and S_F are, where some load case has them.
std::string edition_line(const std::vector<CaseLife>& cases) {
  const auto is_known = [](const PerGear<double>& of) { return !std::isnan(of.pinion) || !std::isnan(of.wheel); };
  std::vector<std::string> editions;
  if (std::ranges::any_of(cases, [&](const CaseLife& c) { return is_known(c.iso_contact_safety); }))
    editions.push_back(fmt::format("S_H by {}", contact_stress_edition));
  if (std::ranges::any_of(cases, [&](const CaseLife& c) { return is_known(c.iso_root_safety); }))
    editions.push_back(fmt::format("S_F by {}", root_stress_edition));
  return editions.empty() ? std::string() : fmt::format("method B: {}\n", fmt::join(editions, "; "));
}

/// "pinion of case_hardened MQ, 700 HV: sigma_Hlim 1400 MPa of the study (ISO 6336-5: 1500), sigma_Flim 425 MPa of ISO 6336-5"
std::string grade_line(const LifeTable& life, Member m) {
  if (!life.grade[m]) return {};
  const MaterialGrade& grade = *life.grade[m];
  const auto limit = [](const GivenSnCurve& given, double of_table) {
    return std::isnan(given.limit) ? fmt::format("{:.5g} MPa of ISO 6336-5", of_table)
                                   : fmt::format("{:.5g} MPa of the study (ISO 6336-5: {:.5g})", given.limit, of_table);
  };
  return fmt::format("{} of {} {}, {:g} {}: sigma_Hlim {}, sigma_Flim {}\n", name_of(m), to_string(grade.kind), to_string(grade.quality),
                     grade.hardness, hardness_scale(grade.kind), limit(life.contact[m], contact_stress_number(grade)),
                     limit(life.root[m], root_stress_number(grade)));
}

/// Which load factors S_H and S_F have, where they are not those of the loaded contact.
std::string load_factor_line(const std::vector<CaseLife>& cases) {
  const auto is_known = [](const PerGear<double>& of) { return !std::isnan(of.pinion) || !std::isnan(of.wheel); };
  const auto has_safety = [&](const CaseLife& c) { return is_known(c.iso_contact_safety) || is_known(c.iso_root_safety); };
  const auto of_contact = std::ranges::count_if(cases, [&](const CaseLife& c) { return has_safety(c) && c.K_from_contact; });
  const auto rated = std::ranges::count_if(cases, has_safety);
  if (of_contact == rated) return {};
  return fmt::format(
      "{}: K_H by ISO 6336-1 method C, to which a lead slope is a misalignment; cycle.peaks = \"refined\" takes "
      "K_H of the loaded contact\n",
      of_contact > 0 ? "S_H, S_F of load cases that do not use the strength most" : "S_H, S_F");
}

}  // namespace

std::string life_table(const StudyResults& results, std::size_t width) {
  if (!results.life) return {};
  const StudyLife& life = *results.life;
  const auto known = [&](const auto& value) { return std::ranges::any_of(life.cases, [&](const CaseLife& c) { return !std::isnan(value(c)); }); };
  const auto cycles = [&](const CaseLife& c) { return results.loaded[c.loaded].operation.revolutions; };
  const bool has_cycles = known(cycles);
  std::vector<const LifeQuantity*> shown = column_order();
  std::erase_if(shown,
                [&](const LifeQuantity* row) { return row->column.heading.empty() || !known([&](const CaseLife& c) { return row->worst(c); }); });
  const auto line = [&](const std::string& name, const std::string& torque, const std::string& cycles_cell, const auto& cell) {
    std::string text = fmt::format("{:<{}}  {:>10}", name, width, torque);
    if (has_cycles) text += fmt::format("  {:>9}", cycles_cell);
    for (const LifeQuantity* row : shown) text += fmt::format("  {:>9}", cell(*row));
    return text + "\n";
  };
  // A long spectrum in many scenes is read in life.csv.
  constexpr std::size_t most_cases = 60;
  std::string out =
      "\n" + line("life", "torque", "cycles", [](const LifeQuantity& row) { return row.column.heading; }) +
      line("", "N·m", "pinion", [](const LifeQuantity& row) { return row.column.subheading.empty() ? row.unit() : row.column.subheading; });
  for (std::size_t c = 0; c < std::min(most_cases, life.cases.size()); ++c) {
    const CaseLife& of = life.cases[c];
    const LoadedResult& loaded = results.loaded[of.loaded];
    const std::string design = loaded.design == "given" ? std::string() : fmt::format(" {}", loaded.design);
    out += line(loaded.scene + design, fmt::format("{:.6g}", in_Nm(loaded.torque)), life_number(cycles(of), "{:.3g}"),
                [&](const LifeQuantity& row) { return life_number(row.worst(of), row.column.form); });
    if (std::isnan(of.errors.loss_factor)) continue;
    out += line("  known to", "", "", [&](const LifeQuantity& row) { return row.error == nullptr ? std::string() : known_to(of.errors.*row.error); });
  }
  if (life.cases.size() > most_cases) out += fmt::format("... {} load cases more in life.csv\n", life.cases.size() - most_cases);
  std::vector<std::string> unknown;
  for (const LifeQuantity* row : shown) {
    const auto is_lost = [&](const CaseLife& of) { return row->error != nullptr && is_unknown(row->worst(of), of.errors.*row->error); };
    if (std::ranges::any_of(life.cases, is_lost)) unknown.emplace_back(row->column.heading);
  }
  out += unknown_line(unknown);
  for (const SpectrumLife& spectrum : life.spectra) out += sum_line(spectrum, width);
  out += edition_line(life.cases) + load_factor_line(life.cases);
  for (const Member m : both_gears) out += grade_line(results.study.life, m);
  return out;
}

std::string life_csv(const StudyResults& results) {
  const std::vector<const LifeQuantity*> columns = column_order();
  std::string csv = std::string(load_case_columns) + ",cycles,gear";
  for (const LifeQuantity* row : columns) csv += fmt::format(",{}", row->key);
  for (const LifeQuantity* row : columns) csv += row->error != nullptr ? fmt::format(",{}_error", row->key) : std::string();
  csv += ",K_A,K_v\n";
  for (const CaseLife& of : results.life->cases) {
    const LoadedResult& loaded = results.loaded[of.loaded];
    for (const Member m : both_gears) {
      csv += fmt::format("{},{},{}", load_case_fields(loaded), csv_field(loaded.operation.revolutions), name_of(m));
      for (const LifeQuantity* row : columns) csv += "," + csv_field(row->of(of, m));
      for (const LifeQuantity* row : columns) csv += row->error != nullptr ? "," + csv_field(of.errors.*row->error) : std::string();
      csv += fmt::format(",{},{}\n", csv_field(loaded.operation.application_factor), csv_field(loaded.operation.dynamic_factor));
    }
  }
  return csv;
}

}  // namespace flankwright::studies
