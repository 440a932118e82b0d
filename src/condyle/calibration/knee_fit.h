#pragma once

/// A knee as a problem of least squares: the rows of its table that are fitted, and predictions for as
/// many threads as ask.

#include <memory>
#include <vector>

#include "condyle/calibration/agreement.h"
#include "condyle/calibration/calibration.h"
#include "condyle/calibration/fit_problem.h"
#include "condyle/calibration/predictions.h"

namespace condyle {

class KneeFit {
 public:
  /// Throws InputError as Predictions does, where the rows that are fitted are fewer than the parameters without a
  /// prior, and where the derivatives of one do not exist at the scene's numbers, as of a neutral pose. The sds hold what flexion and level add at the scene's numbers.
  KneeFit(const Scene& scene,
          const std::vector<FittedSurface>& surfaces,
          const MeasurementTable& table,
          const std::vector<FreeParameter>& parameters,
          int threads);
  KneeFit(const KneeFit&) = delete;
  KneeFit& operator=(const KneeFit&) = delete;

  [[nodiscard]] const FitProblem& problem() const { return problem_; }
  /// Fitted rows at the scene's numbers.
  [[nodiscard]] PredictedRows rows_of_scene();
  /// Of this thread, and its predictions.
  [[nodiscard]] const FitWorker& worker() const { return worker_; }
  [[nodiscard]] Predictions& predictions() { return predictions_; }
  /// Where the rows stand in the whole table.
  [[nodiscard]] const std::vector<Eigen::Index>& places() const { return places_; }
  /// Of all threads.
  [[nodiscard]] Predictions::Counts counts() const;

 private:
  struct Copy {
    std::shared_ptr<Predictions> predictions;
    Predictions::Counts before;
  };
  [[nodiscard]] FitWorker make_worker();

  std::vector<Eigen::Index> places_;
  Predictions predictions_;
  FitWorker worker_;
  FitProblem problem_;
  std::vector<Copy> copies_;
};

/// Those rows of a table, and where they stand in it.
struct RowsOfUse {
  MeasurementTable table;
  std::vector<Eigen::Index> places;
};
[[nodiscard]] RowsOfUse rows_of_use(const MeasurementTable& table, MeasuredUse use);

}  // namespace condyle
