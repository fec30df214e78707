#include "core/compliance/finite_element/solve_half_space_correction.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>

#include "core/base/root.hpp"
#include "core/base/units.hpp"
#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/finite_element/load_functional.hpp"
#include "core/compliance/finite_element/plane_strain.hpp"
#include "core/compliance/local/contact_law.hpp"
#include "core/compliance/local/hertz_line.hpp"

namespace flankwright {
namespace {

using Edge = Eigen::Matrix<double, 2, 3>;  ///< nodes of an edge: corner, mid-side, corner

constexpr std::array heights{0.05, 0.12, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.78, 0.85, 0.9, 0.94, 0.97};
constexpr double closest_to_tip = 0.99;     ///< height up to which the last two are extrapolated
constexpr double half_width_share = 0.027;  ///< L over the length of the flank, so that the pressure lies on it at the last height
constexpr int flank_elements = 36;          ///< as long as the pressure is wide, or shorter

/// The three functions of an edge at local -1 .. 1 and their derivatives.
struct EdgeShape {
  Eigen::Vector3d values, derivatives;
  explicit EdgeShape(double x) : values(0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)), derivatives(x - 0.5, -2 * x, x + 0.5) {}
};

/// use(shape, weight) at three Gauss points in each of n parts of an edge.
template <typename Use>
void integrate_edge(int n, Use&& use) {
  for (int i = 0; i < 3 * n; ++i) use(EdgeShape(-1 + (2 * (i / 3) + 1 + gauss3_abscissae[i % 3]) / n), gauss3_weights[i % 3] / n);
}

Edge nodes_of(const SectionMesh& mesh, const SectionEdge& edge) {
  Edge nodes;
  for (int i = 0; i < 3; ++i) nodes.col(i) = mesh.nodes.col(edge[static_cast<std::size_t>(i)]);
  return nodes;
}

void add(const SectionEdge& edge, const Eigen::Vector3d& shares, const Eigen::Vector2d& direction, Eigen::Ref<Eigen::VectorXd> load) {
  for (int i = 0; i < 3; ++i) load.segment<2>(2 * edge[static_cast<std::size_t>(i)]) += shares[i] * direction;
}

/// A point of the loaded flank in the section.
struct Place {
  Eigen::Vector2d position, normal;  ///< outward
  double centre_depth;               ///< along the normal to the tooth's centre line
  double law_depth;                  ///< h of the contact law, ContactPoint::pinion_depth

  Place(const ToothForm& form, double radius) {
    const double psi = form.half_angle(radius), alpha = std::acos(form.base_radius() / radius);
    position = radius * Eigen::Vector2d(std::sin(psi), std::cos(psi));
    normal = {std::cos(alpha - psi), std::sin(alpha - psi)};
    centre_depth = position.x() / normal.x();
    law_depth = radius * psi / std::cos(alpha);
  }
};

/// Hertz's pressure of a unit line load.
Eigen::VectorXd pressure(const SectionMesh& mesh, const SectionTooth& tooth, const Place& at, double half_width) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.nodes.size());
  double total = 0;
  for (const SectionEdge& edge : tooth.flank) {
    const Edge nodes = nodes_of(mesh, edge);
    if ((nodes.colwise() - at.position).colwise().norm().minCoeff() > half_width + (nodes.col(2) - nodes.col(0)).norm()) continue;
    Eigen::Vector3d shares = Eigen::Vector3d::Zero();
    integrate_edge(40, [&](const EdgeShape& shape, double weight) {
      const double off = (nodes * shape.values - at.position).norm() / half_width;
      if (off < 1) shares += std::sqrt(1 - off * off) * weight * (nodes * shape.derivatives).norm() * shape.values;
    });
    total += shares.sum();
    add(edge, shares, -at.normal, load);
  }
  return load / total;
}

/// The deflection of the flank at one point, as a functional.
Eigen::VectorXd deflection(const SectionMesh& mesh, const SectionTooth& tooth, const Place& at) {
  Eigen::VectorXd functional = Eigen::VectorXd::Zero(mesh.nodes.size());
  const double radius = at.position.norm();
  for (const SectionEdge& edge : tooth.flank) {  // tip to root
    const Edge nodes = nodes_of(mesh, edge);
    if (!(nodes.col(0).norm() >= radius && nodes.col(2).norm() <= radius)) continue;
    const auto above = [&](double x) { return (nodes * EdgeShape(x).values).norm() - radius; };
    const double x = bracketed_root(above, -1.0, above(-1), 1.0, above(1), 1e-12).x;
    add(edge, EdgeShape(x).values, -at.normal, functional);
    return functional;
  }
  assert(false);
  return functional;
}

