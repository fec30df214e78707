#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/compliance/tooth/half_space_correction.hpp"
#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/contact/path/contact_points.hpp"

namespace flankwright {

/// Of either gear; null: the model's contact has none.
using HalfSpaceCorrections = PerGear<std::shared_ptr<const HalfSpaceCorrection>>;

/// How far forces beside those of the mesh move the flanks of both gears apart at contact points, normal to the flank, + opens the gap.
struct OutsideMotion {
  Eigen::VectorXd fixed;     ///< whatever the load, as far as it does not take shafts to the other side of a clearance [mm]; empty: nothing
  Eigen::VectorXd by_force;  ///< per normal force of the mesh, which outside forces are in proportion to [mm/N]; empty: nothing

  bool empty() const { return fixed.size() == 0 && by_force.size() == 0; }
  /// @param gap  the motion under a normal force of the mesh [N] is added to it
  void add_to(Eigen::VectorXd& gap, double force) const {
    if (fixed.size() > 0) gap += fixed;
    if (by_force.size() > 0) gap += force * by_force;
  }
};

/// Structural compliance of a pair of gears by any model: the interface of the load distribution.
class PairCompliance {
 public:
  virtual ~PairCompliance() = default;

  /// K between the contact points of one mesh position, n x n [mm/N]: the deflection of both gears' structures at p,
  /// normal to the flank, per unit force at q. Symmetric to the last bit, positive semi-definite to round-off.
  /// @param axial_offset  of the wheel [mm]
  /// @throws InvalidInput where a point is outside the model
  virtual Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const = 0;

  /// Whether a load at one point moves others: false where each yields for itself.
  virtual bool couples_points() const { return true; }

  /// Whether influence_on_rigid_bodies() may be called: finite elements with rigid bodies need their own run.
  virtual bool knows_rigid_bodies() const { return true; }

  /// The same with rigid gear bodies. A model without bodies gives influence(). Needs knows_rigid_bodies().
  /// @throws InvalidInput as influence()
  virtual Eigen::MatrixXd influence_on_rigid_bodies(const std::vector<ContactPoint>& points, double axial_offset) const {
    return influence(points, axial_offset);
  }

  /// What other forces than those of the mesh do, as those of a gear unit's other meshes; nothing by default.
  virtual OutsideMotion outside_motion(const std::vector<ContactPoint>&, double /*axial_offset*/) const { return {}; }

  /// Whether it is another one at each load, as with clearances: a mesh then takes what linearised_at() makes of it.
  virtual bool depends_on_load() const { return false; }
  /// The same linearised where the mesh's mean force and all others are in equilibrium; null where it does not depend on the load.
  /// @param pinion_torque  > 0 [N mm]
  virtual std::shared_ptr<const PairCompliance> linearised_at(double /*pinion_torque*/) const { return nullptr; }

  /// What contact yields beside such a structure beyond a half space; none: the structure is calibrated to be right as a whole.
  virtual HalfSpaceCorrections half_space_corrections() const { return {}; }

  /// The same gears where they touch with their other flanks, GearPair::on_other_flanks(); null: it knows its own flanks alone.
  virtual std::shared_ptr<const PairCompliance> on_other_flanks() const { return nullptr; }

 protected:
  PairCompliance() = default;
  PairCompliance(const PairCompliance&) = default;
  PairCompliance& operator=(const PairCompliance&) = default;
};

/// Independent slices: a point yields only under its own line load F_i / a_i, and K is diagonal.
class ThinSlicePair final : public PairCompliance {
 public:
  explicit ThinSlicePair(ThinSlice slice) : slice_(std::move(slice)) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override;
  bool couples_points() const override { return false; }
  /// A slice is the same on either flank.
  std::shared_ptr<const PairCompliance> on_other_flanks() const override { return std::make_shared<const ThinSlicePair>(*this); }
  const ThinSlice& slice() const { return slice_; }

 private:
  ThinSlice slice_;
};

/// One gear's structure with its material's modulus.
struct GearStructure {
  std::shared_ptr<const FlankCompliance> compliance;
  double youngs_modulus{not_given};                         ///< E [MPa], > 0
  std::shared_ptr<const FlankCompliance> on_rigid_body{};   ///< GearBody::rigid; null: not known
  std::shared_ptr<const HalfSpaceCorrection> half_space{};  ///< null: none
};

/// Both gears' structures side by side, K = K_1 + K_2, points on different teeth coupled; between intervals of contact lines where points
/// have them, see IntervalMean.
class StructuralPair final : public PairCompliance {
 public:
  /// @param other_flanks  the pair on its other flanks, where a gear's body differs there; null: bodies whose ends are alike
  StructuralPair(const GearPair& pair, GearStructure pinion, GearStructure wheel, std::shared_ptr<const PairCompliance> other_flanks = {})
      : pair_(pair), pinion_(std::move(pinion)), wheel_(std::move(wheel)), other_flanks_(std::move(other_flanks)) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override;
  bool knows_rigid_bodies() const override { return pinion_.on_rigid_body && wheel_.on_rigid_body; }
  Eigen::MatrixXd influence_on_rigid_bodies(const std::vector<ContactPoint>& points, double axial_offset) const override;

  HalfSpaceCorrections half_space_corrections() const override { return {pinion_.half_space, wheel_.half_space}; }

  /// Turned over a gear is itself where both ends of its body are alike, as those of a solid one are.
  std::shared_ptr<const PairCompliance> on_other_flanks() const override {
    if (other_flanks_) return other_flanks_;
    return std::make_shared<const StructuralPair>(pair_.on_other_flanks(), pinion_, wheel_);
  }

  const GearStructure& operator[](Member m) const { return m == Member::Pinion ? pinion_ : wheel_; }

 private:
  Eigen::MatrixXd sum(std::shared_ptr<const FlankCompliance> GearStructure::*of, const std::vector<ContactPoint>& points, double axial_offset) const;

  GearPair pair_;
  GearStructure pinion_, wheel_;
  std::shared_ptr<const PairCompliance> other_flanks_;
};

/// The station of a contact point on one gear of a pair. GearToMesh has the gear right-handed and loaded on its
/// clockwise flanks; half a turn about an axis across its own, or a mirror, leads there:
///
/// - zeta counts from the acute end of the face. The pinion's outward normal has an axial part of the sign of
///   -contact_line_sense(), the wheel's of the opposite one, and the acute end is where that part points away from the
///   face: z = +b/2 of the pinion and -b/2 of the wheel where the sense is +1.
/// - Tooth k of the mesh runs k pitches ahead: on the pinion to the side that its loaded flank faces, so m = -k; on the
///   wheel to the other side, m = +k.
///
/// u is clamped to the flank: a tip edge that touches beyond it, by round-off, counts as on it.
FlankStation flank_station(const GearPair& pair, Member member, const ContactPoint& point, double axial_offset);

/// The tooth of that station alone: the gear's tooth of pair k, counted as in the mesh.
int gear_tooth(Member member, int tooth_pair);

/// Back from zeta [m_n] to z in the pair's frame [mm].
double axial_position(const GearPair& pair, Member member, double zeta, double axial_offset);

}  // namespace flankwright
