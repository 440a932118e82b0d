/// The ways to a position of equilibrium, in the order in which the solver tries them.

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/second_equilibrium.h"

namespace condyle {

bool EquilibriumSolver::tried_from(const RigidTransform& X, const Attempt& attempt) const {
  constexpr double kPracticallySame = 1e-3;  // of L
  return std::any_of(
      attempt.descended_from.begin(), attempt.descended_from.end(),
      [&](const RigidTransform& Y) { return distance(*model_, X, Y) < kPracticallySame; });
}

Work EquilibriumSolver::most(Patience patience) const {
  const Work most = patience == Patience::kFirst
                        ? options_.most_at_first
                        : options_.most.share(patience == Patience::kWay ? 3 : 1);
  return newton_.system().potentials().empty() ? most : most.with_laws();
}

long EquilibriumSolver::looked_at() const {
  return points_until_now(searches_, newton_.system().potentials());
}

/// What may still be spent on the pose under way.
Work EquilibriumSolver::left(Attempt& attempt) const {
  attempt.spent.points = looked_at() - attempt.points_before;
  return attempt.most.after(attempt.spent);
}

bool EquilibriumSolver::descend(EquilibriumState& state, Attempt& attempt) {
  const Work left = this->left(attempt);
  if (!left.any() || (!on_the_way_ && tried_from(state.X, attempt))) return false;
  const RigidTransform from = state.X;
  // Conforming surfaces leave the answer open: nothing is gained by going on.
  attempt.descent = descent_.solve(
      state, drive_, [&](EquilibriumState& s) { return is_admissible(s, attempt); },
      [&] { return !conforming_pair(*model_, searches_, from); }, left);
  attempt.newton = attempt.descent.newton;
  attempt.spent.iterations += attempt.descent.iterations;
  attempt.trace.searches += attempt.descent.searches;
  if (attempt.descent.converged) attempt.trace.residuals = newton_.residuals();
  if (!attempt.descent.converged && !on_the_way_) attempt.descended_from.push_back(from);
  return attempt.descent.converged;
}

/// Laws of energy made softer, then four times as stiff each time, which halves their depths. False
/// where a step fails.
bool EquilibriumSolver::stiffen(double softest, EquilibriumState& state, Attempt& attempt) {
  ContactPotentials& laws = newton_.system().potentials();
  const bool on_the_way = on_the_way_;
  on_the_way_ = true;
  laws.soften(softest);
  bool solved = descend(state, attempt);
  for (double factor = 4 * softest; solved && factor <= 1; factor *= 4) {
    laws.soften(factor);
    on_the_way_ = on_the_way || factor < 1;
    solved = settle(state, attempt);
  }
  laws.soften(1);
  on_the_way_ = on_the_way;
  return solved;
}

/// The descent, by softer laws first where they are stiff: those throw bodies that overlap apart.
bool EquilibriumSolver::descend_softly(EquilibriumState& state, Attempt& attempt) {
  constexpr double kStiff = 1.0 / 4;
  NewtonSystem& system = newton_.system();
  if (system.potentials().empty()) return descend(state, attempt);
  system.assemble(state, drive_);
  const double softest = system.potentials().softest(system.pull(), model_->length);
  if (softest > kStiff) return descend(state, attempt);
  const EquilibriumState start = state;
  const double steps = std::ceil(std::log(1 / softest) / std::log(4.0));
  if (stiffen(std::pow(4, -steps), state, attempt)) return true;
  return descend(state = start, attempt);
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
    on_the_way_ = next < 1;
    set_drive(from, to, next);
    EquilibriumState trial = state;
    bool solved = settle(trial, attempt);
    if (!solved && part <= kDescend) {
      trial = state;
      solved = descend_softly(trial, attempt);
      if (solved) attempt.trace.route = PoseRoute::kPartsDescents;
    }
    on_the_way_ = false;
    if (solved) {
      state = trial;
      t = next;
      ++attempt.trace.parts;
      part = std::min(2 * part, kLongest);
    } else if ((part /= 2) < kShortest || !left(attempt).any()) {
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
                                {pair.on_B->closest(on_B, pair.on_B->seed(on_B)),
                                 pair.on_A->closest(on_A, pair.on_A->seed(on_A))},
                                0});
    }
  }
  if (trial.contacts.empty() || !settle(trial, attempt)) return false;
  state = trial;
  return true;
}

bool EquilibriumSolver::find_first(EquilibriumState& state, Attempt& attempt) {
  attempt.begin(PoseRoute::kNewton, PoseOrigin::kStart);
  if (settle_at_estimates(state, attempt)) return true;
  attempt.begin(PoseRoute::kDescent, PoseOrigin::kStart);
  return descend_softly(state, attempt);
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
    const double k = evaluate(condition, target.values[i], state.X).k;
    own.values[i] = target.values[i] + k;
    far |= std::abs(k) * condition_weight(*model_, i) > kFar * model_->length;
  }
  if (!far) return find_first(state, attempt);
  drive_ = own;
  on_the_way_ = true;
  const bool at_start = find_first(state, attempt);
  on_the_way_ = false;
  const bool by_descent = attempt.trace.route == PoseRoute::kDescent;
  attempt.begin(by_descent ? PoseRoute::kPartsDescents : PoseRoute::kParts, PoseOrigin::kStart);
  const bool arrived = at_start && advance(state, own, target, attempt);
  drive_ = target;
  if (arrived) return true;
  attempt.begin(PoseRoute::kDescent, PoseOrigin::kStart);
  return descend_softly(state = state_, attempt);
}

