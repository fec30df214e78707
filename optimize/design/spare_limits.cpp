#include "optimize/design/spare_limits.hpp"

#include <cmath>

#include "optimize/design/search/design_log.hpp"

namespace flankwright {

namespace {

/// Of what is added to spare, so that one more turn is seldom needed.
constexpr double spare = 0.1;

}  // namespace

bool spare_limits(std::vector<OutputConstraint>& constraints, const std::vector<OutputConstraint>& asked, const std::vector<double>& values,
                  const std::vector<double>& excesses) {
  bool is_tighter = false;
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    const double added = excesses[c] - asked[c].excess(values[c]);
    if (!(excesses[c] > DesignLog::tolerance) || !(added > 0.0)) continue;
    const double limit = asked[c].limit(), to_spare = (1.0 + spare) * added * std::abs(limit);
    const double tighter = asked[c].is_least() ? limit + to_spare : limit - to_spare;
    if (!(tighter * limit > 0.0) || !(asked[c].excess(tighter) < asked[c].excess(constraints[c].limit()))) continue;
    (asked[c].is_least() ? constraints[c].minimum : constraints[c].maximum) = tighter;
    is_tighter = true;
  }
  return is_tighter;
}

}  // namespace flankwright
