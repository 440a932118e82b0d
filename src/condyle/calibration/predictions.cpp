#include "condyle/calibration/predictions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/calibration/prediction_parts.h"

namespace condyle {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Predictions::Predictions(const Scene& scene,
                         const std::vector<FittedSurface>& surfaces,
                         const MeasurementTable& table,
                         const std::vector<FreeParameter>& parameters)
    : parts_(std::make_unique<PredictionParts>(
          std::make_shared<const MeasuredStudy>(scene, surfaces, table, parameters))) {
  parts_->walk();
}

Predictions::Predictions(const Predictions& other)
    : parts_(std::make_unique<PredictionParts>(other.parts_->study)) {
  parts_->nominal = other.parts_->nominal;
  parts_->standing = other.parts_->standing;
  parts_->next = other.parts_->next;
  parts_->exists = other.parts_->exists;
  parts_->told = other.parts_->told;
  parts_->greatest = other.parts_->greatest;
}

Predictions::~Predictions() = default;

std::size_t Predictions::rows() const { return parts_->study->table.rows.size(); }

std::size_t Predictions::parameters() const { return parts_->study->parameters.size(); }

bool Predictions::evaluate(const VectorXd& theta, VectorXd& y, MatrixXd* J) {
  return parts_->evaluate(theta, y, J);
}

const std::string& Predictions::failure() const { return parts_->failure; }

double Predictions::difference_of_cold_path(const VectorXd& theta) {
  VectorXd y;
  if (!evaluate(theta, y, nullptr)) return kNoPrediction;
  const MeasuredStudy& study = *parts_->study;
  TestBench& bench = parts_->bench;
  const std::vector<ReachedPose> reached =
      walk_to_tests(study.scene, study.models, study.tests, bench);
  bench.reset();
  const FrameOffsets offsets = frame_offsets(study.told, theta);
  std::vector<ToldPose> cold(reached.size());
  EquilibriumSolver::Standing unused;
  for (std::size_t p = 0; p < reached.size(); ++p) {
    cold[p].lost = !reached[p].standing || !bench.solve(p, *reached[p].standing, nullptr, unused);
    if (!cold[p].lost)
      tell_values(study.told, study.told.outputs[p], offsets, bench.at(p), bench.result(),
                  cold[p].values);
  }
  VectorXd y_cold;
  parts_->tell_rows(cold, theta, y_cold, nullptr);
  double largest = 0;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (std::isnan(y[i])) continue;  // a test that has no pose either way
    const double off =
        std::abs(y[i] - y_cold[i]) / study.table.rows[static_cast<std::size_t>(i)].sd;
    if (std::isnan(off)) return kNoPrediction;
    largest = std::max(largest, off);
  }
  return largest;
}

VectorXd Predictions::input_variance(const VectorXd& theta) {
  PredictionParts& parts = *parts_;
  const CalibrationDescription& inputs = *parts.study->scene.calibration;
  if (inputs.flexion_sd == 0 && inputs.level_sd == 0)
    return VectorXd::Zero(static_cast<Eigen::Index>(rows()));
  VectorXd y;
  if (!parts.evaluate(theta, y, nullptr))
    return VectorXd::Constant(static_cast<Eigen::Index>(rows()), kNoPrediction);
  for (std::size_t p = 0; p < parts.told.size(); ++p) {
    if (parts.told[p].lost) continue;
    if (!parts.bench.solve(p, parts.standing[p], &parts.nominal[p], parts.next[p]))
      parts.told[p].lost = true;
    else
      parts.differentiate_by_inputs(p);
  }
  VectorXd variance = VectorXd::Zero(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const ToldRows::Row& row = parts.study->told.rows[static_cast<std::size_t>(i)];
    const ToldPose &pose = parts.told[row.number.pose], &other = parts.told[row.from.pose];
    if (pose.lost || (row.is_difference && other.lost)) continue;
    Eigen::RowVector2d by = pose.by_inputs.row(static_cast<Eigen::Index>(row.number.output));
    if (row.is_difference) by -= other.by_inputs.row(static_cast<Eigen::Index>(row.from.output));
    variance[i] = by.squaredNorm();
  }
  return variance;
}

void Predictions::reset() {
  PredictionParts& parts = *parts_;
  parts.standing = parts.next = parts.nominal;
  parts.bench.reset();
  (void)parts.bench.set(VectorXd::Zero(static_cast<Eigen::Index>(parameters())));
}

Predictions::Counts Predictions::counts() const {
  return {parts_->bench.solved, parts_->bench.failed};
}

std::vector<double> Predictions::largest_ligament_forces() const { return parts_->greatest; }

}  // namespace condyle
