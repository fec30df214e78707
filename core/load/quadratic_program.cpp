#include "core/load/quadratic_program.hpp"

#include <Eigen/Cholesky>
#include <vector>

namespace flankwright {

namespace {

constexpr int block_patience = 3;  // block steps without progress before single pivots, as the authors suggest

}  // namespace

QuadraticMinimum minimise_quadratic(const Eigen::MatrixXd& H, const Eigen::VectorXd& b, const Eigen::VectorXd& a, double F,
                                    const Eigen::Array<bool, Eigen::Dynamic, 1>& guess) {
  const Eigen::Index n = b.size();
  Eigen::Array<bool, Eigen::Dynamic, 1> loaded = guess;
  if (!loaded.any()) loaded.setConstant(true);
  QuadraticMinimum best;
  Eigen::Index fewest = n + 1;
  int patience = block_patience;
  std::vector<Eigen::Index> set;
  // Block steps are bounded by n * patience, single pivots by 2^n in theory and a few n in practice.
  for (Eigen::Index step = 0; step < 20 * n + 100; ++step) {
    set.clear();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (loaded[i]) set.push_back(i);
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(H(set, set));
    ++best.factorisations;
    const Eigen::VectorXd ha = factor.solve(a(set)), hb = factor.solve(b(set));
    const double f = (F + a(set).dot(hb)) / a(set).dot(ha);
    const Eigen::VectorXd loads = f * ha - hb;
    best.x = Eigen::VectorXd::Zero(n);
    best.x(set) = loads;
    best.multiplier = f;
    const Eigen::VectorXd slack = H(Eigen::all, set) * loads + b - f * a;
    // Violated: negative load in the set, negative slack outside.
    Eigen::Index violated = 0, last = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (loaded[i] ? best.x[i] < 0.0 : slack[i] < 0.0) {
        ++violated;
        last = i;
      }
    }
    if (violated == 0) {
      best.solved = true;
      return best;
    }
    const bool progress = violated < fewest;
    if (progress) {
      fewest = violated;
      patience = block_patience;
    }
    if (progress || patience-- > 0) {
      for (Eigen::Index i = 0; i < n; ++i) {
        if (loaded[i] ? best.x[i] < 0.0 : slack[i] < 0.0) loaded[i] = !loaded[i];
      }
      if (!loaded.any()) loaded[last] = true;
    } else {
      loaded[last] = !loaded[last];
      if (!loaded.any()) loaded[last] = true;
    }
  }
  best.x = best.x.cwiseMax(0.0);
  return best;
}

}  // namespace flankwright
