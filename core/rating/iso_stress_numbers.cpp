#include "core/rating/iso_stress_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/local/hertz_line.hpp"

namespace flankwright {

namespace {

double involute(double angle) { return std::tan(angle) - angle; }

/// Z_eps [ISO 6336-2, eqs 26 to 28].
double contact_ratio_factor(const GearPair& pair) {
  const double alpha = pair.transverse_contact_ratio, beta = std::min(1.0, pair.overlap_ratio);
  return std::sqrt((4.0 - alpha) / 3.0 * (1.0 - beta) + beta / alpha);
}

/// Z_B or Z_D: from the pitch point to the inner point of single pair contact of the gear [ISO 6336-2, 6.2]. The auxiliary factor of the edition of 2019 for helical
/// gears, f_ZCa, is 1.
double single_pair_factor(const GearPair& pair, Member member) {
  const Member mate = member == Member::Pinion ? Member::Wheel : Member::Pinion;
  const auto tip = [&](Member m) { return std::sqrt(std::pow(pair[m].tip_form_radius / pair[m].base_radius, 2) - 1.0); };
  const double own = tip(member) - 2.0 * units::pi / pair[member].data.teeth;
  const double other = tip(mate) - (pair.transverse_contact_ratio - 1.0) * 2.0 * units::pi / pair[mate].data.teeth;
  const double beta = pair.overlap_ratio;
  if (beta >= 1.0 || !(own > 0.0 && other > 0.0)) return 1.0;
  const double M = std::tan(pair.working_transverse_pressure_angle) / std::sqrt(own * other);
  return std::max(1.0, M - beta * (M - 1.0));
}

struct RootFactors {
  double Y_F, Y_S;
};

/// Tooth form and stress correction [ISO 6336-3:2006, 6.2 and 7.2], symbols as there; lengths in m_n.
RootFactors root_factors(const GearPair& pair, Member member) {
  const Gear& gear = pair[member];
  const RackProfile& rack = gear.data.rack;
  const double alpha_n = pair.data.pressure_angle, beta = pair.data.helix_angle, x = gear.generating_profile_shift, m_n = pair.data.normal_module;
  const double z = gear.data.teeth, cos_beta_b = std::cos(pair.base_helix_angle), z_n = z / (cos_beta_b * cos_beta_b * std::cos(beta));
  const double h_fP = rack.dedendum, rho_fP = rack.root_radius;
  const double E = units::pi / 4.0 - h_fP * std::tan(alpha_n) - (1.0 - std::sin(alpha_n)) * rho_fP / std::cos(alpha_n);
  const double G = rho_fP - h_fP + x;
  const double H = 2.0 / z_n * (units::pi / 2.0 - E) - units::pi / 3.0;
  double theta = units::pi / 6.0;
  constexpr int steps = 50;  // a contraction by 2 G/z_n / cos^2(theta), below 1/2 of any tooth
  for (int i = 0; i < steps; ++i) theta = 2.0 * G / z_n * std::tan(theta) - H;
  const double s_Fn = z_n * std::sin(units::pi / 3.0 - theta) + std::sqrt(3.0) * (G / std::cos(theta) - rho_fP);
  const double rho_F = rho_fP + 2.0 * G * G / (std::cos(theta) * (z_n * std::cos(theta) * std::cos(theta) - 2.0 * G));
  const double eps_alpha_n = pair.transverse_contact_ratio / (cos_beta_b * cos_beta_b);
  const double d_n = z_n, d_bn = d_n * std::cos(alpha_n), d_an = d_n + 2.0 * (gear.tip_form_radius - gear.reference_radius) / m_n;
  const double along = std::sqrt(d_an * d_an - d_bn * d_bn) / 2.0 - units::pi * std::cos(alpha_n) * (eps_alpha_n - 1.0);
  const double d_en = 2.0 * std::sqrt(along * along + d_bn * d_bn / 4.0);
  const double alpha_en = std::acos(d_bn / d_en);
  const double gamma_e = (units::pi / 2.0 + 2.0 * x * std::tan(alpha_n)) / z_n + involute(alpha_n) - involute(alpha_en);
  const double alpha_Fen = alpha_en - gamma_e;
  const double h_Fe = 0.5 * ((std::cos(gamma_e) - std::sin(gamma_e) * std::tan(alpha_Fen)) * d_en - z_n * std::cos(units::pi / 3.0 - theta) -
                             G / std::cos(theta) + rho_fP);
  const double L = s_Fn / h_Fe, q_s = s_Fn / (2.0 * rho_F);
  return {6.0 * h_Fe * std::cos(alpha_Fen) / (s_Fn * s_Fn * std::cos(alpha_n)), (1.2 + 0.13 * L) * std::pow(q_s, 1.0 / (1.21 + 2.3 / L))};
}

}  // namespace

double IsoStressNumbers::contact_stress(Member member, double K) const { return single_pair[member] * contact * std::sqrt(K); }

IsoStressNumbers iso_stress_numbers(const GearPair& pair, const PerGear<Material>& material, double pinion_torque, double face_width,
                                    const PerGear<double>& rim_thickness) {
  IsoStressNumbers numbers;
  const double alpha_t = pair.transverse_pressure_angle, alpha_wt = pair.working_transverse_pressure_angle, u = pair.gear_ratio();
  const double d_1 = 2.0 * pair.pinion.reference_radius, F_t = 2.0 * pinion_torque / d_1;
  numbers.Z_H = std::sqrt(2.0 * std::cos(pair.base_helix_angle) * std::cos(alpha_wt) / (std::sin(alpha_wt) * std::pow(std::cos(alpha_t), 2)));
  numbers.Z_E = std::sqrt(contact_modulus(material.pinion, material.wheel) / units::pi);
  numbers.Z_eps = contact_ratio_factor(pair);
  numbers.Z_beta = 1.0 / std::sqrt(std::cos(pair.data.helix_angle));
  numbers.contact = numbers.Z_H * numbers.Z_E * numbers.Z_eps * numbers.Z_beta * std::sqrt(F_t / (d_1 * face_width) * (u + 1.0) / u);
  const double most = 30.0 * units::deg;  // of beta in Y_beta [ISO 6336-3:2006]
  numbers.Y_beta = 1.0 - std::min(1.0, pair.overlap_ratio) * std::min(most, pair.data.helix_angle) / (120.0 * units::deg);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    numbers.single_pair[m] = single_pair_factor(pair, m);
    const RootFactors root = root_factors(pair, m);
    numbers.Y_F[m] = root.Y_F;
    numbers.Y_S[m] = root.Y_S;
    numbers.Y_B[m] = rim_thickness_factor(pair[m], rim_thickness[m]);
    numbers.root[m] = F_t / (face_width * pair.data.normal_module) * root.Y_F * root.Y_S * numbers.Y_beta * numbers.Y_B[m];
  }
  return numbers;
}

double rim_thickness_factor(const Gear& gear, double rim_thickness) {
  const double s_R = rim_thickness, h_t = gear.tip_radius - gear.root_radius;
  return s_R < 1.2 * h_t ? std::max(1.0, 1.6 * std::log(2.242 * h_t / s_R)) : 1.0;
}

double root_face_load_factor(const GearPair& pair, double face_width, double K_Hbeta) {
  const double depth = std::max(pair.pinion.tip_radius - pair.pinion.root_radius, pair.wheel.tip_radius - pair.wheel.root_radius);
  const double ratio = std::min(1.0 / 3.0, depth / face_width);
  return std::pow(K_Hbeta, 1.0 / (1.0 + ratio + ratio * ratio));
}

}  // namespace flankwright
