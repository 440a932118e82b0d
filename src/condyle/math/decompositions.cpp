#include "condyle/math/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <algorithm>

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
  PivotedBasis basis{qr.householderQ() * SmallMatrix::Identity(A.rows(), A.rows()), qr.rank(), {}};
  const auto& order = qr.colsPermutation().indices();
  std::copy(order.begin(), order.end(), basis.order.begin());
  return basis;
}

SingularValues singular_values(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

SymmetricEigenvalues symmetric_eigenvalues(const SmallMatrix& A) {
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

PlaneEigenvalues plane_eigenvalues(const Eigen::Matrix2d& A) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen;
  eigen.computeDirect(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::VectorXd partially_pivoted_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::MatrixXd fully_pivoted_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.fullPivLu().solve(B);
}

Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.ldlt().solve(B);
}

double square_along(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::VectorXd along = qr.householderQ().adjoint() * b;
  return along.head(qr.rank()).squaredNorm();
}

Eigen::MatrixXd lower_root(const Eigen::MatrixXd& A) { return A.llt().matrixL(); }

Eigen::MatrixXd lower_solution(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B) {
  return L.triangularView<Eigen::Lower>().solve(B);
}

std::optional<SmallMatrix> regular_inverse(const SmallMatrix& A, double least) {
  const Eigen::FullPivLU<SmallMatrix> lu(A);
  if (!lu.matrixLU().allFinite() || !(lu.matrixLU().diagonal().cwiseAbs().minCoeff() > least))
    return std::nullopt;
  return lu.inverse();
}

}  // namespace condyle
