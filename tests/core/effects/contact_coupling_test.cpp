#include "core/effects/contact_coupling.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "core/effects/free_ends.hpp"
#include "core/effects/hertzian_contact.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

HalfSpaceCorrections of_elements() {
  const auto none = std::make_shared<const HalfSpaceCorrection>(1.0, 2.0, std::vector{0.0, 1.0}, std::vector{0.0, 0.0});
  return {none, none};
}

MeshParts parts_of(const GearPair& gears, const HalfSpaceCorrections& half_space) {
  static const PerGear<Material> materials{mesh_cases::steel, mesh_cases::steel};
  static const MeshPlacement placement{};
  return {.pair = gears, .material = materials, .placement = placement, .half_space = half_space};
}

/// A mesh position with contact laws, free ends and what couples contact, without a structure.
MeshBuilder coupled_contact(const MeshParts& parts, double phase, int intervals, bool free_ends = true) {
  MeshBuilder builder(parts, phase);
  const double half = 0.5 * parts.pair.face_width;
  builder.set_points(contact_points(parts.pair, PathOfContact(parts.pair), {QuadratureRule::Graded, intervals}, phase, false, -half, half));
  if (free_ends) FreeEndsEffect{}.act(builder);
  HertzianContactEffect{}.act(builder);
  ContactCouplingEffect{}.act(builder);
  return builder;
}

Eigen::VectorXd lengths(const MeshBuilder& builder) {
  Eigen::VectorXd a(std::ssize(builder.points));
  for (Eigen::Index i = 0; i < a.size(); ++i) a[i] = builder.points[static_cast<std::size_t>(i)].weight;
  return a;
}

}  // namespace

TEST_CASE("Coupling of contact leaves an even load over the face as it is", "[core][effects]") {
  const GearPair gears = mesh_cases::pair(18, 54, 0, 10, 40);
  const bool free_ends = GENERATE(true, false);
  const MeshParts parts = parts_of(gears, of_elements());
  const MeshBuilder builder = coupled_contact(parts, 1.15, 8, free_ends);
  CHECK((builder.influence - builder.influence.transpose()).cwiseAbs().maxCoeff() == 0.0);
  const Eigen::VectorXd a = lengths(builder), even = builder.influence * a;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    CHECK(builder.even_load_compliance[i] > 0.0);
    CHECK(std::abs(even[i]) < 1e-12 * builder.even_load_compliance[i]);  // round-off
  }
}

TEST_CASE("A line that ends on the face is held up there", "[core][effects]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 40);
  const MeshParts parts = parts_of(gears, of_elements());
  const MeshBuilder builder = coupled_contact(parts, 1.0, 8);
  const Eigen::VectorXd a = lengths(builder), even = builder.influence * a;
  bool some_end = false;
  for (std::size_t i = 0; i < builder.points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double to_face = 0.5 * gears.face_width - std::abs(builder.points[i].z);
    const bool ends_here = (i == 0 || builder.points[i - 1].tooth != builder.points[i].tooth || i + 1 == builder.points.size() ||
                            builder.points[i + 1].tooth != builder.points[i].tooth) &&
                           to_face > 0.3 * gears.face_width;
    // In an endless body it is a half, less what changes within h/10.
    if (ends_here) CHECK(even[row] < -0.3 * builder.even_load_compliance[row]);
    some_end |= ends_here;
  }
  CHECK(some_end);
}

TEST_CASE("Contact with its coupling is convex while it is narrower than a fifth of its depth", "[core][effects]") {
  const auto [helix, width] = GENERATE(std::pair{0.0, 40.0}, std::pair{30.0, 40.0}, std::pair{20.0, 6.0});
  const int intervals = GENERATE(4, 12, 30);
  const double phase = GENERATE(0.02, 0.4, 0.7, 1.0);
  const bool free_ends = GENERATE(true, false);
  const GearPair gears = mesh_cases::pair(18, 54, helix, 10, width);
  const MeshParts parts = parts_of(gears, of_elements());
  const MeshBuilder builder = coupled_contact(parts, phase, intervals, free_ends);
  const Eigen::VectorXd a = lengths(builder);
  Eigen::MatrixXd hessian = a.asDiagonal() * builder.influence * a.asDiagonal();
  for (std::size_t i = 0; i < builder.points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const ContactLaw& law = builder.laws[i];
    const double most = 0.2 * std::min(builder.points[i].pinion_depth, builder.points[i].wheel_depth);
    hessian(row, row) += a[row] * law.slope(std::pow(most / law.half_width(1.0), 2));  // the law is least steep at the largest load
  }
  CAPTURE(helix, width, intervals, phase, free_ends);
  const Eigen::VectorXd scale = a.cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd curvatures =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * hessian * scale.asDiagonal(), Eigen::EigenvaluesOnly).eigenvalues();
  CHECK(curvatures.minCoeff() > 0.0);
}

