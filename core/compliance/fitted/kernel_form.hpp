#pragma once

#include <array>
#include <string>
#include <vector>

namespace flankwright {

/// Decay lengths d_k of the end effects, in modules: e_k = exp(-distance from the end / d_k).
inline constexpr std::array<double, 3> kEndLengths{2.0, 0.8, 0.3};

/// Correlation function of a kernel over the scaled squared distance Q.
enum class Smoothness {
  Matern32,  ///< (1 + t) exp(-t), t = sqrt(3 Q)
  Matern52,  ///< (1 + t + t^2/3) exp(-t), t = sqrt(5 Q)
};

/// Which pairs of points a kernel couples.
enum class Reach {
  Tooth,    ///< points of one tooth
  Gear,     ///< all points: Q gains ((m_p - m_q)/lambda)^2, and the axial distance kappa (m_p - m_q)
  Turning,  ///< the same times cos(2 pi (m_p - m_q)/Z): the flank normals turn with the teeth, the motion below them does not
            ///< not
};

/// How a part of the gear body couples teeth.
enum class Coupling {
  Common,    ///< every tooth moves alike: torsion
  Turning,   ///< as cos(2 pi (m_p - m_q)/Z): displacement and tilt of the body, whose direction differs from tooth to tooth
  Decaying,  ///< as exp(-|m_p - m_q|/tau)
};

/// The numbers of powers of u in a function  sum_i c_i u^i + sum over ends and k of e_k sum_i c_i u^i.
struct EndPolynomial {
  int middle{0};             ///< without end effect, 1 .. 6
  std::array<int, 3> end{};  ///< for each decay length, the same at both ends, 0 .. 6

  int count() const { return middle + 2 * (end[0] + end[1] + end[2]); }
  bool operator==(const EndPolynomial&) const = default;
};

/// One kernel: log amplitude, log axial length and log radial length are such functions of the point.
struct Kernel {
  Smoothness smoothness{Smoothness::Matern32};
  Reach reach{Reach::Tooth};
  EndPolynomial amplitude{4, {3, 3, 2}};
  EndPolynomial axial{3, {2, 2, 0}};
  EndPolynomial radial{2, {1, 1, 0}};

  bool couples_teeth() const { return reach != Reach::Tooth; }
  /// Coefficients, among them log(lambda) and kappa where teeth are coupled.
  int count() const { return amplitude.count() + axial.count() + radial.count() + (couples_teeth() ? 2 : 0); }
  bool operator==(const Kernel&) const = default;
};

/// Part of the gear body: (L beta(p)).(L beta(q)) with a lower triangle L over the first functions of
/// beta = 1, t, u, t^2, t u, t^3, u^2, t^4, t^2 u, t^5, where t = 2 zeta/B - 1.
struct BodyPart {
  int functions{7};  ///< 1 .. 10
  Coupling coupling{Coupling::Common};

  int triangle() const { return functions * (functions + 1) / 2; }
  /// Coefficients, among them log(tau) for Coupling::Decaying.
  int count() const { return triangle() + (coupling == Coupling::Decaying ? 1 : 0); }
  bool operator==(const BodyPart&) const = default;
};

/// The form of a fitted compliance, and the meaning of its coefficients.
///
///     K(p,q) = sum over kernels of  h(p) h(q)/sqrt(A R) rho(Q)  +  sum over body parts of  (L beta(p)).(L beta(q))
///     C(m), A = (lz(p)^2 + lz(q)^2)/2,  R = (lr(p)^2 + lr(q)^2)/2,  h = g sqrt(lz lr), Q = (s(p) - s(q))^2/A + (u(p) -
///     u(q))^2/R,
///
/// and, where `torsion` is set, the torsion of the gear body as of a shaft between the end zeta = 0, where its torque
/// leaves, and the nearer of the two points. It is rounded off over a length w because torque spreads into a body only
/// gradually:
///
///     c/2 [v(zeta_p) + v(zeta_q) - v(zeta_p - zeta_q) - w],  v(d) = sqrt(d^2 + w^2);  -> c min(zeta_p, zeta_q), w ->
///     0,
///
/// the non-stationary kernel of Paciorek and Schervish (2006), which is positive semi-definite for any positive lz and
/// lr, as C(m) is for each Coupling and the torsion by Schoenberg's theorem (v is conditionally negative definite). So
/// is the matrix over any points of any teeth, whatever the coefficients. The first five coefficients warp the axis,
///
///     s = zeta + w_0 u + tanh(w_1) e^-zeta + 0.175 tanh(w_2) e^(-zeta/0.35)
///              - tanh(w_3) e^-(B-zeta) - 0.175 tanh(w_4) e^(-(B-zeta)/0.35),
///
/// those of the kernels follow, then log(c), log(w) of the torsion and those of the body parts. The coefficients of the
/// tooth, which interpolate well from gear to gear, are contiguous, and so are those of the body, which do not.
struct KernelForm {
  std::vector<Kernel> kernels;
  std::vector<BodyPart> bodies;
  bool torsion{false};

  static constexpr int kWarpCoefficients = 5;

  static KernelForm one_tooth();           ///< two kernels, 109 coefficients
  static KernelForm one_tooth_accurate();  ///< three kernels, 173 coefficients
  static KernelForm several_teeth();       ///< near and far kernels, 273 coefficients: for points on different teeth too
  static KernelForm correction();          ///< two kernels on one tooth and no body, 79 coefficients

  int tooth_count() const;  ///< coefficients of warp and kernels, the first ones
  int body_count() const;   ///< coefficients of torsion and body parts, the last ones
  int count() const { return tooth_count() + body_count(); }
  bool couples_teeth() const;  ///< whether the form covers two teeth

  /// Readable and unique, e.g. "kernel_0.log_amplitude.end_1.d_0.8.u_2"; size count().
  std::vector<std::string> coefficient_names() const;

  /// @throws InvalidInput where a number of powers or functions is out of range, or there is no kernel
  void validate() const;
  bool operator==(const KernelForm&) const = default;
};

}  // namespace flankwright
