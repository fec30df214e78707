#include "core/compliance/fitted/kernel_sum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::VectorXd;

/// e_k at both ends, [end][k].
using Ends = std::array<std::array<double, 3>, 2>;

Ends ends_at(double zeta, double face) {
  Ends ends;
  for (std::size_t k = 0; k < 3; ++k) {
    ends[0][k] = std::exp(-zeta / kEndLengths[k]);
    ends[1][k] = std::exp(-(face - zeta) / kEndLengths[k]);
  }
  return ends;
}

/// The functions whose coefficients an EndPolynomial counts, in the order of KernelForm::coefficient_names().
template <class Column>
void fill_basis(const EndPolynomial& polynomial, double u, const Ends& ends, Column&& out) {
  Index row = 0;
  const auto powers = [&](double factor, int count) {
    for (int i = 0; i < count; ++i, factor *= u) out[row++] = factor;
  };
  powers(1.0, polynomial.middle);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t end = 0; end < 2; ++end) powers(ends[end][k], polynomial.end[k]);
  }
}

struct Correlation {
  double value, slope;  ///< rho(Q), d rho/d Q
};

template <Smoothness S>
Correlation correlation(double Q) {
  if constexpr (S == Smoothness::Matern32) {
    const double t = std::sqrt(3 * Q), e = std::exp(-t);
    return {(1 + t) * e, -1.5 * e};
  } else {
    const double t = std::sqrt(5 * Q), e = std::exp(-t);
    return {(1 + t + t * t / 3) * e, -5.0 / 6 * (1 + t) * e};
  }
}

Correlation correlation(Smoothness smoothness, double Q) {
  return smoothness == Smoothness::Matern32 ? correlation<Smoothness::Matern32>(Q) : correlation<Smoothness::Matern52>(Q);
}

/// sum_i c_i basis(i, p) for every p, each in the same order: a point's value does not depend on which others there
/// are.
template <class Basis>
VectorXd combine(const Basis& basis, const double* c) {
  VectorXd sum(basis.cols());
  for (Index p = 0; p < basis.cols(); ++p) {
    double value = 0;
    for (Index i = 0; i < basis.rows(); ++i) value += c[i] * basis(i, p);
    sum[p] = value;
  }
  return sum;
}

}  // namespace

KernelSum::KernelSum(const KernelForm& form, const GearProportions& gear, std::span<const FlankStation> points)
    : form_(form), teeth_(gear.teeth), kernels_(form.kernels.size()), bodies_(form.bodies.size()) {
  const auto n = static_cast<Index>(points.size());
  const double B = gear.relative_face;
  tooth_.reserve(points.size());
  u_.resize(n);
  zeta_.resize(n);
  s_.resize(n);
  warp_basis_.resize(KernelForm::kWarpCoefficients, n);
  body_basis_.resize(10, n);
  int offset = KernelForm::kWarpCoefficients;
  for (std::size_t k = 0; k < kernels_.size(); ++k) {
    kernels_[k].amplitude_basis.resize(form.kernels[k].amplitude.count(), n);
    kernels_[k].axial_basis.resize(form.kernels[k].axial.count(), n);
    kernels_[k].radial_basis.resize(form.kernels[k].radial.count(), n);
    kernels_[k].offset = offset;
    offset += form.kernels[k].count();
  }
  torsion_offset_ = offset;
  if (form.torsion) offset += 2;
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    bodies_[k].offset = offset;
    offset += form.bodies[k].count();
  }
  for (Index p = 0; p < n; ++p) {
    const FlankStation& point = points[static_cast<std::size_t>(p)];
    const double u = point.u, zeta = point.zeta, t = 2 * zeta / B - 1;
    tooth_.push_back(point.tooth);
    u_[p] = u;
    zeta_[p] = zeta;
    warp_basis_.col(p) << u, std::exp(-zeta), 0.175 * std::exp(-zeta / 0.35), -std::exp(zeta - B), -0.175 * std::exp((zeta - B) / 0.35);
    body_basis_.col(p) << 1, t, u, t * t, t * u, t * t * t, u * u, t * t * t * t, t * t * u, t * t * t * t * t;
    const Ends ends = ends_at(zeta, B);
    for (std::size_t k = 0; k < kernels_.size(); ++k) {
      fill_basis(form.kernels[k].amplitude, u, ends, kernels_[k].amplitude_basis.col(p));
      fill_basis(form.kernels[k].axial, u, ends, kernels_[k].axial_basis.col(p));
      fill_basis(form.kernels[k].radial, u, ends, kernels_[k].radial_basis.col(p));
    }
  }
  if (tooth_.empty()) return;
  const auto [lowest, highest] = std::minmax_element(tooth_.begin(), tooth_.end());
  teeth_spanned_ = *highest - *lowest;
}

