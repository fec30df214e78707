#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/compliance/local/contact_law.hpp"
#include "core/compliance/pair/pair_compliance.hpp"
#include "core/compliance/pair/pair_root_stress.hpp"
#include "core/contact/path/contact_points.hpp"
#include "core/contact/gap/mesh_placement.hpp"

namespace flankwright {

/// The parts of a loaded mesh. All must outlive what is built from them.
struct MeshParts {
  const GearPair& pair;
  const PerGear<Material>& material;
  const MeshPlacement& placement;
  const PairCompliance* structure{nullptr};    ///< teeth and gear bodies; null: rigid
  const PairCompliance* shafts{nullptr};       ///< null: rigid
  const PairRootStress* root_stress{nullptr};  ///< null: not wanted
  HalfSpaceCorrections half_space{};           ///< of the structure

  double axial_offset() const { return placement.misalignment.axial_offset; }
};

/// Distances of a point from both tips; infinity: as if there were none.
struct TipDistances {
  double pinion{std::numeric_limits<double>::infinity()}, wheel{std::numeric_limits<double>::infinity()};  ///< [mm]
};

/// Distances of a point along its contact line from the end faces of either gear, and the lean of these; infinity: as
/// if there were none.
struct EndDistances {
  std::array<double, 2> pinion{ContactSide::no_ends}, wheel{ContactSide::no_ends};  ///< [mm]
  double pinion_lean{0}, wheel_lean{0};                                             ///< ContactSide::end_lean [rad]
};

/// What the teeth yield at a point beyond their half spaces, ContactSide::correction [mm^2/N].
struct Corrections {
  double pinion{0}, wheel{0};
};

/// One mesh position while effects build it, each adding its part. Without any it is rigid.
class MeshBuilder {
 public:
  /// @param line_phase  of the reference pair's line [base pitches]
  MeshBuilder(const MeshParts& made_of, double line_phase) : parts(made_of), phase(line_phase) {}

  /// Sets the points and the arrays that belong to them; call once.
  void set_points(std::vector<ContactPoint> at) {
    points = std::move(at);
    influence = Eigen::MatrixXd::Zero(std::ssize(points), std::ssize(points));
    tip_distances.resize(points.size());
    end_distances.resize(points.size());
    tip_edges.resize(points.size());
    corrections.resize(points.size());
    even_load_compliance = Eigen::VectorXd::Zero(std::ssize(points));
  }
  /// Whether the contact laws know of end faces.
  bool has_free_ends() const { return !end_distances.empty() && !std::isinf(end_distances.front().pinion.front()); }

  /// K of the structure between the points, teeth coupled as far as it couples them; computed when first asked for.
  const Eigen::MatrixXd& structural_influence() {
    if (!structural_influence_) structural_influence_ = worked_out_influence();
    return *structural_influence_;
  }

  const MeshParts& parts;
  double phase;
  bool with_extended_region{false};  ///< points before A and after E as well
  bool with_gear_bodies{false};      ///< these are compliant as well
  std::vector<ContactPoint> points;
  Eigen::MatrixXd influence;                          ///< K, symmetric, positive semi-definite but for even_load_compliance [mm/N]
  std::vector<TipDistances> tip_distances;            ///< one a point
  std::vector<EndDistances> end_distances;            ///< one a point
  std::vector<std::optional<RoundedEdge>> tip_edges;  ///< one a point; nothing: contact does not see an edge
  std::vector<Corrections> corrections;               ///< one a point
  OutsideMotion outside;                              ///< of the shafts by other forces than the mesh's
  double shaft_compliance{0.0};                       ///< see MeshPosition [mm/N]
  std::vector<ContactLaw> laws;                       ///< one a point, or none
  Eigen::VectorXd even_load_compliance;               ///< part of the laws' compliance that K takes back, see ContactCouplingEffect [mm^2/N]
  RootStressInfluence root_stress;

 private:
  Eigen::MatrixXd worked_out_influence() const {
    if (parts.structure == nullptr) return Eigen::MatrixXd::Zero(std::ssize(points), std::ssize(points));
    return with_gear_bodies ? parts.structure->influence(points, parts.axial_offset())
                            : parts.structure->influence_on_rigid_bodies(points, parts.axial_offset());
  }

  std::optional<Eigen::MatrixXd> structural_influence_;
};

}  // namespace flankwright