/// Newton from where the poses before point to, or from the last one; else the descent; else the
/// way from the last pose in parts.
bool EquilibriumSolver::solve_from_last(EquilibriumState& state,
                                        Attempt& attempt,
                                        Patience patience) {
  attempt.begin(PoseRoute::kNewton, PoseOrigin::kPrediction);
  if (predictor_.predict(target_, state)) {
    if (settle(state, attempt)) return true;
    attempt.not_settled = attempt.first_solution;
  }
  attempt.begin(PoseRoute::kNewton, PoseOrigin::kLastPose);
  if (settle(state = state_, attempt)) return true;
  attempt.not_settled.reset();
  // On a branch that leaves the known surfaces nothing else is found by going on.
  if (attempt.off && patience == Patience::kNone) return false;
  attempt.begin(PoseRoute::kDescent, PoseOrigin::kLastPose);
  if (descend_softly(state = state_, attempt)) return true;
  if (attempt.off || patience == Patience::kNone) return false;
  attempt.begin(PoseRoute::kParts, PoseOrigin::kLastPose);
  const bool arrived = advance(state = state_, solved_, target_, attempt);
  drive_ = target_;
  return arrived;
}

bool EquilibriumSolver::descend_from(const RigidTransform& X,
                                     EquilibriumState& state,
                                     Attempt& attempt) {
  state.X = carried(*model_, drive_, X);
  state.contacts.clear();
  state.sigma.assign(model_->conditions.size(), 0);
  return descend_softly(state, attempt);
}

/// The descent from the scene's start pose and from the last pose, both carried to the values asked
/// for. The start comes first: it depends on no pose before.
bool EquilibriumSolver::solve_from_elsewhere(EquilibriumState& state, Attempt& attempt) {
  from_elsewhere_ = true;
  EquilibriumState last = state;
  attempt.begin(PoseRoute::kDescent, PoseOrigin::kCarriedStart);
  const bool from_start = descend_from(model_->start, state, attempt);
  const PoseTrace way_from_start = attempt.trace;
  attempt.begin(PoseRoute::kDescent, PoseOrigin::kCarriedLast);
  const bool from_last = has_state_ && descend_from(state_.X, last, attempt);
  if (from_last && !from_start) state = last;
  if (from_start) attempt.found_by(way_from_start);
  if (from_last && from_start && !same_pose(*model_, state.X, last.X)) attempt.other = last.X;
  const bool singular = attempt.newton.outcome == NewtonOutcome::kSingular;
  if (!from_last && !from_start && !has_state_ && !attempt.off && !singular)
    return descend_from_beside_start(state, attempt);
  if (!from_last && !from_start) return false;
  // Laws of contact hold what the last of both ways held, a lattice, say.
  if (from_start && has_state_ && !newton_.system().potentials().empty())
    return newton_.solve(state, drive_).outcome == NewtonOutcome::kConverged;
  newton_.system().assemble(state, drive_);
  return true;
}

/// The descent from the carried start moved out and in along the normals of where the surfaces are nearest:
/// of a first pose no other start is known, and one in some thousand comes to where nothing carries.
bool EquilibriumSolver::descend_from_beside_start(EquilibriumState& state, Attempt& attempt) {
  constexpr double kBeside = 0.05, kFar = 0.5;  // of L
  constexpr double kSame = 0.01;                // of the length of the pair
  const RigidTransform start = carried(*model_, drive_, model_->start);
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_->pairs[p].mode == ContactMode::kOpen || !searches_[p].has_samples()) continue;
    const double L = model_->length;
    searches_[p].find(start, kFar * L, minima_, kSame * searches_[p].length(L));
    if (!minima_.empty()) out += minima_.front().n;
  }
  if (!(out.norm() > 0)) return false;
  for (const double by : {kBeside, -kBeside}) {
    attempt.begin(PoseRoute::kDescent, PoseOrigin::kCarriedStart);
    RigidTransform X = start;
    X.p += by * model_->length * out.normalized();
    if (!descend_from(X, state, attempt)) continue;
    newton_.system().assemble(state, drive_);
    return true;
  }
  return false;
}

/// From the last equilibrium beyond an edge: its branch may return to the known surfaces, else it
/// tells where it is now.
bool EquilibriumSolver::solve_from_edge(EquilibriumState& state, Attempt& attempt) {
  if (!has_edge_) return false;
  attempt.begin(PoseRoute::kNewton, PoseOrigin::kBeyondEdge);
  if (settle(state = edge_.state, attempt)) return true;
  if (!attempt.off_on_the_way) attempt.off_on_the_way = edge_;
  return false;
}

/// The equilibrium off the known surfaces that was met, where there was no other: the pose says so
/// itself.
bool EquilibriumSolver::take_off_surfaces(EquilibriumState& state, Attempt& attempt) {
  if (!attempt.off) return false;
  state = attempt.off->state;
  attempt.found_by(attempt.off->trace);
  return newton_.solve(state, drive_).outcome == NewtonOutcome::kConverged;
}

bool EquilibriumSolver::starts_passed_through(Attempt& attempt) {
  for (std::size_t p = 0; p < passed_.size(); ++p) {
    const std::optional<double> depth = passed_[p].depth(state_.X);
    if (!depth) continue;
    attempt.passed_pair = static_cast<int>(p);
    attempt.depth = *depth;
    return true;
  }
  return false;
}

}  // namespace condyle