void KernelSum::set_coefficients(std::span<const double> x) {
  assert(static_cast<int>(x.size()) == form_.count());
  Eigen::Matrix<double, KernelForm::kWarpCoefficients, 1> w;
  w[0] = x[0];
  warp_slope_[0] = 1;
  for (int i = 1; i < KernelForm::kWarpCoefficients; ++i) {
    w[i] = std::tanh(x[static_cast<std::size_t>(i)]);
    warp_slope_[i] = 1 - w[i] * w[i];
  }
  s_ = zeta_ + combine(warp_basis_, w.data());

  for (std::size_t k = 0; k < kernels_.size(); ++k) {
    KernelAtPoints& at = kernels_[k];
    const double* c = x.data() + at.offset;
    const auto linear = [&](const Eigen::MatrixXd& basis) -> Eigen::ArrayXd {
      const Eigen::ArrayXd sum = combine(basis, c);
      c += basis.rows();
      return sum;
    };
    const Eigen::ArrayXd log_g = linear(at.amplitude_basis), log_lz = linear(at.axial_basis), log_lr = linear(at.radial_basis);
    const auto exponential = [](double value) { return std::exp(value); };
    at.h = (log_g + 0.5 * (log_lz + log_lr)).unaryExpr(exponential);
    at.axial_square = (2 * log_lz).unaryExpr(exponential);
    at.radial_square = (2 * log_lr).unaryExpr(exponential);
    if (form_.kernels[k].couples_teeth()) {
      at.inverse_lambda_square = std::exp(-2 * c[0]);
      at.kappa = c[1];
    }
  }
  if (form_.torsion) {
    torsion_compliance_ = std::exp(x[static_cast<std::size_t>(torsion_offset_)]);
    torsion_width_ = std::exp(x[static_cast<std::size_t>(torsion_offset_) + 1]);
    torsion_reach_ = (zeta_.array().square() + torsion_width_ * torsion_width_).sqrt();
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const BodyPart& part = form_.bodies[k];
    const double* c = x.data() + bodies_[k].offset;
    bodies_[k].features.setZero(part.functions, s_.size());
    for (int i = 0; i < part.functions; ++i) {
      for (int j = 0; j <= i; ++j) bodies_[k].features.row(i) += *c++ * body_basis_.row(j);
    }
    if (part.coupling == Coupling::Decaying) bodies_[k].inverse_tau = std::exp(-*c);
  }
}

void KernelSum::add_kernel(std::size_t k, Eigen::MatrixXd& lower) const {
  const KernelAtPoints& at = kernels_[k];
  const bool far = form_.kernels[k].couples_teeth();
  const bool turning = form_.kernels[k].reach == Reach::Turning;
  std::vector<double> cosine;
  for (int apart = 0; turning && apart <= teeth_spanned_; ++apart) cosine.push_back(turning_cosine(apart));
  const auto add = [&]<Smoothness S>() {
    const Index n = s_.size();
    for (Index q = 0; q < n; ++q) {
      const double s = s_[q], u = u_[q], h = at.h[q], lz2 = at.axial_square[q], lr2 = at.radial_square[q];
      const int tooth = tooth_[static_cast<std::size_t>(q)];
      double* column = lower.col(q).data();
      for (Index p = q; p < n; ++p) {
        const int apart = tooth_[static_cast<std::size_t>(p)] - tooth;
        if (apart != 0 && !far) continue;
        const double A = 0.5 * (at.axial_square[p] + lz2), R = 0.5 * (at.radial_square[p] + lr2);
        const double inverse = 1 / (A * R), m = apart;
        const double ds = s_[p] - s + at.kappa * m, du = u_[p] - u;
        const double Q = (ds * ds * R + du * du * A) * inverse + m * m * at.inverse_lambda_square;
        const double value = at.h[p] * h * std::sqrt(inverse) * correlation<S>(Q).value;
        column[p] += turning ? cosine[static_cast<std::size_t>(std::abs(apart))] * value : value;
      }
    }
  };
  if (form_.kernels[k].smoothness == Smoothness::Matern32) {
    add.operator()<Smoothness::Matern32>();
  } else {
    add.operator()<Smoothness::Matern52>();
  }
}

Eigen::MatrixXd KernelSum::tooth_matrix() const {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(s_.size(), s_.size());
  for (std::size_t k = 0; k < kernels_.size(); ++k) add_kernel(k, K);
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
  return K;
}

double KernelSum::torsion(Index p, Index q) const {
  const double d = zeta_[p] - zeta_[q], w = torsion_width_;
  return 0.5 * torsion_compliance_ * (torsion_reach_[p] + torsion_reach_[q] - std::sqrt(d * d + w * w) - w);
}

double KernelSum::turning_cosine(int teeth_apart) const { return std::cos(2 * units::pi * teeth_apart / teeth_); }

double KernelSum::coupling(std::size_t body, int teeth_apart) const {
  switch (form_.bodies[body].coupling) {
    case Coupling::Turning:
      return turning_cosine(teeth_apart);
    case Coupling::Decaying:
      return std::exp(-std::abs(teeth_apart) * bodies_[body].inverse_tau);
    case Coupling::Common:
      break;
  }
  return 1;
}

