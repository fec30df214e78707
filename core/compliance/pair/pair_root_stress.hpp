#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/compliance/finite_element/root_stress_correction.hpp"
#include "core/contact/path/contact_points.hpp"

namespace flankwright {

/// A point on the fillet of one gear's tooth, below its working flank.
struct RootStation {
  Member member{Member::Pinion};
  int tooth{0};             ///< of the tooth pair, as ContactPoint::tooth
  double along{not_given};  ///< arc length from the fillet's start over the fillet's, 0 .. 1 [-]
  double z{not_given};      ///< axial position, as ContactPoint::z [mm]
  bool tangent{false};      ///< at the 30 deg tangent
};

/// Influence of forces at the contact points of one mesh position on the fillets of the teeth in contact.
///
/// The influence of n points on P fillet points is a sum of products R W: a table R of the gear, shared by all
/// positions of the cycle, and the weights W that distribute the forces at the points to those of the table. It is kept
/// as these factors, because P is ten times n and loads are applied only a few times.
class RootStressInfluence {
 public:
  std::vector<RootStation> stations;

  /// Points `begin` .. `begin` + points(), as forces of a table: those of point p are the outer product of column p of both factors.
  struct Forces {
    Eigen::Index begin{0};
    Eigen::MatrixXd along_zeta, along_u;  ///< StationGrid::weight_factors() of every point, a column each [-]; along_u over m_n^2 [1/mm^2]

    Eigen::Index points() const { return along_u.cols(); }
    /// Forces of the table, of those at all points of the position.
    Eigen::VectorXd of_table(const Eigen::VectorXd& at_points) const;
    /// The other way round: of a row of the table the values at the points, 1 x points().
    Eigen::RowVectorXd at_points(const Eigen::RowVectorXd& of_table) const;
  };
  /// A table for the stress at some points of the fillets.
  struct Response {
    Eigen::Index first_station{0};                 ///< its first row / 3
    std::size_t forces{0};                         ///< which of the Forces
    std::shared_ptr<const Eigen::MatrixXd> table;  ///< (s_tt, s_aa, s_ta) of every point, three rows each, x forces of the table [MPa/N]
  };
  /// What the points of a tooth add to its own fillet beside the table, RootStressCorrection::added(): one component of stress.
  struct Added {
    Eigen::Index first_station{0}, first_point{0};
    Eigen::MatrixXd stress;                                ///< places x points [MPa/N]
    std::shared_ptr<const Eigen::Matrix3Xd> components{};  ///< (s_tt, s_aa, s_ta) of a unit of it at every place
  };
  /// @param points  n
  RootStressInfluence(std::vector<RootStation> of_places, Eigen::Index points, std::vector<Forces> forces, std::vector<Response> responses,
                      std::vector<Added> added = {})
      : stations(std::move(of_places)), points_(points), forces_(std::move(forces)), responses_(std::move(responses)), added_(std::move(added)) {}
  RootStressInfluence() = default;

  /// (s_tt, s_aa, s_ta) of every fillet point, three rows each, see FilletStress [MPa].
  /// @param forces  normal to the flank at every point, n [N]
  Eigen::VectorXd components(const Eigen::VectorXd& forces) const;
  /// The same at several positions: every table is read once for all of them.
  /// @param forces  a list for each of the positions
  static std::vector<Eigen::VectorXd> components(const std::vector<const RootStressInfluence*>& positions,
                                                 const std::vector<Eigen::VectorXd>& forces);

  /// The three components at one fillet point per unit force at every contact point, 3 x n [MPa/N].
  Eigen::Matrix3Xd components_of(Eigen::Index station) const;

 private:
  Eigen::Index points_{0};
  std::vector<Forces> forces_;
  std::vector<Response> responses_;
  std::vector<Added> added_;
};

/// Root stress of a pair of gears by any model: the interface of the load distribution, beside PairCompliance.
class PairRootStress {
 public:
  virtual ~PairRootStress() = default;

  /// @param axial_offset  of the wheel [mm]
  /// @throws InvalidInput where a point is outside the model
  virtual RootStressInfluence influence(const std::vector<ContactPoint>& points, double axial_offset) const = 0;

  /// As PairCompliance::on_other_flanks().
  virtual std::shared_ptr<const PairRootStress> on_other_flanks() const { return nullptr; }

 protected:
  PairRootStress() = default;
  PairRootStress(const PairRootStress&) = default;
  PairRootStress& operator=(const PairRootStress&) = default;
};

/// Root stress of one gear.
struct GearRootStress {
  std::shared_ptr<const RootStressTable> table;
  std::shared_ptr<const RootStressCorrection> correction{};  ///< of a table that is scaled() by it; null: none
};

/// From the tables of both gears.
class TabulatedRootStress final : public PairRootStress {
 public:
  /// @param other_flanks  as StructuralPair
  TabulatedRootStress(const GearPair& pair, GearRootStress pinion, GearRootStress wheel, std::shared_ptr<const PairRootStress> other_flanks = {});
  RootStressInfluence influence(const std::vector<ContactPoint>& points, double axial_offset) const override;

  std::shared_ptr<const PairRootStress> on_other_flanks() const override {
    if (other_flanks_) return other_flanks_;
    return std::make_shared<const TabulatedRootStress>(pair_.on_other_flanks(), gears_.pinion, gears_.wheel);
  }

  const RootStressTable& operator[](Member m) const { return *gears_[m].table; }

 private:
  GearPair pair_;
  PerGear<GearRootStress> gears_;
  std::shared_ptr<const PairRootStress> other_flanks_;
  PerGear<std::shared_ptr<const Eigen::Matrix3Xd>> components_;  ///< RootStressInfluence::Added::components
};

}  // namespace flankwright
