#include "equilibrium/equilibrium_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "equilibrium/contact_rules.h"
#include "equilibrium/contact_scales.h"
#include "equilibrium/contact_shape.h"
#include "equilibrium/diagnosis.h"
#include "math/rotation.h"

namespace condyle {
EquilibriumSolver::EquilibriumSolver(Model model, EquilibriumOptions options)
    : model_(std::make_unique<Model>(std::move(model))),
      options_(options),
      searches_(make_searches(*model_)),
      newton_(*model_, options_.newton),
      descent_(*model_, searches_, newton_, options_.descent),
      predictor_(*model_) {
  state_.contacts.reserve(kMaxConstraints);
  state_.sigma.assign(model_->conditions.size(), 0);
  state_.X = model_->start;
}

void EquilibriumSolver::set_state(const EquilibriumState& state) {
  read_drive(target_);
  const bool same = has_state_ && state.X.p == state_.X.p && state.X.R == state_.X.R &&
                    target_.values == solved_.values && target_.scales == solved_.scales;
  if (same) return;
  predictor_.clear();
  state_ = state;
  solved_ = target_;
  has_state_ = true;
}

void EquilibriumSolver::read_drive(Drive& drive) const {
  drive.values.resize(model_->conditions.size());
  drive.scales.resize(model_->loads.size());
  for (std::size_t i = 0; i < drive.values.size(); ++i)
    drive.values[i] = model_->conditions[i].value;
  for (std::size_t i = 0; i < drive.scales.size(); ++i) drive.scales[i] = model_->loads[i].scale;
}

void EquilibriumSolver::set_drive(const Drive& from, const Drive& to, double t) {
  const auto between = [t](double a, double b) { return t == 1 ? b : a + t * (b - a); };
  for (std::size_t i = 0; i < to.values.size(); ++i)
    model_->conditions[i].value = between(from.values[i], to.values[i]);
  for (std::size_t i = 0; i < to.scales.size(); ++i)
    model_->loads[i].scale = between(from.scales[i], to.scales[i]);
}

bool EquilibriumSolver::release_pulling(EquilibriumState& state) const {
  const int worst = most_pulling(*model_, newton_.system(), state);
  if (worst >= 0) state.contacts.erase(state.contacts.begin() + worst);
  return worst >= 0;
}

/// What Newton has solved of a pair is a help to the search.
void EquilibriumSolver::set_known(int pair, const EquilibriumState& state) {
  known_.clear();
  const std::vector<ContactLinearization>& contacts = newton_.system().contacts();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    if (state.contacts[k].pair != pair) continue;
    const ContactLinearization& at = contacts[k];
    known_.push_back({at.B.c, at.A.c, at.B.K, at.A.K, at.relative_curvature[0]});
  }
}

bool EquilibriumSolver::add_overlaps(EquilibriumState& state, bool& too_many) {
  bool added = false;
  const double L = model_->length;
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_->pairs[p].mode != ContactMode::kAuto) continue;
    set_known(static_cast<int>(p), state);
    searches_[p].find(state.X, 0.0, minima_, kMerge * L, known_);
    for (const GapMinimum& minimum : minima_) {
      if (minimum.gap > -options_.description.overlap * L / 30) continue;
      if (is_contact_of(*model_, state, static_cast<int>(p), minimum)) continue;
      if (state.contacts.size() + state.sigma.size() >= kMaxConstraints) {
        too_many = true;
        return added;
      }
      state.contacts.push_back({static_cast<int>(p), minimum.on_B, minimum.on_A, 0});
      added = true;
    }
  }
  return added;
}

/// False where Newton has led a contact to a place where the solids interpenetrate beside it.
bool EquilibriumSolver::on_minima(const EquilibriumState& state) const {
  const std::vector<ContactLinearization>& contacts = newton_.system().contacts();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const bool automatic = model_->pairs[state.contacts[k].pair].mode == ContactMode::kAuto;
    if (automatic && contacts[k].relative_curvature[0] < -1e-7) return false;
  }
  return true;
}

