#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "core/compliance/finite_element/fillet_stress.hpp"
#include "core/compliance/tooth/station_grid.hpp"

namespace flankwright {

/// Points on the fillet below the loaded flank of a tooth, the same on every tooth; zeta runs fastest.
struct FilletGrid {
  std::vector<double> along;  ///< arc length from the fillet's start over the fillet's, ascending [-]
  std::size_t tangent{0};     ///< index in `along` of the 30 deg tangent (normal section)
  std::vector<double> zetas;  ///< z/m_n from the acute end of the face, ascending [-]

  Eigen::Index size() const { return static_cast<Eigen::Index>(along.size() * zetas.size()); }
};

/// Stress along the fillets of one gear under forces on its flanks [Haddad 1991, eq. 1.71, as three components instead
/// of one, so that loads add up exactly before the principal stress is taken].
///
/// Tension side only: the fillet below the flank that carries. Forces on the tooth itself act on the flank, flank_functional(). Those on its neighbours enter
/// over the centre surface as in the gear's influence values, with which they share force and moments: that far away nothing else matters. The same motion is
/// removed as in the influence values, at least translation, torsion and tilt: forces are held by the shaft right where they act. The stress of the shaft's own bending and
/// torsion is therefore not included (5e-4 of the whole with the default shaft; a rigid motion causes no stress).
struct RootStressTable {
  StationGrid grid;   ///< points of the forces
  FilletGrid fillet;  ///< points of the stresses
  /// (s_tt, s_aa, s_ta) m_n^2 / F of every fillet point on tooth 0, three rows each, under a force at every point of
  /// the grid on tooth m, for m = -M .. M, teeth counted as in GearToMesh; 3 P x grid.size().
  std::vector<Eigen::MatrixXd> stress;

  int teeth_each_side() const { return static_cast<int>(stress.size() / 2); }

  /// The table for the fillet of one tooth and forces on another [m_n^2 MPa/N]; null further apart than teeth_each_side(), where forces count as none.
  const Eigen::MatrixXd* response(int tooth, int loaded_tooth) const;
};

/// Points along the fillet, closest where the stress has its maximum; the nearest one is moved to the 30 deg tangent.
inline constexpr std::array fillet_stations{0.3, 0.4, 0.475, 0.55, 0.625, 0.7, 0.8};

/// Axial points there: steps from 0.25 modules at the ends to 0.6. Between these points the stress of a line load rises
/// by up to 3 % above its largest value at them (18 and 24 teeth, helix 30 and 0 deg).
std::vector<double> fillet_zetas(double face_width);

FilletGrid fillet_grid(const GearMesh& mesh, const FilletStress& fillet);

/// What a table is read by, on tooth 0.
struct RootStressReadings {
  FilletGrid fillet;
  Eigen::SparseMatrix<double> stress;  ///< three functionals per fillet point, see FilletStress::functionals(), 3n x 3 P, MPa per mm
  Eigen::SparseMatrix<double>
      on_the_flank;  ///< flank_functional() less centre_functional() at every point of the grid, loads in equilibrium, 3n x grid.size()
};

/// @param material  of the solid model
RootStressReadings root_stress_readings(const GearMesh& mesh, const Material& material, const StationGrid& grid);

/// @param stress        of the readings under unit forces at the points of the grid on teeth -M .. M, one tooth after the
///                      other, over their centre surfaces [MPa/N], 3 P x (2 M + 1) grid.size()
/// @param on_the_flank  of the readings under RootStressReadings::on_the_flank [MPa/N], 3 P x grid.size()
RootStressTable root_stress_table(const GearMesh& mesh, const StationGrid& grid, const FilletGrid& fillet, const Eigen::MatrixXd& stress,
                                  const Eigen::MatrixXd& on_the_flank);

}  // namespace flankwright