/// The functional of a point load over the face, centre_functional(), integrated across the face: integrals over z' of (rho^2 + z'^2)^(-5/2) times
/// 1, z', z'^2 are closed.
class FaceFunctional {
 public:
  FaceFunctional(const SectionMesh& mesh, const SectionTooth& tooth, const Place& at) : mesh_(mesh), depth_(at.centre_depth), direction_(-at.normal) {
    const Eigen::Vector2d source = at.position - (1 - source_height) * depth_ * at.normal, across(at.normal.y(), -at.normal.x());
    for (const SectionEdge& edge : tooth.centre_line) {
      const Edge nodes = nodes_of(mesh, edge);
      const double size = (nodes.col(2) - nodes.col(0)).norm(), distance = (nodes.colwise() - source).colwise().norm().minCoeff();
      integrate_edge(std::clamp(static_cast<int>(std::ceil(3 * size / distance)), 1, 8), [&](const EdgeShape& shape, double weight) {
        const Eigen::Vector2d d = nodes * shape.values - source, along = nodes * shape.derivatives;
        const double a = -at.normal.dot(d);
        if (!(a > 0)) return;
        const double strength = a * a * std::abs(d.x() * along.y() - d.y() * along.x()) * weight;
        points_.push_back({edge, shape.values, d.squaredNorm(), strength, across.dot(nodes * shape.values - at.position) / depth_});
      });
    }
  }

  /// Adds `amount` times the functional of a point whose face ends lie at `low` and `high` from it.
  void add_point(double low, double high, double amount, Eigen::VectorXd& load) const {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    std::vector<std::array<double, 2>> integrals;
    integrals.reserve(points_.size());
    for (const Point& p : points_) {
      const auto [i0, i1, i2] = between(p.distance_squared, low, high);
      Eigen::Matrix3d m;
      m << i0, p.xi * i0, i1, p.xi * i0, p.xi * p.xi * i0, p.xi * i1, i1, p.xi * i1, i2;
      moments += p.strength * m;
      integrals.push_back({i0, i1});
    }
    const Eigen::Vector3d factors = moments.inverse() * Eigen::Vector3d(1, 0, 0);
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Point& p = points_[k];
      const double w = amount * p.strength * ((factors[0] + factors[1] * p.xi) * integrals[k][0] + factors[2] * integrals[k][1]);
      add(p.edge, w * p.shape, direction_, load);
    }
  }

  Eigen::VectorXd at_mid_face(double face) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh_.nodes.size());
    add_point(-face / 2, face / 2, 1, load);
    return load;
  }

  /// The mean of the points of a line along the face.
  Eigen::VectorXd mean(double face) const {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh_.nodes.size());
    // Both halves are alike. Parts are half as long as the functional is wide; where both ends are far off nothing changes any more.
    const double half = face / 2, reach = std::min(half, 12 * depth_);
    const int n = std::max(2, static_cast<int>(std::ceil(2 * reach / depth_)));
    for (int i = 0; i < 3 * n; ++i) {
      const double from_end = reach * (2 * (i / 3) + 1 + gauss3_abscissae[i % 3]) / (2 * n);
      add_point(-from_end, face - from_end, gauss3_weights[i % 3] / (2 * n) * reach / half, load);
    }
    if (reach < half) add_point(-half, half, 1 - reach / half, load);
    return load;
  }

 private:
  struct Point {
    SectionEdge edge;
    Eigen::Vector3d shape;
    double distance_squared, strength, xi;
  };
  /// Integrals of (rho^2 + t^2)^(-5/2) times 1, t, t^2, t in the depth for its powers.
  std::array<double, 3> between(double rho_squared, double low, double high) const {
    const auto at = [&](double t) {
      const double s = rho_squared + t * t, root = s * std::sqrt(s);
      return std::array{t * (3 * rho_squared + 2 * t * t) / (3 * rho_squared * rho_squared * root), -1 / (3 * root * depth_),
                        t * t * t / (3 * rho_squared * root * depth_ * depth_)};
    };
    const auto a = at(low), b = at(high);
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }

  const SectionMesh& mesh_;
  double depth_;
  Eigen::Vector2d direction_;
  std::vector<Point> points_;
};

