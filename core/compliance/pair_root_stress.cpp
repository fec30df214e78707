#include "core/compliance/pair_root_stress.hpp"

#include <set>

#include "core/compliance/pair_compliance.hpp"

namespace flankwright {

RootStressInfluence TabulatedRootStress::influence(const std::vector<ContactPoint>& points, double axial_offset) const {
  const double module = pair_.data.normal_module;
  std::set<int> teeth;
  for (const ContactPoint& point : points) teeth.insert(point.tooth);

  RootStressInfluence result;
  const auto blocks = static_cast<Eigen::Index>(teeth.size());
  result.components.resize(3 * blocks * (pinion_->fillet.size() + wheel_->fillet.size()),
                           static_cast<Eigen::Index>(points.size()));
  Eigen::Index row = 0;
  std::vector<FlankPlace> forces(points.size());
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const RootStressTable& table = (*this)[member];
    for (std::size_t i = 0; i < points.size(); ++i) forces[i] = flank_place(pair_, member, points[i], axial_offset);
    for (const int tooth : teeth) {
      const Eigen::MatrixXd stress = table.evaluate(gear_tooth(member, tooth), forces);
      result.components.middleRows(row, stress.rows()) = stress / (module * module);
      row += stress.rows();
      for (std::size_t i = 0; i < table.fillet.along.size(); ++i) {
        for (const double zeta : table.fillet.zetas) {
          result.places.push_back({member, tooth, table.fillet.along[i],
                                   axial_position(pair_, member, zeta, axial_offset), i == table.fillet.tangent});
        }
      }
    }
  }
  return result;
}

}  // namespace flankwright
