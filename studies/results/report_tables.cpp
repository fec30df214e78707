#include "studies/base/csv.hpp"
#include "studies/results/report_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <functional>

#include "studies/base/json_format.hpp"
#include "studies/results/load_case_fields.hpp"

namespace flankwright::studies {

namespace {

/// A value as a CSV field; empty for null.
std::string field(const Json& value) {
  if (value.is_null()) return {};
  return csv_field(value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Every value below a node with its dotted path; lists of numbers stay one value.
void visit(const Json& node, const std::string& path, const std::function<void(const std::string&, const Json&)>& use) {
  if (!node.is_object()) return use(path, node);
  for (const auto& [key, value] : node.items()) visit(value, path.empty() ? key : path + "." + key, use);
}

std::string key_value_csv(const Json& node) {
  std::string csv = "key,value\n";
  visit(node, "", [&](const std::string& path, const Json& value) { csv += csv_field(path) + "," + field(value) + "\n"; });
  return csv;
}

std::string gears_csv(const Json& geometry) {
  std::string csv = "quantity,pair,pinion,wheel\n";
  for (const auto& [key, value] : geometry.items()) {
    if (key == "pinion" || key == "wheel") continue;
    visit(value, key, [&](const std::string& path, const Json& number) { csv += path + "," + field(number) + ",,\n"; });
  }
  for (const auto& [key, value] : geometry.at("pinion").items()) {
    if (key != "profile") csv += key + ",," + field(value) + "," + field(geometry.at("wheel").at(key)) + "\n";
  }
  return csv;
}

/// The fields of load_case_columns.
std::string case_fields(const Json& loaded) {
  return field(loaded.at("scene")) + "," + field(loaded.at("torque_Nm")) + "," + field(loaded.at("design")) + "," +
         field(loaded.value("bin", Json()));
}

/// Every number of every summary: a line each, since what is rated differs from case to case.
std::string summary_csv(const Json& cases) {
  std::string csv = std::string(load_case_columns) + ",quantity,value\n";
  for (const Json& loaded : cases) {
    visit(loaded.at("summary"), "", [&](const std::string& path, const Json& value) {
      if (!value.is_structured() && !value.is_null()) csv += case_fields(loaded) + "," + csv_field(path) + "," + field(value) + "\n";
    });
  }
  return csv;
}

std::string harmonics_csv(const Json& cases) {
  std::string csv = std::string(load_case_columns) + ",order,te_um\n";
  for (const Json& loaded : cases) {
    int order = 0;
    for (const Json& harmonic : loaded.at("summary").at("te_harmonics_um")) {
      csv += case_fields(loaded) + fmt::format(",{},", ++order) + field(harmonic) + "\n";
    }
  }
  return csv;
}

/// The value of a key; null where there is none.
Json value_or_null(const Json& of, const std::string& key) { return of.contains(key) ? of.at(key) : Json(); }

std::string design_csv(const Json& optimise) {
  const Json &before = optimise.at("before"), &after = optimise.at("after");
  std::string csv = "kind,name,unit,before,after,limit,before_error,after_error\n";
  const auto add = [&](const std::string& kind, const Json& name, const Json& unit, const std::array<Json, 2>& values, const Json& limit = {},
                       const std::array<Json, 2>& errors = {}) {
    csv += kind;
    for (const Json& cell : {name, unit, values[0], values[1], limit, errors[0], errors[1]}) csv += "," + field(cell);
    csv += "\n";
  };
  for (const auto& [name, value] : before.at("variables").items())
    add("variable", name, before.at("variable_units").at(name), {value, after.at("variables").at(name)});
  add("objective", optimise.at("objective_name"), optimise.at("objective_unit"), {before.at("objective"), after.at("objective")}, {},
      {value_or_null(before, "objective_error"), value_or_null(after, "objective_error")});
  for (std::size_t k = 1; optimise.contains("stages") && k < optimise.at("stages").size(); ++k) {  // of a list of objectives
    const Json& stage = optimise.at("stages")[k];
    const auto of = [k](const Json& design, const char* key) { return design.contains(key) ? design.at(key)[k - 1] : Json(); };
    add("objective", stage.at("objective"), stage.at("unit"), {of(before, "later_objectives"), of(after, "later_objectives")}, {},
        {of(before, "later_objectives_error"), of(after, "later_objectives_error")});
  }
  const Json known_before = value_or_null(before, "constraints_error"), known_after = value_or_null(after, "constraints_error");
  for (const auto& [name, bound] : before.at("constraints").items()) {
    add("constraint", name, bound.at("unit"), {bound.at("value"), after.at("constraints").at(name).at("value")},
        bound.at(bound.contains("max") ? "max" : "min"), {value_or_null(known_before, name), value_or_null(known_after, name)});
  }
  return csv;
}

std::string effects_csv(const Json& effects) {
  std::string csv = "name,on,why,seconds,size_from,te_mean_change_um,te_peak_to_peak_change_um,peak_contact_stress_change_MPa,share_percent\n";
  for (const Json& effect : effects) {
    csv += field(effect.at("name")) + "," + field(effect.at("on")) + "," + field(effect.at("why")) + "," + field(effect.at("seconds"));
    const char* from = !effect.at("exact").is_null() ? "exact" : "estimate";
    const Json& size = effect.at(from);
    if (size.is_null()) {
      csv += ",,,,,\n";
      continue;
    }
    csv += std::string(",") + from + "," + field(size.at("te_mean_change_um")) + "," + field(size.at("te_peak_to_peak_change_um")) + "," +
           field(size.at("peak_contact_stress_change_MPa")) + "," + field(size.at("share_percent")) + "\n";
  }
  return csv;
}

std::string steps_csv(const Json& steps) {
  std::string csv = "name,why,seconds\n";
  for (const Json& step : steps) csv += field(step.at("name")) + "," + field(step.at("why")) + "," + field(step.at("seconds")) + "\n";
  return csv;
}

std::string given_csv(const Json& given) {
  std::string csv = "key,value,unit\n";
  for (const Json& entry : given) csv += field(entry.at("key")) + "," + field(entry.at("value")) + "," + entry.value("unit", "") + "\n";
  return csv;
}

}  // namespace

std::vector<NamedText> report_tables(const Json& json) {
  std::vector<NamedText> tables{
      {"gears.csv", gears_csv(json.at("geometry"))}, {"given.csv", given_csv(json.at("given"))}, {"used.csv", key_value_csv(json.at("used"))}};
  if (!json.at("effects").empty()) tables.push_back({"effects.csv", effects_csv(json["effects"])});
  if (!json.at("steps").empty()) tables.push_back({"steps.csv", steps_csv(json["steps"])});
  if (!json.at("loaded").empty()) {
    tables.push_back({"summary.csv", summary_csv(json["loaded"])});
    tables.push_back({"harmonics.csv", harmonics_csv(json["loaded"])});
  }
  if (json.contains("optimise")) tables.push_back({"design.csv", design_csv(json["optimise"])});
  return tables;
}

}  // namespace flankwright::studies
