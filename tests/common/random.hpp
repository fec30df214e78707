#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace flankwright::tests {

/// Random numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double operator()(double from, double to) { return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double log_uniform(double from, double to) { return std::exp((*this)(std::log(from), std::log(to))); }
  /// Both ends included.
  int integer(int from, int to) { return from + static_cast<int>((*this)(0.0, to - from + 1.0)); }
  bool coin() { return (*this)(0.0, 1.0) < 0.5; }
  Eigen::VectorXd vector(Eigen::Index n, double from, double to) {
    return Eigen::VectorXd::NullaryExpr(n, [&] { return (*this)(from, to); });
  }
  /// Entries of -1 to 1.
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return (*this)(-1.0, 1.0); });
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace flankwright::tests
