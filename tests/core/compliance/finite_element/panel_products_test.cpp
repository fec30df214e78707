#include "core/compliance/finite_element/panel_products.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <functional>

#include "core/compliance/finite_element/one_core.hpp"
#include "tests/common/random.hpp"

using namespace flankwright;

namespace {

/// A lower triangle whose solutions are well conditioned.
Eigen::MatrixXd triangle(tests::Random& random, int n) {
  Eigen::MatrixXd l = random.matrix(n, n).triangularView<Eigen::Lower>();
  l /= n;
  l.diagonal().setConstant(1);
  return l;
}

Eigen::MatrixXd lower(const Eigen::MatrixXd& a) { return a.triangularView<Eigen::Lower>(); }

}  // namespace

TEST_CASE("Products in panels are those of whole blocks, in whichever order panels are taken", "[core][compliance][fe]") {
  const OneCore serial;
  std::size_t panels = 0;
  const ForEachIndex backwards = [&](std::size_t count, const std::function<void(std::size_t)>& work) {
    panels = count;
    for (std::size_t i = count; i-- > 0;) work(i);
  };
  const int n = 1000, k = 50;  // several panels of the one, less than one of the other
  tests::Random random(1);
  const Eigen::MatrixXd l = triangle(random, k), tall = random.matrix(n, k), wide = random.matrix(k, n), square = random.matrix(n, n);

  const auto check = [&](const Eigen::MatrixXd& start, const Eigen::MatrixXd& expected,
                         const std::function<void(const PanelProducts&, Eigen::MatrixXd&)>& product) {
    Eigen::MatrixXd in_order = start, in_reverse = start;
    product(PanelProducts({}), in_order);
    panels = 0;
    product(PanelProducts(backwards), in_reverse);
    CHECK((panels > 1 || blas_needs_turns()));
    CHECK(in_order == in_reverse);
    CHECK((in_order - expected).cwiseAbs().maxCoeff() < 1e-13 * expected.cwiseAbs().maxCoeff());  // round-off
  };
  const auto solve = l.triangularView<Eigen::Lower>();
  check(tall, solve.solve(tall.transpose()).transpose(),
        [&](const PanelProducts& p, Eigen::MatrixXd& b) { p.solve_from_right(n, k, l.data(), k, b.data(), n); });
  check(wide, solve.solve(wide), [&](const PanelProducts& p, Eigen::MatrixXd& b) { p.solve_from_left(k, n, l.data(), k, b.data(), k); });
  check(lower(square), lower(square - tall * tall.transpose()),
        [&](const PanelProducts& p, Eigen::MatrixXd& c) { p.subtract_outer(n, k, tall.data(), n, c.data(), n); });
  check(lower(square), lower(0.5 * square + wide.transpose() * wide),
        [&](const PanelProducts& p, Eigen::MatrixXd& c) { p.add_inner(n, k, wide.data(), k, 0.5, c.data(), n); });
  check(square, tall * wide, [&](const PanelProducts& p, Eigen::MatrixXd& c) { p.multiply(n, n, k, tall.data(), n, wide.data(), k, c.data(), n); });
}
