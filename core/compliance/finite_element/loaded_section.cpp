#include "core/compliance/finite_element/loaded_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/base/root.hpp"
#include "core/compliance/finite_element/load_functional.hpp"
#include "core/compliance/finite_element/plane_strain.hpp"
#include "core/compliance/finite_element/quadratic_edge.hpp"

namespace flankwright {
namespace {

constexpr double deepest_yielding = 2;      ///< depth below the root under which the body may as well be rigid: it yields alike under all loads [m_n]
constexpr double half_width_share = 0.027;  ///< L over the length of the flank, so that the pressure lies on it at the last height

/// use(shape, weight) at three Gauss points in each of n parts of an edge.
template <typename Use>
void integrate_edge(int n, Use&& use) {
  for (int i = 0; i < 3 * n; ++i) use(EdgeShape(-1 + (2 * (i / 3) + 1 + gauss3_abscissae[i % 3]) / n), gauss3_weights[i % 3] / n);
}

void add(const SectionEdge& edge, const Eigen::Vector3d& shares, const Eigen::Vector2d& direction, Eigen::Ref<Eigen::VectorXd> load) {
  for (int i = 0; i < 3; ++i) load.segment<2>(2 * edge[static_cast<std::size_t>(i)]) += shares[i] * direction;
}

/// A point of the loaded flank in the section.
SectionPlace place_on(const ToothForm& form, double radius) {
  const double psi = form.half_angle(radius), alpha = std::acos(form.base_radius() / radius);
  const Eigen::Vector2d position = radius * Eigen::Vector2d(std::sin(psi), std::cos(psi)), normal(std::cos(alpha - psi), std::sin(alpha - psi));
  return {position, normal, position.x() / normal.x(), radius * psi / std::cos(alpha)};
}

/// A unit line load on the flank, spread over a half width by a weight of the distance over it, with the force and the moment of the line.
template <typename Weight>
Eigen::VectorXd line_load(const SectionMesh& mesh, const SectionTooth& tooth, const SectionPlace& at, double half_width, Weight&& weight) {
  const Eigen::Vector2d across(at.normal.y(), -at.normal.x());
  std::vector<std::pair<SectionEdge, Eigen::Matrix<double, 3, 2>>> loaded;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const SectionEdge& edge : tooth.flank) {
    const EdgeNodes nodes = edge_nodes(mesh, edge);
    if ((nodes.colwise() - at.position).colwise().norm().minCoeff() > half_width + (nodes.col(2) - nodes.col(0)).norm()) continue;
    Eigen::Matrix<double, 3, 2> sums = Eigen::Matrix<double, 3, 2>::Zero();
    integrate_edge(40, [&](const EdgeShape& shape, double share) {
      const Eigen::Vector2d off = nodes * shape.values - at.position;
      const double distance = off.norm() / half_width;
      if (!(distance < 1)) return;
      const Eigen::Vector2d powers(1, across.dot(off) / half_width);
      const double w = weight(distance) * share * (nodes * shape.derivatives).norm();
      sums += w * shape.values * powers.transpose();
      moments += w * powers * powers.transpose();
    });
    loaded.emplace_back(edge, sums);
  }
  const Eigen::Vector2d factors = moments.inverse() * Eigen::Vector2d(1, 0);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.nodes.size());
  for (const auto& [edge, sums] : loaded) add(edge, sums * factors, -at.normal, load);
  return load;
}

/// Hertz's pressure.
double hertzian(double distance) { return std::sqrt(1 - distance * distance); }
/// A line of patches of flank_functional().
double patches(double distance) { return std::pow(1 - distance * distance, 1.5); }

