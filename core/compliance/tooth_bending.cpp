#include "core/compliance/tooth_bending.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright {
namespace {

using units::pi;

/// Eight-point Gauss-Legendre rule on [-1, 1], positive half.
constexpr std::array<double, 4> kAbscissa{0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                          0.96028985649753623168};
constexpr std::array<double, 4> kWeight{0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                        0.10122853629037625915};
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

ToothCompliance slice_compliance(const std::function<double(double)>& thickness, const std::vector<double>& heights,
                                 double load_angle, double poissons_ratio) {
  assert(heights.size() >= 2);
  const double root = heights.front();
  const double load = heights.back();

  double slenderness = 0;  // int (y_p - y)^2 / s^3 dy
  double height = 0;       // int dy / s
  const auto add = [&](double y, double dy) {
    const double s = thickness(y);
    const double lever = load - y;
    slenderness += lever * lever / (s * s * s) * dy;
    height += dy / s;
  };
  if (load > root) {
    // y = y_f + t^2 on the first piece takes the square root out of a fillet that ends flat.
    integrate(0, std::sqrt(heights[1] - root), [&](double t, double dt) { add(root + t * t, 2 * t * dt); });
    for (std::size_t i = 1; i + 1 < heights.size(); ++i) integrate(heights[i], heights[i + 1], add);
  } else {
    const double s = thickness(root);
    height = (load - root) / s;
    slenderness = height * height * height / 3;
  }

  const double nu = poissons_ratio;
  const double plane_strain = 1 - nu * nu;
  const double cos2 = std::cos(load_angle) * std::cos(load_angle);
  const double sin2 = 1 - cos2;
  const double lever = (load - root) / thickness(root);

  ToothCompliance result;
  result.bending = plane_strain * cos2 * 12 * slenderness;
  result.shear = plane_strain * cos2 * 2.4 / (1 - nu) * height;
  result.compression = plane_strain * sin2 * height;
  result.foundation =
      plane_strain *
      (cos2 * (18 / pi * lever * lever + 2 * (1 - 2 * nu) / (1 - nu) * lever + 4.8 / pi) + sin2 * 2 * (1 - nu) / pi);
  return result;
}

ToothCompliance tooth_compliance(const ToothForm& form, double radius, double poissons_ratio) {
  const double cos_beta = std::cos(form.helix_angle());
  const ProfilePoint contact = form.at_radius(radius);
  const double tan_load = std::tan(contact.tangent_angle) * cos_beta;
  const double load_height = contact.y - contact.x * cos_beta * tan_load;
  const double root_height = form.fillet_point(pi / 2).y;
  const double form_height = form.at_radius(form.form_radius()).y;

  std::vector<double> heights{root_height};
  if (form_height > root_height && form_height < load_height) heights.push_back(form_height);
  heights.push_back(load_height);
  return slice_compliance([&](double y) { return 2 * cos_beta * form.at_height(y).x; }, heights, std::atan(tan_load),
                          poissons_ratio);
}

}  // namespace flankwright
