#include "core/flank/flank.hpp"

#include <Eigen/Geometry>

#include "core/flank/conjugate_field.hpp"
#include "core/flank/generated_field.hpp"
#include "core/gear/involute.hpp"

namespace flankwright {

ToothDeviation::AlongProfile ToothDeviation::at(double radius, double z) const {
  const double rb = flank_.base_radius;
  AlongProfile along{-pitch_};
  // f(u) with u du = r_b ds
  const auto add = [&](const Jet& f, double u) {
    along.value += f.value;
    if (!(u > 0.0)) return;
    const double by_arc = rb / u;
    along.slope += f.u * by_arc;
    along.curvature += (f.uu - f.u / u) * by_arc * by_arc;
  };
  add(formula_.at(radius, z), radius);
  const double roll = flank_.roll_at(radius);
  each_field([&](const DeviationField& field) { add(field.at(roll, z), roll); });
  return along;
}

SurfacePoint surface_point(const Flank& flank, double rho, double z, int tooth, double rotation) {
  const Point3<Jet> p = flank_point(flank, Jet::variable_u(rho), Jet::variable_v(z), tooth, rotation);
  const auto gather = [&](double Jet::*part) { return Eigen::Vector3d(p.x.*part, p.y.*part, p.z.*part); };
  SurfacePoint point;
  point.position = gather(&Jet::value);
  point.d_rho = gather(&Jet::u);
  point.d_z = gather(&Jet::v);
  point.d_rho_rho = gather(&Jet::uu);
  point.d_rho_z = gather(&Jet::uv);
  point.d_z_z = gather(&Jet::vv);
  // The involute's outward normal is +t in the transverse section; d_rho points out of the gear, d_z along it.
  point.normal = point.d_z.cross(point.d_rho).normalized();
  return point;
}

Flank make_flank(const GearPair& pair, Member member, const Modification& modification, const ManufacturingError& error) {
  const Gear& gear = pair[member];
  Flank flank;
  flank.base_radius = gear.base_radius;
  flank.origin = involute(pair.working_transverse_pressure_angle);
  flank.form_radius = std::max(gear.form_radius, gear.base_radius * lowest_start);
  flank.tip_radius = gear.tip_form_radius;
  flank.face = gear.face;
  flank.frame = pair.flank_frame(member);
  flank.helix_rate = flank.frame.helix_rate;
  flank.modification = modification;
  flank.error = error;
  flank.modification.parabolic_te = 0.0;
  flank.modification.topography = flank.modification.opposite_topography = nullptr;
  flank.modification.process = {};
  if (auto generated = make_generated_field(pair, member)) flank.fields.push_back(std::move(generated));
  if (modification.parabolic_te != 0.0) flank.fields.push_back(make_conjugate_field(pair, member, modification.parabolic_te));
  if (modification.topography) flank.fields.push_back(modification.topography);
  if (auto twist = make_natural_twist_field(pair, member, modification)) flank.fields.push_back(std::move(twist));
  return flank;
}

GroundDerivative ground_derivative(const GearPair& pair, Member member, const Modification& modification, ModificationParameter parameter,
                                   bool opposite) {
  if (parameter == parameter_of("twist_compensation")) return GroundDerivative(CompensationDerivative(pair, member, modification));
  return GroundDerivative(
      RemovalDerivative(modification, pair.flank_frame(member), parameter, ContactShift::of(pair, member, modification.process), opposite));
}

}  // namespace flankwright
