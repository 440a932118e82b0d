#pragma once

/// What data and prior determine: singular values of S = W J P^½ (W = 1/sd, P the prior's variance). A
/// singular value above 1 is a direction of which the data say more than the prior.

#include <Eigen/Core>

#include <vector>

namespace condyle {

struct Identifiability {
  Eigen::VectorXd singular_values;  ///< of S, descending, one for each θ
  Eigen::MatrixXd directions;       ///< columns: right singular vectors, of θ/prior_sd
  int determined = 0;               ///< singular values above 1
  double effective = 0;             ///< Σ s²/(1 + s²): how many parameters the data determine
  Eigen::MatrixXd covariance;       ///< of θ: (JᵀW²J + P⁻¹)⁻¹
  Eigen::VectorXd sd;               ///< root of its diagonal
};

/// `weight`: 1/sd of each row, times the root of the robust weight. Of a θ at its bound (`fixed`) row
/// and column are left out: its sd is 0. Finite for any rank; prior_sd finite.
[[nodiscard]] Identifiability identifiability(const Eigen::MatrixXd& J,
                                              const Eigen::VectorXd& weight,
                                              const Eigen::VectorXd& prior_sd,
                                              const std::vector<bool>& fixed);

/// What more rows would tell where C is known: ½ ln det(I + C JᵀW²J) [-], and the covariance
/// (C⁻¹ + JᵀW²J)⁻¹. `weight`: 1/sd of each row of J.
struct Information {
  double nats = 0;
  Eigen::MatrixXd covariance;
};
[[nodiscard]] Information information_of(const Eigen::MatrixXd& J,
                                         const Eigen::VectorXd& weight,
                                         const Eigen::MatrixXd& covariance);

}  // namespace condyle