/// The deflection of the flank at one point, as a functional.
Eigen::VectorXd deflection(const SectionMesh& mesh, const SectionTooth& tooth, const SectionPlace& at) {
  Eigen::VectorXd functional = Eigen::VectorXd::Zero(mesh.nodes.size());
  const double radius = at.position.norm();
  for (const SectionEdge& edge : tooth.flank) {  // tip to root
    const EdgeNodes nodes = edge_nodes(mesh, edge);
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
  FaceFunctional(const SectionMesh& mesh, const SectionTooth& tooth, const SectionPlace& at)
      : mesh_(mesh), depth_(at.centre_depth), direction_(-at.normal) {
    const Eigen::Vector2d source = at.position - (1 - source_height) * depth_ * at.normal, across(at.normal.y(), -at.normal.x());
    for (const SectionEdge& edge : tooth.centre_line) {
      const EdgeNodes nodes = edge_nodes(mesh, edge);
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

}  // namespace

struct LoadedSection::BelowTeeth {
  double depth;   ///< of the surface inside the teeth's blocks below the root, BodyRadii::teeth [m_n]
  bool is_rigid;  ///< nothing yields below it
};

LoadedSection::BelowTeeth LoadedSection::below_teeth(const Gear& gear, const GearPair& pair, const GearBody& body) {
  GearData data = as_generated(gear.data, pair.data.normal_module, pair.data.pressure_angle);
  data.tip_diameter = 2 * gear.tip_radius;
  const ToothForm own(data, pair.data.normal_module, pair.data.pressure_angle, pair.data.helix_angle);
  const BodyRadii radii = body_radii(body, own, pair.data.normal_module, data.face_width);
  return {(own.root_radius() - radii.teeth) / pair.data.normal_module, body.hold == BodyHold::RigidBore && !body.web && radii.teeth <= radii.bore};
}

/// The body as far as the section has it. The centre line, which carries loads, runs on far below what yields, as that of the gear does.
GearBody LoadedSection::section_body(const ToothForm& spur, const BelowTeeth& below) {
  const double surface = spur.root_radius() - below.depth, deepest = std::max(spur.root_radius() - deepest_yielding, surface / 2);
  GearBody body;
  if (below.is_rigid) {
    body.hold = BodyHold::RigidBore;
    body.bore_diameter = 2 * surface;
  } else {
    constexpr double round_off = 1e-9;
    const bool is_disc = rim_radius(spur, 2 * deepest, 1) > surface - round_off;  // a shaft so deep leaves the same blocks
    body.shaft_diameter = 2 * (is_disc ? deepest : surface);
  }
  return complete_body(body, spur, 1, 1);
}

GearMeshOptions fine_section() {
  GearMeshOptions options;
  options.flank_elements = 36;  // as long as the pressure is wide, or shorter
  options.half_thickness_elements = 8;
  options.fillet_elements = 16;
  return options;
}

LoadedSection::LoadedSection(const Gear& gear, const GearPair& pair, double nu, GearMeshOptions options, const GearBody& body)
    : LoadedSection(gear, pair, nu, (options.teeth_each_side = 1, options.layer_share = 0, options), below_teeth(gear, pair, body)) {}

LoadedSection::LoadedSection(const Gear& gear, const GearPair& pair, double nu, const GearMeshOptions& options, const BelowTeeth& below)
    : poissons_ratio(nu), form(equivalent_spur_gear(gear, pair), 1, pair.data.pressure_angle, 0) {
  const GearData spur = equivalent_spur_gear(gear, pair);
  const double face = gear.data.face_width / pair.data.normal_module / std::cos(pair.base_helix_angle);
  const GearBody body = section_body(form, below);
  mesh = section_mesh(form, spur.teeth, 1, spur.face_width, body, options);
  const double rigid = below.is_rigid ? body.bore_diameter / 2 : form.root_radius() - deepest_yielding;
  std::vector<int> held;
  for (int node = 0; node < mesh.nodes.cols(); ++node) {
    if (mesh.nodes.col(node).norm() < std::max(rigid, body.bore_diameter / 2) * (1 + 1e-9)) held.push_back(node);  // round-off
  }
  const PlaneStrainSection section(mesh, {1, poissons_ratio}, held);
  assert(section.status() == FactorStatus::Factorised);

  const double flank_length = (form.tip_radius() * form.tip_radius() - form.form_radius() * form.form_radius()) / (2 * form.base_radius());
  half_width = half_width_share * flank_length;
  const auto n = static_cast<Eigen::Index>(section_heights.size());
  Eigen::MatrixXd loads(mesh.nodes.size(), 3 * n), readings(mesh.nodes.size(), 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double height = section_heights[static_cast<std::size_t>(i)];
    places.push_back(place_on(form, form.form_radius() + height * (form.tip_radius() - form.form_radius())));
    const FaceFunctional functional(mesh, loaded_tooth(), places.back());
    loads.col(i) = line_load(mesh, loaded_tooth(), places.back(), half_width, hertzian);
    loads.col(2 * n + i) = line_load(mesh, loaded_tooth(), places.back(), flank_patch, patches);
    loads.col(n + i) = functional.mean(face);
    readings.col(i) = deflection(mesh, loaded_tooth(), places.back());
    readings.col(n + i) = functional.at_mid_face(face);
  }
  const Eigen::MatrixXd moved = section.solve(loads);
  by_flank = moved.leftCols(n);
  by_patch = moved.rightCols(n);
  const Eigen::VectorXd read = readings.cwiseProduct(moved.leftCols(2 * n)).colwise().sum();
  flank_deflection = read.head(n);
  centre_deflection = read.tail(n);
}

}  // namespace flankwright
