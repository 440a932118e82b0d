#pragma once

/// What stands behind predictions: the study, which threads share, and the poses of one thread.

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "condyle/calibration/test_walk.h"
#include "condyle/calibration/told_rows.h"

namespace condyle {

inline constexpr double kNoPrediction = std::numeric_limits<double>::quiet_NaN();

/// What the workspaces of several threads share.
struct MeasuredStudy {
  Scene scene;
  MeasurementTable table;
  std::vector<FreeParameter> parameters;
  MeasuredModels models;
  TestPoses tests;
  ToldRows told;

  MeasuredStudy(const Scene& knee,
                const std::vector<FittedSurface>& surfaces,
                const MeasurementTable& measured,
                const std::vector<FreeParameter>& free)
      : scene(knee),
        table(measured),
        parameters(free),
        models(measured_models(scene, surfaces)),
        tests(test_poses(scene, table, models)),
        told(told_rows(table, parameters, tests, models)) {}

  [[nodiscard]] std::string name_of_pose(std::size_t pose) const {
    return name_of(table.rows[tests.poses[pose].row], table, scene);
  }
};

/// One pose at θ.
struct ToldPose {
  bool lost = false;
  Eigen::VectorXd values;      ///< by ToldRows::outputs
  Eigen::MatrixXd by_theta;    ///< their derivatives,
  Eigen::MatrixXd by_inputs;   ///< and by flexion and level, times the sds of these
  std::vector<double> forces;  ///< of ligaments [N]
};

struct PredictionParts {
  std::shared_ptr<const MeasuredStudy> study;
  TestBench bench;
  using Standing = EquilibriumSolver::Standing;
  std::vector<Standing> nominal, standing, next;  ///< by poses
  std::vector<bool> exists;                       ///< at the scene's numbers
  std::vector<ToldPose> told, told_next;
  std::vector<double> greatest;  ///< force of each ligament
  Eigen::MatrixXd by_numbers;
  std::string failure;

  explicit PredictionParts(std::shared_ptr<const MeasuredStudy> shared)
      : study(std::move(shared)),
        bench(study->scene, study->models, study->tests, study->parameters),
        told(study->tests.poses.size()),
        told_next(study->tests.poses.size()),
        greatest(study->scene.ligaments.size(), 0.0) {}

  void walk();
  void check_nominal(const std::vector<ReachedPose>& reached) const;
  bool fail(std::size_t pose, const char* words);
  bool solve(std::size_t pose);
  void differentiate(std::size_t pose, Sensitivity& sensitivity, const FrameOffsets& offsets);
  bool solve_all(const Eigen::VectorXd& theta, bool derivatives);
  void tell_rows(const std::vector<ToldPose>& of,
                 const Eigen::VectorXd& theta,
                 Eigen::VectorXd& y,
                 Eigen::MatrixXd* J) const;
  void note_forces();
  bool evaluate(const Eigen::VectorXd& theta, Eigen::VectorXd& y, Eigen::MatrixXd* J);
  /// By flexion and by the logarithm of the level, times their standard deviations.
  void differentiate_by_inputs(std::size_t pose);
};

}  // namespace condyle
