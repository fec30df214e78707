#pragma once

#include <vector>

#include "optimize/assessment/compared_design.hpp"

namespace flankwright {

/// The data of the rules of thumb.
struct RuleBasis {
  double torque{not_given};                  ///< design torque: the largest of the scenes [N mm]
  double misalignment{not_given};            ///< largest F_beta_y over the scenes, of housing and errors, see IsoDeviations [mm]
  double deflection{not_given};              ///< mean deflection of the teeth, F_bt/(b c_gamma): c_gamma of ISO 6336-1, method B [mm]
  double single_pair_deflection{not_given};  ///< F_bt/(b c'): c' of ISO 6336-1, method B [mm]
};

/// Both deflections are of teeth alone. Gear bodies and shafts give way at all positions alike, so a relief that makes up for them would be
/// several times too large on a wide or a thin gear. Haddad takes c_m of his slices instead, which have no bodies either [eq. 2.17b].
RuleBasis rule_basis(const DesignProblem& problem);

/// Radial height below the tip at which a relief starts that is `length` long on the path of contact:
///
///     h = r_a - sqrt(r_b^2 + (rho_a - length)^2),   rho_a = sqrt(r_a^2 - r_b^2)        [mm]
///
/// @param length  [mm], 0 .. rho_a
double relief_height(const Gear& gear, double length);

/// The designs that a designer would choose without an optimiser: every profile rule with every lead rule, the first of
/// them unmodified flanks. A measured grid on a flank is kept; every other modification of the task is left out.
///
/// Profile rules. Relief is linear and on the tips of both gears; amounts are along the transverse base tangent.
/// - Short tip relief, Munro [47 in Haddad 1991; eq. 4.13]: over (eps_alpha - 1)/2 p_bt of the path, by the mean deflection.
/// - Long tip relief, Munro [ibid., section 4.3.3]: from the pitch point on, by the mean deflection.
/// - Tip relief to single contact: from the highest point of single tooth contact, over (eps_alpha - 1) p_bt, by the
///   deflection of a single pair after ISO 6336-1, that is, of a pair that carries alone. It is what commercial gear software
///   propose for 1 < eps_alpha < 2.
/// - Profile crowning by the mean deflection, on the pinion [preferred to relief in Haddad 1991, section 4.3.3].
///
/// Lead rules, on the pinion, left out where no scene is misaligned.
/// - Crowning of half the misalignment, Munro and Myers [46, 47 in Haddad 1991, section 4.2.4]: C_beta = 0.5 F_beta_y.
/// - Crowning after ISO 6336-1:2006, annex B (informative): C_beta = 0.5 F_beta_y, within 10 .. 40 um.
/// - End relief after the same annex: C_I(II) = F_beta_y, over the smaller of 0.1 b and m_n. The annex is followed as it is
///   customarily quoted, without its allowance for manufacturing tolerances.
///
/// Short relief and relief to single contact are rules of pairs with 1 < eps_alpha < 2 and left out of others.
std::vector<NamedDesign> rules_of_thumb(const DesignTask& task, const RuleBasis& basis);

/// The scaled designs nearest to these: a variable has their value, or the bound that is next to it, and everything else is as the task has it. Each design once.
std::vector<Eigen::VectorXd> within_bounds(const DesignProblem& problem, const std::vector<NamedDesign>& designs);

/// The amounts of a design that the variables of a task do not reach: "pinion tip relief". Where amounts are the same, the extents.
std::vector<std::string> out_of_reach(const DesignProblem& problem, const NamedDesign& design);

}  // namespace flankwright
