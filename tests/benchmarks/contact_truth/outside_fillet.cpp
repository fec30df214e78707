#include "tests/benchmarks/contact_truth/outside_fillet.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/compliance/finite_element/brick.hpp"
#include "core/compliance/finite_element/fillet_stress.hpp"
#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/benchmarks/contact_truth/root_curve.hpp"

namespace flankwright::contact_truth {
namespace {

constexpr std::array<double, 2> gauss2{-std::numbers::inv_sqrt3, std::numbers::inv_sqrt3};

/// Largest principal stress at a local point of a face [MPa].
double surface_stress(const FilletFace& face, double xi, double eta, const Material& material) {
  const FaceShape shape = face_shape(xi, eta);
  const Eigen::Matrix<double, 3, 2> tangents = face.nodes * shape.derivatives, slopes = face.displacements * shape.derivatives;
  const Eigen::Vector3d t = tangents.col(0).normalized();
  const Eigen::Vector3d a = tangents.col(0).cross(tangents.col(1)).cross(t).normalized();
  Eigen::Matrix<double, 3, 2> frame;
  frame << t, a;
  // Displacement gradient in the tangent plane: rows t and a of the displacement, columns along t and a.
  const Eigen::Matrix2d gradient = frame.transpose() * slopes * (frame.transpose() * tangents).inverse();
  const double nu = material.poissons_ratio, plane = material.youngs_modulus / (1 - nu * nu), shear = material.youngs_modulus / (2 * (1 + nu));
  return largest_principal({plane * (gradient(0, 0) + nu * gradient(1, 1)), plane * (gradient(1, 1) + nu * gradient(0, 0)),
                            shear * (gradient(0, 1) + gradient(1, 0))})
      .value;
}

}  // namespace

/// The faces of one tooth's fillet and its Gauss points.
struct OutsideFillet::Layout {
  bool half_face;
  double tangent;
  std::vector<double> along, z;
  Eigen::MatrixXd values;  ///< along x z

  Layout(const ContactTask& task, Member member, int tooth, const ContactAnswer& answer) : half_face(task.half_face) {
    const GearPair pair = make_gear_pair(task.pair);
    const ToothForm form = tooth_form(pair, member);
    const RootCurve root(form, units::pi / pair[member].data.teeth);
    const ProfilePoint point = form.root_tangent_point(30 * units::deg);
    tangent = root.along_fillet(std::hypot(point.x, point.y));
    const double whole = 1 / root.fillet_share();  // with half of the root land, of the fillet

    std::vector<const FilletFace*> faces;
    for (const FilletFace& face : answer.fillets[member]) {
      if (face.tooth == tooth) faces.push_back(&face);
    }
    // Neighbours of a layer share a side's nodes.
    std::size_t elements = 1;
    while (elements < faces.size() && faces[elements]->nodes.col(0) == faces[elements - 1]->nodes.col(1)) ++elements;
    const std::size_t layers = faces.size() / elements;
    for (std::size_t i = 0; i < elements; ++i) {
      for (const double xi : gauss2) along.push_back((static_cast<double>(i) + (1 + xi) / 2) / static_cast<double>(elements) * whole);
    }
    values.resize(std::ssize(along), static_cast<Eigen::Index>(2 * layers));
    for (std::size_t layer = 0; layer < layers; ++layer) {
      for (std::size_t k = 0; k < 2; ++k) {
        const double below = faces[layer * elements]->nodes(2, 0), above = faces[layer * elements]->nodes(2, 3);
        z.push_back((below + above) / 2 + gauss2[k] * (above - below) / 2);
        for (std::size_t i = 0; i < elements; ++i) {
          for (std::size_t j = 0; j < 2; ++j) {
            values(static_cast<Eigen::Index>(2 * i + j), static_cast<Eigen::Index>(2 * layer + k)) =
                surface_stress(*faces[layer * elements + i], gauss2[j], gauss2[k], task.material);
          }
        }
      }
    }
  }
};

OutsideFillet::OutsideFillet(const ContactTask& task, Member member, int tooth, const ContactAnswer& answer)
    : OutsideFillet(Layout(task, member, tooth, answer)) {}

OutsideFillet::OutsideFillet(const Layout& layout)
    : half_face_(layout.half_face), tangent_(layout.tangent), along_(layout.along), z_(layout.z), values_(layout.values) {}

double OutsideFillet::stress(double along, double z) const { return along_.weights(along).dot(values_ * z_.weights(half_face_ ? -std::abs(z) : z)); }

OutsideFillet::Peak OutsideFillet::peak(double from, double to) const {
  constexpr int steps_along = 60, steps_z = 120;
  const double first = z_.nodes().front(), last = z_.nodes().back();
  Peak peak{-INFINITY, from, first};
  for (int i = 0; i <= steps_along; ++i) {
    for (int k = 0; k <= steps_z; ++k) {
      const double along = from + (to - from) * i / steps_along, z = first + (last - first) * k / steps_z;
      if (const double value = stress(along, z); value > peak.stress) peak = {value, along, z};
    }
  }
  return peak;
}

}  // namespace flankwright::contact_truth
