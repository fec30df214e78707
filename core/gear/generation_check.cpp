#include "core/gear/generation_check.hpp"

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/gear/rack_envelope.hpp"

namespace flankwright {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string field_of(Member member, const char* key) {
  std::string field(name_of(member));
  return field.append(".generation.").append(key);
}

/// The least number that is accepted, above one that is not; infinite where none is.
template <class Predicate>
double least_above(double refused, const Predicate& is_accepted) {
  double accepted = 2.0 * refused;
  while (!is_accepted(accepted)) {
    if (accepted == infinity) return infinity;
    accepted *= 2.0;
  }
  return limit_between(accepted, refused, is_accepted);
}

}  // namespace

std::vector<InvalidInput> find_tool_problems(const PairData& pair, Member member) {
  std::vector<InvalidInput> problems;
  const auto require = [&](bool holds, const char* key, const std::string& value, const char* allowed) {
    if (!holds) problems.emplace_back(field_of(member, key), value, allowed);
  };
  const Generation& generation = pair[member].generation;
  if (const auto* rack = std::get_if<ParabolicRack>(&generation)) {
    require(rack->coefficient >= 0.0 && std::isfinite(rack->coefficient), "coefficient", in_words(rack->coefficient), "0 or more, finite (1/mm)");
  }
  if (const auto* tool = std::get_if<RevolutionTool>(&generation)) {
    require(pair.helix_angle == 0.0, "kind", "revolution", "a spur pair (pair.helix_angle = 0) for this tool");
    require(tool->half_apex > 0.0 && tool->half_apex < 0.5 * units::pi, "half_apex", in_words(tool->half_apex / units::deg),
            "above 0 and below 90 deg");
    require(tool->distance > 0.0 && std::isfinite(tool->distance), "distance", in_words(tool->distance), "above 0 mm, finite");
    require(tool->arc_radius > 0.0, "arc_radius", in_words(tool->arc_radius), "above 0 mm, or left out for a cone");
  }
  return problems;
}

double largest_parabola_coefficient(const Gear& gear, const PairData& pair) {
  const auto accepts = [&](double coefficient) { return generates(ParabolicSection({coefficient}, pair), gear, FlankStart::Active); };
  double refused = 1.0 / gear.reference_radius;
  while (accepts(refused)) refused *= 2.0;
  return limit_between(0.0, refused, accepts);
}

std::vector<InvalidInput> find_generation_problems(const Gear& gear, const PairData& pair) {
  const Generation& generation = gear.data.generation;
  const auto problem = [&](const char* key, double value, const std::string& allowed) {
    return std::vector{InvalidInput(field_of(gear.member, key), in_words(value), allowed)};
  };
  if (const auto* rack = std::get_if<ParabolicRack>(&generation)) {
    if (generates(ParabolicSection(*rack, pair), gear, FlankStart::Active)) return {};
    return problem("coefficient", rack->coefficient,
                   "0 .. " + in_words(largest_parabola_coefficient(gear, pair)) + " 1/mm, above which the flank folds over itself");
  }
  if (const auto* tool = std::get_if<RevolutionTool>(&generation)) {
    const auto accepts = [&](double distance, double arc_radius) {
      return generates(RevolutionSection({tool->half_apex, distance, arc_radius}, pair, gear.data), gear, FlankStart::Active);
    };
    if (!accepts(tool->distance, infinity)) {
      const double least = least_above(tool->distance, [&](double distance) { return accepts(distance, infinity); });
      return problem("distance", tool->distance, "at least " + in_words(least) + " mm, so that the tool reaches over the tooth and the face");
    }
    if (!accepts(tool->distance, tool->arc_radius)) {
      const double least = least_above(tool->arc_radius, [&](double radius) { return accepts(tool->distance, radius); });
      return problem("arc_radius", tool->arc_radius, "at least " + in_words(least) + " mm, below which the flank folds over itself");
    }
  }
  return {};
}

}  // namespace flankwright
