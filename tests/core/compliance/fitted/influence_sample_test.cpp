#include "core/compliance/fitted/influence_sample.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "core/base/error.hpp"

using namespace flankwright;

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

InfluenceSample two_points() {
  InfluenceSample sample{{40, 0.5, 12, 0}, {{0, 0.5, 3}, {1, -0.5, 6}}, Eigen::MatrixXd(2, 2)};
  sample.compliance << 2, 0.9, 1.1, 3;
  return sample;
}

}  // namespace

TEST_CASE("The reciprocal value of a pair is the mean of what is known", "[core][compliance][fitted]") {
  InfluenceSample sample = two_points();
  CHECK(sample.at(0, 1) == Approx(1.0).epsilon(1e-15));
  CHECK(sample.at(1, 0) == sample.at(0, 1));
  sample.compliance(0, 1) = kUnknown;
  CHECK(sample.at(0, 1) == 1.1);
  CHECK(sample.at(1, 0) == 1.1);
  sample.compliance(1, 0) = kUnknown;
  CHECK(std::isnan(sample.at(1, 0)));
  CHECK_NOTHROW(sample.validate());
}

TEST_CASE("An influence sample that cannot be right is refused by name", "[core][compliance][fitted]") {
  const auto field_of = [](const InfluenceSample& sample) -> std::string {
    try {
      sample.validate();
    } catch (const InvalidInput& error) {
      return error.field();
    }
    return "";
  };
  CHECK(field_of(two_points()) == "");
  InfluenceSample sample = two_points();
  sample.gear.teeth = 4;
  CHECK(field_of(sample) == "gear.teeth");
  sample = two_points();
  sample.gear.relative_face = kUnknown;
  CHECK(field_of(sample) == "gear.relative_face");
  sample = two_points();
  sample.points[0].zeta = 12.1;
  CHECK(field_of(sample) == "sample.zeta");
  sample = two_points();
  sample.points[0].u = -1.2;
  CHECK(field_of(sample) == "sample.u");
  sample = two_points();
  sample.compliance(1, 1) = -1e-3;
  CHECK(field_of(sample) == "sample.compliance");
  sample = two_points();
  sample.compliance(0, 1) = std::numeric_limits<double>::infinity();
  CHECK(field_of(sample) == "sample.compliance");
  sample = two_points();
  sample.points.pop_back();
  CHECK(field_of(sample) == "sample.compliance");
}
