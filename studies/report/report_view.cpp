#include "studies/report/report_view.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "studies/report/plain_names.hpp"

namespace flankwright::studies {
namespace {

using nlohmann::json;

constexpr int significant_digits = 6;
/// Of the unloaded transmission error: backlash may lift it by a thousand arcsec, and a thousandth is of interest.
constexpr int te_digits = 10;

/// The double nearest to x that this many significant digits can write; its shortest text has at most these digits.
double rounded(double x, int digits) {
  if (!std::isfinite(x)) return x;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, x);
  return std::strtod(text.data(), nullptr);
}

void round_numbers(json& node, int digits) {
  if (node.is_number_float()) {
    node = rounded(node.get<double>(), digits);
  } else if (node.is_object()) {
    for (auto& [key, child] : node.items()) round_numbers(child, key == "te_arcsec" ? te_digits : digits);
  } else if (node.is_array()) {
    for (json& child : node) round_numbers(child, digits);
  }
}

/// List of points -> object of columns.
json columns_of(const json& points) {
  json columns = json::object();
  for (const char* key : {"z_mm", "pinion_radius_mm", "load_N_per_mm", "contact_stress_MPa", "gap_um"}) {
    json& column = columns[key] = json::array();
    for (const json& point : points) column.push_back(point.is_object() ? point.value(key, json()) : json());
  }
  return columns;
}

/// Calls visit(child) for every element of the array node[key], where there is one.
template <class Visitor>
void for_each_in(json& node, const char* key, Visitor&& visit) {
  if (!node.is_object()) return;
  const auto found = node.find(key);
  if (found == node.end() || !found->is_array()) return;
  for (json& child : *found) visit(child);
}

}  // namespace

nlohmann::json report_view(nlohmann::json results) {
  for_each_in(results, "loaded", [](json& entry) {
    if (entry.is_object() && entry.contains("gradients") && entry["gradients"].is_object()) {
      for (const char* part : {"cycle", "shafts"}) entry["gradients"].erase(part);  // the page has those of the summary
    }
    for_each_in(entry, "cycle", [](json& position) {
      for_each_in(position, "teeth", [](json& tooth) {
        if (!tooth.is_object()) return;
        const auto points = tooth.find("points");
        if (points != tooth.end() && points->is_array()) *points = columns_of(*points);
        tooth.erase("line_ends");  // no picture draws them
      });
    });
  });
  if (!results.is_object()) return results;
  json& names = results["names"] = json::array();  // in the order in which tables list them
  for (const PlainName& name : plain_names()) names.push_back({name.key, name.name, name.symbol, name.sense});
  for (auto& [key, section] : results.items()) {
    if (key != "given" && key != "used") round_numbers(section, significant_digits);
  }
  return results;
}

}  // namespace flankwright::studies
