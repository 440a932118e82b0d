#include "condyle/equilibrium/sweep_walk.h"

#include <chrono>
#include <utility>

#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/second_equilibrium.h"

namespace condyle {

SweepWalk::SweepWalk(EquilibriumSolver& solver, const Swept& swept, const SweepOptions& options)
    : walker_(solver, swept, options.drive ? *options.drive : drive_of(solver.model())),
      options_(options),
      known_(options.known),
      start_(solver.standing()) {}

SweepResult SweepWalk::along(const std::vector<double>& values) {
  stops_.reserve(values.size());
  event_tolerance_ = tolerance_of_events(walker_.swept(), values);
  for (const double value : values) step(value);
  tell();
  note_second_equilibria();
  SweepResult result;
  result.poses.reserve(stops_.size());
  for (Stop& stop : stops_) {
    result.poses.push_back(std::move(stop.at.result));
    result.events.insert(result.events.end(), stop.events.begin(), stop.events.end());
  }
  return result;
}

void SweepWalk::step(double value) {
  Stop& stop = stops_.emplace_back();
  stop.at.value = value;
  stop.visit = visits_[value]++;
  const KnownPose* known = known_.find(value, stop.visit);
  if (known != nullptr && take_over(*known, stop)) {
    if (!known->open) stop.taken = known;
    stop.from_elsewhere = known->from_elsewhere;
  } else {
    compute(stop);
    if (!stop.converged() && options_.on_open)
      options_.on_open({stop.at.result, stop.visit, {}, {}, stop.from_elsewhere, true});
  }
  if (!stop.converged()) return;
  last_converged_ = stops_.size() - 1;
  mend_gap();
  tell();
}

/// False where the known pose does not tell enough, or is none of this model's.
bool SweepWalk::take_over(const KnownPose& known, Stop& stop) {
  PoseResult& pose = stop.at.result;
  if (!known.pose.converged() && known.pose.status != PoseStatus::kLeftPatch) {
    pose = known.pose;
    pose.value = stop.at.value;
    return known.pose.status != PoseStatus::kNotComputed;
  }
  if (!can_restore(model(), known.pose)) return false;
  walker_.stand_at(stop.at.value, restore_state(model(), known.pose));
  walker_.step(stop.at.value, Patience::kNone, stop.at);
  const bool same = agrees(pose, known.pose);
  if (same) {
    pose.iterations = known.pose.iterations;
    pose.seconds = known.pose.seconds;
    if (!known.pose.remark.empty()) pose.remark = known.pose.remark;
    // Derivatives of a sum over points are not the same to the last bits from another start.
    if (pose.stability == known.pose.stability) pose.lowest_stiffness = known.pose.lowest_stiffness;
    if (pose.joint_stiffness && known.pose.joint_stiffness)
      pose.joint_stiffness = known.pose.joint_stiffness;
    pose.trace.origin = PoseOrigin::kEarlierRun;
    if (known.pose.trace.told()) pose.trace = known.pose.trace;
  }
  if (!same || !pose.converged()) stand_at_last_converged();
  return same;
}

RigidTransform SweepWalk::in_model(const PoseResult& pose) const {
  return model().origins.into_model(pose.X_BA);
}

bool SweepWalk::agrees(const PoseResult& pose, const PoseResult& known) const {
  return pose.status == known.status && same_pose(model(), in_model(pose), in_model(known));
}

void SweepWalk::compute(Stop& stop) {
  if (!last_converged_) {
    const KnownPose* nearest = known_.nearest_converged(stop.at.value);
    if (nearest != nullptr && can_restore(model(), nearest->pose))
      walker_.stand_at(nearest->pose.value, restore_state(model(), nearest->pose));
  }
  walker_.step(stop.at.value, stops_.size() == 1 ? Patience::kFirst : Patience::kAll, stop.at);
  stop.from_elsewhere = solver().from_elsewhere();
}

/// From the pose that has just converged back over those before it that did not, and on again from
/// those that were found this way.
void SweepWalk::mend_gap() {
  const std::size_t end = stops_.size() - 1;
  const std::size_t begin = told_;
  if (begin == end) return;
  std::size_t from = end;
  for (std::size_t k = end; k-- > begin;)
    if (mend(stops_[k], stops_[from], PoseOrigin::kNextPose)) from = k;
  for (std::size_t k = begin + 1; k < end; ++k)
    if (stops_[k - 1].converged() && !stops_[k].converged()) mend(stops_[k], stops_[k - 1]);
  walker_.stand_at(stops_[end].at);
}

bool SweepWalk::mend(Stop& stop, const Stop& from, std::optional<PoseOrigin> origin) {
  if (stop.taken != nullptr) return false;
  walker_.stand_at(from.at);
  walker_.step(stop.at.value, Patience::kWay, trial_);
  if (origin) trial_.result.trace.origin = *origin;
  PoseResult &pose = stop.at.result, &trial = trial_.result;
  if (trial.converged() || (trial.solved() && !pose.solved())) {
    std::swap(stop.at, trial_);
    stop.from_elsewhere = true;
  }
  pose.seconds += trial.seconds;
  pose.iterations += trial.iterations;
  pose.trace.add_effort(trial.trace);
  return stop.converged();
}

/// What has become final is told, in order.
void SweepWalk::tell() {
  for (; told_ < stops_.size(); ++told_) {
    Stop& stop = stops_[told_];
    if (stop.at.result.solved()) {
      find_events(stop);
      last_solved_ = told_;
    }
    note_jump(stop);
    if (options_.on_pose) options_.on_pose(stop.at.result);
    if (stop.taken == nullptr && options_.on_computed)
      options_.on_computed(
          {stop.at.result, stop.visit, stop.from, stop.events, stop.from_elsewhere, false});
  }
}

/// Says so where the body moved far since the pose before, by more than what is prescribed.
void SweepWalk::note_jump(Stop& stop) {
  std::string words;
  if (stop.converged() && told_ > 0 && stops_[told_ - 1].converged()) {
    const RigidTransform before = in_model(stops_[told_ - 1].at.result);
    words = jump(model(), carried(model(), walker_.drive_at(stop.at.value), before),
                 in_model(stop.at.result));
  }
  tell_jump(stop.at.result, words);  // a known pose may tell of the one that stood before it then
}

/// Events since the last solved pose. The solver then stands at the last converged one.
void SweepWalk::find_events(Stop& stop) {
  if (!options_.events || !last_solved_) return;
  const Stop& last = stops_[*last_solved_];
  stop.from = last.at.value;
  if (stop.taken != nullptr && last.taken != nullptr && stop.taken->from &&
      same_value(*stop.taken->from, last.at.value)) {
    stop.events = stop.taken->events;
    return;
  }
  const auto begin = std::chrono::steady_clock::now();
  EventOptions options;
  options.tolerance = event_tolerance_;
  options.arrival = stop.converged() && stop.taken == nullptr;
  EventsFound found = locate_events(walker_, last.at, stop.at, stop.events, options);
  if (found.instead) {
    put_in_place(std::move(*found.instead), stop);
    options.arrival = false;
    (void)locate_events(walker_, last.at, stop.at, stop.events, options);
  } else if (found.elsewhere) {
    stop.from_elsewhere = true;
  }
  stand_at_last_converged();
  stop.at.result.event_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The pose on the branch of those before it; what the other one took is counted.
void SweepWalk::put_in_place(SolvedPose there, Stop& stop) {
  there.result.seconds += stop.at.result.seconds;
  there.result.iterations += stop.at.result.iterations;
  there.result.trace.add_effort(stop.at.result.trace);
  stop.at = std::move(there);
  stop.from_elsewhere = false;
}

void SweepWalk::stand_at_last_converged() {
  if (last_converged_) return walker_.stand_at(stops_[*last_converged_].at);
  solver().go_back(start_);
}

/// Did the sweep go from one converged pose to the next on one branch, so far as is known?
bool SweepWalk::continuous(std::size_t a, std::size_t b) const {
  if (b > a + 1 || stops_[a].from_elsewhere || stops_[b].from_elsewhere) return false;
  for (const Event& event : stops_[b].events)
    if (event.kind == EventKind::kJump || event.kind == EventKind::kLimitPoint ||
        event.value == stops_[b].at.value)  // told there as it could not be located
      return false;
  return true;
}

/// Where the sweep may have changed from one branch of equilibria to another, both are followed
/// into each other.
void SweepWalk::note_second_equilibria() {
  std::optional<std::size_t> last;
  for (std::size_t k = 0; k < stops_.size(); ++k) {
    if (!stops_[k].converged()) continue;
    if (last && !continuous(*last, k)) {
      follow(*last, 1);
      follow(k, -1);
    }
    last = k;
  }
  stand_at_last_converged();
}

void SweepWalk::follow(std::size_t from, int way) {
  const SolvedPose* last = &stops_[from].at;
  for (auto k = static_cast<std::ptrdiff_t>(from) + way;
       k >= 0 && k < static_cast<std::ptrdiff_t>(stops_.size()); k += way) {
    Stop& stop = stops_[static_cast<std::size_t>(k)];
    if (!stop.converged()) continue;
    walker_.stand_at(*last);
    walker_.step(stop.at.value, Patience::kNone, trial_);
    last = &trial_;
    stop.at.result.seconds += trial_.result.seconds;
    const RigidTransform here = in_model(stop.at.result), there = in_model(trial_.result);
    if (!trial_.result.converged() || same_pose(model(), here, there)) return;
    add_remark(stop.at.result,
               second_equilibrium(model(), here, there,
                                  way > 0 ? "followed from the poses before it in the sweep"
                                          : "followed back from the poses after it in the sweep"));
  }
}

}  // namespace condyle
