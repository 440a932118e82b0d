#include "condyle/math/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace condyle {

LeastNormSolution least_norm_solution(const Eigen::MatrixXd& A,
                                      const Eigen::VectorXd& b,
                                      std::optional<double> threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> of_A;
  if (threshold) of_A.setThreshold(*threshold);
  of_A.compute(A);
  return {of_A.solve(b), of_A.rank()};
}

Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
}

PivotedBasis pivoted_basis(const SmallMatrix& A, double threshold) {
  Eigen::ColPivHouseholderQR<SmallMatrix> qr(A);
  qr.setThreshold(threshold);
  return {qr.householderQ() * SmallMatrix::Identity(A.rows(), A.rows()), qr.rank()};
}

SingularValues singular_values(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

SymmetricEigenvalues symmetric_eigenvalues(const SmallMatrix& A) {
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXd partially_pivoted_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::MatrixXd fully_pivoted_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.fullPivLu().solve(B);
}

}  // namespace condyle
