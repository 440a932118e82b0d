#pragma once

/// Decompositions of dense matrices of a few rows, each instantiated in one place: what Eigen makes of one for a type of
/// matrix takes seconds to compile. Most of them allocate: the Newton loop has small_lu.h.

#include <Eigen/Core>

#include <array>
#include <optional>

namespace condyle {

/// At most 6 x 6, on the stack.
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

struct LeastNormSolution {
  Eigen::VectorXd x;
  Eigen::Index rank = 0;  ///< of A
};
/// Of all x with the least |A x - b| the shortest. Pivots up to `threshold` times the largest count as nothing; without
/// one those that round-off makes.
[[nodiscard]] LeastNormSolution least_norm_solution(const Eigen::MatrixXd& A,
                                                    const Eigen::VectorXd& b,
                                                    std::optional<double> threshold = std::nullopt);

/// The square orthogonal Q of A = Q R: its first columns span those of A, the others are orthogonal to them where A has
/// full rank.
[[nodiscard]] Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& A);

struct PivotedBasis {
  SmallMatrix Q;  ///< square and orthogonal; its first `rank` columns span those of A
  Eigen::Index rank = 0;
  std::array<int, 6> order{};  ///< of the columns of A, the largest pivot first
};
/// Pivots up to `threshold` times the largest count as nothing. Allocates nothing.
[[nodiscard]] PivotedBasis pivoted_basis(const SmallMatrix& A, double threshold);

struct SingularValues {
  Eigen::VectorXd values;  ///< min(rows, columns) of them, the largest first
  Eigen::MatrixXd V;       ///< square; a column of each, and those of nothing
};
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXd& A);

struct SymmetricEigenvalues {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> values;  ///< the least first
  SmallMatrix vectors;                                       ///< a column of each
};
/// Of a symmetric matrix. Allocates nothing: every pose asks for some.
[[nodiscard]] SymmetricEigenvalues symmetric_eigenvalues(const SmallMatrix& A);

struct PlaneEigenvalues {
  Eigen::Vector2d values;   ///< the lesser first
  Eigen::Matrix2d vectors;  ///< a column of each
};
/// Of a symmetric matrix in closed form.
[[nodiscard]] PlaneEigenvalues plane_eigenvalues(const Eigen::Matrix2d& A);

/// x with A x = b for a regular A, by elimination with partial pivoting.
[[nodiscard]] Eigen::VectorXd partially_pivoted_solution(const Eigen::MatrixXd& A,
                                                         const Eigen::VectorXd& b);
/// X with A X = B by elimination with full pivoting, where A may be close to singular.
[[nodiscard]] Eigen::MatrixXd fully_pivoted_solution(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& B);
/// X with A X = B for a symmetric A, that of normal equations say, by L D Lᵀ with pivoting.
[[nodiscard]] Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& A,
                                                 const Eigen::MatrixXd& B);
/// The square of the length that b has along the columns of A.
[[nodiscard]] double square_along(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// The lower triangle L of A = L Lᵀ, of a positive definite A.
[[nodiscard]] Eigen::MatrixXd lower_root(const Eigen::MatrixXd& A);
/// X with L X = B, of a lower triangle L.
[[nodiscard]] Eigen::MatrixXd lower_solution(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B);
/// By elimination with full pivoting, without allocation; none where A has no number or a pivot up to `least`.
[[nodiscard]] std::optional<SmallMatrix> regular_inverse(const SmallMatrix& A, double least);

}  // namespace condyle
