#include "studies/study_file/study_life.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/gear/both_gears.hpp"
#include "studies/study_file/spectrum_file.hpp"
#include "studies/study_file/study_signal.hpp"

namespace flankwright::studies {

namespace {

/// Problems after which no further load is looked at: long files tend to have the same one in every row.
constexpr std::size_t most_said = 50;

constexpr double notch_of_test_gear = 2.0;  // Y_ST [ISO 6336-3]: sigma_FE = sigma_Flim Y_ST

/// A cell as a value of a study file: a number where it is nothing else.
std::unique_ptr<toml::node> node_of(const std::string& text) {
  double number = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status == std::errc{} && end == text.data() + text.size()) return std::make_unique<toml::value<double>>(number);
  return std::make_unique<toml::value<std::string>>(text);
}

void read_row(StudyReading& reading, const std::string& file, const SpectrumRow& row, int index) {
  static const KeyIndex keys = element_keys("load.spectrum");
  const SchemaKey& list = *study_keys().at("load.spectrum");
  std::get<StoreInStudy>(list.store)(reading.builder, Member::Pinion, {});
  const std::string path = "load.spectrum." + std::to_string(index) + ".";
  bool has_torque = false;
  for (const SpectrumCell& cell : row) {
    const SchemaKey& key = *keys.at(cell.key);
    has_torque = has_torque || cell.key == "torque";
    reading.positions.emplace(path + cell.key, Position{file, cell.line, cell.column});
    try {
      std::get<StoreInStudy>(key.store)(reading.builder, Member::Pinion, read_value(key, *node_of(cell.text)));
    } catch (const InvalidInput& problem) {
      reading.problems.push_back({file, cell.line, cell.column, path + cell.key, cell.text, "allowed is " + problem.allowed()});
    }
  }
  reading.positions.emplace(path.substr(0, path.size() - 1), Position{file, row.front().line, 1});
  if (!has_torque) {
    reading.problems.push_back({file, row.front().line, 1, path + "torque", "(not given)", "required: allowed is a torque in N·m"});
  }
}

/// Bins from the file or the signal that a table names.
void read_source(StudyReading& reading, const Match& match) {
  const SpectrumSource& source = reading.builder.study.spectrum_source;
  const bool has_file = reading.find("load.spectrum.file") != nullptr, has_signal = reading.find("load.spectrum.signal") != nullptr;
  if (!has_file && !has_signal) {
    return reading.refuse(match.position, match.path, match.node, "allowed is a list of tables, { file = \"x.csv\" } or { signal = \"x.csv\" }");
  }
  for (const char* key : {"counting", "bins", "hours", "repeats", "torque_factor"}) {
    const std::string path = std::string("load.spectrum.") + key;
    if (!has_signal && reading.find(path) != nullptr) reading.refuse_key(path, "has a meaning with load.spectrum.signal only");
  }
  const std::string& name = has_signal ? source.signal : source.file;
  const bool is_text = reading.find(has_signal ? "load.spectrum.signal" : "load.spectrum.file")->node->is_string();
  if ((has_file && has_signal) || !is_text) return;  // refused elsewhere
  // Relative to the study; on the command line, too, a study means the same wherever it is run from.
  const std::string path = (std::filesystem::path(reading.document.name()).parent_path() / name).string();
  try {
    int index = 0;
    if (has_signal) return read_signal(reading, path);
    for (const SpectrumRow& row : read_spectrum_file(path)) {
      if (reading.problems.size() >= most_said) {
        reading.problems.push_back({path, row.front().line, 1, match.path, "(the rows from here on)",
                                    "not looked at: there are " + std::to_string(most_said) + " problems before them"});
        break;
      }
      read_row(reading, path, row, index++);
    }
  } catch (const StudyErrors& errors) {
    for (const StudyProblem& problem : errors.problems()) {
      if (problem.line > 0) {
        reading.problems.push_back(problem);
      } else {
        reading.refuse(match.position, match.path, match.node, path + ": " + problem.allowed);
      }
    }
  }
}

void check_bin(StudyReading& reading, SpectrumBin& bin, int index) {
  const std::string path = "load.spectrum." + std::to_string(index);
  const auto refuse = [&](const std::string& key, const std::string& value, const std::string& allowed) {
    reading.refuse_value(path + "." + key, value, allowed);
  };
  const auto is_refused = [&](const std::string& of) {
    return std::ranges::any_of(reading.problems, [&](const StudyProblem& problem) { return problem.key == of; });
  };
  if (is_refused(path + ".hours") || is_refused(path + ".cycles") || is_refused(path + ".speed")) return;  // given, but not as it must be
  if (std::isnan(bin.speed)) bin.speed = reading.builder.base.speed;
  if (!std::isnan(bin.hours) && !std::isnan(bin.cycles)) return refuse("cycles", in_words(bin.cycles), "allowed is this or hours, not both");
  if (!std::isnan(bin.cycles)) return;
  if (std::isnan(bin.hours)) return refuse("hours", "(not given)", "required: allowed is a number above 0 h, or cycles instead");
  if (!(bin.speed > 0.0) && is_refused("load.speed")) return;
  if (!(bin.speed > 0.0))
    return refuse("speed", "(not given)", "required with hours: allowed is a number above 0 rpm, here or as load.speed, or cycles instead of hours");
  bin.cycles = bin.hours * bin.speed / (2.0 * units::pi);
}

std::optional<SnCurve> sn_curve(const std::optional<MaterialGrade>& grade, const GivenSnCurve& given, bool is_root) {
  double limit = given.limit;
  if (std::isnan(limit) && grade) limit = is_root ? root_stress_number(*grade) : contact_stress_number(*grade);
  if (std::isnan(limit)) return std::nullopt;
  if (is_root) limit *= notch_of_test_gear;
  if (std::isnan(given.exponent)) {
    const LifeFactors factors = given.factors.value_or(grade ? life_factors(grade->kind) : LifeFactors::CaseHardened);
    return is_root ? root_sn_curve(factors, limit) : contact_sn_curve(factors, limit);
  }
  SnCurve curve;
  curve.limit = limit;
  curve.knee = given.knee;
  curve.exponent = given.exponent;
  curve.exponent_beyond = std::isnan(given.exponent_beyond) ? given.exponent : given.exponent_beyond;
  return curve;
}

/// Where a key of a gear's material is given: its own, else that of both gears.
std::string material_path(const StudyReading& reading, Member member, const std::string& key) {
  const std::string own = std::string(name_of(member)) + ".material." + key;
  return reading.find(own) != nullptr ? own : "material." + key;
}

/// A named material is complete and in the range of its table; one that is not is forgotten.
void check_grade(StudyReading& reading, Member member) {
  std::optional<MaterialGrade>& grade = reading.builder.study.life.grade[member];
  if (!grade) return;
  const auto refuse = [&](const std::string& key, const std::string& allowed) {
    const std::string path = material_path(reading, member, "strength." + key);
    const auto said = [&](const StudyProblem& problem) { return problem.key == path; };  // of the other gear
    if (std::ranges::none_of(reading.problems, said)) reading.refuse_key(path, "allowed is " + allowed);
    grade.reset();
  };
  if (reading.find(material_path(reading, member, "strength.kind")) == nullptr) return refuse("kind", "a kind of material, with hardness");
  if (std::isnan(grade->hardness)) return refuse("hardness", "a number: a named material needs it");
  try {
    contact_stress_number(*grade);
    root_stress_number(*grade);
  } catch (const InvalidInput& problem) {
    refuse(problem.field(), problem.allowed());
  }
}

/// The curve of one gear, or that of both gears, about which nothing is said twice.
void check_curve(StudyReading& reading, const GivenSnCurve& curve, Member member, const std::string& kind) {
  const auto path_of = [&](const std::string& key) { return material_path(reading, member, kind + key); };
  const auto given = [&](const std::string& key) { return reading.find(path_of(key)) != nullptr; };
  const auto is_said = [&](const StudyProblem& problem) { return problem.key.starts_with(path_of("_sn_curve")); };
  if (std::ranges::any_of(reading.problems, is_said)) return;
  if (std::isnan(curve.exponent) != std::isnan(curve.knee)) {
    const std::string missing = std::isnan(curve.exponent) ? "_sn_curve.exponent" : "_sn_curve.knee";
    reading.refuse(reading.where(path_of("_sn_curve")), path_of(missing), nullptr, "allowed is a number: a curve of one's own has exponent and knee");
    return;
  }
  if (!std::isnan(curve.exponent_beyond) && !(curve.exponent_beyond >= curve.exponent)) {
    reading.refuse_key(path_of("_sn_curve.exponent_beyond"), "allowed is a number of at least exponent, with exponent and knee");
  }
  if (given("_sn_curve") && !given("_endurance_limit") && !reading.builder.study.life.grade[member]) {
    reading.refuse_key(path_of("_sn_curve"), "has a meaning with " + path_of("_endurance_limit") + " or material.strength only");
  }
}

/// The oil is one at this temperature, neither solid nor gas.
void check_viscosity(StudyReading& reading, const std::string& path, double temperature) {
  const Lubricant& oil = reading.builder.study.life.lubricant;
  if (oil.has_viscosity_at(temperature)) return;
  reading.refuse_value(path, in_words(temperature) + " degC",
                       fmt::format("this oil would have {:.3g} mm2/s there: allowed is a temperature at which it has {:g} .. {:g} mm2/s",
                                   oil.kinematic_viscosity(temperature).value, Lubricant::least_viscosity, Lubricant::largest_viscosity));
}

/// Teeth are no colder than the oil, and they scuff at a temperature above it.
void check_temperatures(StudyReading& reading) {
  const LifeTable& life = reading.builder.study.life;
  double hottest = life.lubricant.temperature;
  std::string of = "lubricant.temperature";
  const std::vector<SpectrumBin>& bins = reading.builder.study.spectrum;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    if (!(bins[k].temperature > hottest)) continue;
    hottest = bins[k].temperature;
    of = "load.spectrum." + std::to_string(k) + ".temperature";
  }
  if (life.bulk_temperature < hottest)
    reading.refuse_key("lubricant.bulk_temperature", "allowed is at least " + of + ", " + in_words(hottest) + " degC");
  if (life.scuffing_temperature <= hottest)
    reading.refuse_key("lubricant.scuffing_temperature", "allowed is a number above " + of + ", " + in_words(hottest) + " degC");
}

