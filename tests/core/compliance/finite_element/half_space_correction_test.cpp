#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/finite_element/plane_strain.hpp"
#include "core/compliance/finite_element/solve_half_space_correction.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

GearPair pair_of(int pinion, int wheel, double face, double helix_deg = 0, double module = 1) {
  PairData data;
  data.normal_module = module;
  data.helix_angle = helix_deg * units::deg;
  data.pinion.teeth = pinion;
  data.wheel.teeth = wheel;
  data.pinion.face_width = data.wheel.face_width = face * module;
  return make_gear_pair(data);
}

double at_height(const GearPair& pair, Member m, double height) {
  const Gear& gear = pair[m];
  return half_space_correction(LoadedSection(gear, pair, 0.3, fine_section()), gear)
      .at(gear.form_radius + height * (gear.tip_radius - gear.form_radius));
}

}  // namespace

TEST_CASE("A quad in plane strain is stiff against strain alone, as its material is", "[core][compliance][fe][half-space]") {
  Eigen::Matrix<double, 2, 8> nodes;
  nodes << 0, 2, 2.2, -0.1, 1, 2.1, 1.05, -0.05, 0, 0.1, 1.6, 1.4, 0.05, 0.85, 1.5, 0.7;
  const Material material{2, 0.3};
  const Eigen::Matrix<double, 16, 16> stiffness = quad_stiffness(nodes, material);
  constexpr double round_off = 1e-12;
  CHECK((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() < round_off);
  Eigen::Matrix<double, 16, 3> rigid;
  for (int i = 0; i < 8; ++i) rigid.middleRows<2>(2 * i) << 1, 0, -nodes(1, i), 0, 1, nodes(0, i);
  CHECK((stiffness * rigid).cwiseAbs().maxCoeff() < round_off);
  // Even strain e_xx: energy (lambda + 2 mu) e^2 A / 2, whatever the quad's form; edges are straight, so that its area is that of the corners.
  Eigen::Matrix<double, 16, 1> stretched = Eigen::Matrix<double, 16, 1>::Zero();
  for (int i = 0; i < 8; ++i) stretched[2 * i] = nodes(0, i);
  double area = 0;
  for (int i = 0; i < 4; ++i) area += 0.5 * (nodes(0, i) * nodes(1, (i + 1) % 4) - nodes(0, (i + 1) % 4) * nodes(1, i));
  const double modulus = material.youngs_modulus * (1 - 0.3) / ((1 + 0.3) * (1 - 2 * 0.3));
  CHECK(stretched.dot(stiffness * stretched) == Approx(modulus * area).epsilon(1e-10));
}

TEST_CASE("Structure, half space and correction are the flank's own deflection in three dimensions", "[core][compliance][fe][half-space]") {
  // Middle of the face of whole spur teeth with free ends, even Hertzian load of half width 0.15 m_n on the flank: its deflection less that of the
  // structure under the same line of points and less the half space's, E = 1. By bricks, 22 elements along the flank and 5 to the tooth's centre, layers of 0.2 to 0.8 modules.
  struct Tooth {
    int teeth;
    double face;
    std::array<double, 4> left_out;  ///< at heights 0.1, 0.3, 0.5, 0.85 of the flank
  };
  for (const Tooth& tooth :
       {Tooth{18, 2, {0.131, 0.228, 0.253, 0.255}}, Tooth{18, 4, {0.121, 0.218, 0.255, 0.299}}, Tooth{18, 8, {0.129, 0.234, 0.285, 0.351}},
        Tooth{54, 2, {0.057, 0.176, 0.232, 0.298}}, Tooth{54, 4, {0.054, 0.178, 0.249, 0.370}}}) {
    const GearPair pair = pair_of(18, 54, tooth.face);
    const Member member = tooth.teeth == 18 ? Member::Pinion : Member::Wheel;
    constexpr std::array heights{0.1, 0.3, 0.5, 0.85};
    for (std::size_t i = 0; i < heights.size(); ++i) {
      CAPTURE(tooth.teeth, tooth.face, heights[i]);
      // Model: load even along the face within the section. 0.045 w/E are 0.35 % of the approach of such a pair.
      CHECK(at_height(pair, member, heights[i]) == tests::about(tooth.left_out[i], 0.045));
    }
  }
}

TEST_CASE("The correction does not know the size of a gear, and hardly that of a wide face", "[core][compliance][fe][half-space]") {
  const double small = at_height(pair_of(20, 40, 6), Member::Pinion, 0.5);
  CHECK(at_height(pair_of(20, 40, 6, 0, 7.5), Member::Pinion, 0.5) == Approx(small).epsilon(1e-8));  // round-off of solved systems
  const double wide = at_height(pair_of(20, 40, 60), Member::Pinion, 0.5), wider = at_height(pair_of(20, 40, 120), Member::Pinion, 0.5);
  CHECK(wide == tests::about(wider, 0.003));  // both ends have 1/60 of their part
}

TEST_CASE("A tooth yields more towards its tip than a half space does, also of a helical gear of the same section",
          "[core][compliance][fe][half-space]") {
  const GearPair spur = pair_of(30, 60, 6);
  double before = -INFINITY;
  for (const double height : {0.1, 0.3, 0.5, 0.7, 0.9, 0.97}) {
    const double here = at_height(spur, Member::Wheel, height);
    CHECK(here > before);
    before = here;
  }
  // z_n = z/(cos^2 beta_b cos beta) of 20 teeth at 30 deg is 29.7: the same section as that of 30 spur teeth, whose face is b/cos(beta_b).
  const GearPair helical = pair_of(20, 60, 6 * std::cos(std::asin(std::sin(30 * units::deg) * std::cos(20 * units::deg))), 30);
  CHECK(helical.pinion.virtual_teeth == tests::about(30, 0.5));
  CHECK(at_height(helical, Member::Pinion, 0.5) == tests::about(at_height(spur, Member::Pinion, 0.5), 0.01));  // model: the mate's share of u
}
