#include "condyle/calibration/hull_step.h"

#include <algorithm>
#include <limits>

#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Weights on some of the pieces, the others 0, for which all of these are level; not yet positive.
VectorXd level_weights(const MatrixXd& Q,
                       const VectorXd& c,
                       const std::vector<Index>& of,
                       double& level) {
  const auto k = static_cast<Index>(of.size());
  MatrixXd K = MatrixXd::Zero(k + 1, k + 1);
  VectorXd right = VectorXd::Ones(k + 1);
  for (Index i = 0; i < k; ++i) {
    for (Index j = 0; j < k; ++j)
      K(i, j) = Q(of[static_cast<std::size_t>(i)], of[static_cast<std::size_t>(j)]);
    K(i, k) = K(k, i) = 1;
    right[i] = c[of[static_cast<std::size_t>(i)]];
  }
  const VectorXd solved = fully_pivoted_solution(K, right);
  VectorXd weights = VectorXd::Zero(c.size());
  for (Index i = 0; i < k; ++i) weights[of[static_cast<std::size_t>(i)]] = solved[i];
  level = solved[k];
  return weights;
}

/// Most of c·w - ½ wᵀ Q w over convex weights, by active sets.
VectorXd hull_weights(MatrixXd Q, const VectorXd& c) {
  Q.diagonal().array() += 1e-13 * Q.diagonal().maxCoeff() + std::numeric_limits<double>::min();
  Index first = 0;
  (c - 0.5 * Q.diagonal()).maxCoeff(&first);
  VectorXd weights = VectorXd::Unit(c.size(), first);
  std::vector<Index> used = {first};
  for (Index round = 0; round < 20 * c.size(); ++round) {
    double level = 0;
    const VectorXd wanted = level_weights(Q, c, used, level);
    double part = 1;
    Index drop = -1;
    for (const Index k : used) {
      if (wanted[k] >= 0) continue;
      const double until = weights[k] / (weights[k] - wanted[k]);
      if (until < part || drop < 0) {
        part = until;
        drop = k;
      }
    }
    weights += part * (wanted - weights);
    if (drop >= 0) {
      weights[drop] = 0;
      used.erase(std::find(used.begin(), used.end(), drop));
      continue;
    }
    Index highest = 0;
    const double above = (c - Q * weights).maxCoeff(&highest) - level;
    if (!(above > 1e-12 * (1 + Q.diagonal().maxCoeff())) ||
        std::find(used.begin(), used.end(), highest) != used.end())
      break;
    used.push_back(highest);
  }
  return weights;
}

/// Pieces as told from the centre, with one curvature.
struct Pieces {
  VectorXd cost;       ///< at the centre
  MatrixXd gradients;  ///< columns
  MatrixXd H;          ///< damped
};

/// Which components a box holds, and where.
struct Held {
  std::vector<bool> is;
  VectorXd at;
};

/// With the held components where they are.
HullStep step_with(const Pieces& pieces, const Held& held) {
  const Index n = held.at.size();
  std::vector<Index> free;
  VectorXd fixed = VectorXd::Zero(n);
  for (Index j = 0; j < n; ++j)
    if (held.is[static_cast<std::size_t>(j)])
      fixed[j] = held.at[j];
    else
      free.push_back(j);
  const VectorXd pull = pieces.H * fixed;
  const MatrixXd gradients = pieces.gradients.colwise() + pull;
  const MatrixXd G = gradients(free, Eigen::all);
  const VectorXd cost = pieces.cost + pieces.gradients.transpose() * fixed;
  const MatrixXd back = free.empty() ? G : symmetric_solution(pieces.H(free, free), G);
  HullStep found;
  found.weights = hull_weights(G.transpose() * back, cost);
  found.step = fixed;
  const VectorXd step = -(back * found.weights);
  for (std::size_t i = 0; i < free.size(); ++i) found.step[free[i]] = step[static_cast<Index>(i)];
  return found;
}

/// Components that the box holds are found by holding those that leave it, and by letting go of the one
/// that is pulled inwards most.
HullStep step_in_box(const Pieces& pieces, const VectorXd& lower, const VectorXd& upper) {
  const Index n = lower.size();
  Held held{std::vector<bool>(static_cast<std::size_t>(n), false), VectorXd::Zero(n)};
  HullStep found;
  for (Index round = 0; round < 4 * n + 4; ++round) {
    found = step_with(pieces, held);
    bool leaves = false;
    for (Index j = 0; j < n; ++j) {
      if (found.step[j] >= lower[j] && found.step[j] <= upper[j]) continue;
      leaves = held.is[static_cast<std::size_t>(j)] = true;
      held.at[j] = found.step[j] < lower[j] ? lower[j] : upper[j];
    }
    if (leaves) continue;
    const VectorXd slope = pieces.gradients * found.weights + pieces.H * found.step;
    Index release = -1;
    double most = 0;
    for (Index j = 0; j < n; ++j) {
      if (!held.is[static_cast<std::size_t>(j)] || lower[j] == upper[j]) continue;
      const double inwards = held.at[j] == lower[j] ? -slope[j] : slope[j];
      if (inwards <= most) continue;
      most = inwards;
      release = j;
    }
    if (release < 0) break;
    held.is[static_cast<std::size_t>(release)] = false;
  }
  found.step = found.step.cwiseMax(lower).cwiseMin(upper);
  return found;
}

/// How much of its curvature leaves a piece level with the cost at the centre.
double bend_of(const CostPiece& piece, const VectorXd& centre, double cost) {
  constexpr double kLeast = 0.1;
  const double above = piece.value(centre) - cost;
  if (above <= 0) return 1;
  const VectorXd way = centre - piece.at;
  return std::max(kLeast, 1 - 2 * above / way.dot(piece.H * way));
}

}  // namespace

HullStep hull_step(const std::vector<CostPiece>& pieces,
                   const VectorXd& centre,
                   double cost,
                   double damping,
                   const VectorXd& lower,
                   const VectorXd& upper) {
  const auto count = static_cast<Index>(pieces.size());
  const Index n = centre.size();
  Pieces told{VectorXd(count), MatrixXd(n, count), {}};
  VectorXd bends(count);
  for (Index k = 0; k < count; ++k) {
    const CostPiece& piece = pieces[static_cast<std::size_t>(k)];
    bends[k] = bend_of(piece, centre, cost);
    told.cost[k] = std::min(piece.value(centre, bends[k]) - cost, 0.0);
    told.gradients.col(k) = piece.slope(centre, bends[k]);
  }
  HullStep found;
  found.weights = VectorXd::Unit(count, count - 1);
  constexpr int kRounds = 3;  // of curvature by weights
  MatrixXd H;
  for (int round = 0; round < kRounds; ++round) {
    H = MatrixXd::Zero(n, n);
    for (Index k = 0; k < count; ++k)
      if (found.weights[k] > 0)
        H += found.weights[k] * bends[k] * pieces[static_cast<std::size_t>(k)].H;
    told.H = H + damping * MatrixXd::Identity(n, n);
    const VectorXd before = found.weights;
    found = step_in_box(told, lower - centre, upper - centre);
    if ((found.weights - before).lpNorm<Eigen::Infinity>() < 1e-3) break;
  }
  found.cost = cost + (told.cost + told.gradients.transpose() * found.step).maxCoeff() +
               0.5 * found.step.dot(H * found.step);
  return found;
}

}  // namespace condyle