void check_lubricant(StudyReading& reading) {
  const LifeTable& life = reading.builder.study.life;
  if (!life.has_lubricant) return;
  bool complete = true;
  for (const auto& [key, value] : {std::pair{"viscosity_40", life.lubricant.viscosity_40}, std::pair{"viscosity_100", life.lubricant.viscosity_100},
                                   std::pair{"temperature", life.lubricant.temperature}, std::pair{"roughness", life.roughness}}) {
    if (!std::isnan(value)) continue;
    complete = false;
    const std::string path = std::string("lubricant.") + key;
    if (!reading.positions.contains(path)) {  // else it is refused already
      reading.refuse(reading.where("lubricant"), path, nullptr, "required: allowed is " + allowed_values(*study_keys().at(path)));
    }
  }
  if (!complete) return;
  if (!(life.lubricant.viscosity_40 > life.lubricant.viscosity_100)) {
    return reading.refuse_key("lubricant.viscosity_40", "allowed is a number above viscosity_100");
  }
  check_viscosity(reading, "lubricant.temperature", life.lubricant.temperature);
  check_temperatures(reading);
  if (!std::isnan(life.bulk_temperature)) check_viscosity(reading, "lubricant.bulk_temperature", life.bulk_temperature);
  const std::vector<SpectrumBin>& bins = reading.builder.study.spectrum;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    if (!std::isnan(bins[k].temperature)) check_viscosity(reading, "load.spectrum." + std::to_string(k) + ".temperature", bins[k].temperature);
  }
}

}  // namespace

