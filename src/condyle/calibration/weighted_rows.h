#pragma once

/// Trial θ of a fit, and the rows of data and prior over their standard deviations at one of them.

#include <Eigen/Core>

#include <limits>
#include <optional>

#include "condyle/calibration/least_squares_problem.h"

namespace condyle {

/// f with f² = ρ(r²) and the sign of r, and df/dr: ½ Σ f² is the cost, its gradient exact. Huber's
/// ρ(r²) = r² within δ, 2 δ |r| - δ² beyond.
struct RobustResidual {
  double f, slope;
};
[[nodiscard]] RobustResidual robust_residual(double r, const std::optional<double>& huber);

/// y, J and the cost at one θ.
struct Trial {
  Eigen::VectorXd theta, y;
  Eigen::MatrixXd J;
  double cost = std::numeric_limits<double>::infinity();
  bool exists = false;
};

/// The last θ that was asked for and the best: value and derivatives come with one solution of the
/// poses, however often Ceres asks.
class Trials {
 public:
  explicit Trials(const LeastSquaresProblem& problem) : problem_(problem) {}

  const Trial& at(const Eigen::VectorXd& theta);
  [[nodiscard]] const Trial& best() const { return best_; }
  [[nodiscard]] int refused() const { return refused_; }

 private:
  [[nodiscard]] double cost(const Trial& trial) const;

  const LeastSquaresProblem& problem_;
  Trial last_, best_;
  int refused_ = 0;
};

/// θ = scale z, scale a power of 2 next to the inverse of the column's norm at the start: the units of
/// the parameters drop out, and no bit is lost on the way.
[[nodiscard]] Eigen::VectorXd scale_of(const LeastSquaresProblem& problem,
                                       const Eigen::MatrixXd& J);

/// All rows over z at a trial, those of the prior last.
struct WeightedRows {
  Eigen::VectorXd f;
  Eigen::MatrixXd J;
};
[[nodiscard]] WeightedRows weighted_rows(const LeastSquaresProblem& problem,
                                         const Trial& at,
                                         const Eigen::VectorXd& scale);

/// What a whole step of Gauss and Newton would take off the cost, were the rows linear: 0 at a least. A
/// parameter that its gradient holds at a bound stays there.
[[nodiscard]] double cost_left(const LeastSquaresProblem& problem,
                               const Trial& at,
                               const Eigen::VectorXd& scale);

/// What is nothing to a cost: half of a χ² that moves θ by 1.4e-4 posterior sd, or its rounding.
[[nodiscard]] double negligible_cost(const LeastSquaresOptions& options, double cost);

}  // namespace condyle
