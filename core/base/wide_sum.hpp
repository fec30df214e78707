#pragma once

#include <Eigen/Core>
#include <array>

namespace flankwright {

// Sums and products of columns by the widest registers that the processor has, see vector_registers.hpp: Eigen takes two numbers at a time unless the
// whole program is compiled for one processor. The order of the terms does not depend on the registers.

/// Adds four columns, each times its factor, to a sum.
/// @param columns  n numbers each
/// @param sum      n
void add_four_columns(const std::array<const double*, 4>& columns, const std::array<double, 4>& factors, Eigen::Index n, double* sum);

/// A B.
/// @param A  n x k
/// @param B  k x m
Eigen::MatrixXd wide_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace flankwright
