#include "core/compliance/fitted/correction_library.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/fitted/kernel_sum.hpp"
#include "core/compliance/fitted/correction_fit.hpp"
#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/reference/eigenvalues.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::testing;
using units::deg;

namespace {

Eigen::MatrixXd kernels_between(const GearProportions& gear, const std::vector<double>& coefficients, const std::vector<FlankStation>& stations) {
  KernelSum sum(KernelForm::correction(), gear, stations);
  sum.set_coefficients(coefficients);
  return sum.tooth_matrix();
}

}  // namespace

TEST_CASE("The shipped library's fits have converged and are within their limits at unseen stations", "[core][compliance][fitted]") {
  int stopped = 0;
  for (const CorrectionEntry& entry : CorrectionLibrary::shipped().entries()) {
    CAPTURE(entry.gear.teeth, entry.gear.helix_angle / deg, entry.gear.profile_shift);
    stopped += entry.status != FitStatus::Converged;
    // Model: how far coarse values and fit are from fine ones.
    CHECK(entry.unseen.pairs > 600);
    CHECK(entry.unseen.median < 0.005);
    CHECK(entry.unseen.share_95 < 0.025);
    CHECK(entry.unseen.worst < 0.08);
  }
  CHECK(stopped == 0);
}

TEST_CASE("The library gives its own entries back, spur gears alike at both ends", "[core][compliance][fitted]") {
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  const auto stations = places_on({-1, 0, 1}, {0, 0.3, 2, 4, 6, 7.7, 8});
  for (const CorrectionEntry& entry : library.entries()) {
    CAPTURE(entry.gear.teeth, entry.gear.helix_angle / deg, entry.gear.profile_shift);
    const std::vector<double> found = library.coefficients(entry.gear, entry.profile);
    if (entry.gear.helix_angle != 0) {
      for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == tests::about(entry.coefficients[i], 1e-12));
    }
    const Eigen::MatrixXd here = kernels_between(entry.gear, found, stations), fitted = kernels_between(entry.gear, entry.coefficients, stations);
    // Model: a spur gear's torque leaves at one of its ends.
    CHECK((here - fitted).norm() < 0.03 * fitted.norm());
    if (entry.gear.helix_angle == 0) {
      auto turned = stations;
      for (FlankStation& station : turned) station.zeta = entry.gear.relative_face - station.zeta;
      CHECK((kernels_between(entry.gear, found, turned) - here).norm() < 1e-12 * here.norm());  // round-off
    }
  }
}

TEST_CASE("The library's fits have a covariance, positive definite but for its rounding", "[core][compliance][fitted]") {
  for (const CorrectionEntry& entry : CorrectionLibrary::shipped().entries()) {
    const Eigen::VectorXd errors = entry.covariance.diagonal().cwiseSqrt();
    REQUIRE(static_cast<std::size_t>(errors.size()) == entry.coefficients.size());
    CHECK(errors.minCoeff() > 0);
    const Eigen::MatrixXd correlation = errors.cwiseInverse().asDiagonal() * entry.covariance * errors.cwiseInverse().asDiagonal();
    // Four digits: entries of a correlation are off by 5e-4 at most, eigenvalues by that times the size.
    CHECK(symmetric_eigenvalues(correlation).minCoeff() > -5e-4 * static_cast<double>(errors.size()));
  }
}

TEST_CASE("Mirrored coefficients are the same kernels seen from the other end", "[core][compliance][fitted]") {
  const KernelForm form = GENERATE(KernelForm::correction(), KernelForm::several_teeth());
  tests::Random32 random(3);
  const GearProportions gear = helical_gear();
  const std::vector<double> x = random_coefficients(form, random);
  const std::vector<FlankStation> stations = random_stations(20, gear.relative_face, -1, 1, random);
  auto turned = stations;
  for (FlankStation& station : turned) station.zeta = gear.relative_face - station.zeta;
  KernelSum here(form, gear, stations), there(form, gear, turned);
  here.set_coefficients(x);
  there.set_coefficients(mirrored(form, x));
  const Eigen::MatrixXd K = here.tooth_matrix();
  CHECK((there.tooth_matrix() - K).norm() < 1e-12 * K.norm());  // round-off
}

TEST_CASE("Between its entries the library neither overshoots nor does negative work", "[core][compliance][fitted]") {
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  double least = INFINITY, most = 0;
  const auto middle_of = [&](const GearProportions& gear) {
    const auto stations = places_on({0}, {gear.relative_face / 2});
    return kernels_between(gear, library.coefficients(gear), stations)(0, 0);
  };
  for (const CorrectionEntry& entry : library.entries()) {
    least = std::min(least, middle_of(entry.gear));
    most = std::max(most, middle_of(entry.gear));
  }
  tests::Random32 random(7);
  for (int i = 0; i < 40; ++i) {
    const GearProportions gear{static_cast<int>(1 / random(1.0 / 12, 1.0 / 150)), random(0, 35) * deg, random(2, 30), random(-0.4, 0.6)};
    CAPTURE(gear.teeth, gear.helix_angle / deg, gear.relative_face, gear.profile_shift);
    // A smooth quantity stays near the range of its nodes.
    CHECK(middle_of(gear) > 0.5 * least);
    CHECK(middle_of(gear) < 1.5 * most);
    const auto stations = random_stations(60, gear.relative_face, -2, 2, random);
    const Eigen::MatrixXd K = kernels_between(gear, library.coefficients(gear), stations);
    CHECK(K == K.transpose());
    const Eigen::VectorXd values = symmetric_eigenvalues(K);
    CHECK(values[0] > -1e-13 * values[values.size() - 1]);  // round-off
  }
}

