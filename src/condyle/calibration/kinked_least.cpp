#include "condyle/calibration/kinked_least.h"

#include <algorithm>
#include <cmath>

#include "condyle/calibration/hull_step.h"

namespace condyle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastDamping = 1e-12;  // of the squares of scaled columns, which are about 1
constexpr double kFromHere = 1e-3;       // where a step that went wrong is damped first
constexpr std::size_t kMostPieces = 24;
constexpr int kMostTrials = 60, kMostRefused = 5;
constexpr double kLevel = 5e-7;   // of ½ χ²: 1e-3 posterior sd, beyond which second orders count
constexpr double kNextTo = 5e-6;  // 3e-3 posterior sd: how far the sides of a kink are met

class KinkedDescent {
 public:
  KinkedDescent(const LeastSquaresProblem& problem,
                const LeastSquaresOptions& options,
                const VectorXd& scale,
                Trials& trials)
      : problem_(problem),
        options_(options),
        scale_(scale),
        trials_(trials),
        lower_(problem.lower.cwiseQuotient(scale)),
        upper_(problem.upper.cwiseQuotient(scale)) {}

  KinkedLeast run(const std::function<bool()>& fell) {
    KinkedLeast result;
    add(trials_.best());
    const int most_refused = trials_.refused() + kMostRefused;
    for (int trial = 0; trial < kMostTrials && trials_.refused() < most_refused; ++trial) {
      const double cost = trials_.best().cost;
      const VectorXd centre = trials_.best().theta.cwiseQuotient(scale_);
      const HullStep step = hull_step(pieces_, centre, cost, damping_, lower_, upper_);
      const double left = cost - step.cost;
      if (left > std::max(kLevel, negligible_cost(options_, cost))) {
        go(centre + step.step, cost, left);
      } else if (held_back_) {
        damping_ = std::max(kLeastDamping, 1e-3 * damping_);
        held_back_ = damping_ > kLeastDamping;
      } else if (const Index far = farthest(step.weights, centre); far >= 0) {
        draw_near(static_cast<std::size_t>(far), centre);
      } else {
        result.found = true;
        result.rows = kinked_rows(step.weights);
        break;
      }
      result.stopped = trials_.best().cost < cost && !fell();
      if (result.stopped) break;
    }
    return result;
  }

 private:
  void add(const Trial& at) {
    const WeightedRows rows = weighted_rows(problem_, at, scale_);
    if (pieces_.size() == kMostPieces) drop();
    pieces_.push_back({at.theta.cwiseQuotient(scale_), rows.J.transpose() * rows.f,
                       rows.J.transpose() * rows.J, at.cost});
    slopes_.push_back(at.J);
  }

  /// The piece farthest from the best θ.
  void drop() {
    const VectorXd centre = trials_.best().theta.cwiseQuotient(scale_);
    std::size_t farthest = 0;
    double most = -1;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const double off = distance(k, centre);
      if (off <= most) continue;
      most = off;
      farthest = k;
    }
    remove(farthest);
  }

  /// As what the way there adds to a cost at its least.
  [[nodiscard]] double distance(std::size_t piece, const VectorXd& from) const {
    const VectorXd way = pieces_[piece].at - from;
    return 0.5 * way.dot(pieces_[piece].H * way);
  }

  /// Of the pieces that hold the least the one that does not lie next to it; -1: all do.
  [[nodiscard]] Index farthest(const VectorXd& weights, const VectorXd& centre) const {
    Index found = -1;
    double most = kNextTo;
    for (Index k = 0; k < weights.size(); ++k) {
      if (weights[k] <= 0) continue;
      const double off = distance(static_cast<std::size_t>(k), centre);
      if (off <= most) continue;
      most = off;
      found = k;
    }
    return found;
  }

  /// The other side of the kink nearer to the best θ: by halves, where a tenth of the way lies before it.
  void draw_near(std::size_t piece, const VectorXd& centre) {
    constexpr int kHalves = 4;
    const VectorXd there = pieces_[piece].at;
    const MatrixXd beyond = slopes_[piece], here = trials_.best().J;
    const double cost = trials_.best().cost;
    remove(piece);
    double before = 0, part = 0.1;
    for (int half = 0; half < kHalves; ++half) {
      const Trial& trial = look_at(centre + part * (there - centre));
      if (!trial.exists || trial.cost < cost || jump(trial.J, beyond) < jump(trial.J, here)) return;
      before = part;
      part = 0.5 * (before + 1);
    }
    look_at(there);
  }

  /// Greatest change of a row's weighted derivatives.
  [[nodiscard]] double jump(const MatrixXd& J, const MatrixXd& from) const {
    return ((J - from) * scale_.asDiagonal())
        .rowwise()
        .norm()
        .cwiseQuotient(problem_.sd)
        .maxCoeff();
  }

  void remove(std::size_t piece) {
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(piece));
    slopes_.erase(slopes_.begin() + static_cast<std::ptrdiff_t>(piece));
  }

  const Trial& look_at(const VectorXd& z) {
    const VectorXd theta = scale_.cwiseProduct(z).cwiseMax(problem_.lower).cwiseMin(problem_.upper);
    const Trial& trial = trials_.at(theta);
    if (trial.exists) add(trial);
    return trial;
  }

  /// A step goes too far where the rows are not linear that far; a kink on the way is none of that.
  void go(const VectorXd& z, double cost, double expected) {
    const VectorXd centre = trials_.best().theta.cwiseQuotient(scale_);
    const Trial& trial = look_at(z);
    const bool good = trial.exists && cost - trial.cost > 0.25 * expected;
    const bool bent = trial.exists && pieces_.back().value(centre) > cost + 0.5 * expected;
    held_back_ = held_back_ || !trial.exists;
    if (good)
      damping_ = std::max(kLeastDamping, 0.1 * damping_);
    else if (bent || !trial.exists)
      damping_ = std::max(kFromHere, 10 * damping_);
  }

  [[nodiscard]] std::vector<Index> kinked_rows(const VectorXd& weights) const {
    const MatrixXd& J = trials_.best().J;
    VectorXd jumps = VectorXd::Zero(J.rows());
    for (Index k = 0; k < weights.size(); ++k) {
      if (weights[k] <= 0) continue;
      const MatrixXd off = (slopes_[static_cast<std::size_t>(k)] - J) * scale_.asDiagonal();
      jumps = jumps.cwiseMax(off.rowwise().norm().cwiseQuotient(problem_.sd));
    }
    const double least = 1e-3 * jump(MatrixXd::Zero(J.rows(), J.cols()), J);
    std::vector<Index> rows;
    for (Index i = 0; i < jumps.size(); ++i)
      if (jumps[i] > std::max(least, 1e-2 * jumps.maxCoeff())) rows.push_back(i);
    return rows;
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  const VectorXd& scale_;
  Trials& trials_;
  VectorXd lower_, upper_;
  std::vector<CostPiece> pieces_;
  std::vector<MatrixXd> slopes_;  ///< ∂y/∂θ of the pieces
  double damping_ =
      kLeastDamping;        ///< raised where trials show more curvature than that of the rows,
  bool held_back_ = false;  ///< or where there were no predictions: that says nothing of a least
};

}  // namespace

KinkedLeast descend_along_kinks(const LeastSquaresProblem& problem,
                                const LeastSquaresOptions& options,
                                const VectorXd& scale,
                                Trials& trials,
                                const std::function<bool()>& fell) {
  return KinkedDescent(problem, options, scale, trials).run(fell);
}

}  // namespace condyle
