#include "condyle/calibration/predicted_table.h"

namespace condyle {

PredictedTable predict_table(Predictions& predictions, const Eigen::VectorXd& theta) {
  PredictedTable table;
  predictions.evaluate(0 * theta, table.before.y, &table.before.J);
  const Eigen::VectorXd variance = predictions.input_variance(0 * theta);
  table.input_variance = variance.array().isFinite().select(variance, 0);
  for (const double part : {0.25, 0.5, 0.75})
    predictions.evaluate(part * theta, table.after.y, nullptr);
  predictions.evaluate(theta, table.after.y, &table.after.J);
  return table;
}

void count_poses(const Predictions::Counts& counts, CalibrationResult& result) {
  result.poses += counts.poses;
  result.failed_poses += counts.failures;
}

Measurement predicted_row(double flexion, MeasuredKind kind, std::size_t index) {
  Measurement row;
  row.flexion = flexion;
  row.kind = kind;
  row.index = index;
  row.use = MeasuredUse::kTest;
  return row;
}

}  // namespace condyle