TEST_CASE("Racks between those of the library change its kernels in proportion to what they depart by", "[core][compliance][fitted]") {
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  const GearProportions gear{40, 20 * deg, 10, 0.1};
  const auto departs = [&](const RackProfile& rack) {
    const std::vector<double> with = library.coefficients(gear, {.rack = rack}), standard = library.coefficients(gear);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(with.data(), std::ssize(with)) -
                           Eigen::Map<const Eigen::VectorXd>(standard.data(), std::ssize(standard)));
  };
  const Eigen::VectorXd addendum = departs({1.4, 1.25, 0.39}), root = departs({1, 1.25, 0.2}), dedendum = departs({1, 1.6, 0.25});
  CHECK(std::min({addendum.norm(), root.norm(), dedendum.norm()}) > 0);
  const Eigen::VectorXd sum = departs({1.2, 1.25 + 0.175, 0.39 - 0.095 - 0.07});
  CHECK((sum - 0.5 * (addendum + root + dedendum)).norm() < 1e-12 * sum.norm());  // round-off
}

TEST_CASE("A gear outside the library is reported by the quantity and its range", "[core][compliance][fitted]") {
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  GearToMesh gear = standard_gear({24, 20 * deg, 10, 0.2});
  CHECK(library.unknown(gear, 0.3).empty());
  gear.gear.rack.root_radius = 0.38;  // ISO 53, profile A
  CHECK(library.unknown(gear, 0.3).empty());
  for (const GearProportions& end : {GearProportions{12, 0, 2, -0.4}, GearProportions{150, 35 * deg, 30, 0.6}}) {
    CHECK(library.unknown(standard_gear(end), 0.3).empty());
  }
  const auto unknown = [&](auto&& change) {
    GearToMesh changed = standard_gear({24, 20 * deg, 10, 0.2});
    change(changed);
    return library.unknown(changed, 0.3);
  };
  CHECK(unknown([](GearToMesh& g) { g.gear.teeth = 11; }) == "teeth 11, in the library 12 .. 150");
  CHECK(unknown([](GearToMesh& g) { g.helix_angle = 36 * deg; }) == "helix angle 36 deg, in the library 0 .. 35 deg");
  CHECK(unknown([](GearToMesh& g) { g.pressure_angle = 25 * deg; }) == "pressure angle 25 deg, in the library 17.5 .. 22.5 deg");
  CHECK_THAT(unknown([](GearToMesh& g) { g.gear.profile_shift = 0.7; }), Catch::StartsWith("profile shift"));
  CHECK_THAT(unknown([](GearToMesh& g) { g.gear.face_width = 1.9; }), Catch::StartsWith("face width"));
  CHECK_THAT(unknown([](GearToMesh& g) { g.gear.rack.dedendum = 1.7; }), Catch::StartsWith("rack dedendum"));
  CHECK_THAT(unknown([](GearToMesh& g) { g.gear.tip_diameter = 20; }), Catch::StartsWith("tip diameter"));
  CHECK_THAT(library.unknown(gear, 0.4), Catch::StartsWith("Poisson's ratio"));
}

TEST_CASE("The nearest gear of the library is the gear itself within its ranges, and else at their ends", "[core][compliance][fitted]") {
  const CorrectionGrid& library = CorrectionLibrary::shipped().standard();
  const GearProportions inside{24, 20 * deg, 10, 0.2};
  CHECK(library.nearest(inside) == inside);
  CHECK(library.nearest({10, 40 * deg, 3, 0.8}) == GearProportions{12, library.helix_angles().back(), 3, 0.6});
  CHECK(library.nearest({200, -40 * deg, 3, -0.5}) == GearProportions{150, -library.helix_angles().back(), 3, -0.4});
  const CorrectionLibrary& whole = CorrectionLibrary::shipped();
  CHECK(whole.coefficients({10, 40 * deg, 3, 0.8}) == whole.coefficients({12, library.helix_angles().back(), 3, 0.6}));
  CHECK(whole.coefficients(inside, {.rack = {1.6, 1.25, 0.39}}) == whole.coefficients(inside, {.rack = {1.4, 1.25, 0.39}}));
}

TEST_CASE("A library is read as it was written, and refused where an entry is missing", "[core][compliance][fitted]") {
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  std::string text = "# a remark\n";
  for (const CorrectionEntry& entry : library.entries()) text += to_text(entry);
  const std::vector<CorrectionEntry> read = entries_in(text);
  REQUIRE(read.size() == library.entries().size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    CHECK(read[i].gear == library.entries()[i].gear);
    CHECK(read[i].profile == library.entries()[i].profile);
    CHECK(read[i].coefficients == library.entries()[i].coefficients);
    CHECK(read[i].unseen == library.entries()[i].unseen);
    CHECK(read[i].covariance == library.entries()[i].covariance);
  }
  auto incomplete = read;
  incomplete.pop_back();
  CHECK_THROWS_AS(CorrectionLibrary(incomplete), InvalidInput);
  auto twice = read;
  twice.back() = twice.front();
  CHECK_THROWS_AS(CorrectionLibrary(twice), InvalidInput);
  CHECK_THROWS_AS(CorrectionLibrary({}), InvalidInput);
  auto two_racks = read;
  std::erase_if(two_racks, [&](const CorrectionEntry& entry) { return entry.profile.rack.addendum != RackProfile{}.addendum; });
  CHECK_THROWS_AS(CorrectionLibrary(two_racks), InvalidInput);
  auto at_once = read;
  for (CorrectionEntry& entry : at_once) {
    if (entry.profile.rack.addendum != RackProfile{}.addendum) entry.profile.pressure_angle = 15 * deg;
  }
  CHECK_THROWS_AS(CorrectionLibrary(at_once), InvalidInput);
  CHECK_THROWS_WITH(entries_in("# remark\n1 2 3\n"), Catch::Contains("line 2"));
}
