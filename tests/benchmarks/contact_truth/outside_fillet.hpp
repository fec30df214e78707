#pragma once

#include <Eigen/Core>

#include "core/compliance/tooth/station_grid.hpp"
#include "tests/benchmarks/contact_truth/contact_run.hpp"

namespace flankwright::contact_truth {

/// Stress at the free surface of the fillet below the loaded flank of one tooth, from CalculiX' displacements of the surface alone. No traction acts there, so that
/// plane-stress Hooke gives stress from strain along the tangent t of the transverse section and along a, across it,
///
///     s_tt = E/(1-nu^2) (e_tt + nu e_aa),   s_aa = E/(1-nu^2) (e_aa + nu e_tt),   s_ta = E/(2 (1+nu)) g_ta.
///
/// It is taken at the 2 x 2 Gauss points of the elements' faces, where derivatives of quadratic elements are best, and its largest principal value is
/// interpolated by splines between them. Towards a face end the outermost ones lie 0.21 of a layer inside; beyond them their stress is used.
class OutsideFillet {
 public:
  /// @param answer  with ContactAnswer::fillets
  OutsideFillet(const ContactTask& task, Member member, int tooth, const ContactAnswer& answer);

  /// Largest principal stress [MPa].
  /// @param along  arc length from the fillet's start over the fillet's, 0 .. 1
  /// @param z      in the housing's frame; of half a face -|z| [mm]
  double stress(double along, double z) const;
  double tangent() const { return tangent_; }  ///< `along` at the 30 deg tangent of the normal section

  struct Peak {
    double stress, along, z;  ///< [MPa, -, mm]
  };
  /// The largest between two places along the fillet, over the whole face.
  Peak peak(double from, double to) const;

 private:
  struct Layout;
  explicit OutsideFillet(const Layout& layout);

  bool half_face_;
  double tangent_;
  SplineAxis along_, z_;    ///< Gauss points
  Eigen::MatrixXd values_;  ///< there [MPa]
};

}  // namespace flankwright::contact_truth
