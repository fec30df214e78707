#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"
#include "core/rating/lubricant.hpp"

namespace flankwright {

/// Gear loss factor of load that the tooth pairs in contact share alike [Ohlendorf, Verlustleistung und Erwaermung von Stirnraedern, TH Munich 1958;
/// Niemann and Winter, Maschinenelemente II, 1983, eq. 21.11],
///
///     H_V = pi (u + 1)/(z_1 u cos(beta_b)) (1 - eps_alpha + eps_1^2 + eps_2^2)
///
/// with eps_1, eps_2 the contact ratios of the pinion's and the wheel's addendum, eps_1 + eps_2 = eps_alpha. It holds for 1 <= eps_alpha <= 2; above, where up to three pairs share the load, it is too large (by 26 % at 2.38) [-]. They end at the tip form
/// circles: with a tip alteration k m_n, or a rounding, those of the teeth so shortened.
double ohlendorf_loss_factor(const GearPair& pair);

/// |v_g| / v_tb at a contact point: sliding speed over the pitch line's at the base circle, |rho_1 - rho_2/u| / r_b1 in the transverse section [-].
double relative_sliding(const GearPair& pair, const ContactPoint& point);

/// A number of a cycle and its derivatives.
struct CycleNumber {
  double value{not_given};
  Eigen::RowVectorXd gradient;  ///< 1 x m; empty where the cycle has no derivatives
};

/// Gear loss factor from the local line loads w: the mean over the positions of
///
///     H_VL = sum a w |v_g| / (F_bt v_tb),     F_bt = F cos(beta_b)
///
/// [Wimmer, Lastverluste von Stirnradverzahnungen, TU Munich 2006], the friction of the flanks over coefficient of friction times transmitted power [-]. With
/// line loads that are uniform and shared alike by the pairs in contact it is Ohlendorf's factor.
/// @param cycle  usable(), under some force; evenly spaced positions
CycleNumber local_loss_factor(const MeshModel& model, const LoadedCycle& cycle);

/// The same at each position, before the mean [-].
std::vector<double> local_loss_factors(const MeshModel& model, const LoadedCycle& cycle);

/// Mean coefficient of friction of a mesh [Schlenk, Untersuchungen zur Fresstragfaehigkeit von Grossgetrieben, TU Munich 1994],
///
///     mu_mz = 0.048 ((F_bt/b) / (v_SigmaC rho_redC))^0.2 eta^-0.05 Ra^0.25 X_L
///
/// with F_bt/b in N/mm and at least 150, v_SigmaC the sum of the flanks' speeds at the pitch point in m/s, rho_redC the relative radius there in the normal section in
/// mm, eta of the oil in mPa s, Ra in um; X_L = 1 of mineral oils, 0.8 of polyalphaolefins and 0.75 (6/v_SigmaC)^0.2 of polyglycols.
/// @param force      normal to the flanks [N]
/// @param speed      of the pinion [rad/s], > 0
/// @param roughness  Ra, mean of both flanks [um], > 0
double schlenk_friction(const GearPair& pair, double face_width, double force, double speed, const Lubricant& lubricant, double temperature_C,
                        double roughness);

/// Relative radius of curvature at the pitch point, normal section [mm].
double pitch_point_radius(const GearPair& pair);

}  // namespace flankwright
