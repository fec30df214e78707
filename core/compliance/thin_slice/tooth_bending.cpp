#include "core/compliance/thin_slice/tooth_bending.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright {
namespace {

using units::pi;

/// Eight-point Gauss-Legendre rule on [-1, 1], positive half.
constexpr std::array<double, 4> kAbscissa{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959, 0.96028985649753623168};
constexpr std::array<double, 4> kWeight{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054, 0.10122853629037625915};
/// Panels per smooth piece of the profile: the compliance then holds to 1e-6, and to 1e-4 at the tip of a tooth all but
/// pointed (measured against 48 panels).
constexpr int kPanels = 3;

/// Calls visit(x, weight) at the nodes of the composite rule on [a, b].
template <typename Visit>
void integrate(double a, double b, Visit&& visit) {
  const double half = 0.5 * (b - a) / kPanels;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = a + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < kAbscissa.size(); ++i) {
      visit(middle - half * kAbscissa[i], half * kWeight[i]);
      visit(middle + half * kAbscissa[i], half * kWeight[i]);
    }
  }
}

}  // namespace

ToothCompliance slice_compliance(const std::vector<SlicePiece>& pieces, double load_height, double load_angle, double poissons_ratio) {
  assert(!pieces.empty());
  const SlicePoint root = pieces.front().at(pieces.front().begin);
  const double lever = (load_height - root.height) / root.thickness;

  double slenderness = lever * lever * lever / 3;  // int (y_p - y)^2 / s^3 dy
  double height = lever;                           // int dy / s
  if (lever > 0) {
    slenderness = height = 0;
    for (const SlicePiece& piece : pieces) {
      integrate(piece.begin, piece.end, [&](double p, double dp) {
        const auto [y, s, rise] = piece.at(p);
        const double arm = load_height - y;
        slenderness += arm * arm / (s * s * s) * rise * dp;
        height += rise * dp / s;
      });
    }
  }

  const double nu = poissons_ratio;
  const double plane_strain = 1 - nu * nu;
  const double cos2 = std::cos(load_angle) * std::cos(load_angle);
  const double sin2 = 1 - cos2;

  ToothCompliance result;
  result.bending = plane_strain * cos2 * 12 * slenderness;
  result.shear = plane_strain * cos2 * 2.4 / (1 - nu) * height;
  result.compression = plane_strain * sin2 * height;
  result.foundation = plane_strain * (cos2 * (18 / pi * lever * lever + 2 * (1 - 2 * nu) / (1 - nu) * lever + 4.8 / pi) + sin2 * 2 * (1 - nu) / pi);
  return result;
}

ToothCompliance tooth_compliance(const ToothForm& form, double radius, double poissons_ratio) {
  const double cos_beta = std::cos(form.helix_angle());
  const ProfilePoint contact = form.at_radius(radius);
  const double tan_load = std::tan(contact.tangent_angle) * cos_beta;
  const double load_height = contact.y - contact.x * cos_beta * tan_load;

  const SlicePiece fillet{pi / 2, form.fillet_at_height(load_height), [&](double lambda) {
                            const ProfilePoint p = form.fillet_point(lambda);
                            return SlicePoint{p.y, 2 * cos_beta * p.x, form.fillet_rise(lambda)};
                          }};
  const SlicePiece involute{form.involute_start(), form.involute_at_height(load_height), [&](double roll) {
                              const ProfilePoint p = form.involute_point(roll);
                              return SlicePoint{p.y, 2 * cos_beta * p.x, form.involute_rise(roll)};
                            }};
  return slice_compliance({fillet, involute}, load_height, std::atan(tan_load), poissons_ratio);
}

}  // namespace flankwright
