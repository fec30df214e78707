#include "core/base/wide_sum.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/common/random.hpp"

using namespace flankwright;

TEST_CASE("A wide product is the product of matrices, whatever their sizes", "[core][base]") {
  tests::Random32 random(3);
  for (const Eigen::Index rows : {1, 7, 256, 300, 515}) {
    for (const Eigen::Index terms : {1, 4, 6, 33}) {
      for (const Eigen::Index columns : {0, 1, 4, 11}) {
        CAPTURE(rows, terms, columns);
        const Eigen::MatrixXd A = random.normal_matrix(rows, terms), B = random.normal_matrix(terms, columns);
        const Eigen::MatrixXd product = wide_product(A, B);
        REQUIRE(product.rows() == rows);
        REQUIRE(product.cols() == columns);
        const double round_off = static_cast<double>(terms) * std::numeric_limits<double>::epsilon();
        CHECK(((product - A * B).cwiseAbs().array() <= round_off * (A.cwiseAbs() * B.cwiseAbs()).array()).all());
      }
    }
  }
}

TEST_CASE("Four columns are added by their factors", "[core][base]") {
  const Eigen::MatrixXd columns = Eigen::MatrixXd::Random(37, 4);
  const Eigen::Vector4d factors(1.0, -2.0, 0.5, 4.0);
  Eigen::VectorXd sum = Eigen::VectorXd::LinSpaced(37, 0.0, 1.0);
  const Eigen::VectorXd expected = sum + columns * factors;
  add_four_columns({columns.col(0).data(), columns.col(1).data(), columns.col(2).data(), columns.col(3).data()},
                   {factors[0], factors[1], factors[2], factors[3]}, sum.size(), sum.data());
  CHECK((sum - expected).lpNorm<Eigen::Infinity>() <= 16.0 * std::numeric_limits<double>::epsilon());
}
