#include "equilibrium/sweep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include "equilibrium/arc_length.h"
#include "equilibrium/build_model.h"
#include "equilibrium/events.h"
#include "equilibrium/restore_state.h"

namespace condyle {
namespace {

/// The greatest distance of two neighbouring values: what an arc-length sweep does not exceed.
double largest_step(const std::vector<double>& values) {
  double largest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i] - values[i - 1]));
  return largest;
}

/// One walk along the values. Between two of them the solver stands at the last solved pose.
class Walk {
 public:
  Walk(EquilibriumSolver& solver, double& swept, const SweepOptions& options)
      : solver_(solver), swept_(swept), options_(options), known_(options.known) {}

  SweepResult along(const std::vector<double>& values) {
    SweepResult result;
    result.poses.reserve(values.size());
    for (const double value : values) {
      step(value);
      result.poses.push_back(current_.pose);
      result.events.insert(result.events.end(), current_.events.begin(), current_.events.end());
    }
    return result;
  }

 private:
  void step(double value) {
    current_.visit = visits_[value]++;
    const KnownPose* known = known_.find(value, current_.visit);
    const bool taken = known != nullptr && take_over(*known, value);
    if (!taken) compute(value);
    current_.pose.value = value;
    if (options_.on_pose) options_.on_pose(current_.pose);
    current_.from.reset();
    current_.events.clear();
    if (is_solved(current_.pose)) move_on(value, taken ? known : nullptr);
    if (!taken && options_.on_computed) options_.on_computed(current_);
  }

  /// False where the known pose does not tell enough, or is none of this model's.
  bool take_over(const KnownPose& known, double value) {
    if (!is_solved(known.pose)) {
      current_.pose = known.pose;
      return known.pose.status != PoseStatus::kNotComputed;
    }
    if (!can_restore(solver_.model(), known.pose)) return false;
    swept_ = value;
    solver_.set_state(restore_state(solver_.model(), known.pose));
    solver_.solve(current_.pose, /*patient=*/false);
    if (!agrees(known.pose)) {
      if (last_) stand_at(*last_);
      return false;
    }
    current_.pose.iterations = known.pose.iterations;
    current_.pose.seconds = known.pose.seconds;
    return true;
  }

  [[nodiscard]] bool agrees(const PoseResult& known) const {
    constexpr double kClose = 1e-6;  // [rad], and of L
    const PoseResult& pose = current_.pose;
    return pose.status == known.status && (pose.X_BA.R - known.X_BA.R).norm() < kClose &&
           (pose.X_BA.p - known.X_BA.p).norm() < kClose * solver_.model().length;
  }

  void compute(double value) {
    if (!last_) {
      const KnownPose* nearest = known_.nearest_converged(value);
      if (nearest != nullptr && can_restore(solver_.model(), nearest->pose)) {
        swept_ = nearest->pose.value;
        solver_.set_state(restore_state(solver_.model(), nearest->pose));
      }
    }
    swept_ = value;
    solver_.solve(current_.pose);
  }

  void stand_at(const SolvedPose& pose) {
    swept_ = pose.value;
    solver_.set_state(pose.state);
  }

  /// Events since the last solved pose; the current one becomes the last.
  void move_on(double value, const KnownPose* known) {
    now_.value = value;
    now_.result = current_.pose;
    now_.state = solver_.state();
    if (options_.events && last_) {
      current_.from = last_->value;
      if (known != nullptr && last_taken_ && known->from &&
          same_value(*known->from, last_->value)) {
        current_.events = known->events;
      } else {
        locate_events(solver_, swept_, *last_, now_, current_.events);
        stand_at(now_);
      }
    }
    if (!last_) last_.emplace();
    std::swap(*last_, now_);
    last_taken_ = known != nullptr;
  }

  EquilibriumSolver& solver_;
  double& swept_;
  const SweepOptions& options_;
  KnownPoseIndex known_;
  std::unordered_map<double, int> visits_;
  KnownPose current_;
  SolvedPose now_;
  std::optional<SolvedPose> last_;  ///< the last solved pose of this walk
  bool last_taken_ = false;
};

}  // namespace

SweepResult sweep(EquilibriumSolver& solver,
                  double& swept,
                  const std::vector<double>& values,
                  const SweepOptions& options) {
  return Walk(solver, swept, options).along(values);
}

SweepResult sweep(const Scene& scene,
                  const std::vector<FittedSurface>& surfaces,
                  const SweepOptions& options) {
  assert(scene.sweep);
  EquilibriumOptions equilibrium;
  equilibrium.description.stability = options.stability;
  equilibrium.description.joint_stiffness = options.stability && scene.joint;
  EquilibriumSolver solver(build_model(scene, surfaces), equilibrium);
  const SweptValue swept{scene.sweep->varies_load, static_cast<std::size_t>(scene.sweep->index)};
  const std::vector<double>& values = scene.sweep->values;
  if (!scene.sweep->arc_length || values.size() < 2)
    return sweep(solver, swept.in(solver.model()), values, options);
  PathOptions path;
  path.on_pose = options.on_pose;
  return follow_path(solver, swept, values.front(), values.back(), largest_step(values), path);
}

}  // namespace condyle
