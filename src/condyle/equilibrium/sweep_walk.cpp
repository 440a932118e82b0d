#include "condyle/equilibrium/sweep_walk.h"

#include <chrono>
#include <utility>

#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/second_equilibrium.h"

namespace condyle {

SweepWalk::SweepWalk(EquilibriumSolver& solver, const Swept& swept, const SweepOptions& options)
    : solver_(solver),
      swept_(swept),
      drive_(options.drive ? *options.drive : drive_of(solver.model())),
      options_(options),
      known_(options.known),
      start_(solver.standing()) {
  check_drive(drive_, solver.model());
}

const Drive& SweepWalk::drive_at(double value) {
  swept_.in(drive_) = value;
  return drive_;
}

SweepResult SweepWalk::along(const std::vector<double>& values) {
  stops_.reserve(values.size());
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
    stop.taken = known;
    stop.from_elsewhere = known->from_elsewhere;
  } else {
    compute(stop);
  }
  stop.at.result.value = value;
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
    return known.pose.status != PoseStatus::kNotComputed;
  }
  if (!can_restore(solver_.model(), known.pose)) return false;
  solver_.set_state(restore_state(solver_.model(), known.pose), drive_at(stop.at.value));
  solver_.solve(drive_at(stop.at.value), pose, Patience::kNone);
  const bool same = agrees(pose, known.pose);
  if (same) {
    stop.at.state = solver_.solution();
    pose.iterations = known.pose.iterations;
    pose.seconds = known.pose.seconds;
    if (!known.pose.remark.empty()) pose.remark = known.pose.remark;
  }
  if (!same || !pose.converged()) stand_at_last_converged();
  return same;
}

RigidTransform SweepWalk::in_model(const PoseResult& pose) const {
  return solver_.model().origins.into_model(pose.X_BA);
}

bool SweepWalk::agrees(const PoseResult& pose, const PoseResult& known) const {
  return pose.status == known.status && same_pose(solver_.model(), in_model(pose), in_model(known));
}

void SweepWalk::compute(Stop& stop) {
  if (!last_converged_) {
    const KnownPose* nearest = known_.nearest_converged(stop.at.value);
    if (nearest != nullptr && can_restore(solver_.model(), nearest->pose))
      solver_.set_state(restore_state(solver_.model(), nearest->pose),
                        drive_at(nearest->pose.value));
  }
  solver_.solve(drive_at(stop.at.value), stop.at.result);
  stop.from_elsewhere = solver_.from_elsewhere();
  if (stop.at.result.solved()) stop.at.state = solver_.solution();
}

/// From the pose that has just converged back over those before it that did not, and on again from
/// those that were found this way.
void SweepWalk::mend_gap() {
  const std::size_t end = stops_.size() - 1;
  const std::size_t begin = told_;
  if (begin == end) return;
  std::size_t from = end;
  for (std::size_t k = end; k-- > begin;)
    if (mend(stops_[k], stops_[from])) from = k;
  for (std::size_t k = begin + 1; k < end; ++k)
    if (stops_[k - 1].converged() && !stops_[k].converged()) mend(stops_[k], stops_[k - 1]);
  stand_at(stops_[end].at);
}

bool SweepWalk::mend(Stop& stop, const Stop& from) {
  if (stop.taken != nullptr) return false;
  stand_at(from.at);
  solver_.solve(drive_at(stop.at.value), trial_, Patience::kWay);
  const double seconds = stop.at.result.seconds + trial_.seconds;
  const int iterations = stop.at.result.iterations + trial_.iterations;
  if (trial_.converged() || (trial_.solved() && !stop.at.result.solved())) {
    stop.at.result = trial_;
    stop.at.result.value = stop.at.value;
    stop.at.state = solver_.solution();
    stop.from_elsewhere = true;
  }
  stop.at.result.seconds = seconds;
  stop.at.result.iterations = iterations;
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
          {stop.at.result, stop.visit, stop.from, stop.events, stop.from_elsewhere});
  }
}

/// Says so where the body moved far since the pose before, by more than what is prescribed.
void SweepWalk::note_jump(Stop& stop) {
  if (!stop.converged() || told_ == 0 || !stops_[told_ - 1].converged()) return;
  const Model& model = solver_.model();
  const std::string words =
      jump(model, carried(model, drive_at(stop.at.value), in_model(stops_[told_ - 1].at.result)),
           in_model(stop.at.result));
  if (!words.empty()) add_remark(stop.at.result, words);
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
  locate_events(solver_, swept_, drive_, last.at, stop.at, stop.events);
  stand_at_last_converged();
  stop.at.result.event_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void SweepWalk::stand_at(const SolvedPose& pose) {
  solver_.set_state(pose.state, drive_at(pose.value));
}

void SweepWalk::stand_at_last_converged() {
  if (last_converged_) return stand_at(stops_[*last_converged_].at);
  solver_.go_back(start_);
}

/// Did the sweep go from one converged pose to the next on one branch, so far as is known?
bool SweepWalk::continuous(std::size_t a, std::size_t b) const {
  if (b > a + 1 || stops_[a].from_elsewhere || stops_[b].from_elsewhere) return false;
  for (const Event& event : stops_[b].events)
    if (event.kind == EventKind::kJump || event.kind == EventKind::kLimitPoint) return false;
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
  SolvedPose at = stops_[from].at;
  for (auto k = static_cast<std::ptrdiff_t>(from) + way;
       k >= 0 && k < static_cast<std::ptrdiff_t>(stops_.size()); k += way) {
    Stop& stop = stops_[static_cast<std::size_t>(k)];
    if (!stop.converged()) continue;
    stand_at(at);
    solver_.solve(drive_at(stop.at.value), trial_, Patience::kNone);
    stop.at.result.seconds += trial_.seconds;
    const Model& model = solver_.model();
    const RigidTransform here = in_model(stop.at.result), there = in_model(trial_);
    if (!trial_.converged() || same_pose(model, here, there)) return;
    add_remark(stop.at.result,
               second_equilibrium(model, here, there,
                                  way > 0 ? "followed from the poses before it in the sweep"
                                          : "followed back from the poses after it in the sweep"));
    at.value = stop.at.value;
    at.state = solver_.solution();
  }
}

}  // namespace condyle
