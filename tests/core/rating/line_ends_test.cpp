#include "core/rating/line_ends.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/natural_spline.hpp"
#include "tests/core/load/load_cases.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using mesh_cases::torque_for;

namespace {

/// Outputs of Haddad 1991, appendix 4A: bending deflections at the Gauss points of one tooth pair [um], then at an end of its line, and
/// the contact deflection found there.
struct PrintedLine {
  double transmission_error;
  std::vector<double> z, bending;
  double end, bending_there, contact_there;
};

const std::vector<PrintedLine> printed_lines{
    {8.33224863, {53.072, 66.928, 77.072, 90.928, 101.072, 114.928}, {4.142, 5.066, 6.611, 6.659, 6.390, 6.774}, 120.0, 6.980, 1.352},
    {8.77575952, {77.072, 90.928, 101.072, 114.928}, {3.754, 3.774, 3.884, 4.169}, 120.0, 4.283, 4.492},
    {8.77575952, {5.072, 18.928, 29.072, 42.928}, {6.901, 4.779, 4.085, 3.623}, 0.0, 7.779, 0.997}};

}  // namespace

TEST_CASE("Structural deflections at line ends are the thesis' by a natural cubic spline", "[core][load][line-ends][haddad]") {
  constexpr double kDigits = 3e-3;  // um: the last digits of four to six values, carried outwards
  for (const PrintedLine& line : printed_lines) {
    CHECK(NaturalSpline(line.z, line.bending)(line.end) == tests::about(line.bending_there, kDigits));
    // On the path and without errors the contact deflection is what bending leaves of f_t.
    CHECK(line.transmission_error - line.bending_there == tests::about(line.contact_there, 2e-3));
  }
}

TEST_CASE("The contact law is inverted to the load that gives the deflection", "[core][load][line-ends]") {
  const ContactLaw law = load_cases::steel_law(12.0, 8.0, 9.0, GENERATE(0.0, 0.3, 1e9));
  const double load = GENERATE(1e-6, 0.5, 120.0, 2e4);
  CHECK(law.line_load(law.deflection(load)) == Approx(load).epsilon(1e-9));  // round-off over the flattest part of the law
  CHECK(law.line_load(0.0) == 0.0);
  CHECK(law.line_load(-1e-3) == 0.0);
}

TEST_CASE("On a spur pair in one contact every end carries what the line does", "[core][load][line-ends]") {
  constexpr double kRoundOff = 1e-9;
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const double phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + PathOfContact::extension;
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 4}, {phase}}, MeshEffects::all_but({"free_ends"}));
  const LoadedPosition loaded = analyse_cycle(model, {}, torque_for(gears, 300)).positions[0];
  const std::vector<LineEnd> ends = line_ends(model, model.positions[0], loaded, {});
  REQUIRE(ends.size() == 2);
  CHECK(ends[0].z == -15);
  CHECK(ends[1].z == 15);
  const std::vector<ContactPoint>& points = model.positions[0].points;
  const auto first = std::ranges::find(points, ends[0].tooth, &ContactPoint::tooth) - points.begin();
  for (const LineEnd& end : ends) {
    CHECK(end.line_load == Approx(300).epsilon(kRoundOff));
    CHECK(end.contact_stress == Approx(loaded.contact_stress[first]).epsilon(kRoundOff));
    CHECK(end.structural_deflection == Approx(loaded.load.structural_deflection[first]).epsilon(kRoundOff));
  }
}

TEST_CASE("Line ends come to what a fine line carries there", "[core][load][line-ends]") {
  // Discretisation: the outermost of two Gauss points in the narrow last interval of a graded line lies ever closer to its end.
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  FlankCondition condition;
  condition.misalignment.mesh_misalignment = 6 * units::um;
  const auto distance = [&](int intervals) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, intervals}, {1.2}});
    const LoadedPosition loaded = analyse_cycle(model, condition, torque_for(gears, 100)).positions[0];
    const MeshPosition& at = model.positions[0];
    double largest = 0;
    for (const LineEnd& end : line_ends(model, at, loaded, condition)) {
      double nearest = 1e9, load = 0;
      for (std::size_t i = 0; i < at.points.size(); ++i) {
        if (at.points[i].tooth != end.tooth || std::abs(at.points[i].z - end.z) > nearest) continue;
        nearest = std::abs(at.points[i].z - end.z);
        load = loaded.load.line_load[static_cast<Eigen::Index>(i)];
      }
      largest = std::max(largest, std::abs(end.line_load - load));
    }
    return largest;
  };
  const double coarse = distance(5), fine = distance(20);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.25 * coarse);
  CHECK(fine < 6);  // N/mm of about 100, which falls steeply at the acute end of a face
}

TEST_CASE("Line ends take no part in the equilibrium and need a contact law", "[core][load][line-ends]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  const MeshModel model = mesh_cases::model(gears, {{}, {1.0}});
  const LoadedCycle cycle = analyse_cycle(model, {}, torque_for(gears, 100));
  const LoadedPosition& loaded = cycle.positions[0];
  CHECK(model.positions[0].weight.dot(loaded.load.line_load) == Approx(cycle.force).epsilon(1e-11));
  CHECK(line_ends(model, model.positions[0], loaded, {}).size() >= 4);
  const MeshModel bending = mesh_cases::model(gears, {{}, {1.0}}, MeshEffects::all_but({"hertzian_contact"}));
  CHECK(line_ends(bending, bending.positions[0], analyse_cycle(bending, {}, torque_for(gears, 100)).positions[0], {}).empty());
  CHECK(line_ends(model, model.positions[0], {}, {}).empty());
}
