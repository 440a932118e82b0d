#include "condyle/calibration/profiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kValues = 20;   // even: the least is none of them
constexpr double kReach = 3;  // posterior sds

/// All but component j.
VectorXd without(const VectorXd& v, Index j) {
  VectorXd rest(v.size() - 1);
  rest << v.head(j), v.tail(v.size() - j - 1);
  return rest;
}

VectorXd with(const VectorXd& rest, Index j, double value) {
  VectorXd v(rest.size() + 1);
  v << rest.head(j), value, rest.tail(rest.size() - j);
  return v;
}

/// The problem of the others while θ_j is held.
LeastSquaresProblem with_held(const LeastSquaresProblem& rows,
                              const Evaluate& evaluate,
                              Index j,
                              double value) {
  LeastSquaresProblem others = rows;
  others.prior_sd = without(rows.prior_sd, j);
  others.prior_mean = without(rows.prior_mean, j);
  others.lower = without(rows.lower, j);
  others.upper = without(rows.upper, j);
  others.evaluate = [&evaluate, j, value](const VectorXd& theta, VectorXd& y, MatrixXd* J) {
    MatrixXd all;
    if (!evaluate(with(theta, j, value), y, J != nullptr ? &all : nullptr)) return false;
    if (J != nullptr) {
      J->resize(all.rows(), all.cols() - 1);
      *J << all.leftCols(j), all.rightCols(all.cols() - j - 1);
    }
    return true;
  };
  return others;
}

/// Of which the data say most: the profile of one that they leave alone is the prior's parabola.
std::vector<std::size_t> best_known(const Identifiability& known,
                                    const VectorXd& prior_sd,
                                    int most) {
  std::vector<std::size_t> order(static_cast<std::size_t>(known.sd.size()));
  std::iota(order.begin(), order.end(), 0U);
  const auto kept = [&](std::size_t j) {
    return known.sd[static_cast<Index>(j)] / prior_sd[static_cast<Index>(j)];
  };
  std::erase_if(order, [&](std::size_t j) { return !(kept(j) > 0); });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return kept(a) < kept(b); });
  order.resize(std::min(order.size(), static_cast<std::size_t>(std::max(0, most))));
  std::sort(order.begin(), order.end());
  return order;
}

Profile empty_profile(const LeastSquaresProblem& rows,
                      const LeastSquaresResult& least,
                      const Identifiability& known,
                      std::size_t parameter) {
  const auto j = static_cast<Index>(parameter);
  const double half = kReach * known.sd[j];
  const double first = std::max(least.theta[j] - half, rows.lower[j]);
  const double last = std::min(least.theta[j] + half, rows.upper[j]);
  Profile profile;
  profile.parameter = parameter;
  for (int k = 0; k < kValues; ++k)
    profile.theta.push_back(first + (last - first) * k / (kValues - 1));
  profile.chi_square.assign(kValues, kNoNumber);
  return profile;
}

/// One side of a profile, outwards, until there are no predictions.
void walk(const FitWorker& worker,
          const LeastSquaresProblem& rows,
          const LeastSquaresResult& least,
          bool upwards,
          Profile& profile,
          StudyProgress& progress) {
  if (!reach(worker, least.theta)) return;
  const auto j = static_cast<Index>(profile.parameter);
  VectorXd others = without(least.theta, j);
  LeastSquaresOptions options;
  options.tolerance = kStudyTolerance;
  options.on_step = [&](int, double, const VectorXd&) { return progress.goes_on(); };
  for (std::size_t i = 0; i < kValues; ++i) {
    const std::size_t k = upwards ? i : kValues - 1 - i;
    const double value = profile.theta[k];
    if (upwards == (value < least.theta[j])) continue;
    const LeastSquaresProblem held = with_held(rows, worker.evaluate, j, value);
    const LeastSquaresResult fit = solve_least_squares(held, others, options);
    if (!fit.converged) return;
    const double from_prior = (value - rows.prior_mean[j]) / rows.prior_sd[j];
    profile.chi_square[k] = 2 * (fit.cost - least.cost) + from_prior * from_prior;
    others = fit.theta;
  }
}

}  // namespace

std::vector<Profile> find_profiles(const FitProblem& problem,
                                   const LeastSquaresResult& least,
                                   const Identifiability& known,
                                   int most,
                                   StudyProgress& progress) {
  std::vector<Profile> profiles;
  if (least.theta.size() < 2) return profiles;
  for (const std::size_t j : best_known(known, problem.rows.prior_sd, most))
    profiles.push_back(empty_profile(problem.rows, least, known, j));
  const auto make_task = [&] {
    return [&, worker = problem.make_worker()](int side) {
      walk(worker, problem.rows, least, side % 2 != 0, profiles[static_cast<std::size_t>(side / 2)],
           progress);
    };
  };
  const bool whole = in_parallel("profiles", 2 * static_cast<int>(profiles.size()), problem.threads,
                                 make_task, progress);
  if (!whole) profiles.clear();
  return profiles;
}

}  // namespace condyle
