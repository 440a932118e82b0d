#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "condyle/calibration/agreement.h"
#include "condyle/calibration/bands.h"
#include "condyle/calibration/calibration.h"
#include "condyle/calibration/knee_fit.h"
#include "condyle/calibration/multi_start.h"
#include "condyle/calibration/posterior_samples.h"
#include "condyle/calibration/predicted_table.h"
#include "condyle/calibration/profiles.h"
#include "condyle/calibration/suggest_tests.h"
#include "condyle/elements/joint_table.h"
#include "condyle/input_error.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Eigen::VectorXd;

constexpr int kMostProfiles = 12;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Tells of a θ only where it is the best so far.
class Better {
 public:
  explicit Better(const CalibrationOptions& options) : options_(options) {}
  void operator()(const VectorXd& theta, double cost) {
    if (!(cost < least_)) return;
    least_ = cost;
    if (options_.on_better) options_.on_better(theta, cost);
  }

 private:
  const CalibrationOptions& options_;
  double least_ = std::numeric_limits<double>::infinity();
};

/// Where the first fit begins: at the scene's numbers, or where an earlier one was stopped.
VectorXd first_start(const CalibrationOptions& options, KneeFit& knee) {
  const LeastSquaresProblem& rows = knee.problem().rows;
  VectorXd start = VectorXd::Zero(rows.prior_sd.size());
  if (options.from) {
    if (options.from->size() != start.size())
      throw InputError(fmt::format("an earlier fit of {} parameters, expected one of {}",
                                   options.from->size(), start.size()));
    start = *options.from;
  }
  start = start.cwiseMax(rows.lower).cwiseMin(rows.upper);
  return reach(knee.worker(), start) ? start : nearest_start(knee.worker(), start);
}

LeastSquaresResult first_fit(const CalibrationOptions& options,
                             KneeFit& knee,
                             Better& better,
                             StudyProgress& progress) {
  const VectorXd start = first_start(options, knee);
  LeastSquaresProblem problem = knee.problem().rows;
  problem.evaluate = knee.worker().evaluate;
  LeastSquaresOptions how;
  how.on_step = [&](int iteration, double cost, const VectorXd& theta) {
    better(theta, cost);
    return progress("fit", iteration, how.most_iterations);
  };
  LeastSquaresResult fit = solve_least_squares(problem, start, how);
  better(fit.theta, fit.cost);  // the last trial may be the best
  return fit;
}

/// Costs that differ by less are the same least.
constexpr double kSameCost = 1e-9;

/// The best of the first fit and of those from other starts, and how all of them came out.
void search(const CalibrationOptions& options,
            const CalibrationDescription& asked,
            KneeFit& knee,
            CalibrationResult& result,
            StudyProgress& progress) {
  Better better(options);
  const auto begin = std::chrono::steady_clock::now();
  std::vector<LeastSquaresResult> fits = {first_fit(options, knee, better, progress)};
  result.fit_seconds = seconds_since(begin);
  // Without a prior there is nothing to draw other starts from.
  if (!progress.stopped() &&
      std::any_of(result.prior_sd.begin(), result.prior_sd.end(), has_prior)) {
    std::vector<LeastSquaresResult> others =
        fit_from_prior(knee.problem(), options.starts.value_or(asked.starts), asked.seed,
                       std::ref(better), progress);
    for (LeastSquaresResult& other : others)
      if (other.theta.size() > 0) fits.push_back(std::move(other));
  }
  const LeastSquaresResult* best = &fits.front();
  for (const LeastSquaresResult& fit : fits)
    if (fit.cost < best->cost * (1 - kSameCost)) best = &fit;
  result.fit = *best;
  for (const LeastSquaresResult& fit : fits) {
    const double distance =
        (fit.theta - best->theta).cwiseQuotient(result.prior_sd).lpNorm<Eigen::Infinity>();
    result.starts.push_back({fit.cost, distance, fit.converged, fit.iterations, fit.message});
  }
}

/// Root of Huber's weight over the sd of each row.
VectorXd weights_of(const LeastSquaresProblem& rows, const VectorXd& y) {
  VectorXd weight = rows.sd.cwiseInverse();
  if (!rows.huber) return weight;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const double r = std::abs(y[i] - rows.d[i]) / rows.sd[i];
    if (r > *rows.huber) weight[i] *= std::sqrt(*rows.huber / r);
  }
  return weight;
}

void find_known(const LeastSquaresProblem& rows, CalibrationResult& result) {
  const VectorXd& theta = result.fit.theta;
  result.at_bound.assign(static_cast<std::size_t>(theta.size()), false);
  for (Eigen::Index j = 0; j < theta.size(); ++j)
    result.at_bound[static_cast<std::size_t>(j)] =
        theta[j] <= rows.lower[j] || theta[j] >= rows.upper[j];
  result.known = identifiability(result.fit.J, weights_of(rows, result.fit.y), result.prior_sd,
                                 result.at_bound);
  const double freedom = static_cast<double>(rows.d.size()) - result.known.effective;
  result.reduced_chi_square = result.fit.chi_square / freedom;
  result.reduced_chi_square_limit = reduced_chi_square_limit(freedom);
}

/// Rows of a part of the table, put where they stand.
void put_rows(const PredictedRows& before,
              const PredictedRows& after,
              const VectorXd& sd,
              const std::vector<Eigen::Index>& places,
              CalibrationResult& result) {
  const std::vector<CalibratedRow> part =
      calibrated_rows(before, after, result.prior_sd, result.known.covariance, sd);
  for (std::size_t i = 0; i < part.size(); ++i)
    result.rows[static_cast<std::size_t>(places[i])] = part[i];
}

