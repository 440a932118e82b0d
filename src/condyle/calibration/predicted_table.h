#pragma once

/// A table of rows that nobody measured: what a knee answers in them at the fit.

#include "condyle/calibration/agreement.h"
#include "condyle/calibration/predictions.h"

namespace condyle {

/// At the scene's numbers and at θ, which is reached in quarters: poses follow from there. Rows are
/// those of the table; none of them is to be fitted.
struct PredictedTable {
  PredictedRows before, after;
  Eigen::VectorXd input_variance;  ///< at the scene's numbers; 0 where there is no pose
};
[[nodiscard]] PredictedTable predict_table(Predictions& predictions, const Eigen::VectorXd& theta);

/// Adds to what `result` counts.
void count_poses(const Predictions::Counts& counts, CalibrationResult& result);

/// A joint coordinate of the knee at a flexion, to be predicted only.
[[nodiscard]] Measurement predicted_row(double flexion, MeasuredKind kind, std::size_t index);

}  // namespace condyle