/// False where a contact lies far beyond the known part of a surface, or an open pair has passed
/// through itself: no part of one surface faces the other, or one is buried.
bool EquilibriumSolver::on_surfaces(const EquilibriumState& state) {
  for (const ClosedContact& contact : state.contacts)
    if (edge_distance(model_->pairs[contact.pair], contact.on_B, contact.on_A) <
        -0.1 * model_->length)
      return false;
  return faces(state);
}

bool EquilibriumSolver::carries_and_clear(EquilibriumState& state) {
  bool too_many = false;
  EquilibriumState copy = state;
  return on_minima(state) && !release_pulling(copy) && !add_overlaps(copy, too_many) && !too_many &&
         on_surfaces(state);
}

bool EquilibriumSolver::faces(const EquilibriumState& state) {
  const double L = model_->length;
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_->pairs[p].mode != ContactMode::kAuto || !searches_[p].has_samples()) continue;
    const bool closed =
        std::any_of(state.contacts.begin(), state.contacts.end(),
                    [p](const ClosedContact& c) { return c.pair == static_cast<int>(p); });
    if (closed) continue;
    searches_[p].find_nearest(state.X, kAnywhere * L, minima_, kMerge * L);
    if (minima_.empty() || minima_.front().gap < -options_.description.overlap * L / 30)
      return false;
  }
  return true;
}

bool EquilibriumSolver::settle(EquilibriumState& state, Attempt& attempt) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    attempt.newton = newton_.solve(state);
    attempt.iterations += attempt.newton.iterations;
    if (attempt.newton.outcome == NewtonOutcome::kZeroLength)
      attempt.zero_element = attempt.newton.zero_element;
    if (attempt.newton.outcome != NewtonOutcome::kConverged) return false;
    if (release_pulling(state)) continue;
    bool too_many = false;
    if (add_overlaps(state, too_many)) continue;
    if (too_many || !on_minima(state)) return false;
    attempt.off_surfaces = !on_surfaces(state);
    return !attempt.off_surfaces;
  }
  return false;
}

bool EquilibriumSolver::descend(EquilibriumState& state, Attempt& attempt) {
  constexpr int kFewSteps = 10;  // where conforming surfaces leave the answer open
  const bool open_ended = conforming_pair(*model_, searches_, state.X).has_value();
  attempt.descent = descent_.solve(
      state, [this](EquilibriumState& s) { return carries_and_clear(s); },
      open_ended ? kFewSteps : options_.descent.max_steps);
  attempt.newton = attempt.descent.newton;
  attempt.iterations += attempt.descent.iterations;
  return attempt.descent.converged;
}

/// From a solved state to another drive in parts: halved where a part fails, doubled where it
/// succeeds.
bool EquilibriumSolver::advance(EquilibriumState& state,
                                const Drive& from,
                                const Drive& to,
                                Attempt& attempt) {
  constexpr double kLongest = 0.5, kShortest = 1.0 / 256, kDescend = 1.0 / 32;
  double part = kLongest;
  for (double t = 0; t < 1;) {
    const double next = std::min(1.0, t + part);
    set_drive(from, to, next);
    EquilibriumState trial = state;
    bool solved = settle(trial, attempt);
    if (!solved && part <= kDescend) {
      trial = state;
      solved = descend(trial, attempt);
    }
    if (solved) {
      state = trial;
      t = next;
      part = std::min(2 * part, kLongest);
    } else if ((part /= 2) < kShortest) {
      return false;
    }
  }
  return true;
}

