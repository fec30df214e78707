#pragma once

#include <string>
#include <vector>

namespace flankwright {

/// The distribution of one uncertain quantity, independent of all others. A value is drawn by the inverse of the
/// distribution function, so that any design of points in the unit cube (SampleDesign) serves every distribution.
class Distribution {
 public:
  enum class Kind { Normal, TruncatedNormal, Uniform, Values };

  /// @param deviation  standard deviation, > 0
  static Distribution normal(double mean, double deviation);
  /// A normal distribution of which only low .. high is kept; mean and deviation are those before truncation.
  /// @param low  < high; at least 1e-12 of the probability lies between them
  static Distribution truncated_normal(double mean, double deviation, double low, double high);
  /// @param low  < high
  static Distribution uniform(double low, double high);
  /// Each value equally likely.
  /// @param values  at least one, in the order of a grid's levels
  static Distribution values(std::vector<double> values);
  /// n values from low to high at equal steps, each equally likely.
  /// @param n  >= 2
  static Distribution grid(double low, double high, int n);
  // Each throws InvalidInput with the parameter's name ("deviation") where it is out of range or not finite.

  /// A slope or pitch deviation held to a tolerance: normal about zero with a third of the tolerance as its deviation, cut off
  /// at the tolerance either way (parts beyond it are rejected).
  /// @param tolerance  > 0
  static Distribution within_tolerance(double tolerance) { return truncated_normal(0.0, tolerance / 3.0, -tolerance, tolerance); }

  Kind kind() const { return kind_; }
  /// Levels of Kind::Values; 0 of a continuous distribution.
  int levels() const { return static_cast<int>(values_.size()); }
  /// These, in their order; none of a continuous distribution.
  const std::vector<double>& level_values() const { return values_; }
  /// The value below which a share u lies; of Values the one that u falls to. Increasing in u, except in Values.
  /// @param u  0 < u < 1
  double quantile(double u) const;
  double median() const { return quantile(0.5); }
  /// The value of the largest magnitude, of a continuous distribution but for a millionth beyond either end: for decisions that must hold for every draw.
  double widest() const;

  bool operator==(const Distribution&) const = default;

 private:
  Distribution() = default;

  Kind kind_{Kind::Normal};
  double mean_{0.0}, deviation_{1.0}, low_{0.0}, high_{0.0};
  std::vector<double> values_;
};

/// Phi(x) of the standard normal distribution, to round-off in both tails' smaller side.
double normal_probability(double x);
/// Its inverse. @param p  0 < p < 1
double normal_quantile(double p);

}  // namespace flankwright
