#pragma once

#include <cmath>
#include <set>

#include "core/compliance/pair/pair_root_stress.hpp"

namespace flankwright::mesh_cases {

/// Root stress of a made-up kind that costs nothing: 3 x 5 places on every fillet in contact, stressed by forces nearby
/// on the same tooth, by higher ones more, a tenth as much by those on other teeth, with shear on either side.
class SyntheticRootStress final : public PairRootStress {
 public:
  explicit SyntheticRootStress(const GearPair& pair) : pair_(pair) {}

  RootStressInfluence influence(const std::vector<ContactPoint>& points, double axial_offset) const override {
    const double module = pair_.data.normal_module, reach = 2 * module;
    std::vector<RootStation> stations;
    std::set<int> teeth;
    for (const ContactPoint& point : points) teeth.insert(point.tooth);
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      for (const int tooth : teeth) {
        for (int i = 0; i < 15; ++i) {
          const double z = (i % 5 - 2) / 4.0 * pair_.face_width + (member == Member::Wheel ? axial_offset : 0);
          stations.push_back({member, tooth, 0.3 + 0.2 * (i / 5), z, i / 5 == 1});
        }
      }
    }
    Eigen::MatrixXd table(3 * std::ssize(stations), std::ssize(points));
    for (std::size_t p = 0; p < stations.size(); ++p) {
      const RootStation& station = stations[p];
      for (std::size_t i = 0; i < points.size(); ++i) {
        const ContactPoint& point = points[i];
        const Gear& gear = pair_[station.member];
        const double radius = station.member == Member::Pinion ? point.pinion_radius : point.wheel_radius;
        const double height = (radius - gear.root_radius) / module, apart = (point.z - station.z) / reach;
        const double share = point.tooth == station.tooth ? 1.0 : 0.1;
        const double tension = share * height * (1 - std::pow(station.along - 0.45, 2)) * std::exp(-apart * apart) / (module * module);
        table.block<3, 1>(3 * static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(i)) << tension, 0.3 * tension, 0.4 * apart * tension;
      }
    }
    // The points are the forces of the table.
    return {stations,
            table.cols(),
            {{0, Eigen::MatrixXd::Identity(table.cols(), table.cols()), Eigen::MatrixXd::Ones(1, table.cols())}},
            {{0, 0, std::make_shared<const Eigen::MatrixXd>(table)}}};
  }

 private:
  GearPair pair_;
};

}  // namespace flankwright::mesh_cases
