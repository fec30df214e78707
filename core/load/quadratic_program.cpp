#include "core/load/quadratic_program.hpp"

#include <limits>
#include <vector>

namespace flankwright {

namespace {

using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// Block steps without progress before the primal method; the authors suggest as many before single pivots.
constexpr int block_patience = 3;
/// A slack counts as negative below -round_off * (sum of the magnitudes of its terms).
constexpr double round_off = 16.0 * std::numeric_limits<double>::epsilon();

class Programme {
 public:
  Programme(const Eigen::MatrixXd& H, const Eigen::VectorXd& b, const Eigen::VectorXd& a, double F)
      : H_(H), b_(b), a_(a), force_(F), size_(b.size()) {}

  QuadraticMinimum pivot_blocks(Flags loaded) {
    if (!loaded.any()) loaded.setConstant(true);
    Eigen::Index fewest = size_ + 1;
    for (int patience = block_patience; patience >= 0;) {
      balance_on(loaded);
      const Eigen::VectorXd slack = slacks();
      // Violated: negative load in the set, negative slack outside.
      const Flags violated = loaded.select(at_.x.array() < 0.0, slack.array() < 0.0);
      const Eigen::Index count = violated.count();
      if (count == 0) {
        at_.solved = true;
        return at_;
      }
      patience = count < fewest ? block_patience : patience - 1;
      fewest = std::min(fewest, count);
      loaded = loaded != violated;
    }
    return descend();
  }

 private:
  /// From the loads of the last set, without the negative ones, down to the minimum: towards the minimiser on the
  /// loaded set up to the first load that vanishes, which leaves the set; at the minimiser the point that would
  /// penetrate most joins it.
  QuadraticMinimum descend() {
    Eigen::VectorXd x = at_.x.cwiseMax(0.0);
    x *= force_ / a_.dot(x);
    Flags loaded = x.array() > 0.0;
    Eigen::Index joined = -1;
    for (Eigen::Index step = 0; step < 20 * size_ + 100; ++step) {
      balance_on(loaded);
      double length = 1.0;
      for (Eigen::Index i = 0; i < size_; ++i) {
        if (loaded[i] && at_.x[i] < 0.0) length = std::min(length, x[i] / (x[i] - at_.x[i]));
      }
      if (length == 1.0) {
        x = at_.x;
        joined = most_penetrating(loaded);
        if (joined < 0) {
          at_.solved = true;
          return at_;
        }
        loaded[joined] = true;
        continue;
      }
      const Eigen::VectorXd target = at_.x;
      for (Eigen::Index i = 0; i < size_; ++i) {
        if (!loaded[i]) continue;
        const bool vanishes = target[i] < 0.0 && x[i] / (x[i] - target[i]) <= length;
        x[i] = vanishes ? 0.0 : x[i] + length * (target[i] - x[i]);
        loaded[i] = !vanishes;
      }
      // The point that has just joined would take no load: its slack was round-off.
      if (joined >= 0 && !loaded[joined] && length == 0.0) {
        balance_on(loaded);
        at_.solved = (at_.x.array() >= 0.0).all();
        if (at_.solved) return at_;
      }
    }
    at_.x = x;
    return at_;
  }

  /// Loads on a set that balance the force, signs free.
  void balance_on(const Flags& loaded) {
    std::vector<Eigen::Index> set;
    for (Eigen::Index i = 0; i < size_; ++i) {
      if (loaded[i]) set.push_back(i);
    }
    const Eigen::MatrixXd H = H_(set, set);
    const Eigen::VectorXd a = a_(set), b = b_(set);
    at_.factor.compute(H);
    ++at_.factorisations;
    const Eigen::VectorXd ha = at_.factor.solve(a);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(a.size());
    at_.multiplier = 0.0;
    // The second pass solves for what is left: where H is nearly singular the first loses digits between large terms.
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd left = at_.factor.solve(H * x + b - at_.multiplier * a);
      const double rise = (force_ - a.dot(x) + a.dot(left)) / a.dot(ha);
      x += rise * ha - left;
      at_.multiplier += rise;
    }
    at_.x = Eigen::VectorXd::Zero(size_);
    at_.x(set) = x;
  }

  Eigen::VectorXd slacks() const { return H_ * at_.x + b_ - at_.multiplier * a_; }

  /// The unloaded point of the largest negative slack per length, -1 where there is none.
  Eigen::Index most_penetrating(const Flags& loaded) const {
    const Eigen::VectorXd slack = slacks();
    const Eigen::VectorXd terms = H_.cwiseAbs() * at_.x + b_.cwiseAbs() + std::abs(at_.multiplier) * a_;
    Eigen::Index worst = -1;
    for (Eigen::Index i = 0; i < size_; ++i) {
      if (loaded[i] || slack[i] >= -round_off * terms[i]) continue;
      if (worst < 0 || slack[i] * a_[worst] < slack[worst] * a_[i]) worst = i;
    }
    return worst;
  }

  const Eigen::MatrixXd& H_;
  const Eigen::VectorXd& b_;
  const Eigen::VectorXd& a_;
  double force_;
  Eigen::Index size_;
  QuadraticMinimum at_;
};

}  // namespace

QuadraticMinimum minimise_quadratic(const Eigen::MatrixXd& H, const Eigen::VectorXd& b, const Eigen::VectorXd& a,
                                    double F, const Flags& guess) {
  return Programme(H, b, a, F).pivot_blocks(guess);
}

}  // namespace flankwright
