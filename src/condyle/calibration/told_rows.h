#pragma once

/// From poses to rows: what each pose has to tell, and how the rows of the table are made of it.

#include <Eigen/Core>

#include <vector>

#include "condyle/calibration/changed_knee.h"
#include "condyle/calibration/measured_frames.h"
#include "condyle/calibration/test_poses.h"
#include "condyle/equilibrium/sensitivity.h"

namespace condyle {

/// What rows need of the poses.
struct ToldRows {
  /// One number of one pose.
  struct Number {
    std::size_t pose = 0, output = 0;
  };
  struct Row {
    Number number;
    double sign = 1;  ///< -1: a reaction is the multiplier with the other sign (pose_result.h)
    bool is_difference = false;  ///< less another one:
    Number from;
    std::vector<std::size_t> offsets;  ///< θ that are added to it
  };
  /// By poses. Where frames are free (`frames`) and a coordinate is asked for, all six come first.
  std::vector<std::vector<PoseOutput>> outputs;
  std::vector<Row> rows;  ///< as MeasurementTable::rows
  /// By the six numbers of the femur's and the tibia's frame: which θ, -1: none.
  std::array<int, 12> frame_parameters{};
  /// -1: those of a left knee whose numbers are told with the other sign than the program counts them along and about its
  /// axes, of which the first points medially: shifts along `lateral`, turns about the others. A knee and its mirror image
  /// have the same numbers.
  std::array<double, 12> frame_signs{};
  bool frames = false;
};

[[nodiscard]] ToldRows told_rows(const MeasurementTable& table,
                                 const std::vector<FreeParameter>& parameters,
                                 const TestPoses& tests,
                                 const MeasuredModels& models);

/// Frames of the measurement at θ.
[[nodiscard]] FrameOffsets frame_offsets(const ToldRows& told, const Eigen::VectorXd& theta);

/// The numbers that a pose tells: `values` by `outputs`.
void tell_values(const ToldRows& told,
                 const std::vector<PoseOutput>& outputs,
                 const FrameOffsets& offsets,
                 const Linearization& at,
                 const PoseResult& pose,
                 Eigen::VectorXd& values);

/// Their derivatives by numbers of the model: row i of the output, column j. `sensitivity` set there.
void tell_derivatives(const ToldRows& told,
                      const std::vector<PoseOutput>& outputs,
                      const FrameOffsets& offsets,
                      const Linearization& at,
                      const std::vector<ModelParameter>& numbers,
                      Sensitivity& sensitivity,
                      Eigen::MatrixXd& derivatives);

/// Adds what six joint coordinates change with the frames themselves, where `outputs` has them: columns
/// by θ.
void add_frame_derivatives(const ToldRows& told,
                           const std::vector<PoseOutput>& outputs,
                           const FrameOffsets& offsets,
                           const Linearization& at,
                           Eigen::MatrixXd& by_theta);

}  // namespace condyle
