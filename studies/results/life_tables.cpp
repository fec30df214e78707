#include "studies/results/load_case_fields.hpp"
#include "studies/results/life_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/known_to.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array each_gear{Member::Pinion, Member::Wheel};

std::string life_number(double value, const char* form) { return std::isnan(value) ? std::string("-") : fmt::format(fmt::runtime(form), value); }

/// The larger of both gears; NaN where neither has one.
double worst_damage(const PerGear<double>& of) { return std::fmax(of.pinion, of.wheel); }
double least_safety(const PerGear<double>& of) { return std::fmin(of.pinion, of.wheel); }

struct LifeColumn {
  const char *heading, *unit, *form;
  double (*value)(const CaseLife&, const LoadedResult&);
  double CaseLifeErrors::*error{nullptr};  ///< null: none is estimated
};

constexpr std::array<LifeColumn, 12> life_columns{{
    {"cycles", "pinion", "{:.3g}", [](const CaseLife&, const LoadedResult& l) { return l.operation.revolutions; }},
    {"contact", "damage", "{:.3g}", [](const CaseLife& c, const LoadedResult&) { return worst_damage(c.contact_damage); }},
    {"root", "damage", "{:.3g}", [](const CaseLife& c, const LoadedResult&) { return worst_damage(c.root_damage); }},
    {"contact", "safety", "{:.2f}", [](const CaseLife& c, const LoadedResult&) { return least_safety(c.contact_safety); }},
    {"root", "safety", "{:.2f}", [](const CaseLife& c, const LoadedResult&) { return least_safety(c.root_safety); }},
    {"S_H", "ISO 6336", "{:.2f}", [](const CaseLife& c, const LoadedResult&) { return least_safety(c.iso_contact_safety); }},
    {"S_F", "ISO 6336", "{:.2f}", [](const CaseLife& c, const LoadedResult&) { return least_safety(c.iso_root_safety); }},
    {"H_VL", "-", "{:.4f}", [](const CaseLife& c, const LoadedResult&) { return c.loss_factor; }, &CaseLifeErrors::loss_factor},
    {"loss", "W", "{:.4g}", [](const CaseLife& c, const LoadedResult&) { return c.loss_power; }, &CaseLifeErrors::loss_power},
    {"film", "lambda", "{:.3f}", [](const CaseLife& c, const LoadedResult&) { return c.film; }, &CaseLifeErrors::film},
    {"theta_B", "degC", "{:.1f}", [](const CaseLife& c, const LoadedResult&) { return c.contact_temperature; }, &CaseLifeErrors::contact_temperature},
    {"S_B", "scuffing", "{:.2f}", [](const CaseLife& c, const LoadedResult&) { return c.scuffing_safety; }, &CaseLifeErrors::scuffing_safety},
}};

