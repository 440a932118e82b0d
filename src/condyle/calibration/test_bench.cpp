#include "condyle/calibration/test_bench.h"

#include <algorithm>

namespace condyle {
namespace {

EquilibriumOptions options() {
  EquilibriumOptions options;
  options.description.stability = false;
  return options;
}

}  // namespace

TestBench::TestBench(const Scene& scene,
                     const MeasuredModels& models,
                     const TestPoses& tests,
                     const std::vector<FreeParameter>& parameters)
    : tests_(tests),
      knee_(*models.models[0].model, parameters),
      theta_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))),
      on_the_way_(theta_) {
  const std::vector<double> ones(scene.loads.size(), 1.0);
  for (const TestPose& pose : tests.poses)
    nominal_.push_back(drive_of(pose, scene, models.models[pose.model], ones));
  for (const MeasuredModel& model : models.models) {
    solvers_.push_back(std::make_unique<EquilibriumSolver>(model.model, models.covers, options()));
    sensitivities_.push_back(std::make_unique<Sensitivity>(*model.model));
  }
  (void)set(theta_);
}

bool TestBench::set(const Eigen::VectorXd& theta) {
  theta_ = theta;
  if (!knee_.set(theta)) return false;
  set_parameters();
  return true;
}

void TestBench::set_parameters() {
  for (const auto& solver : solvers_) solver->set_parameters(knee_.parameters());
}

const Drive& TestBench::drive(std::size_t pose) {
  drive_ = nominal_[pose];
  for (std::size_t i = 0; i < drive_.scales.size(); ++i)
    drive_.scales[i] *= knee_.load_factors()[i];
  return drive_;
}

Linearization TestBench::at(std::size_t pose) const {
  return solvers_[tests_.poses[pose].model]->linearized_solution();
}

Sensitivity* TestBench::sensitivity(std::size_t pose) {
  Sensitivity* found = sensitivities_[tests_.poses[pose].model].get();
  return found->set(at(pose)) ? found : nullptr;
}

void TestBench::reset() {
  for (const auto& solver : solvers_) solver->reset();
}

bool TestBench::attempt(std::size_t pose,
                        const EquilibriumSolver::Standing& from,
                        EquilibriumSolver::Standing& to) {
  EquilibriumSolver& solver = *solvers_[tests_.poses[pose].model];
  solver.go_back(from);
  solver.solve(drive(pose), result_, Patience::kNone);
  ++solved;
  if (!result_.converged()) {
    ++failed;
    return false;
  }
  to.state = solver.state();
  to.solved = drive_;
  to.has_state = true;
  return true;
}

bool TestBench::solve(std::size_t pose,
                      const EquilibriumSolver::Standing& from,
                      const EquilibriumSolver::Standing* nominal,
                      EquilibriumSolver::Standing& to) {
  const bool found = attempt(pose, from, to);
  if (found && result_.trace.route == PoseRoute::kNewton) return true;
  // A descent may have led to another equilibrium than the one that goes on from before.
  if (nominal != nullptr && follow(pose, *nominal, to)) return true;
  return found && attempt(pose, from, to);
}

/// Halved where a part fails, doubled where it succeeds.
bool TestBench::follow(std::size_t pose,
                       const EquilibriumSolver::Standing& nominal,
                       EquilibriumSolver::Standing& to) {
  constexpr double kLongest = 0.5, kShortest = 1.0 / 16;
  const Eigen::VectorXd& theta = theta_;
  step_ = nominal;
  double part = kLongest;
  bool arrived = false;
  for (double t = 0; !arrived && part >= kShortest;) {
    const double next = std::min(1.0, t + part);
    on_the_way_ = next * theta;
    const bool advanced = knee_.set(on_the_way_) &&
                          (set_parameters(), attempt(pose, step_, trial_)) &&
                          result_.trace.route == PoseRoute::kNewton;
    if (advanced) {
      std::swap(step_, trial_);
      t = next;
      part = std::min(2 * part, kLongest);
      arrived = t == 1;
    } else {
      part /= 2;
    }
  }
  if (!arrived) {
    (void)knee_.set(theta_);
    set_parameters();
    return false;
  }
  to = step_;
  return true;
}

}  // namespace condyle
