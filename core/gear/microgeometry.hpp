#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "core/gear/deviation_field.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Shape of a tip or root relief between its start and the tip (or start of active profile).
enum class ReliefShape { Linear, Parabolic };

/// Relief measured radially from the tip downwards (tip) or from the start of active profile upwards (root).
struct ProfileRelief {
  double amount{0.0};   ///< material removed at the tip / at the start of active profile [mm]
  double height{0.0};   ///< radial extent [mm], > 0 where amount != 0
  ReliefShape shape{ReliefShape::Linear};
  bool operator==(const ProfileRelief&) const = default;
};

/// Relief from each face end inwards, linear.
struct EndRelief {
  double amount{0.0};  ///< material removed at the face ends [mm]
  double length{0.0};  ///< axial extent from each end [mm], > 0 where amount != 0
  bool operator==(const EndRelief&) const = default;
};

/// Degrees of one smooth shape over the active flank: material removed P_profile(xi) P_face(eta) with the Legendre polynomials P_n,
/// xi = -1 at the start of active profile .. 1 at the tip, eta = -1 at z = -b/2 .. 1 at z = +b/2.
struct TopographyShape {
  int profile{0}, face{0};
};

/// All shapes to the fourth degree but the constant, which only delays the mesh, and those of the first degree in both
/// directions, which are the slopes and the twist.
inline constexpr std::array<TopographyShape, 11> topography_shapes{
    {{0, 2}, {2, 0}, {0, 3}, {3, 0}, {1, 2}, {2, 1}, {0, 4}, {4, 0}, {1, 3}, {3, 1}, {2, 2}}};

/// Flank modification as a designer states it: material removed (positive into the tooth), measured in the
/// transverse plane along the base tangent [ISO 21771; ISO 1328-1]. All amounts in mm, parabolic_te in 1/rad.
struct Modification {
  double lead_crowning{0.0};      ///< C_beta, removed at both face ends, parabola over z
  double lead_slope{0.0};         ///< C_Hbeta over the face width; + removes at z = +b/2, zero at mid face
  double addendum_crowning{0.0};  ///< removed at the tip, parabola in radius from the pitch point up
  double dedendum_crowning{0.0};  ///< removed at the start of active profile, parabola from the pitch point down
  double profile_slope{0.0};      ///< C_Halpha over the active profile height; + removes at the tip, zero at the pitch point
  ProfileRelief tip_relief;
  ProfileRelief root_relief;
  EndRelief end_relief;
  double twist{0.0};              ///< removed: twist * (y / h_active) * (z / b); + removes at the tip at z = +b/2
  /// a of the predesigned transmission error delta_phi2 = -a phi1^2 [1/rad]; removed along the line that touches at phi1: r_b2 a phi1^2.
  double parabolic_te{0.0};
  /// Of each of topography_shapes [mm].
  std::array<double, topography_shapes.size()> shapes{};
  /// Measured or topological grid on top of the rest; none where null.
  std::shared_ptr<const DeviationField> topography;
  bool operator==(const Modification&) const = default;  ///< of grids: the same object
};

/// The numbers of a Modification that a designer may vary, in the order of modification_parameters.
enum class ModificationParameter {
  LeadCrowning, LeadSlope, ProfileCrowning, AddendumCrowning, DedendumCrowning, ProfileSlope,
  TipReliefAmount, TipReliefHeight, RootReliefAmount, RootReliefHeight,
  EndReliefAmount, EndReliefLength, Twist, ParabolicTe,
  // Coefficients of topography_shapes, in their order.
  TopographyFace2, TopographyProfile2, TopographyFace3, TopographyProfile3, TopographyProfile1Face2, TopographyProfile2Face1, 
  TopographyFace4, TopographyProfile4, TopographyProfile1Face3, TopographyProfile3Face1, TopographyProfile2Face2
};

/// A parameter and the name it carries in a study file below [pinion.modification].
struct NamedModificationParameter {
  ModificationParameter parameter;
  std::string_view name;
};

