#include "studies/comparison/compared_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/analysis/life_quantities.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/base/unit_of_name.hpp"

namespace flankwright::studies {

namespace {

/// Two values differ by round-off where they differ by no more than this share of their scale: some thousand roundings.
constexpr double round_off = 1e-12;

/// Rows in the order in which they are first seen, found again by section and name.
class Rows {
 public:
  explicit Rows(std::size_t runs) : runs_(runs) {}

  ComparedValue& row(const std::string& section, const std::string& name) {
    const auto [it, is_new] = index_.try_emplace(section + "\n" + name, rows_.size());
    if (is_new) {
      ComparedValue row;
      row.section = section;
      row.name = name;
      row.unit = unit_of_name(name);
      row.values.assign(runs_, not_given);
      rows_.push_back(std::move(row));
    }
    return rows_[it->second];
  }

  std::vector<ComparedValue> take() { return std::move(rows_); }

 private:
  std::size_t runs_;
  std::vector<ComparedValue> rows_;
  std::map<std::string, std::size_t> index_;
};

/// Names whose numbers are no results: places that jump between equal peaks, estimates of errors, numerical diagnostics, times.
bool is_left_out(const std::string& name) {
  static constexpr std::array words{
      "phase",           "tooth",     "z_mm",    "along_fillet", "worst_kkt_residual", "worst_condition", "te_convergence",           "spike_rule",
      "phase_tolerance", "positions", "profile", "seconds",      "y_alpha_um",         "hottest_z_mm",    "hottest_pinion_radius_mm", "bin"};
  return name.ends_with("_error") || name.ends_with("_at") || std::ranges::find(words, name) != words.end();
}

/// Every number below a node by its dotted path.
template <class Use>
void visit(const Json& node, const std::string& path, const Use& use) {
  const auto below = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  if (node.is_number()) use(path, node.get<double>());
  if (node.is_array()) {
    for (std::size_t i = 0; i < node.size(); ++i) visit(node[i], below(std::to_string(i)), use);
  }
  if (!node.is_object()) return;
  for (const auto& [key, child] : node.items()) {
    if (!is_left_out(key)) visit(child, below(key), use);
  }
}

const Json& member(const Json& node, const char* name) {
  static const Json nothing;
  const auto found = node.is_object() ? node.find(name) : node.end();
  return node.is_object() && found != node.end() ? *found : nothing;
}

/// What the run's own table shows of a load case.
const CycleQuantity* shown_quantity(const std::string& name) {
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const std::string key(quantity.key);
    if (name == key || (quantity.is_list && name == key + ".0")) return quantity.heading.empty() ? nullptr : &quantity;
  }
  return nullptr;
}

void add_geometry(const Json& results, std::size_t run, Rows& rows) {
  visit(member(results, "geometry"), "", [&](const std::string& name, double value) {
    ComparedValue& row = rows.row("geometry", name);
    row.values[run] = value;
    row.headline = name.ends_with("contact_ratio") || name == "overlap_ratio";
  });
}

void add_design(const Json& results, std::size_t run, Rows& rows) {
  const Json& optimise = member(results, "optimise");
  for (const char* design : {"before", "after"}) {
    const Json& of = member(optimise, design);
    const std::string section = std::string("design ") + design;
    for (const auto& [key, value] : member(of, "variables").items()) {
      ComparedValue& row = rows.row(section, key);
      row.words = plain_name(key);
      row.headline = std::string_view(design) == "after";
      if (const Json& unit = member(member(of, "variable_units"), key.c_str()); unit.is_string()) row.unit = unit;
      if (value.is_number()) row.values[run] = value;
    }
    if (const Json& objective = member(of, "objective"); objective.is_number()) {
      const Json& name = member(optimise, "objective_name");
      const std::string what = name.is_string() ? name.get<std::string>() : std::string();
      ComparedValue& row = rows.row(section, what.empty() ? "objective" : "objective " + what);  // runs may have different ones
      row.values[run] = objective;
      row.headline = true;
      row.words = plain_name(what);
      if (const Json& unit = member(optimise, "objective_unit"); unit.is_string() && !unit.get<std::string>().empty()) row.unit = unit;
    }
    for (const auto& [key, bound] : member(of, "constraints").items()) {
      ComparedValue& row = rows.row(section, "constraint " + key);
      if (const Json& unit = member(bound, "unit"); unit.is_string()) row.unit = unit;
      if (const Json& value = member(bound, "value"); value.is_number()) row.values[run] = value;
    }
  }
}

/// Of every quantity that the run's own table shows, the worst of the final load cases, where there are several.
void add_worst(const std::vector<const Json*>& cases, std::size_t run, Rows& rows) {
  if (cases.size() < 2) return;
  for (const Json* loaded : cases) {
    visit(member(*loaded, "summary"), "", [&](const std::string& name, double value) {
      const CycleQuantity* quantity = shown_quantity(name);
      if (quantity == nullptr) return;
      ComparedValue& row = rows.row("worst of the load cases", name);
      double& worst = row.values[run];
      worst = quantity->smaller_is_worse ? std::fmin(worst, value) : std::fmax(worst, value);
      row.headline = true;
      row.words = CycleEntry{quantity, quantity->is_list ? 1 : 0}.words();
    });
  }
}

constexpr std::ptrdiff_t most_headline_cases = 4;  ///< of more the worst stands for all

void add_loaded(const Json& results, std::size_t run, Rows& rows) {
  std::vector<const Json*> final_cases;
  for (const Json& loaded : member(results, "loaded")) {
    if (member(loaded, "design") != "before") final_cases.push_back(&loaded);
  }
  add_worst(final_cases, run, rows);
  for (const Json& loaded : member(results, "loaded")) {
    const std::string section = load_case_name(loaded);
    const bool in_short = member(loaded, "design") != "before" && std::ssize(final_cases) <= most_headline_cases;
    visit(member(loaded, "summary"), "", [&](const std::string& name, double value) {
      ComparedValue& row = rows.row(section, name);
      row.values[run] = value;
      if (const CycleQuantity* quantity = shown_quantity(name)) {
        row.headline = row.headline || in_short;
        row.words = CycleEntry{quantity, quantity->is_list ? 1 : 0}.words();
      }
    });
  }
}

void add_unloaded(const Json& results, std::size_t run, Rows& rows) {
  const Json& several = member(results, "unloaded_scenes");
  const auto add = [&](const Json& unloaded, const std::string& section) {
    const Json& mesh = member(unloaded, "mesh");
    for (const char* name : {"peak_to_peak_arcsec", "harmonics_arcsec"}) {
      visit(member(mesh, name), name, [&](const std::string& path, double value) {
        ComparedValue& row = rows.row(section, path);
        row.values[run] = value;
        row.headline = path == "peak_to_peak_arcsec";
      });
    }
  };
  if (!several.is_array()) return add(member(results, "unloaded"), "unloaded contact");
  for (std::size_t i = 0; i < several.size(); ++i) {
    const Json& scene = member(several[i], "scene");
    add(several[i], "unloaded contact, " + (scene.is_string() ? scene.get<std::string>() : std::to_string(i)));
  }
}

void add_life(const Json& results, std::size_t run, Rows& rows) {
  const auto is_shown = [](std::string_view key) {
    return std::ranges::any_of(life_quantities(), [&](const LifeQuantity& quantity) { return quantity.is_compared && quantity.key == key; });
  };
  const Json& life = member(results, "life");
  const auto is_final = [](const Json& of) { return member(of, "design") != "before"; };
  const Json& cases = member(life, "cases");
  const bool few = std::ranges::count_if(cases, is_final) <= most_headline_cases;
  for (const Json& of : cases) {
    visit(of, "", [&](const std::string& name, double value) {
      ComparedValue& row = rows.row("life, " + load_case_name(of), name);
      row.values[run] = value;
      row.headline = few && is_final(of) && is_shown(std::string_view(name).substr(name.rfind('.') + 1));
    });
  }
  for (const Json& of : member(life, "spectra")) {
    const std::string section = "life, spectrum of " + load_case_name(of);
    for (const char* gear : {"pinion", "wheel"}) {
      for (const char* what : {"contact", "root"}) {
        const Json& damage = member(member(member(of, gear), what), "damage");
        if (!damage.is_number()) continue;
        ComparedValue& row = rows.row(section, std::string(gear) + "." + what + "_damage");
        row.values[run] = damage;
        row.headline = is_final(of);
      }
    }
  }
}

void add_sweep(const Json& results, std::size_t run, Rows& rows) {
  for (const auto& [output, statistics] : member(member(results, "sweep"), "statistics").items()) {
    const Json& unit = member(statistics, "unit");
    const auto add = [&](const std::string& name, const Json& value) {
      ComparedValue& row = rows.row("sweep", output + " " + name);
      if (value.is_number()) row.values[run] = value;
      if (unit.is_string()) row.unit = unit;
      row.headline = (name == "mean" || name == "95 %") && shown_quantity(output) != nullptr;
    };
    for (const char* name : {"mean", "std", "min", "max"}) add(name, member(statistics, name));
    for (const auto& [name, value] : member(statistics, "quantiles").items()) add(name, value);
  }
}

/// Changes count from the first run, or from the largest value where it has none but 0. An entry of a list is as large as the largest of the list: of
/// harmonics the small ones are differences of large numbers.
void set_scales(std::vector<ComparedValue>& rows) {
  const auto list_of = [](const ComparedValue& row) {
    const std::size_t dot = row.name.rfind('.');
    const bool is_entry = dot != std::string::npos && row.name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
    return row.section + "\n" + (is_entry ? row.name.substr(0, dot) : row.name);
  };
  std::map<std::string, double> first, largest;
  for (const ComparedValue& row : rows) {
    const auto raise = [key = list_of(row)](std::map<std::string, double>& scales, double value) {
      double& scale = scales.try_emplace(key, 0.0).first->second;
      if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
    };
    raise(first, row.values.front());
    for (const double value : row.values) raise(largest, value);
  }
  for (ComparedValue& row : rows) {
    const std::string key = list_of(row);
    row.scale = first.at(key) > 0.0 ? first.at(key) : largest.at(key);
  }
}

/// A text as the file would have it: of its two forms of quotes one.
std::string with_one_kind_of_quotes(std::string value) {
  const bool is_literal = value.size() >= 2 && value.front() == '\'' && value.back() == '\'' && value.find_first_of("\"\\") == std::string::npos;
  if (is_literal) value.front() = value.back() = '"';
  return value;
}

std::vector<ComparedKey> differing_keys(const std::vector<ComparedRun>& runs) {
  std::vector<ComparedKey> keys;
  std::map<std::string, std::size_t> index;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (const Json& given : member(runs[run].results, "given")) {
      const auto [it, is_new] = index.try_emplace(given.at("key").get<std::string>(), keys.size());
      if (is_new) keys.push_back({it->first, std::vector<std::string>(runs.size())});
      keys[it->second].values[run] = with_one_kind_of_quotes(given.at("value"));
    }
  }
  std::erase_if(keys, [](const ComparedKey& key) { return std::ranges::all_of(key.values, [&](const auto& v) { return v == key.values.front(); }); });
  return keys;
}

}  // namespace