/// Newton from the first estimates of contact points that the scene gives, if it gives any.
bool EquilibriumSolver::settle_at_estimates(EquilibriumState& state, Attempt& attempt) {
  EquilibriumState trial = state;
  for (std::size_t p = 0; p < model_->pairs.size(); ++p) {
    const ContactPair& pair = model_->pairs[p];
    if (pair.mode == ContactMode::kOpen) continue;
    for (const Eigen::Vector3d& on_B : pair.start) {
      if (trial.contacts.size() + trial.sigma.size() >= kMaxConstraints) break;
      const Eigen::Vector3d on_A = state.X.inverse() * on_B;
      trial.contacts.push_back({static_cast<int>(p),
                                pair.on_B->closest(on_B, pair.on_B->seed(on_B)),
                                pair.on_A->closest(on_A, pair.on_A->seed(on_A)), 0});
    }
  }
  if (trial.contacts.empty() || !settle(trial, attempt)) return false;
  state = trial;
  return true;
}

bool EquilibriumSolver::find_first(EquilibriumState& state, Attempt& attempt) {
  return settle_at_estimates(state, attempt) || descend(state, attempt);
}

/// The first pose: where the start is far from what the conditions prescribe, the equilibrium at
/// the start's own values comes first.
bool EquilibriumSolver::solve_first(EquilibriumState& state,
                                    const Drive& target,
                                    Attempt& attempt) {
  constexpr double kFar = 0.1;  // of L
  Drive own = target;
  bool far = false;
  for (std::size_t i = 0; i < model_->conditions.size(); ++i) {
    const KinematicCondition& condition = model_->conditions[i];
    const double k = evaluate(condition, state.X).k;
    own.values[i] = target.values[i] + k;
    far |= std::abs(k) * condition_weight(*model_, i) > kFar * model_->length;
  }
  if (!far) return find_first(state, attempt);
  set_drive(own, own, 1);
  return find_first(state, attempt) && advance(state, own, target, attempt);
}

/// Newton from where the poses before point to, or from the last one; else the descent; else the
/// way from the last pose in parts.
bool EquilibriumSolver::solve_from_last(EquilibriumState& state, Attempt& attempt, bool patient) {
  if (predictor_.predict(target_, state) && settle(state, attempt)) return true;
  state = state_;
  if (settle(state, attempt)) return true;
  const bool off_surfaces = attempt.off_surfaces;
  if (off_surfaces) trial_ = state;
  if (descend(state = state_, attempt)) return true;
  if (off_surfaces) {
    // Both ways end off the known surfaces: the pose says so itself.
    state = trial_;
    return newton_.solve(state).outcome == NewtonOutcome::kConverged;
  }
  return patient && advance(state = state_, solved_, target_, attempt);
}

void EquilibriumSolver::solve(PoseResult& result, bool patient) {
  const auto begin = std::chrono::steady_clock::now();
  read_drive(target_);
  Attempt attempt;
  bool solved = false;
  if (has_state_) {
    solved = solve_from_last(next_, attempt, patient);
    set_drive(target_, target_, 1);
  } else {
    state_.X.R = orthonormalized(state_.X.R);
    next_ = state_;
    solved = solve_first(next_, target_, attempt);
    set_drive(target_, target_, 1);
    if (!solved) solved = descend(next_ = state_, attempt);
  }
  clear(result);
  result.iterations = attempt.iterations;
  result.residual = attempt.newton.residual;
  if (solved) {
    result.status = PoseStatus::kConverged;
    describe_pose(*model_, newton_.system(), next_, searches_, options_.description, minima_,
                  result);
    // Beyond the edge of a patch as well: the next pose may come back.
    if (result.status != PoseStatus::kOverlap) keep(next_);
  } else if (patient) {
    explain_failure(*model_, newton_.system(), searches_, next_, attempt, result);
  } else {
    result.status = PoseStatus::kIterationLimit;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void EquilibriumSolver::keep(const EquilibriumState& state) {
  state_ = state;
  state_.X.R = orthonormalized(state.X.R);
  solved_ = target_;
  has_state_ = true;
  predictor_.add(target_, state_);
}

PoseResult EquilibriumSolver::solve(bool patient) {
  PoseResult result;
  solve(result, patient);
  return result;
}

}  // namespace condyle