/// All of them. ProfileCrowning is the common value of addendum and dedendum crowning.
inline constexpr std::array<NamedModificationParameter, 25> modification_parameters{{
    {ModificationParameter::LeadCrowning, "lead_crowning"},
    {ModificationParameter::LeadSlope, "lead_slope"},
    {ModificationParameter::ProfileCrowning, "profile_crowning"},
    {ModificationParameter::AddendumCrowning, "addendum_crowning"},
    {ModificationParameter::DedendumCrowning, "dedendum_crowning"},
    {ModificationParameter::ProfileSlope, "profile_slope"},
    {ModificationParameter::TipReliefAmount, "tip_relief.amount"},
    {ModificationParameter::TipReliefHeight, "tip_relief.height"},
    {ModificationParameter::RootReliefAmount, "root_relief.amount"},
    {ModificationParameter::RootReliefHeight, "root_relief.height"},
    {ModificationParameter::EndReliefAmount, "end_relief.amount"},
    {ModificationParameter::EndReliefLength, "end_relief.length"},
    {ModificationParameter::Twist, "twist"},
    {ModificationParameter::ParabolicTe, "parabolic_te"},
    {ModificationParameter::TopographyFace2, "topography.face_2"},
    {ModificationParameter::TopographyProfile2, "topography.profile_2"},
    {ModificationParameter::TopographyFace3, "topography.face_3"},
    {ModificationParameter::TopographyProfile3, "topography.profile_3"},
    {ModificationParameter::TopographyProfile1Face2, "topography.profile_1_face_2"},
    {ModificationParameter::TopographyProfile2Face1, "topography.profile_2_face_1"},
    {ModificationParameter::TopographyFace4, "topography.face_4"},
    {ModificationParameter::TopographyProfile4, "topography.profile_4"},
    {ModificationParameter::TopographyProfile1Face3, "topography.profile_1_face_3"},
    {ModificationParameter::TopographyProfile3Face1, "topography.profile_3_face_1"},
    {ModificationParameter::TopographyProfile2Face2, "topography.profile_2_face_2"},
}};

/// Value of one parameter [mm; parabolic_te 1/rad]. ProfileCrowning reads the mean of addendum and dedendum crowning.
double get(const Modification& modification, ModificationParameter parameter);

/// Sets one parameter [mm; parabolic_te 1/rad]. ProfileCrowning sets both halves.
void set(Modification& modification, ModificationParameter parameter, double value);

/// Manufacturing error of one gear [Haddad 1991, eq. 6.1]: metal *added* is positive, in the transverse plane
/// along the base tangent, mm. Never to be mixed with Modification.
struct ManufacturingError {
  double helix_slope{0.0};    ///< f_Hbeta over the face width, linear, zero at mid face; + adds at z = +b/2
  double profile_slope{0.0};  ///< f_Halpha over the active profile height, zero at the reference circle; + adds at the tip
  double twist{0.0};          ///< f_yz: added twist * (y / h_active) * (z / b)
  /// What single teeth have beyond that, the same quantities: tooth k has entry k mod size; empty: all teeth are alike. k
  /// counts teeth as for the pitch.
  std::vector<double> helix_slopes{}, profile_slopes{}, twists{};
  /// Cumulative pitch deviation of tooth k is pitch_step * k, or cumulative_pitch[k mod size] where the list is
  /// not empty; k counts teeth in the order in which they come into mesh before the reference tooth.
  double pitch_step{0.0};
  std::vector<double> cumulative_pitch{};
  /// Measured deviation of single teeth [mm, + into the tooth as every DeviationField]: entry k mod size, none where null; empty: none.
  std::vector<std::shared_ptr<const DeviationField>> topographies{};

  bool operator==(const ManufacturingError&) const = default;
};

/// The slopes and the twist of one tooth's flank [mm], see ManufacturingError.
struct ToothError {
  double helix_slope{0.0}, profile_slope{0.0}, twist{0.0};
};
ToothError tooth_error(const ManufacturingError& error, int tooth);

/// The measured deviation of one tooth's flank; null where there is none.
const DeviationField* tooth_topography(const ManufacturingError& error, int tooth);

/// Cumulative pitch deviation of tooth k [mm], see ManufacturingError.
double pitch_deviation(const ManufacturingError& error, int tooth);

/// What a removal is measured against; see GearPair::flank_frame() for a gear of a pair.
struct FlankFrame {
  double pitch_radius{not_given};       ///< working pitch radius r_w [mm]: origin of crowning and profile slope
  double reference_radius{not_given};   ///< reference radius r [mm]: origin of error profile slope
  double tip_radius{not_given};         ///< r_a [mm]
  double active_root_radius{not_given}; ///< radius at the start of active profile [mm]
  double face_width{not_given};         ///< b [mm]
  double base_radius{not_given};        ///< r_b [mm]
  double pitch_roll{not_given};         ///< roll length at the working pitch circle [mm]
  double helix_rate{not_given};         ///< turn of the transverse section per mm of z, signed as in Flank [rad/mm]
  double pinion_turn{not_given};        ///< turn of the pinion per turn of this gear in its own frame: 1, or -N2/N1 for the wheel
  double wheel_base_radius{not_given};  ///< r_b2 [mm]
};

}  // namespace flankwright