TEST_CASE("Thin slices are not coupled by their contact", "[core][effects]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 40);
  const MeshParts parts = parts_of(gears, {});
  const MeshBuilder builder = coupled_contact(parts, 0.7, 5);
  CHECK(builder.influence.cwiseAbs().maxCoeff() == 0.0);
  CHECK(builder.even_load_compliance.cwiseAbs().maxCoeff() == 0.0);
}

TEST_CASE("The kernel between two parts of a line is the mean of that between their places", "[core][effects]") {
  constexpr double depth = 1.4, lean = 0.4, nu = 0.3;
  const ContactKernel kernel(nu, {0.0, 20.0}, lean, true);
  const ContactKernel::Range one{3.0, 3.7};
  const auto [apart, length] = GENERATE(std::pair{0.0, 0.7}, std::pair{0.0, 0.1}, std::pair{0.5, 0.3}, std::pair{6.0, 0.7});
  const ContactKernel::Range other{one.end + apart, one.end + apart + length};
  constexpr int n = 400;  // midpoints: their error is of order (0.7 mm/n/e)^2, e a tenth of the depth
  double mean = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto place = [](const ContactKernel::Range& of, int k) { return of.begin + (k + 0.5) / n * (of.end - of.begin); };
      mean += kernel.between(place(one, i), place(other, j), depth) / n / n;
    }
  }
  CAPTURE(apart, length);
  // Of midpoints and of the leaning end's part; of parts far apart as documented, where what is near and what is deep nearly cancel.
  const double error = apart > 4.0 ? 0.01 * 0.5 / apart : 1e-4 * std::abs(mean);
  CHECK(std::abs(kernel.between(one, other, depth) - mean) < error);
  CHECK(kernel.between(one, other, depth) == Approx(kernel.between(other, one, depth)).epsilon(1e-13));  // round-off
}

TEST_CASE("The kernel between parts of a line goes over to that of places as they shrink to nothing", "[core][effects]") {
  constexpr double depth = 1.4, s = 3.0;
  const ContactKernel kernel(0.3, {-1e3, 1e3}, 0.0, true);
  const double length = GENERATE(0.0, 1e-16, 1e-7, 1e-5), apart = GENERATE(0.0, 1e-6, 0.05);
  const ContactKernel::Range one{s, s + length}, other{s + length + apart, s + 2.0 * length + apart}, whole{s + length + apart, s + 0.5};
  CAPTURE(length, apart);
  const double place = s + 0.5 * length;
  constexpr double changes = 1e-4, round_off = 1e-6;  // of G over 1e-5 mm; of a difference of integrals over as little
  CHECK(kernel.between(one, other, depth) == Approx(kernel.between(place, place + length + apart, depth)).epsilon(changes));
  const double mean = kernel.over(place, whole, depth) / (whole.end - whole.begin);
  CHECK(kernel.between(one, whole, depth) == Approx(mean).epsilon(length < 1e-6 ? round_off : changes));
}

TEST_CASE("A kink of the load on a point is seen by contact as by its integral", "[core][effects]") {
  // Spur, in the middle of a wide face: w = |s| about a point, far from ends.
  const GearPair gears = mesh_cases::pair(18, 54, 0, 10, 40);
  const MeshParts parts = parts_of(gears, of_elements());
  const auto deflection_at_kink = [&](int intervals) {
    const MeshBuilder builder = coupled_contact(parts, 1.15, intervals, false);
    const Eigen::VectorXd a = lengths(builder);
    std::size_t kink = 0;
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      if (std::abs(builder.points[i].z) < std::abs(builder.points[kink].z)) kink = i;
    }
    Eigen::VectorXd w(a.size());
    for (std::size_t i = 0; i < builder.points.size(); ++i)
      w[static_cast<Eigen::Index>(i)] =
          builder.points[i].tooth == builder.points[kink].tooth ? std::abs(builder.points[i].z - builder.points[kink].z) : 0.0;
    return builder.influence.row(static_cast<Eigen::Index>(kink)).dot(a.cwiseProduct(w));
  };
  const double coarse = deflection_at_kink(12), fine = deflection_at_kink(192);
  // What a point's own part has of the kink, half its length, was missed as a whole: 8 % of it.
  CHECK(coarse == Approx(fine).epsilon(0.01));
}
