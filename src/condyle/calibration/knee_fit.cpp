#include "condyle/calibration/knee_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"

namespace condyle {
namespace {

FitWorker worker_of(Predictions& predictions) {
  return {[&predictions](const Eigen::VectorXd& theta, Eigen::VectorXd& y, Eigen::MatrixXd* J) {
            return predictions.evaluate(theta, y, J);
          },
          [&predictions] { predictions.reset(); }};
}

LeastSquaresProblem rows_of(const MeasurementTable& table,
                            const std::vector<FreeParameter>& parameters,
                            const Eigen::VectorXd& input_variance) {
  const auto m = static_cast<Eigen::Index>(table.rows.size());
  const auto n = static_cast<Eigen::Index>(parameters.size());
  LeastSquaresProblem rows;
  rows.d.resize(m);
  rows.sd.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Measurement& row = table.rows[static_cast<std::size_t>(i)];
    rows.d[i] = row.value;
    rows.sd[i] = std::sqrt(row.sd * row.sd + input_variance[i]);
  }
  rows.prior_sd.resize(n);
  rows.prior_mean = Eigen::VectorXd::Zero(n);
  rows.lower.resize(n);
  rows.upper.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const FreeParameter& parameter = parameters[static_cast<std::size_t>(j)];
    rows.prior_sd[j] = parameter.prior_sd;
    rows.lower[j] = parameter.bounds[0];
    rows.upper[j] = parameter.bounds[1];
  }
  return rows;
}

void check_enough(const MeasurementTable& table, const std::vector<FreeParameter>& parameters) {
  const auto unheld = std::count_if(parameters.begin(), parameters.end(),
                                    [](const auto& p) { return !has_prior(p.prior_sd); });
  if (static_cast<std::size_t>(unheld) <= table.rows.size()) return;
  throw InputError(
      fmt::format("{}: {} rows to fit, expected as many as the {} parameters that have "
                  "no prior (prior_sd of 1e6 and more), or a prior for each",
                  table.file.string(), table.rows.size(), unheld));
}

}  // namespace

RowsOfUse rows_of_use(const MeasurementTable& table, MeasuredUse use) {
  RowsOfUse of{{table.file, table.specimen, {}}, {}};
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i].use == use) {
      of.table.rows.push_back(table.rows[i]);
      of.places.push_back(static_cast<Eigen::Index>(i));
    }
  return of;
}

KneeFit::KneeFit(const Scene& scene,
                 const std::vector<FittedSurface>& surfaces,
                 const MeasurementTable& table,
                 const std::vector<FreeParameter>& parameters,
                 int threads)
    : places_(rows_of_use(table, MeasuredUse::kFit).places),
      predictions_(scene, surfaces, rows_of_use(table, MeasuredUse::kFit).table, parameters),
      worker_(worker_of(predictions_)) {
  const MeasurementTable fitted = rows_of_use(table, MeasuredUse::kFit).table;
  check_enough(fitted, parameters);
  const Eigen::VectorXd scene_numbers =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  problem_.rows = rows_of(fitted, parameters, predictions_.input_variance(scene_numbers));
  problem_.rows.huber = scene.calibration->huber;
  (void)rows_of_scene();
  problem_.threads = threads;
  problem_.make_worker = [this] { return make_worker(); };
}

PredictedRows KneeFit::rows_of_scene() {
  PredictedRows rows;
  const Eigen::VectorXd own =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(predictions_.parameters()));
  predictions_.reset();
  if (!predictions_.evaluate(own, rows.y, &rows.J))
    throw InputError(predictions_.failure() + ", at the scene's numbers");
  return rows;
}

FitWorker KneeFit::make_worker() {
  auto own = std::make_shared<Predictions>(predictions_);
  copies_.push_back({own, own->counts()});
  FitWorker worker = worker_of(*own);
  worker.reset = [own] { own->reset(); };  // holds it
  return worker;
}

Predictions::Counts KneeFit::counts() const {
  Predictions::Counts counts = predictions_.counts();
  for (const Copy& copy : copies_) {
    const Predictions::Counts all = copy.predictions->counts();
    counts.poses += all.poses - copy.before.poses;
    counts.failures += all.failures - copy.before.failures;
  }
  return counts;
}

}  // namespace condyle
