#include "core/compliance/shaft/bearing_equilibrium.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace flankwright {

namespace {

using Eigen::Index, Eigen::Matrix2d, Eigen::MatrixXd, Eigen::Vector2d, Eigen::VectorXd;

class Equilibrium {
 public:
  Equilibrium(const VectorXd& forces, const MatrixXd& stiffness, const std::vector<NonlinearBearing>& bearings)
      : forces_(forces), stiffness_(stiffness), bearings_(bearings), largest_force_(forces.cwiseAbs().maxCoeff()) {
    std::vector<double> clearances;
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const auto at = static_cast<Index>(2 * i);
      std::vector<Index>& kind = bearings[i].law ? with_law_ : without_law_;
      kind.insert(kind.end(), {at, at + 1});
      if (!bearings[i].law) clearances.push_back(bearings[i].clearance);
    }
    clearance_ = Eigen::Map<const VectorXd>(clearances.data(), std::ssize(clearances));
  }

  ClearanceState run() {
    state_.shift = VectorXd::Zero(forces_.size());
    if (largest_force_ > 0.0) {
      start();
      constexpr int most_iterations = 200;
      for (state_.iterations = 0; state_.iterations < most_iterations; ++state_.iterations) {
        state_.residual = residual();
        if (is_converged() || !improve()) break;
      }
    } else {
      state_.residual = state_.iterations = 0;
    }
    state_.converged = is_converged();
    finish();
    return std::move(state_);
  }

 private:
  Vector2d at(const VectorXd& shift, std::size_t bearing) const { return shift.segment<2>(static_cast<Index>(2 * bearing)); }

  bool is_converged() const {
    if (!(largest_force_ > 0.0)) return true;
    // Forces of stiff shafts and steep laws are known to the round-off of displacements only, and to what solve_clearances() leaves of them.
    constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon(), left_by_clearances = 4.0 * clearance_residual;
    VectorXd unknown = round_off * state_.shift.cwiseAbs();
    if (!without_law_.empty()) unknown.array() += left_by_clearances * clearance_.maxCoeff();
    const double of_displacements = (hessian(state_.shift).cwiseAbs() * unknown).maxCoeff();
    return state_.residual <= std::max(bearing_residual, of_displacements / largest_force_);
  }