void find_fitted_rows(KneeFit& knee, CalibrationResult& result) {
  put_rows(knee.rows_of_scene(), {result.fit.y, result.fit.J}, knee.problem().rows.sd,
           knee.places(), result);
}

/// Variance of the zero of a curve of which no row is fitted, so that its offset is no parameter.
double zero_variance(const Measurement& row,
                     const CalibrationDescription& asked,
                     const std::vector<FreeParameter>& parameters) {
  if (!asked.curve_sd || row.kind != MeasuredKind::kJointCoordinate || row.laxity) return 0;
  const bool is_parameter =
      std::any_of(parameters.begin(), parameters.end(), [&](const FreeParameter& p) {
        return p.kind == FreeParameter::Kind::kCurveOffset && p.test == row.test &&
               p.coordinate == row.index;
      });
  if (is_parameter) return 0;
  return std::pow((*asked.curve_sd)[kJointCoordinates[row.index].angle ? 1 : 0], 2);
}

void find_unseen_rows(const Scene& scene,
                      const std::vector<FittedSurface>& surfaces,
                      CalibrationResult& result) {
  const RowsOfUse unseen = rows_of_use(result.table, MeasuredUse::kTest);
  if (unseen.table.rows.empty()) return;
  Predictions predictions(scene, surfaces, unseen.table, result.parameters);
  const PredictedTable predicted = predict_table(predictions, result.fit.theta);
  count_poses(predictions.counts(), result);
  VectorXd sd = predicted.input_variance;
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    const Measurement& row = unseen.table.rows[static_cast<std::size_t>(i)];
    sd[i] = std::sqrt(sd[i] + row.sd * row.sd +
                      zero_variance(row, *scene.calibration, result.parameters));
  }
  put_rows(predicted.before, predicted.after, sd, unseen.places, result);
}

/// Ligaments that carry less than 1e-9 of what the most loaded one does in the fitted poses, and whether
/// those poses are found from the start pose, too.
void look_at_poses(const Scene& scene, KneeFit& knee, CalibrationResult& result) {
  if (!reach(knee.worker(), result.fit.theta)) {
    result.cold_difference = kNoNumber;
    return;
  }
  const std::vector<double> forces = knee.predictions().largest_ligament_forces();
  const double most = forces.empty() ? 0 : *std::max_element(forces.begin(), forces.end());
  for (std::size_t i = 0; i < forces.size(); ++i)
    if (forces[i] <= 1e-9 * most) result.silent.push_back(scene.ligaments[i].name);
  result.cold_difference = knee.predictions().difference_of_cold_path(result.fit.theta);
}

void find_samples(const CalibrationOptions& options,
                  const CalibrationDescription& asked,
                  const FitProblem& problem,
                  CalibrationResult& result,
                  StudyProgress& progress) {
  PosteriorSamples samples = posterior_samples(
      problem, result.fit.theta, options.samples.value_or(asked.samples), asked.seed, progress);
  result.samples = std::move(samples.theta);
  result.lost_samples = samples.lost;
  if (result.samples.rows() > 1) result.sample_sd = std::move(samples.sd);  // else there is none
}

/// What is found beside the fit, as long as nobody says stop.
void find_studies(const Scene& scene,
                  const std::vector<FittedSurface>& surfaces,
                  const CalibrationOptions& options,
                  const FitProblem& problem,
                  CalibrationResult& result,
                  StudyProgress& progress) {
  if (options.bands && progress("bands", 0, 1)) {
    result.band_flexions = band_flexions(scene, result.table);
    result.bands = find_bands(scene, surfaces, result);
  }
  if (options.suggest && progress("suggest", 0, 1))
    result.suggested = suggest_tests(scene, surfaces, result);
  if (options.profiles && !progress.stopped())
    result.profiles = find_profiles(problem, result.fit, result.known, kMostProfiles, progress);
  if (!progress.stopped()) find_samples(options, *scene.calibration, problem, result, progress);
}

}  // namespace

CalibrationResult calibrate(const Scene& scene,
                            const std::vector<FittedSurface>& surfaces,
                            const MeasurementTable& table,
                            const std::vector<TriangleMesh>& meshes,
                            const CalibrationOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const CalibrationDescription& asked = *scene.calibration;
  StudyProgress progress(options.on_progress);
  CalibrationResult result;
  result.table = table;
  result.parameters = free_parameters(scene, meshes, result.table);
  KneeFit knee(scene, surfaces, result.table, result.parameters, options.threads);
  result.prior_sd = knee.problem().rows.prior_sd;

  search(options, asked, knee, result, progress);
  find_known(knee.problem().rows, result);
  result.rows.resize(result.table.rows.size());
  find_fitted_rows(knee, result);
  find_unseen_rows(scene, surfaces, result);
  result.fitted = agreement_by_use("fitted", MeasuredUse::kFit, result.table, result.rows);
  result.unseen = agreement_by_use("unseen", MeasuredUse::kTest, result.table, result.rows);
  result.tests = agreement_by_test(result.table, result.rows);
  look_at_poses(scene, knee, result);
  find_studies(scene, surfaces, options, knee.problem(), result, progress);

  count_poses(knee.counts(), result);
  result.stopped = progress.stopped();
  result.seconds = seconds_since(begin);
  return result;
}

}  // namespace condyle
