#include "core/compliance/pair/pair_compliance.hpp"

#include <algorithm>
#include <cassert>

#include "core/compliance/pair/interval_mean.hpp"

namespace flankwright {

Eigen::MatrixXd ThinSlicePair::influence(const std::vector<ContactPoint>& points, double) const {
  const Eigen::Index n = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd diagonal(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ContactPoint& point = points[static_cast<std::size_t>(i)];
    diagonal[i] = slice_.compliance(point.pinion_radius, point.wheel_radius) / point.weight;
  }
  return diagonal.asDiagonal();
}

int gear_tooth(Member member, int tooth_pair) { return member == Member::Pinion ? -tooth_pair : tooth_pair; }

double axial_position(const GearPair& pair, Member member, double zeta, double axial_offset) {
  const double z = pair.acute_end(member) * (0.5 * pair[member].data.face_width - zeta * pair.data.normal_module);
  return member == Member::Pinion ? z : z + axial_offset;
}

FlankStation flank_station(const GearPair& pair, Member member, const ContactPoint& point, double axial_offset) {
  const Gear& gear = pair[member];
  const bool pinion = member == Member::Pinion;
  const double radius = pinion ? point.pinion_radius : point.wheel_radius;
  const double u = 2.0 * (radius - gear.form_radius) / (gear.tip_radius - gear.form_radius) - 1.0;
  const double z = pinion ? point.z : point.z - axial_offset;
  return {gear_tooth(member, point.tooth), std::clamp(u, -1.0, 1.0),
          (0.5 * gear.data.face_width - pair.acute_end(member) * z) / pair.data.normal_module};
}

Eigen::MatrixXd StructuralPair::influence(const std::vector<ContactPoint>& points, double axial_offset) const {
  return sum(&GearStructure::compliance, points, axial_offset);
}

Eigen::MatrixXd StructuralPair::influence_on_rigid_bodies(const std::vector<ContactPoint>& points, double axial_offset) const {
  return sum(&GearStructure::on_rigid_body, points, axial_offset);
}

Eigen::MatrixXd StructuralPair::sum(std::shared_ptr<const FlankCompliance> GearStructure::*of, const std::vector<ContactPoint>& points,
                                    double axial_offset) const {
  const IntervalMean intervals(points);
  const std::vector<ContactPoint>& fine = intervals.points();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(std::ssize(fine), std::ssize(fine));
  std::vector<FlankStation> stations(fine.size());
  for (Member member : {Member::Pinion, Member::Wheel}) {
    const GearStructure& gear = (*this)[member];
    assert(gear.*of);
    for (std::size_t i = 0; i < fine.size(); ++i) stations[i] = flank_station(pair_, member, fine[i], axial_offset);
    sum += (gear.*of)->evaluate(stations) / (gear.youngs_modulus * pair_.data.normal_module);
  }
  return intervals.mean(sum);
}

}  // namespace flankwright
