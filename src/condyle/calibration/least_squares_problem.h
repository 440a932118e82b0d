#pragma once

/// What a maximum a posteriori estimate (least_squares.h) is asked for, and what it says.

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace condyle {

/// y and, where J is not null, ∂y/∂θ at θ; false where there is no y.
using Evaluate =
    std::function<bool(const Eigen::VectorXd& theta, Eigen::VectorXd& y, Eigen::MatrixXd* J)>;

/// Is a deviation of the prior one that holds anything, be it of a strain, of a logarithm or in mm?
[[nodiscard]] inline bool has_prior(double sd) { return sd < 1e6; }

struct LeastSquaresProblem {
  Evaluate evaluate;
  Eigen::VectorXd d, sd;       ///< of the rows that are fitted; evaluate gives as many
  Eigen::VectorXd prior_sd;    ///< of each θ (has_prior)
  Eigen::VectorXd prior_mean;  ///< 0 but for draws of the posterior
  Eigen::VectorXd lower, upper;
  std::optional<double> huber;  ///< in standard deviations
};

struct LeastSquaresOptions {
  int most_iterations = 300;
  double tolerance =
      1e-12;  ///< relative change of the cost, of θ; of the gradient 1e-14 of its start
  /// Told of every accepted step, with cost; false: stop with the best so far.
  std::function<bool(int iteration, double cost, const Eigen::VectorXd& theta)> on_step;
};

struct LeastSquaresResult {
  Eigen::VectorXd theta;
  Eigen::VectorXd y;                        ///< at θ
  Eigen::MatrixXd J;                        ///< ∂y/∂θ there
  double cost = 0;                          ///< ½ Σ, the prior's part included
  double chi_square = 0;                    ///< Σ ((y - d)/sd)², without robust loss and prior
  int iterations = 0, refused = 0;          ///< accepted steps; trial θ at which y did not exist
  bool converged = false, stopped = false;  ///< stopped: by on_step
  /// Rows whose derivatives jump at the least, where a contact opens or closes, rising: J, and what
  /// follows from it, hold on one side.
  std::vector<Eigen::Index> one_sided;
  std::string message;
  double seconds = 0;
};

}  // namespace condyle
