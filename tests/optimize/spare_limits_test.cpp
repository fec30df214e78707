#include "optimize/design/spare_limits.hpp"

#include <catch2/catch.hpp>

#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// What a finer look sees of a value: the search's own plus the same rise, in parts of the limit.
double finer_excess(const OutputConstraint& asked, double value, double rise) { return asked.excess(value) + rise; }

}  // namespace

TEST_CASE("A design at a limit tightened by what a finer look adds keeps the limit asked for there", "[optimize][design]") {
  const double rise = GENERATE(0.003, 0.02, 0.3);
  const OutputConstraint most{term(Output::PeakContactStress), 1500.0};
  OutputConstraint least{term(Output::EffectiveContactRatio)};
  least.minimum = 1.2;
  const std::vector<OutputConstraint> asked{most, least};
  std::vector<OutputConstraint> constraints = asked;
  const std::vector<double> at_limits{1500.0, 1.2};
  CHECK(spare_limits(constraints, asked, at_limits, {finer_excess(most, 1500.0, rise), finer_excess(least, 1.2, rise)}));
  CHECK(constraints[0].maximum < 1500.0);
  CHECK(constraints[1].minimum > 1.2);
  CHECK(finer_excess(most, constraints[0].maximum, rise) < 0.0);
  CHECK(finer_excess(least, constraints[1].minimum, rise) < 0.0);
  CHECK(constraints[1].maximum == asked[1].maximum);

  // The design that was found at these limits is not asked for more, and a smaller rise does not widen them.
  std::vector<OutputConstraint> again = constraints;
  const std::vector<double> found{constraints[0].maximum, constraints[1].minimum};
  CHECK_FALSE(spare_limits(again, asked, found, {finer_excess(most, found[0], rise), finer_excess(least, found[1], rise)}));
  CHECK_FALSE(spare_limits(again, asked, at_limits, {finer_excess(most, 1500.0, 0.5 * rise), finer_excess(least, 1.2, 0.5 * rise)}));
  CHECK(again[0].maximum == constraints[0].maximum);
  CHECK(again[1].minimum == constraints[1].minimum);
}

TEST_CASE("A limit stays where a finer look exceeds it no more than the search does, or where it would reach 0", "[optimize][design]") {
  const std::vector<OutputConstraint> asked{{term(Output::PeakContactStress), 1500.0}};
  std::vector<OutputConstraint> constraints = asked;
  CHECK_FALSE(spare_limits(constraints, asked, {1515.0}, {0.01}));
  CHECK_FALSE(spare_limits(constraints, asked, {1400.0}, {-0.01}));
  CHECK_FALSE(spare_limits(constraints, asked, {1500.0}, {1.0}));
  CHECK(constraints.front().maximum == 1500.0);
}
