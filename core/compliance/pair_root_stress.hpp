#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/compliance/finite_element/root_stress_table.hpp"
#include "core/contact/contact_points.hpp"

namespace flankwright {

/// A place on the fillet of one gear's tooth, below its working flank.
struct RootPlace {
  Member member{Member::Pinion};
  int tooth{0};             ///< of the tooth pair, as ContactPoint::tooth
  double along{not_given};  ///< arc length from the fillet's start over the fillet's, 0 .. 1 [-]
  double z{not_given};      ///< axial position, as ContactPoint::z [mm]
  bool tangent{false};      ///< at the 30 deg tangent
};

/// What forces at the contact points of one mesh position do to the fillets of the teeth in contact.
struct RootStressInfluence {
  std::vector<RootPlace> places;
  /// (s_tt, s_aa, s_ta) of every place, three rows each, per unit force normal to the flank at every point,
  /// 3 places x points [MPa/N]; see FilletStress.
  Eigen::MatrixXd components;
};

/// Root stress of a pair of gears, whatever it is made from: the interface that load distribution sees, beside
/// PairCompliance.
class PairRootStress {
 public:
  virtual ~PairRootStress() = default;

  /// @param axial_offset  of the wheel [mm]
  /// @throws InvalidInput where the model does not know a point
  virtual RootStressInfluence influence(const std::vector<ContactPoint>& points, double axial_offset) const = 0;

 protected:
  PairRootStress() = default;
  PairRootStress(const PairRootStress&) = default;
  PairRootStress& operator=(const PairRootStress&) = default;
};

/// From the tables of both gears.
class TabulatedRootStress final : public PairRootStress {
 public:
  TabulatedRootStress(const GearPair& pair, std::shared_ptr<const RootStressTable> pinion,
                      std::shared_ptr<const RootStressTable> wheel)
      : pair_(pair), pinion_(std::move(pinion)), wheel_(std::move(wheel)) {}
  RootStressInfluence influence(const std::vector<ContactPoint>& points, double axial_offset) const override;

  const RootStressTable& operator[](Member m) const { return m == Member::Pinion ? *pinion_ : *wheel_; }

 private:
  GearPair pair_;
  std::shared_ptr<const RootStressTable> pinion_, wheel_;
};

}  // namespace flankwright
