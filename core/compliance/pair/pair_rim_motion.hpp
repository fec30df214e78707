#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/compliance/finite_element/rim_motion.hpp"
#include "core/contact/path/contact_points.hpp"

namespace flankwright {

/// How the rim of a gear on a web has moved under the load of one mesh position, relative to its shaft or its held bore. Poisoned where the gear has no web.
struct RimMotion {
  double radial{not_given};  ///< of the rim's centre at mid face along the line of centres [mm], + away from the mate
  double axial{not_given};   ///< of the rim's centre [mm], + towards +z
  double tilt{not_given};    ///< angle between the rim's axis and its axis without load [rad], >= 0
  /// What the whole rim's tilt opens the mesh by at +z: motion along the common normal, transverse base tangent, away from the mate, at the end of the
  /// common face at +z less that at -z [mm]. As ShaftMotion::misalignment.
  double misalignment{not_given};
  /// The same of the rim within half a pitch of the loaded teeth, a mean weighted by their forces: with it the flanks meet.
  double misalignment_at_teeth{not_given};
};

/// The rims' motion under normal forces at contact points, from the tables of gears on webs. The same tilt is in the influence matrix, from the same run: it acts in
/// the loaded contact whether it is asked for here or not.
class PairRimMotion {
 public:
  /// The table of one gear with its material's modulus; null: a solid disc.
  struct Rim {
    std::shared_ptr<const RimMotionTable> table{};
    double youngs_modulus{not_given};  ///< E [MPa], > 0
  };

  PairRimMotion(const GearPair& pair, PerGear<Rim> rims);

  bool has_rim(Member member) const { return rims_[member].table != nullptr; }

  /// @param forces        normal to the flank at every point, n [N]
  /// @param axial_offset  of the wheel [mm]
  RimMotion motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const;

 private:
  GearPair pair_;
  PerGear<Rim> rims_;
  PerGear<double> base_half_angle_;  ///< half the angle of a tooth where its involute starts at the base circle [rad]
};

}  // namespace flankwright
