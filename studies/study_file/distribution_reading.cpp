#include "studies/study_file/distribution_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "core/gear/flank_tolerances.hpp"
#include "studies/study_file/study_reading.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

namespace {

[[noreturn]] void refuse(const std::string& allowed) { throw InvalidInput("", "", allowed); }

constexpr const char* forms =
    "{ normal = [mean, deviation] }, { truncated_normal = [mean, deviation, low, high] }, { uniform = [low, high] }, "
    "{ grid = [low, high, levels] }, { values = [...] } or { iso_1328_class = 1 .. 11 }";

/// A number in the unit of a bare one.
double bare_number(const SchemaKey& key, const toml::node& node) {
  SchemaKey unbounded = key;
  unbounded.kind = ValueKind::Number;
  unbounded.range = {};
  const double inside = read_number(unbounded, node);
  return node.is_number() ? node.value<double>().value_or(0.0) : outside_value(inside, key.quantity);
}

std::vector<double> bare_numbers(const SchemaKey& key, const toml::node& node, std::size_t least, std::size_t most) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() < least || list->size() > most) refuse(forms);
  std::vector<double> numbers;
  for (const toml::node& element : *list) numbers.push_back(bare_number(key, element));
  return numbers;
}

/// The ends of a distribution must be values that the key accepts.
void check_ends(const SchemaKey& key, const std::vector<double>& ends) {
  for (const double end : ends) {
    if (!is_in_range(key, end))
      refuse((is_extent(key) ? "values above 0, as of the extent of a relief, inside those of the key: " : "values inside those of the key: ") +
             allowed_values(key));
  }
}

/// Numbers of draws, as whole as a double can hold many of.
NamedDistribution drawn_gears(const PitchTolerance& tolerance, int tolerance_class) {
  constexpr double draws = 0x1p32;
  return {Distribution::uniform(0.0, draws),
          fmt::format("ISO 1328-1 class {}: number of a gear drawn tooth by tooth, single pitch within \u00b1{:.4g} um, cumulative within {:.4g} um",
                      tolerance_class, tolerance.single / units::um, tolerance.cumulative / units::um),
          tolerance};
}

std::optional<NamedDistribution> read_class(const SchemaKey& key, const toml::node& node, const GearPair* pair) {
  const bool has_tolerance =
      key.path.ends_with(".error.helix_slope") || key.path.ends_with(".error.profile_slope") || key.path.ends_with(".error.pitch");
  if (!has_tolerance) refuse("another distribution: iso_1328_class is for helix_slope, profile_slope and pitch of an error");
  const auto* number = node.as_integer();
  if (number == nullptr || number->get() < 1 || number->get() > 11) refuse("a class 1 .. 11");
  if (pair == nullptr) return std::nullopt;
  const int tolerance_class = static_cast<int>(number->get());
  try {
    const ToleranceData data = ToleranceData::of(*pair, key.member);
    const FlankTolerances tolerances = flank_tolerances(data, tolerance_class);
    if (key.path.ends_with(".error.pitch")) {
      return drawn_gears({data.teeth, tolerances.single_pitch, tolerances.cumulative_pitch}, tolerance_class);
    }
    const double tolerance = (key.path.ends_with(".error.helix_slope") ? tolerances.helix_slope : tolerances.profile_slope) / units::um;
    return NamedDistribution{
        Distribution::within_tolerance(tolerance),
        fmt::format("ISO 1328-1 class {}: normal, mean 0, deviation {:.4g}, cut off at \u00b1{:.4g}", tolerance_class, tolerance / 3.0, tolerance),
        {}};
  } catch (const InvalidInput& problem) {
    refuse("a gear that ISO 1328-1 covers: " + problem.field() + " is " + problem.value() + ", covered is " + problem.allowed());
  }
}

NamedDistribution read_named(const SchemaKey& key, const std::string& name, const toml::node& node) {
  if (name == "normal") {
    const std::vector<double> n = bare_numbers(key, node, 2, 2);
    check_ends(key, {n[0]});
    return {Distribution::normal(n[0], n[1]), fmt::format("normal, mean {:g}, deviation {:g}", n[0], n[1]), {}};
  }
  if (name == "truncated_normal") {
    const std::vector<double> n = bare_numbers(key, node, 4, 4);
    check_ends(key, {n[2], n[3]});
    return {Distribution::truncated_normal(n[0], n[1], n[2], n[3]),
            fmt::format("normal, mean {:g}, deviation {:g}, cut off at {:g} and {:g}", n[0], n[1], n[2], n[3]),
            {}};
  }
  if (name == "uniform") {
    const std::vector<double> n = bare_numbers(key, node, 2, 2);
    check_ends(key, n);
    return {Distribution::uniform(n[0], n[1]), fmt::format("uniform, {:g} .. {:g}", n[0], n[1]), {}};
  }
  if (name == "grid") {
    const toml::array* list = node.as_array();
    constexpr long long most_levels = 100'000;
    if (list == nullptr || list->size() != 3 || !list->get(2)->is_integer()) refuse(forms);
    const double low = bare_number(key, *list->get(0)), high = bare_number(key, *list->get(1));
    const long long levels = list->get(2)->as_integer()->get();
    if (levels < 2 || levels > most_levels) refuse("2 .. 100000 levels");
    check_ends(key, {low, high});
    return {Distribution::grid(low, high, static_cast<int>(levels)), fmt::format("{} values, {:g} .. {:g}", levels, low, high), {}};
  }
  const std::vector<double> values = bare_numbers(key, node, 1, 100'000);
  check_ends(key, values);
  return {
      Distribution::values(values), values.size() <= 8 ? fmt::format("{:g}", fmt::join(values, ", ")) : fmt::format("{} values", values.size()), {}};
}

}  // namespace

std::optional<NamedDistribution> read_distribution(const SchemaKey& key, const toml::node& node, const GearPair* pair) {
  const toml::table* table = node.as_table();
  if (table == nullptr || table->size() != 1) refuse(forms);
  const std::string name(table->begin()->first.str());
  const toml::node& value = table->begin()->second;
  if (name == "iso_1328_class") return read_class(key, value, pair);
  if (name != "normal" && name != "truncated_normal" && name != "uniform" && name != "grid" && name != "values") refuse(forms);
  try {
    return read_named(key, name, value);
  } catch (const InvalidInput& problem) {
    if (problem.field().empty()) throw;
    refuse(problem.field() + " as " + problem.allowed());
  }
}

}  // namespace flankwright::studies