Eigen::MatrixXd KernelSum::body_matrix() const {
  const Index n = s_.size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  if (tooth_.empty()) return K;
  if (form_.torsion) {
    for (Index q = 0; q < n; ++q) {
      for (Index p = q; p < n; ++p) K(p, q) = torsion(p, q);
    }
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    std::vector<double> factor;
    for (int apart = 0; apart <= teeth_spanned_; ++apart) factor.push_back(coupling(k, apart));
    const Eigen::MatrixXd& features = bodies_[k].features;
    for (Index q = 0; q < n; ++q) {
      for (Index p = q; p < n; ++p) {
        double sum = 0;
        for (Index i = 0; i < features.rows(); ++i) sum += features(i, p) * features(i, q);
        const int apart = std::abs(tooth_[static_cast<std::size_t>(p)] - tooth_[static_cast<std::size_t>(q)]);
        K(p, q) += factor[static_cast<std::size_t>(apart)] * sum;
      }
    }
  }
  K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
  return K;
}

double KernelSum::with_gradient(Index p, Index q, std::span<double> gradient) const {
  std::fill(gradient.begin(), gradient.end(), 0.0);
  double value = 0;
  for (std::size_t k = 0; k < kernels_.size(); ++k) value += kernel_gradient(k, p, q, gradient);
  if (form_.torsion) {
    const double w = torsion_width_, d = zeta_[p] - zeta_[q], K = torsion(p, q);
    const auto at = static_cast<std::size_t>(torsion_offset_);
    gradient[at] = K;
    gradient[at + 1] = 0.5 * torsion_compliance_ * w * (w / torsion_reach_[p] + w / torsion_reach_[q] - w / std::sqrt(d * d + w * w) - 1);
    value += K;
  }
  for (std::size_t k = 0; k < bodies_.size(); ++k) value += body_gradient(k, p, q, gradient);
  return value;
}

double KernelSum::kernel_gradient(std::size_t k, Index p, Index q, std::span<double> gradient) const {
  const KernelAtPoints& at = kernels_[k];
  const int apart = tooth_[static_cast<std::size_t>(p)] - tooth_[static_cast<std::size_t>(q)];
  const bool far = form_.kernels[k].couples_teeth();
  if (apart != 0 && !far) return 0;
  const double m = apart;
  const double A = 0.5 * (at.axial_square[p] + at.axial_square[q]);
  const double R = 0.5 * (at.radial_square[p] + at.radial_square[q]);
  const double ds = s_[p] - s_[q] + at.kappa * m, du = u_[p] - u_[q];
  const double Q = ds * ds / A + du * du / R + m * m * at.inverse_lambda_square;
  const Correlation rho = correlation(form_.kernels[k].smoothness, Q);
  const double turn = form_.kernels[k].reach == Reach::Turning ? turning_cosine(apart) : 1;
  const double scale = turn * at.h[p] * at.h[q] / std::sqrt(A * R);
  const double K = scale * rho.value, dK_dQ = scale * rho.slope;

  double* out = gradient.data() + at.offset;
  const auto add = [&out](const Eigen::MatrixXd& basis, Index i, double by_i, Index j, double by_j) {
    Map<VectorXd>(out, basis.rows()) += by_i * basis.col(i) + by_j * basis.col(j);
    out += basis.rows();
  };
  add(at.amplitude_basis, p, K, q, K);
  // d/d log l of sqrt(l) / sqrt(A) and of Q, where dA/d log l = l^2.
  const double axial = -0.5 * K / A - dK_dQ * ds * ds / (A * A);
  add(at.axial_basis, p, 0.5 * K + axial * at.axial_square[p], q, 0.5 * K + axial * at.axial_square[q]);
  const double radial = -0.5 * K / R - dK_dQ * du * du / (R * R);
  add(at.radial_basis, p, 0.5 * K + radial * at.radial_square[p], q, 0.5 * K + radial * at.radial_square[q]);
  const double dK_ds = dK_dQ * 2 * ds / A;
  if (far) {
    out[0] = -2 * dK_dQ * m * m * at.inverse_lambda_square;
    out[1] = dK_ds * m;
  }
  Map<Eigen::Matrix<double, KernelForm::kWarpCoefficients, 1>> warp(gradient.data());
  warp += dK_ds * (warp_basis_.col(p) - warp_basis_.col(q)).cwiseProduct(warp_slope_);
  return K;
}

double KernelSum::body_gradient(std::size_t k, Index p, Index q, std::span<double> gradient) const {
  const BodyPart& part = form_.bodies[k];
  const Eigen::MatrixXd& features = bodies_[k].features;
  const int apart = std::abs(tooth_[static_cast<std::size_t>(p)] - tooth_[static_cast<std::size_t>(q)]);
  const double factor = coupling(k, apart);
  const double K = factor * features.col(p).dot(features.col(q));
  double* out = gradient.data() + bodies_[k].offset;
  for (int i = 0; i < part.functions; ++i) {
    for (int j = 0; j <= i; ++j) {
      *out++ = factor * (body_basis_(j, p) * features(i, q) + features(i, p) * body_basis_(j, q));
    }
  }
  if (part.coupling == Coupling::Decaying) *out = K * apart * bodies_[k].inverse_tau;
  return K;
}

}  // namespace flankwright
