#include "core/rating/sn_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

/// A point of a life factor: factor at a number of cycles.
struct LifePoint {
  double cycles, factor;
};

constexpr LifePoint last_point{1e10, 0.85};

struct LifeShape {
  LifePoint first;  ///< of the static limit
  double knee;      ///< where the factor is 1
};

constexpr std::array contact_shapes{LifeShape{{1e5, 1.6}, 5e7}, LifeShape{{1e5, 1.6}, 5e7}, LifeShape{{1e5, 1.3}, 2e6}, LifeShape{{1e5, 1.1}, 2e6}};
constexpr std::array root_shapes{LifeShape{{1e4, 2.5}, 3e6}, LifeShape{{1e3, 2.5}, 3e6}, LifeShape{{1e3, 1.6}, 3e6}, LifeShape{{1e3, 1.1}, 3e6}};

SnCurve through_points(const LifeShape& shape, double limit) {
  SnCurve curve;
  curve.limit = limit;
  curve.knee = shape.knee;
  curve.exponent = std::log(shape.knee / shape.first.cycles) / std::log(shape.first.factor);
  curve.exponent_beyond = std::log(last_point.cycles / shape.knee) / -std::log(last_point.factor);
  curve.static_limit = shape.first.factor * limit;
  return curve;
}

void check_above(const char* field, double value, double least) {
  if (!(value > least)) throw InvalidInput(field, in_words(value), "above " + in_words(least));
}

}  // namespace

void SnCurve::validate() const {
  check_above("limit", limit, 0.0);
  check_above("knee", knee, 0.0);
  check_above("exponent", exponent, 0.0);
  check_above("exponent_beyond", exponent_beyond, 0.0);
  check_above("static_limit", static_limit, limit);
}

double SnCurve::cycles_to_failure(double stress) const {
  if (!(stress > 0.0)) return std::numeric_limits<double>::infinity();
  return knee * std::pow(limit / stress, stress >= limit ? exponent : exponent_beyond);
}

double SnCurve::stress_for(double cycles) const {
  return std::min(static_limit, limit * std::pow(knee / cycles, 1.0 / (cycles <= knee ? exponent : exponent_beyond)));
}

double SnCurve::stress_borne(double cycles) const { return std::isnan(cycles) ? limit : stress_for(cycles); }

SnCurve::Damage SnCurve::damage(double stress) const {
  if (!(stress > 0.0)) return {};
  const double p = stress >= limit ? exponent : exponent_beyond;
  const double value = std::pow(stress / limit, p) / knee;
  return {value, p * value / stress};
}

SnCurve SnCurve::of_stress_times(double factor) const {
  SnCurve curve = *this;
  curve.limit /= factor;
  curve.static_limit /= factor;
  return curve;
}

std::string_view to_string(LifeFactors kind) {
  switch (kind) {
    case LifeFactors::ThroughHardened:
      return "through_hardened";
    case LifeFactors::CaseHardened:
      return "case_hardened";
    case LifeFactors::Nitrided:
      return "nitrided";
    case LifeFactors::Nitrocarburised:
      return "nitrocarburised";
  }
  return "";
}

SnCurve contact_sn_curve(LifeFactors kind, double endurance_limit) {
  return through_points(contact_shapes[static_cast<std::size_t>(kind)], endurance_limit);
}

SnCurve root_sn_curve(LifeFactors kind, double notched_limit) { return through_points(root_shapes[static_cast<std::size_t>(kind)], notched_limit); }

}  // namespace flankwright
