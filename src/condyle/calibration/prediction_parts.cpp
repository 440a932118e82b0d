#include "condyle/calibration/prediction_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "condyle/input_error.h"

namespace condyle {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Where no fitted pose is missing, all that were found are what the numbers of the scene stand for.
void PredictionParts::walk() {
  const std::vector<ReachedPose> reached =
      walk_to_tests(study->scene, study->models, study->tests, bench);
  check_nominal(reached);
  for (const ReachedPose& pose : reached) {
    exists.push_back(pose.standing.has_value());
    nominal.push_back(pose.standing.value_or(Standing()));
  }
  standing = next = nominal;
  bench.reset();
}

void PredictionParts::check_nominal(const std::vector<ReachedPose>& reached) const {
  for (std::size_t p = 0; p < reached.size(); ++p)
    if (!reached[p].standing && study->tests.poses[p].fitted)
      throw InputError(study->name_of_pose(p) +
                       ": no pose of equilibrium at the scene's numbers: " + reached[p].reason);
}

bool PredictionParts::fail(std::size_t pose, const char* words) {
  if (!study->tests.poses[pose].fitted) {
    told_next[pose].lost = true;
    next[pose] = standing[pose];
    return true;
  }
  failure = study->name_of_pose(pose) + ": " + words;
  if (!bench.result().reason.empty()) failure += ": " + bench.result().reason;
  return false;
}

bool PredictionParts::solve(std::size_t pose) {
  told_next[pose].lost = false;
  if (!exists[pose]) {
    told_next[pose].lost = true;
    return false;
  }
  return bench.solve(pose, standing[pose], &nominal[pose], next[pose]);
}

void PredictionParts::differentiate(std::size_t pose,
                                    Sensitivity& sensitivity,
                                    const FrameOffsets& offsets) {
  const ToldRows& rows = study->told;
  const std::vector<PoseOutput>& outputs = rows.outputs[pose];
  const Linearization at = bench.at(pose);
  const ChangedKnee& knee = bench.knee();
  MatrixXd& D = told_next[pose].by_theta;
  D.setZero(static_cast<Eigen::Index>(outputs.size()),
            static_cast<Eigen::Index>(study->parameters.size()));
  tell_derivatives(rows, outputs, offsets, at, knee.numbers(), sensitivity, by_numbers);
  for (const ChangedKnee::Link& link : knee.links()) {
    const ModelParameter& number = knee.numbers()[link.number];
    double by = link.by;
    if (number.kind == ParameterKind::kLoadScale)
      by *= nominal_scale(study->tests.poses[pose], study->scene, number.index);
    D.col(static_cast<Eigen::Index>(link.parameter)) +=
        by * by_numbers.col(static_cast<Eigen::Index>(link.number));
  }
  add_frame_derivatives(rows, outputs, offsets, at, D);
}

bool PredictionParts::solve_all(const VectorXd& theta, bool derivatives) {
  failure.clear();
  if (!bench.set(theta)) {
    failure = bench.knee().objection();
    return false;
  }
  const FrameOffsets offsets = frame_offsets(study->told, theta);
  for (std::size_t p = 0; p < study->tests.poses.size(); ++p) {
    ToldPose& pose = told_next[p];
    if (!solve(p)) {
      if (!pose.lost && !fail(p, "no pose of equilibrium")) return false;
      continue;
    }
    tell_values(study->told, study->told.outputs[p], offsets, bench.at(p), bench.result(),
                pose.values);
    pose.forces.resize(greatest.size());
    for (std::size_t i = 0; i < greatest.size(); ++i)
      pose.forces[i] = bench.result().ligaments[i].force;
    if (!derivatives) continue;
    Sensitivity* sensitivity = bench.sensitivity(p);
    if (sensitivity == nullptr) {
      if (!fail(p, "no derivatives, as at a limit point")) return false;
      continue;
    }
    try {
      differentiate(p, *sensitivity, offsets);
    } catch (const std::invalid_argument& none) {  // a path that follows its end in no known way
      if (!fail(p, fmt::format("no derivatives: {}", none.what()).c_str())) return false;
    }
  }
  return true;
}

void PredictionParts::tell_rows(const std::vector<ToldPose>& of,
                                const VectorXd& theta,
                                VectorXd& y,
                                MatrixXd* J) const {
  const std::vector<ToldRows::Row>& rows = study->told.rows;
  const auto count = static_cast<Eigen::Index>(rows.size());
  y.resize(count);
  if (J != nullptr) J->resize(count, static_cast<Eigen::Index>(study->parameters.size()));
  for (Eigen::Index i = 0; i < count; ++i) {
    const ToldRows::Row& row = rows[static_cast<std::size_t>(i)];
    const ToldPose &pose = of[row.number.pose], &other = of[row.from.pose];
    if (pose.lost || (row.is_difference && other.lost)) {
      y[i] = kNoPrediction;
      if (J != nullptr) J->row(i).setConstant(kNoPrediction);
      continue;
    }
    const auto output = static_cast<Eigen::Index>(row.number.output),
               from = static_cast<Eigen::Index>(row.from.output);
    y[i] = row.sign * pose.values[output];
    if (row.is_difference) y[i] -= other.values[from];
    for (const std::size_t j : row.offsets) y[i] += theta[static_cast<Eigen::Index>(j)];
    if (J == nullptr) continue;
    J->row(i) = row.sign * pose.by_theta.row(output);
    if (row.is_difference) J->row(i) -= other.by_theta.row(from);
    for (const std::size_t j : row.offsets) (*J)(i, static_cast<Eigen::Index>(j)) += 1;
  }
}

void PredictionParts::note_forces() {
  std::fill(greatest.begin(), greatest.end(), 0.0);
  for (std::size_t p = 0; p < told.size(); ++p) {
    if (told[p].lost || !study->tests.poses[p].fitted) continue;
    for (std::size_t i = 0; i < greatest.size(); ++i)
      greatest[i] = std::max(greatest[i], told[p].forces[i]);
  }
}

bool PredictionParts::evaluate(const VectorXd& theta, VectorXd& y, MatrixXd* J) {
  if (!solve_all(theta, J != nullptr)) return false;
  standing.swap(next);
  told.swap(told_next);
  tell_rows(told, theta, y, J);
  note_forces();
  return true;
}

void PredictionParts::differentiate_by_inputs(std::size_t p) {
  const CalibrationDescription& calibration = *study->scene.calibration;
  const TestPose& pose = study->tests.poses[p];
  const MeasuredModel& model = study->models.models[pose.model];
  const int flexion = model.conditions[static_cast<std::size_t>(calibration.flexion)];
  std::vector<ModelParameter> inputs = {
      {ParameterKind::kConditionValue, static_cast<std::size_t>(flexion)}};
  double level =
      0;  // what the test holds, as the model counts it: a load's scale, or a condition's value
  if (pose.load >= 0) {
    inputs.push_back({ParameterKind::kLoadScale, static_cast<std::size_t>(pose.load)});
    level = bench.drive(p).scales[static_cast<std::size_t>(pose.load)];
  } else if (model.held >= 0) {
    const int held = model.conditions[static_cast<std::size_t>(model.held)];
    inputs.push_back({ParameterKind::kConditionValue, static_cast<std::size_t>(held)});
    level = pose.level;
  }
  const std::vector<PoseOutput>& outputs = study->told.outputs[p];
  MatrixXd& D = told[p].by_inputs;
  D.setZero(static_cast<Eigen::Index>(outputs.size()), 2);
  Sensitivity* sensitivity = bench.sensitivity(p);
  if (sensitivity == nullptr) return;
  const FrameOffsets offsets = frame_offsets(study->told, bench.theta());
  tell_derivatives(study->told, outputs, offsets, bench.at(p), inputs, *sensitivity, by_numbers);
  D.col(0) = calibration.flexion_sd * by_numbers.col(0);
  if (inputs.size() > 1) D.col(1) = calibration.level_sd * level * by_numbers.col(1);
}

}  // namespace condyle
