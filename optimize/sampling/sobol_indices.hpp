#pragma once

#include <limits>
#include <span>
#include <vector>

namespace flankwright {

/// Share of an output's variance that one parameter has: alone (first) and with all its interactions (total), each with its standard
/// error. NaN where there are fewer than two blocks, or the output does not vary.
struct SobolIndex {
  double first{std::numeric_limits<double>::quiet_NaN()}, first_error{std::numeric_limits<double>::quiet_NaN()};
  double total{std::numeric_limits<double>::quiet_NaN()}, total_error{std::numeric_limits<double>::quiet_NaN()};
};

/// Sobol indices of one output from blocks of a SensitivityDesign, kept as sums, so that memory does not grow with the blocks:
///
///     S_j  = mean( f(B) (f(A_Bj) - f(A)) ) / V          [Saltelli et al. 2010, table 2, (b)]
///     ST_j = mean( (f(A) - f(A_Bj))^2 ) / (2 V)         [Jansen, Comput. Phys. Commun. 117 (1999)]
///     V    = mean( ((f(A) - c)^2 + (f(B) - c)^2) / 2 )
///
/// where c is the output's mean, which must be known beforehand: the first estimator scatters with c's distance from it. The
/// standard errors are those of independent blocks (of the ratio, by the delta method); of Sobol's points they are upper bounds in practice.
class SobolEstimate {
 public:
  /// @param centre  c
  SobolEstimate(int parameters, double centre) : centre_(centre), sums_(static_cast<std::size_t>(parameters)) {}

  /// @param outputs  of one block: f(A), f(B), f(A_B1) ...
  void add_block(std::span<const double> outputs);
  long long blocks() const { return blocks_; }
  std::vector<SobolIndex> indices() const;

 private:
  /// Of g, a block's term of a numerator: sums of g, g^2 and g v.
  struct Sums {
    double g{0.0}, gg{0.0}, gv{0.0};
    void add(double term, double v);
  };
  struct Numerators {
    Sums first, total;
  };
  double centre_;
  long long blocks_{0};
  double v_{0.0}, vv_{0.0};  ///< sums of v, a block's term of V, and of v^2
  std::vector<Numerators> sums_;
};

}  // namespace flankwright
