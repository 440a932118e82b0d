#pragma once

/// The solvers of all models of a table, in one thread, and how one pose of a test is found.

#include <memory>
#include <vector>

#include "condyle/calibration/changed_knee.h"
#include "condyle/calibration/test_poses.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/sensitivity.h"

namespace condyle {

class TestBench {
 public:
  /// Refers to all of them.
  TestBench(const Scene& scene,
            const MeasuredModels& models,
            const TestPoses& tests,
            const std::vector<FreeParameter>& parameters);

  /// False, with an objection of `knee`, where no knee has such numbers.
  bool set(const Eigen::VectorXd& theta);
  [[nodiscard]] const ChangedKnee& knee() const { return knee_; }
  [[nodiscard]] const Eigen::VectorXd& theta() const { return theta_; }

  /// The pose from `from`, at the θ that was set: what it is told is `result`, where it stands then
  /// `to`. By Newton from there, else, and where `nominal` is given, by the way from that standing at
  /// θ = 0 over θ in parts, else by the solver's other ways. False where it is not found.
  bool solve(std::size_t pose,
             const EquilibriumSolver::Standing& from,
             const EquilibriumSolver::Standing* nominal,
             EquilibriumSolver::Standing& to);
  [[nodiscard]] const PoseResult& result() const { return result_; }

  [[nodiscard]] EquilibriumSolver& solver(std::size_t model) { return *solvers_[model]; }
  [[nodiscard]] Linearization at(std::size_t pose) const;
  /// Of the pose that was solved last; null where it has no derivatives.
  [[nodiscard]] Sensitivity* sensitivity(std::size_t pose);

  /// What drives the pose at the θ that was set.
  const Drive& drive(std::size_t pose);

  /// Solvers as newly made.
  void reset();

  long solved = 0, failed = 0;

 private:
  bool attempt(std::size_t pose,
               const EquilibriumSolver::Standing& from,
               EquilibriumSolver::Standing& to);
  bool follow(std::size_t pose,
              const EquilibriumSolver::Standing& nominal,
              EquilibriumSolver::Standing& to);
  void set_parameters();

  const TestPoses& tests_;
  ChangedKnee knee_;
  Eigen::VectorXd theta_, on_the_way_;
  std::vector<Drive> nominal_;  ///< by poses
  Drive drive_;
  std::vector<std::unique_ptr<EquilibriumSolver>> solvers_;
  std::vector<std::unique_ptr<Sensitivity>> sensitivities_;
  PoseResult result_;
  EquilibriumSolver::Standing trial_, step_;
};

}  // namespace condyle
