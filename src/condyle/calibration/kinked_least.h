#pragma once

/// The way down to a least that lies on kinks: predictions are continuous, their derivatives jump where
/// a contact opens or closes. A step of Gauss and Newton from one side of a kink is wrong on the other.
/// Here the linear models of all sides met next to the best θ are held against each other, as in
/// bundle methods [Lemaréchal 1978]: steps lead to the least of the greatest of them, and θ is a least
/// (in Clarke's sense) where that takes nothing off the cost, by pieces that all lie next to θ.

#include <functional>
#include <vector>

#include "condyle/calibration/weighted_rows.h"

namespace condyle {

struct KinkedLeast {
  bool found = false;
  bool stopped = false;
  std::vector<Eigen::Index> rows;  ///< whose derivatives jump at the least, rising
};

/// From the best trial, which is the least where it was found. `fell` is told of every step that took
/// something off the cost; false: stop.
[[nodiscard]] KinkedLeast descend_along_kinks(const LeastSquaresProblem& problem,
                                              const LeastSquaresOptions& options,
                                              const Eigen::VectorXd& scale,
                                              Trials& trials,
                                              const std::function<bool()>& fell);

}  // namespace condyle