  /// Every shaft pressed against its bearings along the forces F0.
  void start() {
    double softest = 0.0;  // deflection of a bearing under the largest force
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      const NonlinearBearing& bearing = bearings_[i];
      const Vector2d force = at(forces_, i);
      if (bearing.law) softest = std::max(softest, bearing.clearance + bearing.law->deflection(largest_force_));
      if (!(force.norm() > 0.0)) continue;
      const double size = bearing.clearance + (bearing.law ? bearing.law->deflection(force.norm()) : 0.0);
      state_.shift.segment<2>(static_cast<Index>(2 * i)) = size / force.norm() * force;
    }
    // Shafts that no bearing touches are held by this part of a bearing's stiffness: steps stay finite, and the energy's slope ends them.
    constexpr double held_in_a_step = 1e-6;
    held_ = held_in_a_step * largest_force_ / softest;
  }

  /// Force of a law's bearing and, where asked for, its derivative by the shift.
  Vector2d law_force(std::size_t i, const Vector2d& shift, Matrix2d* slope = nullptr) const {
    const NonlinearBearing& bearing = bearings_[i];
    const double size = shift.norm(), beyond = size - bearing.clearance;
    if (!(beyond > 0.0)) {
      // Without clearance a table has a stiffness at no load.
      if (slope != nullptr) *slope = (size == bearing.clearance ? bearing.law->stiffness(0.0) : 0.0) * Matrix2d::Identity();
      return Vector2d::Zero();
    }
    const Vector2d outwards = shift / size;
    const double force = bearing.law->force(beyond);
    if (slope != nullptr) {
      const Matrix2d along = outwards * outwards.transpose();
      *slope = bearing.law->stiffness(beyond) * along + force / size * (Matrix2d::Identity() - along);
    }
    return force * outwards;
  }

  /// Of the energy, without what holds at the border.
  VectorXd gradient(const VectorXd& shift) const {
    VectorXd by_shift = stiffness_ * shift - forces_;
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      if (bearings_[i].law) by_shift.segment<2>(static_cast<Index>(2 * i)) += law_force(i, at(shift, i));
    }
    return by_shift;
  }

  MatrixXd hessian(const VectorXd& shift) const {
    MatrixXd second = stiffness_ + held_ * MatrixXd::Identity(stiffness_.rows(), stiffness_.cols());
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      if (!bearings_[i].law) continue;
      Matrix2d slope;
      law_force(i, at(shift, i), &slope);
      second.block<2, 2>(static_cast<Index>(2 * i), static_cast<Index>(2 * i)) += slope;
    }
    return second;
  }

  double residual() const {
    const VectorXd left = gradient(state_.shift);
    double largest = left(with_law_).cwiseAbs().maxCoeff() / largest_force_;
    if (without_law_.empty()) return largest;
    // As solve_clearances() has it.
    const double size = clearance_.maxCoeff();
    const double gamma = 1.0 / (stiffness_.cwiseAbs().rowwise().sum().maxCoeff() + largest_force_ / size);
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      if (bearings_[i].law) continue;
      Vector2d pushed = at(state_.shift, i) - gamma * at(left, i);
      if (pushed.norm() > bearings_[i].clearance) pushed *= bearings_[i].clearance / pushed.norm();
      largest = std::max(largest, (at(state_.shift, i) - pushed).cwiseAbs().maxCoeff() / size);
    }
    return largest;
  }

  /// The minimum of the quadratic model of the energy, seen from the present shift.
  VectorXd step(const VectorXd& left) const {
    const MatrixXd second = hessian(state_.shift);
    const Eigen::LDLT<MatrixXd> of_laws(second(with_law_, with_law_));
    VectorXd step = VectorXd::Zero(left.size());
    VectorXd of_laws_left = left(with_law_);
    if (!without_law_.empty()) {
      // What the bearings with a law do to the others is eliminated; the rest is equilibrium in clearances.
      const MatrixXd coupling = second(with_law_, without_law_);
      const MatrixXd reduced = second(without_law_, without_law_) - coupling.transpose() * of_laws.solve(coupling);
      const MatrixXd symmetric = 0.5 * (reduced + reduced.transpose());
      const VectorXd here = state_.shift(without_law_);
      const VectorXd pull = symmetric * here - (left(without_law_) - coupling.transpose() * of_laws.solve(of_laws_left));
      const VectorXd moved = solve_clearances(pull, symmetric, clearance_).shift - here;
      step(without_law_) = moved;
      of_laws_left += coupling * moved;
    }
    step(with_law_) = -of_laws.solve(of_laws_left);
    return step;
  }

  /// False where no step lessens the energy any more.
  bool improve() {
    const VectorXd left = gradient(state_.shift), direction = step(left);
    const double slope = left.dot(direction);
    if (!(slope < 0.0)) return false;
    const auto slope_at = [&](double part) { return gradient(state_.shift + part * direction).dot(direction); };
    constexpr double little = 0.1;  // of the first slope is taken for the least energy along the step
    double low = 0.0, high = 1.0, part = 1.0;
    for (int halving = 0; halving < 100; ++halving) {
      const double here = slope_at(part);
      if (std::abs(here) <= -little * slope || (part == 1.0 && here < 0.0)) break;
      (here < 0.0 ? low : high) = part;
      part = 0.5 * (low + high);
    }
    state_.shift += part * direction;
    return true;
  }

  void finish() {
    state_.force = forces_ - stiffness_ * state_.shift;
    for (std::size_t i = 0; i < bearings_.size(); ++i) {
      const NonlinearBearing& bearing = bearings_[i];
      const auto here = static_cast<Index>(2 * i);
      const Vector2d shift = at(state_.shift, i);
      if (bearing.law) state_.force.segment<2>(here) = law_force(i, shift);
      const double force = at(state_.force, i).norm();
      // A bearing without law is touched where the shaft is at its border; without load some keep a stiffness.
      const bool keeps = bearing.law && bearing.clearance == 0.0 && bearing.law->stiffness(0.0) > 0.0;
      const bool touches = bearing.law || shift.norm() >= bearing.clearance * (1.0 - 1e-9);
      constexpr double nothing = 1e-9;  // a force below this part of the largest is none
      state_.carries.push_back(keeps || (touches && force > nothing * largest_force_));
      if (!state_.carries.back() || force == 0.0) state_.force.segment<2>(here).setZero();
    }
  }

  const VectorXd& forces_;
  const MatrixXd& stiffness_;
  const std::vector<NonlinearBearing>& bearings_;
  double largest_force_, held_{0.0};
  std::vector<Index> with_law_, without_law_;  ///< rows of bearings
  VectorXd clearance_;                         ///< of bearings without a law
  ClearanceState state_;
};

}  // namespace

ClearanceState solve_bearings(const VectorXd& forces, const MatrixXd& stiffness, const std::vector<NonlinearBearing>& bearings) {
  if (std::ranges::any_of(bearings, [](const NonlinearBearing& bearing) { return bearing.law.has_value(); })) {
    return Equilibrium(forces, stiffness, bearings).run();
  }
  VectorXd clearance(std::ssize(bearings));
  for (std::size_t i = 0; i < bearings.size(); ++i) clearance[static_cast<Index>(i)] = bearings[i].clearance;
  return solve_clearances(forces, stiffness, clearance);
}

BearingTangent tangent_of(const NonlinearBearing& bearing, const Vector2d& force, const Vector2d& shift, bool carries) {
  BearingTangent tangent;
  tangent.carries = carries;
  if (!carries) return tangent;
  if (!(force.norm() > 0.0)) {
    tangent.compliance = 1.0 / bearing.law->stiffness(0.0) * Matrix2d::Identity();
    return tangent;
  }
  const double size = force.norm();
  const Vector2d outwards = force.normalized();
  const Matrix2d along = outwards * outwards.transpose();
  if (!bearing.law) {
    tangent.compliance = bearing.clearance / size * (Matrix2d::Identity() - along);
    tangent.prestrain = shift;
    return tangent;
  }
  const double deflection = bearing.law->deflection(size), by_force = bearing.law->compliance(size);
  tangent.compliance = by_force * along + (bearing.clearance + deflection) / size * (Matrix2d::Identity() - along);
  tangent.prestrain = (bearing.clearance + (deflection - by_force * size)) * outwards;
  return tangent;
}

}  // namespace flankwright
