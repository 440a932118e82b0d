#pragma once

#include <Eigen/Core>

#include <random>

namespace condyle::test {

/// Normally distributed numbers, the same in every run.
inline Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 numbers(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(numbers); });
}

}  // namespace condyle::test
