#pragma once

/// The step to the least of the greatest of several quadratics within a box.

#include <Eigen/Core>

#include <vector>

namespace condyle {

/// cost + gradient·(z - at) + ½ (z - at)ᵀ H (z - at): the linear model of rows at one place.
struct CostPiece {
  Eigen::VectorXd at, gradient;
  Eigen::MatrixXd H;
  double cost = 0;

  [[nodiscard]] double value(const Eigen::VectorXd& z, double bend = 1) const {
    const Eigen::VectorXd way = z - at;
    return cost + gradient.dot(way) + 0.5 * bend * way.dot(H * way);
  }
  [[nodiscard]] Eigen::VectorXd slope(const Eigen::VectorXd& z, double bend = 1) const {
    return gradient + bend * (H * (z - at));
  }
};

struct HullStep {
  Eigen::VectorXd step;     ///< from the centre
  Eigen::VectorXd weights;  ///< convex ones of the pieces: their gradients cancel at the least
  double cost = 0;          ///< of the model there
};

/// From `centre` to the least of max_k piece_k + ½ damping |step|² between the bounds. Curvature is that
/// of the pieces by their weights. A piece that comes out above the cost at the centre is bent less, as
/// rows that are not linear would, so that it is level with it there and keeps what is known where it
/// was met.
[[nodiscard]] HullStep hull_step(const std::vector<CostPiece>& pieces,
                                 const Eigen::VectorXd& centre,
                                 double cost,
                                 double damping,
                                 const Eigen::VectorXd& lower,
                                 const Eigen::VectorXd& upper);

}  // namespace condyle
