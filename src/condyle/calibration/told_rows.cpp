#include "condyle/calibration/told_rows.h"

#include <algorithm>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/joint_stiffness.h"
#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

constexpr std::size_t kCoordinates = kJointCoordinates.size();

PoseOutput output_of(const Measurement& row, const MeasuredModel& model) {
  switch (row.kind) {
    case MeasuredKind::kReaction: {
      const int condition = model.conditions[static_cast<std::size_t>(model.held)];
      return {OutputKind::kMultiplier, static_cast<std::size_t>(condition)};
    }
    case MeasuredKind::kLigamentForce:
      return {OutputKind::kLigamentForce, row.index};
    case MeasuredKind::kContactForce:
      return {OutputKind::kContactForce, row.index};
    default:
      return {OutputKind::kJointCoordinate, row.index};
  }
}

bool same(const PoseOutput& a, const PoseOutput& b) {
  return a.kind == b.kind && a.index == b.index;
}

std::size_t place_of(const PoseOutput& output, bool frames, std::vector<PoseOutput>& outputs) {
  if (frames && output.kind == OutputKind::kJointCoordinate) {
    const bool there = !outputs.empty() && outputs[0].kind == OutputKind::kJointCoordinate;
    if (!there)
      for (std::size_t i = kCoordinates; i-- > 0;)
        outputs.insert(outputs.begin(), {OutputKind::kJointCoordinate, i});
    return output.index;
  }
  const auto found = std::find_if(outputs.begin(), outputs.end(),
                                  [&](const PoseOutput& other) { return same(output, other); });
  const auto at = static_cast<std::size_t>(found - outputs.begin());
  if (found == outputs.end()) outputs.push_back(output);
  return at;
}

bool has_coordinates(const ToldRows& told, const std::vector<PoseOutput>& outputs) {
  return told.frames && !outputs.empty() && outputs[0].kind == OutputKind::kJointCoordinate;
}

std::vector<std::size_t> offsets_of(const Measurement& row,
                                    const std::vector<FreeParameter>& parameters) {
  std::vector<std::size_t> offsets;
  if (row.laxity) return offsets;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    if (parameters[j].kind == FreeParameter::Kind::kCurveOffset && parameters[j].test == row.test &&
        row.kind == MeasuredKind::kJointCoordinate && parameters[j].coordinate == row.index)
      offsets.push_back(j);
  return offsets;
}

void find_frames(const std::vector<FreeParameter>& parameters, double side, ToldRows& told) {
  told.frame_parameters.fill(-1);
  for (std::size_t i = 0; i < told.frame_signs.size(); ++i) {
    const std::size_t component = i % 6;
    told.frame_signs[i] = component == 0 || component > 3 ? side : 1;
  }
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const bool femur = parameters[j].kind == FreeParameter::Kind::kFemurFrame;
    if (!femur && parameters[j].kind != FreeParameter::Kind::kTibiaFrame) continue;
    told.frames = true;
    const int component = parameters[j].component + (femur ? 0 : 6);
    told.frame_parameters.at(static_cast<std::size_t>(component)) = static_cast<int>(j);
  }
}

}  // namespace

ToldRows told_rows(const MeasurementTable& table,
                   const std::vector<FreeParameter>& parameters,
                   const TestPoses& tests,
                   const MeasuredModels& models) {
  ToldRows told;
  const std::optional<JointFrames>& joint = models.models.front().model->joint;
  find_frames(parameters, joint ? joint->side : 1, told);
  told.outputs.resize(tests.poses.size());
  // Coordinates first, so that what is asked for before them keeps its place.
  for (const bool coordinates : {true, false}) {
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const Measurement& row = table.rows[i];
      if ((row.kind == MeasuredKind::kJointCoordinate) != coordinates) continue;
      told.rows.resize(table.rows.size());
      ToldRows::Row& made = told.rows[i];
      const RowPlace& place = tests.rows[i];
      const PoseOutput output = output_of(row, models.models[tests.poses[place.pose].model]);
      made.number = {place.pose, place_of(output, told.frames, told.outputs[place.pose])};
      made.sign = row.kind == MeasuredKind::kReaction ? -1 : 1;
      made.offsets = offsets_of(row, parameters);
      if (place.from < 0) continue;
      const auto from = static_cast<std::size_t>(place.from);
      made.is_difference = true;
      made.from = {from, place_of(output, told.frames, told.outputs[from])};
    }
  }
  return told;
}

FrameOffsets frame_offsets(const ToldRows& told, const Eigen::VectorXd& theta) {
  FrameOffsets offsets;
  for (std::size_t i = 0; i < told.frame_parameters.size(); ++i)
    if (told.frame_parameters[i] >= 0)
      (i < 6 ? offsets.femur[i] : offsets.tibia[i - 6]) =
          told.frame_signs[i] * theta[told.frame_parameters[i]];
  return offsets;
}

void tell_values(const ToldRows& told,
                 const std::vector<PoseOutput>& outputs,
                 const FrameOffsets& offsets,
                 const Linearization& at,
                 const PoseResult& pose,
                 Eigen::VectorXd& values) {
  values.resize(static_cast<Eigen::Index>(outputs.size()));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = value_of(outputs[i], pose);
  if (!has_coordinates(told, outputs)) return;
  const JointCoordinates q = joint_coordinates(moved_frames(*at.model.joint, offsets), at.state.X);
  for (std::size_t i = 0; i < kCoordinates; ++i)
    values[static_cast<Eigen::Index>(i)] = q.*kJointCoordinates[i].member;
}

void tell_derivatives(const ToldRows& told,
                      const std::vector<PoseOutput>& outputs,
                      const FrameOffsets& offsets,
                      const Linearization& at,
                      const std::vector<ModelParameter>& numbers,
                      Sensitivity& sensitivity,
                      Eigen::MatrixXd& derivatives) {
  sensitivity.derivatives(outputs, numbers, derivatives);
  if (!has_coordinates(told, outputs)) return;
  // Of both sets of coordinates by the pose: dq' = J' J⁻¹ dq.
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Matrix6 J = joint_jacobian(*at.model.joint, at.state.X);
  const Matrix6 J_told = joint_jacobian(moved_frames(*at.model.joint, offsets), at.state.X);
  const Matrix6 to_told = fully_pivoted_solution(J.transpose(), J_told.transpose()).transpose();
  for (Eigen::Index j = 0; j < derivatives.cols(); ++j) {
    const Eigen::Matrix<double, 6, 1> column = derivatives.col(j).head<6>();
    derivatives.col(j).head<6>() = to_told * column;
  }
}

void add_frame_derivatives(const ToldRows& told,
                           const std::vector<PoseOutput>& outputs,
                           const FrameOffsets& offsets,
                           const Linearization& at,
                           Eigen::MatrixXd& by_theta) {
  if (!has_coordinates(told, outputs)) return;
  const Eigen::Matrix<double, 6, 12> by_frames =
      derivatives_by_frames(*at.model.joint, offsets, at.state.X);
  for (std::size_t i = 0; i < told.frame_parameters.size(); ++i)
    if (told.frame_parameters[i] >= 0)
      by_theta.col(told.frame_parameters[i]).head<6>() +=
          told.frame_signs[i] * by_frames.col(static_cast<int>(i));
}

}  // namespace condyle
