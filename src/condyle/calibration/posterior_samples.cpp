#include "condyle/calibration/posterior_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "condyle/design/normal_draws.h"

namespace condyle {
namespace {

/// Data and mean of the prior of sample k.
LeastSquaresProblem randomised(LeastSquaresProblem rows, unsigned seed, int k) {
  const auto sample = static_cast<std::uint64_t>(k);
  rows.d += normal_draws(seed, DrawsFor::kNoise, sample, rows.d.size()).cwiseProduct(rows.sd);
  const Eigen::VectorXd draw =
      normal_draws(seed, DrawsFor::kPriorMean, sample, rows.prior_sd.size());
  for (Eigen::Index j = 0; j < draw.size(); ++j)
    if (has_prior(rows.prior_sd[j])) rows.prior_mean[j] += draw[j] * rows.prior_sd[j];
  return rows;
}

Eigen::VectorXd column_sd(const Eigen::MatrixXd& samples) {
  if (samples.rows() < 2) return Eigen::VectorXd::Zero(samples.cols());
  const Eigen::RowVectorXd mean = samples.colwise().mean();
  return ((samples.rowwise() - mean).colwise().squaredNorm() /
          static_cast<double>(samples.rows() - 1))
      .cwiseSqrt()
      .transpose();
}

/// What is kept of a fit: its derivatives would take a thousand times the memory.
struct Sample {
  Eigen::VectorXd theta;
  bool converged = false, done = false;
};

}  // namespace

PosteriorSamples posterior_samples(const FitProblem& problem,
                                   const Eigen::VectorXd& theta,
                                   int count,
                                   unsigned seed,
                                   StudyProgress& progress) {
  std::vector<Sample> fits(static_cast<std::size_t>(std::max(0, count)));
  LeastSquaresOptions options;
  options.tolerance = kStudyTolerance;
  const auto make_task = [&] {
    return [&, worker = problem.make_worker()](int k) {
      LeastSquaresResult fit;
      if (reach(worker, theta))
        fit = fit_by(worker, randomised(problem.rows, seed, k), theta, progress, options);
      fits[static_cast<std::size_t>(k)] = {std::move(fit.theta), fit.converged, !fit.stopped};
    };
  };
  in_parallel("samples", static_cast<int>(fits.size()), problem.threads, make_task, progress);

  PosteriorSamples samples;
  samples.theta.resize(static_cast<Eigen::Index>(fits.size()), theta.size());
  Eigen::Index kept = 0;
  for (const Sample& sample : fits) {
    if (sample.converged)
      samples.theta.row(kept++) = sample.theta.transpose();
    else if (sample.done)
      ++samples.lost;
  }
  samples.theta.conservativeResize(kept, Eigen::NoChange);
  samples.sd = column_sd(samples.theta);
  return samples;
}

}  // namespace condyle