void read_spectrum(StudyReading& reading) {
  const Match* match = reading.find("load.spectrum");
  if (match == nullptr) return;
  const std::size_t problems = reading.problems.size();
  if (match->node->is_table()) read_source(reading, *match);
  std::vector<SpectrumBin>& bins = reading.builder.study.spectrum;
  if (reading.problems.size() > problems) return;
  std::vector<double>& torques = reading.builder.base.torques;
  torques.clear();
  for (std::size_t k = 0; k < bins.size(); ++k) {
    if (std::isnan(bins[k].torque)) continue;  // refused where it is read
    if (!reading.builder.study.signal && reading.problems.size() < most_said) check_bin(reading, bins[k], static_cast<int>(k));
    torques.push_back(std::max(0.0, bins[k].torque));
  }
  if (torques.empty()) torques = {0.0};
  const bool is_idle = !bins.empty() && std::ranges::all_of(bins, [](const SpectrumBin& bin) { return bin.torque == 0.0; });
  if (is_idle) reading.refuse(match->position, match->path, match->node, "allowed is a spectrum with a torque other than 0");
}

namespace {

/// Where the spectrum has a direction, scenes that load the other flank take the torques below 0.
void reverse_torques(Study& study) {
  if (std::ranges::none_of(study.spectrum, [](const SpectrumBin& bin) { return bin.torque < 0.0; })) return;
  for (Scene& scene : study.scenes) {
    if (!loads_other_flanks(study, scene) || scene.torques.size() != study.spectrum.size()) continue;
    for (std::size_t k = 0; k < scene.torques.size(); ++k) scene.torques[k] = std::max(0.0, -study.spectrum[k].torque);
  }
}

}  // namespace

