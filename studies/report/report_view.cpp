#include "studies/report/report_view.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/base/plain_names.hpp"

namespace flankwright::studies {
namespace {

constexpr int significant_digits = 6;
/// Of the unloaded transmission error: backlash may lift it by a thousand arcsec, and a thousandth is of interest.
constexpr int te_digits = 10;

/// The double nearest to x that this many significant digits can write; its shortest text has at most these digits.
double rounded(double x, int digits) {
  if (!std::isfinite(x)) return x;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, digits - 1);
  std::from_chars(text.data(), end.ptr, x);
  return x;
}

/// A copy with its numbers rounded.
Json drawn(const Json& node, int digits = significant_digits) {
  if (node.is_number_float()) return rounded(node.get<double>(), digits);
  if (!node.is_structured()) return node;
  Json copy = node.is_object() ? Json::object() : Json::array();
  if (node.is_array()) {
    for (const Json& child : node) copy.push_back(drawn(child, digits));
  } else {
    for (const auto& [key, child] : node.items()) copy[key] = drawn(child, key == "te_arcsec" ? te_digits : digits);
  }
  return copy;
}

/// A copy of an object, with one of its members drawn in its own way; anything else is drawn as it is.
template <class Draw>
Json drawn_with(const Json& node, const char* member, const Draw& draw_member) {
  if (!node.is_object()) return drawn(node);
  Json copy = Json::object();
  for (const auto& [key, child] : node.items()) copy[key] = key == member ? draw_member(child) : drawn(child);
  return copy;
}

template <class Draw>
Json drawn_list(const Json& list, const Draw& draw_entry) {
  if (!list.is_array()) return drawn(list);
  Json copy = Json::array();
  for (const Json& entry : list) copy.push_back(draw_entry(entry));
  return copy;
}

/// A member of an object; null where it has none.
/// @param place  index at which it is looked for first and, afterwards, at which it was found
const Json* member_near(const Json& object, std::string_view key, std::ptrdiff_t& place) {
  if (!object.is_object()) return nullptr;
  const auto& members = object.get_ref<const Json::object_t&>();
  const auto is_at = [&](std::ptrdiff_t i) { return i < std::ssize(members) && members.begin()[i].first == key; };
  if (!is_at(place)) place = std::ranges::find_if(members, [&](const auto& member) { return member.first == key; }) - members.begin();
  return is_at(place) ? &members.begin()[place].second : nullptr;
}

/// List of points -> object of columns; those of tip edges and of the film only where a point of the list has them, the radius of the wheel only where life is drawn on it.
Json columns_of(const Json& points, bool has_life) {
  if (!points.is_array()) return drawn(points);
  const auto has_any = [&](const char* key) { return std::ranges::any_of(points, [&](const Json& point) { return point.contains(key); }); };
  std::vector<const char*> keys{"z_mm", "pinion_radius_mm", "load_N_per_mm", "contact_stress_MPa", "gap_um"};
  if (has_life) keys.push_back("wheel_radius_mm");
  if (has_any("specific_film_thickness")) keys.insert(keys.end(), {"specific_film_thickness", "flash_temperature_K"});
  if (has_any("tip_edge")) keys.insert(keys.end(), {"edge_stress_MPa", "tip_edge"});
  Json columns = Json::object();
  for (const char* key : keys) {
    Json& column = columns[key] = Json::array();
    std::ptrdiff_t place = 0;  // of the key in a point; nearly always that in the point before
    for (const Json& point : points) {
      const Json* value = member_near(point, key, place);
      column.push_back(value != nullptr ? drawn(*value) : Json());
    }
  }
  return columns;
}

/// Without the ends of lines, which no picture draws.
Json drawn_tooth(const Json& tooth, bool has_life) {
  Json copy = drawn_with(tooth, "points", [&](const Json& points) { return columns_of(points, has_life); });
  if (copy.is_object()) copy.erase("line_ends");
  return copy;
}

Json drawn_position(const Json& position, bool has_life) {
  const auto tooth = [&](const Json& entry) { return drawn_tooth(entry, has_life); };
  return drawn_with(position, "teeth", [&](const Json& teeth) { return drawn_list(teeth, tooth); });
}

/// Of the gradients the page has those of the summary.
Json drawn_case(const Json& entry, bool has_life) {
  const auto position = [&](const Json& at) { return drawn_position(at, has_life); };
  Json copy = drawn_with(entry, "cycle", [&](const Json& cycle) { return drawn_list(cycle, position); });
  if (copy.is_object() && copy.contains("gradients") && copy["gradients"].is_object()) {
    for (const char* part : {"cycle", "shafts"}) copy["gradients"].erase(part);
  }
  return copy;
}

}  // namespace

Json report_view(const Json& results) {
  if (!results.is_object()) return drawn(results);
  Json view = Json::object();
  const auto load_case = [has_life = results.contains("life")](const Json& entry) { return drawn_case(entry, has_life); };
  for (const auto& [key, section] : results.items()) {
    if (key == "given" || key == "used") {
      view[key] = section;
    } else {
      view[key] = key == "loaded" ? drawn_list(section, load_case) : drawn(section);
    }
  }
  Json& names = view["names"] = Json::array();  // in the order in which tables list them
  for (const PlainName& name : plain_names()) names.push_back({name.key, name.name, name.symbol, name.sense});
  Json& quantities = view["quantities"] = Json::array();
  for (const CycleQuantity& q : cycle_quantities()) {
    quantities.push_back({{"key", q.key},
                          {"name", CycleEntry{&q, q.is_list ? 1 : 0}.words()},
                          {"unit", q.unit},
                          {"topic", q.topic},
                          {"is_list", q.is_list},
                          {"is_headline", !q.heading.empty()},
                          {"has_error", q.errors != nullptr},
                          {"smaller_is_worse", q.smaller_is_worse}});
  }
  return view;
}

}  // namespace flankwright::studies