double ComparedValue::difference(std::size_t run) const {
  const double from = values.front(), to = values[run];
  if (std::isnan(from) && std::isnan(to)) return 0.0;
  return to == from ? 0.0 : (to - from) / scale;
}

bool ComparedValue::differs(std::size_t run, double tolerance) const {
  const double by = difference(run);
  return std::isnan(by) || std::abs(by) > std::max(tolerance, round_off);
}

std::string load_case_name(const Json& loaded) {
  const Json &scene = member(loaded, "scene"), &torque = member(loaded, "torque_Nm"), &design = member(loaded, "design");
  std::string name = scene.is_string() ? scene.get<std::string>() : std::string("nominal");
  if (torque.is_number()) name += fmt::format(", {:.6g} N·m", torque.get<double>());
  if (const Json& bin = member(loaded, "bin"); bin.is_number_integer()) name += fmt::format(", load {}", bin.get<int>() + 1);
  return design == "before" ? name + ", before" : name;
}

ComparedRuns compare_runs(const std::vector<ComparedRun>& runs) {
  if (runs.size() < 2) throw InvalidInput("compare", std::to_string(runs.size()) + " run", "at least two results folders");
  Rows rows(runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (!runs[run].results.is_object()) throw InvalidInput(runs[run].name, runs[run].results.type_name(), results_of_a_run);
    for (const auto& add : {add_geometry, add_design, add_loaded, add_life, add_unloaded, add_sweep}) add(runs[run].results, run, rows);
  }
  ComparedRuns compared{differing_keys(runs), rows.take()};
  set_scales(compared.values);
  return compared;
}

}  // namespace flankwright::studies