void check_life(StudyReading& reading) {
  reverse_torques(reading.builder.study);
  const Study& study = reading.builder.study;
  for (const Member m : both_gears) {
    check_grade(reading, m);
    check_curve(reading, study.life.contact[m], m, "contact");
    check_curve(reading, study.life.root[m], m, "root");
  }
  check_lubricant(reading);
  if (reading.find("load.spectrum") == nullptr) return;
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    for (const char* key : {"load.torque", "load.speed"}) {
      const std::string path = "scenes." + std::to_string(i) + "." + key;
      if (!reading.positions.contains(path)) continue;
      reading.refuse_value(path, "beside load.spectrum", "allowed is this or load.spectrum, which holds in every scene");
    }
  }
}

std::shared_ptr<const LifeModel> life_model(const Study& study) {
  if (!asks_for_life(study)) return nullptr;
  auto model = std::make_shared<LifeModel>();
  const LifeTable& life = study.life;
  for (const Member m : both_gears) {
    model->strength[m] = {sn_curve(life.grade[m], life.contact[m], false), sn_curve(life.grade[m], life.root[m], true)};
    if (study.body[m].web) model->rim_thickness[m] = study.body[m].web->rim_thickness;
  }
  if (study.life.has_lubricant) model->lubricant = study.life.lubricant;
  model->roughness = study.life.roughness / units::um;
  model->bulk_temperature = study.life.bulk_temperature;
  model->permissible_film = study.life.permissible_film;
  model->scuffing_temperature = study.life.scuffing_temperature;
  return model;
}

bool has_strength(const Study& study) {
  return std::ranges::any_of(
      both_gears, [&](Member m) { return study.life.grade[m] || !std::isnan(study.life.contact[m].limit) || !std::isnan(study.life.root[m].limit); });
}

bool asks_for_life(const Study& study) {
  const auto has_speed = [](const Scene& scene) { return !std::isnan(scene.speed); };
  const bool has_load_factor = study.life.application_factor != 1.0 || study.life.dynamic_factor != 1.0;
  return !study.spectrum.empty() || study.life.has_lubricant || has_load_factor || has_strength(study) ||
         std::ranges::any_of(study.scenes, has_speed);
}

}  // namespace flankwright::studies