std::string sum_line(const SpectrumLife& spectrum, std::size_t width) {
  std::string out;
  for (const auto& [name, points] : {std::pair{"contact damage", &spectrum.contact}, std::pair{"root damage", &spectrum.root}}) {
    for (const Member m : each_gear) {
      const std::optional<DamagedPoint>& point = (*points)[m];
      if (!point) continue;
      const std::string where =
          std::isnan(point->radius) ? fmt::format("z {:.2f} mm", point->z) : fmt::format("z {:.2f} mm, radius {:.3f} mm", point->z, point->radius);
      const std::string error = std::isnan(point->damage_error) ? std::string() : fmt::format(" + {:.2g}", point->damage_error);
      out += fmt::format("{:<{}}  {} of the {}: {:.4g}{} over the spectrum, largest at {}{}\n", spectrum.scene + " " + spectrum.design, width, name,
                         name_of(m), point->damage, error, where, point->exceeds_static_limit ? "; a load case exceeds the static limit" : "");
    }
  }
  return out;
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
  const auto has_safety = [](const CaseLife& c) {
    return !std::isnan(least_safety(c.iso_contact_safety)) || !std::isnan(least_safety(c.iso_root_safety));
  };
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
  std::vector<const LifeColumn*> shown;
  for (const LifeColumn& column : life_columns) {
    const auto known = [&](const CaseLife& c) { return !std::isnan(column.value(c, results.loaded[c.loaded])); };
    if (std::ranges::any_of(life.cases, known)) shown.push_back(&column);
  }
  // A long spectrum in many scenes is read in life.csv.
  constexpr std::size_t most_cases = 60;
  std::string out = fmt::format("\n{:<{}}  {:>10}", "life", width, "torque"), units = fmt::format("{:<{}}  {:>10}", "", width, "N·m");
  for (const LifeColumn* column : shown) {
    out += fmt::format("  {:>9}", column->heading);
    units += fmt::format("  {:>9}", column->unit);
  }
  out += "\n" + units + "\n";
  for (std::size_t c = 0; c < std::min(most_cases, life.cases.size()); ++c) {
    const CaseLife& of = life.cases[c];
    const LoadedResult& loaded = results.loaded[of.loaded];
    const std::string design = loaded.design == "given" ? std::string() : fmt::format(" {}", loaded.design);
    out += fmt::format("{:<{}}  {:>10.6g}", loaded.scene + design, width, in_Nm(loaded.torque));
    for (const LifeColumn* column : shown) out += fmt::format("  {:>9}", life_number(column->value(of, loaded), column->form));
    out += "\n";
    if (std::isnan(of.errors.loss_factor)) continue;
    out += fmt::format("{:<{}}  {:>10}", "  known to", width, "");
    for (const LifeColumn* column : shown)
      out += fmt::format("  {:>9}", column->error == nullptr ? std::string() : known_to(of.errors.*column->error));
    out += "\n";
  }
  if (life.cases.size() > most_cases) out += fmt::format("... {} load cases more in life.csv\n", life.cases.size() - most_cases);
  for (const SpectrumLife& spectrum : life.spectra) out += sum_line(spectrum, width);
  out += load_factor_line(life.cases);
  for (const Member m : each_gear) out += grade_line(results.study.life, m);
  return out;
}

std::string life_csv(const StudyResults& results) {
  std::string csv =
      std::string(load_case_columns) +
      ",cycles,gear,contact_damage,root_damage,contact_safety,root_safety,sigma_H_MPa,sigma_F_MPa,S_H,S_F,"
      "loss_factor,loss_power_W,specific_film_thickness,micropitting_safety,flash_temperature_K,contact_temperature_degC,scuffing_safety,"
      "loss_factor_error,loss_power_W_error,specific_film_thickness_error,micropitting_safety_error,flash_temperature_K_error,contact_temperature_degC_error,"
      "scuffing_safety_error,K_A,K_v\n";
  for (const CaseLife& of : results.life->cases) {
    const LoadedResult& loaded = results.loaded[of.loaded];
    for (const Member m : each_gear) {
      csv += fmt::format("{},{},{}", load_case_fields(loaded), csv_field(loaded.operation.revolutions), name_of(m));
      for (const double value : {of.contact_damage[m],
                                 of.root_damage[m],
                                 of.contact_safety[m],
                                 of.root_safety[m],
                                 of.iso_contact[m],
                                 of.iso_root[m],
                                 of.iso_contact_safety[m],
                                 of.iso_root_safety[m],
                                 of.loss_factor,
                                 of.loss_power,
                                 of.film,
                                 of.micropitting_safety,
                                 of.flash_temperature,
                                 of.contact_temperature,
                                 of.scuffing_safety,
                                 of.errors.loss_factor,
                                 of.errors.loss_power,
                                 of.errors.film,
                                 of.errors.micropitting_safety,
                                 of.errors.flash_temperature,
                                 of.errors.contact_temperature,
                                 of.errors.scuffing_safety,
                                 loaded.operation.application_factor,
                                 loaded.operation.dynamic_factor}) {
        csv += fmt::format(",{}", csv_field(value));
      }
      csv += "\n";
    }
  }
  return csv;
}

}  // namespace flankwright::studies