/// The gear's tooth in the section across the contact line, m_n = 1.
GearData equivalent_spur_gear(const Gear& gear, const GearPair& pair) {
  GearData spur = as_generated(gear.data, pair.data.normal_module, pair.data.pressure_angle);
  spur.face_width = gear.data.face_width / pair.data.normal_module;
  spur.teeth = static_cast<int>(std::lround(gear.virtual_teeth));
  spur.tip_diameter = spur.teeth + 2 * (gear.tip_radius - gear.reference_radius) / pair.data.normal_module;
  // Rounded, a tooth that is all but pointed may become so: then it is cut off where it is as thick as elements can show.
  constexpr double thinnest = 0.02;
  while (ToothForm(spur, 1, pair.data.pressure_angle, 0).tip_thickness() < thinnest) spur.tip_diameter -= thinnest;
  return spur;
}

/// Deflection of one body down to a depth in a half space under a unit line load, E = 1.
double half_space_deflection(double depth, double half_width, double poissons_ratio) {
  const Material material{1, poissons_ratio};
  const ContactSide side = ContactSide::of(material, depth);
  const double modulus = contact_modulus(material, material);
  const ContactLaw both(side, side, half_width * half_width * units::pi * modulus / 4, modulus);  // L = sqrt(4 w R / (pi E'))
  return both.deflection(1) / 2;
}

}  // namespace

HalfSpaceCorrection solve_half_space_correction(const Gear& gear, const GearPair& pair, double poissons_ratio) {
  const GearData spur = equivalent_spur_gear(gear, pair);
  const double face = gear.data.face_width / pair.data.normal_module / std::cos(pair.base_helix_angle);
  const ToothForm form(spur, 1, pair.data.pressure_angle, 0);
  GearMeshOptions options;
  options.flank_elements = flank_elements;
  options.half_thickness_elements = 8;
  options.fillet_elements = 8;
  options.teeth_each_side = 1;
  options.layer_share = 0;
  options.shaft_elements = 1;
  // The body yields alike under both loads: two modules below the root it may as well be rigid.
  GearBody body;
  body.shaft_diameter = std::max(default_shaft_diameter(form, 1), 2 * (form.root_radius() - 2));
  const SectionMesh mesh = section_mesh(form, spur.teeth, 1, spur.face_width, complete_body(body, form, 1, spur.face_width), options);
  std::set<int> held;
  for (Eigen::Index quad = 0; quad < mesh.quads.cols(); ++quad) {
    if (mesh.parts[static_cast<std::size_t>(quad)] == SectionPart::Shaft) held.insert(mesh.quads.col(quad).begin(), mesh.quads.col(quad).end());
  }
  const PlaneStrainSection section(mesh, {1, poissons_ratio}, {held.begin(), held.end()});
  assert(section.status() == FactorStatus::Factorised);

  const SectionTooth& tooth = mesh.teeth[mesh.teeth.size() / 2];
  const double flank_length = (form.tip_radius() * form.tip_radius() - form.form_radius() * form.form_radius()) / (2 * form.base_radius());
  const double half_width = half_width_share * flank_length;
  const auto n = static_cast<Eigen::Index>(heights.size());
  Eigen::MatrixXd loads(mesh.nodes.size(), 2 * n), readings(mesh.nodes.size(), 2 * n);
  std::vector<Place> places;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double height = heights[static_cast<std::size_t>(i)];
    places.emplace_back(form, form.form_radius() + height * (form.tip_radius() - form.form_radius()));
    const FaceFunctional functional(mesh, tooth, places.back());
    loads.col(2 * i) = pressure(mesh, tooth, places.back(), half_width);
    loads.col(2 * i + 1) = functional.mean(face);
    readings.col(2 * i) = deflection(mesh, tooth, places.back());
    readings.col(2 * i + 1) = functional.at_mid_face(face);
  }
  const Eigen::MatrixXd moved = section.solve(loads);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < n; ++i) {
    values.push_back(readings.col(2 * i).dot(moved.col(2 * i)) - readings.col(2 * i + 1).dot(moved.col(2 * i + 1)) -
                     half_space_deflection(places[static_cast<std::size_t>(i)].law_depth, half_width, poissons_ratio));
  }
  // Closer to the tip, where no pressure fits in, the deflection goes on growing with the logarithm of the distance as at the edge of a wedge.
  std::vector<double> all(heights.begin(), heights.end());
  const std::size_t last = heights.size() - 1;
  all.push_back(closest_to_tip);
  values.push_back(values[last] + (values[last] - values[last - 1]) * std::log((1 - all[last]) / (1 - closest_to_tip)) /
                                      std::log((1 - all[last - 1]) / (1 - all[last])));
  return {gear.form_radius, gear.tip_radius, all, values};
}

}  // namespace flankwright
