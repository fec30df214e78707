#include "core/flank/modifications/topography_shapes.hpp"

#include <algorithm>

namespace flankwright::modifications {

namespace {

struct Polynomial {
  double value, first, second;
};

/// P_0 .. P_4 with their derivatives.
std::array<Polynomial, 5> legendre(double x) {
  const double x2 = x * x;
  return {{{1.0, 0.0, 0.0},
           {x, 1.0, 0.0},
           {0.5 * (3.0 * x2 - 1.0), 3.0 * x, 3.0},
           {0.5 * x * (5.0 * x2 - 3.0), 1.5 * (5.0 * x2 - 1.0), 15.0 * x},
           {0.125 * ((35.0 * x2 - 30.0) * x2 + 3.0), 2.5 * x * (7.0 * x2 - 3.0), 7.5 * (7.0 * x2 - 1.0)}}};
}

}  // namespace

template <ModificationClass Class>
TopographyShapesOf<Class>::Term::Term(const TopographyShapesOf& m, const FlankFrame& frame)
    : any_(std::ranges::any_of(m.shapes, [](double c) { return c != 0.0; })),
      shapes_(m.shapes),
      middle_radius_(0.5 * (frame.tip_radius + frame.active_root_radius)),
      half_height_(0.5 * (frame.tip_radius - frame.active_root_radius)),
      half_face_(0.5 * frame.face_width) {}

template <ModificationClass Class>
void TopographyShapesOf<Class>::Term::sum(double r, double z, Jet& d) const {
  const auto profile = legendre((r - middle_radius_) / half_height_), face = legendre(z / half_face_);
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const Polynomial& p = profile[static_cast<std::size_t>(list[k].profile)];
    const Polynomial& f = face[static_cast<std::size_t>(list[k].face)];
    d.value += shapes_[k] * p.value * f.value;
    d.u += shapes_[k] * p.first * f.value / half_height_;
    d.v += shapes_[k] * p.value * f.first / half_face_;
    d.uu += shapes_[k] * p.second * f.value / (half_height_ * half_height_);
    d.uv += shapes_[k] * p.first * f.first / (half_height_ * half_face_);
    d.vv += shapes_[k] * p.value * f.second / (half_face_ * half_face_);
  }
}

template struct TopographyShapesOf<ModificationClass::Lead>;
template struct TopographyShapesOf<ModificationClass::Profile>;
template struct TopographyShapesOf<ModificationClass::Topography>;

}  // namespace flankwright::modifications
