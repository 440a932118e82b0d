#include "equilibrium/equilibrium_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "equilibrium/stability.h"
#include "math/rotation.h"

namespace condyle {
namespace {

constexpr double kSpacing = 0.04;  // of contact samples, in units of L (1.2 mm for a knee)
constexpr double kAnywhere = 1e3;  // how far an open contact is looked for, in units of L
constexpr double kMerge = 0.01;    // minima nearer than this are one contact, in units of L

std::vector<ContactSearch> make_searches(const Model& model) {
  std::vector<ContactSearch> searches;
  searches.reserve(model.pairs.size());
  for (const ContactPair& pair : model.pairs) searches.emplace_back(pair, kSpacing * model.length);
  return searches;
}

}  // namespace

EquilibriumSolver::EquilibriumSolver(Model model, EquilibriumOptions options)
    : model_(std::make_unique<Model>(std::move(model))),
      options_(options),
      searches_(make_searches(*model_)),
      newton_(*model_, options_.newton),
      descent_(*model_, searches_, newton_, options_.descent) {
  state_.contacts.reserve(kMaxConstraints);
  state_.sigma.assign(model_->conditions.size(), 0);
  state_.X = model_->start;
}

void EquilibriumSolver::set_state(const EquilibriumState& state) {
  state_ = state;
  solved_ = drive();
  has_state_ = true;
}

EquilibriumSolver::Drive EquilibriumSolver::drive() const {
  Drive drive;
  for (const KinematicCondition& condition : model_->conditions)
    drive.values.push_back(condition.value);
  for (const Load& load : model_->loads) drive.scales.push_back(load.scale);
  return drive;
}

void EquilibriumSolver::set_drive(const Drive& from, const Drive& to, double t) {
  const auto between = [t](double a, double b) { return t == 1 ? b : a + t * (b - a); };
  for (std::size_t i = 0; i < to.values.size(); ++i)
    model_->conditions[i].value = between(from.values[i], to.values[i]);
  for (std::size_t i = 0; i < to.scales.size(); ++i)
    model_->loads[i].scale = between(from.scales[i], to.scales[i]);
}

bool EquilibriumSolver::release_pulling(EquilibriumState& state) const {
  int worst = -1;
  double lowest = -1e-12 * newton_.system().force_scale();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& contact = state.contacts[k];
    if (model_->pairs[contact.pair].mode == ContactMode::kClosed || contact.p >= lowest) continue;
    worst = static_cast<int>(k);
    lowest = contact.p;
  }
  if (worst >= 0) state.contacts.erase(state.contacts.begin() + worst);
  return worst >= 0;
}

bool EquilibriumSolver::add_overlaps(EquilibriumState& state, bool& too_many) {
  bool added = false;
  const double L = model_->length;
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_->pairs[p].mode != ContactMode::kAuto) continue;
    searches_[p].find(state.X, 0.0, minima_, kMerge * L);
    for (const GapMinimum& minimum : minima_) {
      if (minimum.gap > -options_.overlap * L / 30) continue;
      const bool known =
          std::any_of(state.contacts.begin(), state.contacts.end(), [&](const ClosedContact& c) {
            return c.pair == static_cast<int>(p) &&
                   (model_->pairs[p].on_B->evaluate(c.on_B).c - minimum.point_B).norm() <
                       kMerge * L;
          });
      if (known && minimum.gap > -1e-3 * kMerge * L) continue;
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

/// Contacts that Newton may have led astray: to a place where the solids interpenetrate beside the
/// point, or far beyond the known part of a patch.
bool EquilibriumSolver::on_minima(const EquilibriumState& state) const {
  const std::vector<ContactLinearization>& contacts = newton_.system().contacts();
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& contact = state.contacts[k];
    const ContactPair& pair = model_->pairs[contact.pair];
    if (pair.mode == ContactMode::kAuto && contacts[k].relative_curvature[0] < -1e-7) return false;
    if (edge_distance(pair, contact.on_B, contact.on_A) < -0.1 * model_->length) return false;
  }
  return true;
}

bool EquilibriumSolver::carries_and_clear(EquilibriumState& state) {
  bool too_many = false;
  EquilibriumState copy = state;
  return on_minima(state) && !release_pulling(copy) && !add_overlaps(copy, too_many) && !too_many;
}

bool EquilibriumSolver::settle(EquilibriumState& state, Attempt& attempt) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    attempt.newton = newton_.solve(state);
    attempt.iterations += attempt.newton.iterations;
    if (attempt.newton.outcome != NewtonOutcome::kConverged) return false;
    if (release_pulling(state)) continue;
    bool too_many = false;
    if (add_overlaps(state, too_many)) continue;
    return !too_many && on_minima(state);
  }
  return false;
}

bool EquilibriumSolver::descend(EquilibriumState& state, Attempt& attempt) {
  attempt.descent =
      descent_.solve(state, [this](EquilibriumState& s) { return carries_and_clear(s); });
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
  if (!far) return descend(state, attempt);
  set_drive(own, own, 1);
  return descend(state, attempt) && advance(state, own, target, attempt);
}

PoseResult EquilibriumSolver::solve(bool patient) {
  const auto begin = std::chrono::steady_clock::now();
  const Drive target = drive();
  Attempt attempt;
  state_.X.R = orthonormalized(state_.X.R);
  EquilibriumState state = state_;
  bool solved = false;
  if (has_state_) {
    solved = settle(state, attempt);
    if (!solved) solved = descend(state = state_, attempt);
    if (!solved && patient) solved = advance(state = state_, solved_, target, attempt);
    set_drive(target, target, 1);
  } else {
    solved = solve_first(state, target, attempt);
    set_drive(target, target, 1);
    if (!solved) solved = descend(state = state_, attempt);
  }
  PoseResult result;
  result.iterations = attempt.iterations;
  result.residual = attempt.newton.residual;
  if (solved) {
    result.status = PoseStatus::kConverged;
    newton_.system().assemble(state);
    fill(result, state);
    judge(result);
    // Beyond the edge of a patch as well: the next pose may come back.
    if (result.status != PoseStatus::kOverlap) set_state(state);
  } else {
    explain_failure(result, attempt);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

void EquilibriumSolver::fill(PoseResult& result, const EquilibriumState& state) {
  const NewtonSystem& system = newton_.system();
  result.X_BA = state.X;
  result.residual = system.out_of_balance();
  if (model_->joint) result.joint = joint_coordinates(*model_->joint, state.X);
  for (const LineElement& element : model_->elements) {
    const LineElementState now = line_element_state(element, state.X);
    const double slack = slack_length(element.law);
    result.ligaments.push_back({now.length, slack > 0 ? now.length / slack - 1 : 0, now.force});
  }
  for (std::size_t i = 0; i < model_->conditions.size(); ++i)
    result.conditions.push_back({system.conditions()[i].coordinate, state.sigma[i]});
  fill_contacts(result, state);
  if (options_.stability) {
    result.lowest_stiffness = stability(*model_, system).lowest_stiffness;
    result.stability = result.lowest_stiffness > 0 ? 1 : 0;
  }
}

void EquilibriumSolver::fill_contacts(PoseResult& result, const EquilibriumState& state) {
  result.contacts.resize(model_->pairs.size());
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& closed = state.contacts[k];
    const ContactLinearization& at = newton_.system().contacts()[k];
    ContactResult& contact = result.contacts[closed.pair];
    ContactPointResult point;
    point.force = closed.p;
    point.point_ground = at.B.c;
    point.point_moving = at.A.c;
    point.normal_ground = at.B.n;
    point.gap = at.gap();
    point.relative_curvature = at.relative_curvature;
    point.edge_distance = edge_distance(model_->pairs[closed.pair], closed.on_B, closed.on_A);
    point.on_edge = point.edge_distance < options_.edge_margin;
    contact.closed = true;
    contact.force += closed.p;
    contact.points.push_back(point);
  }
  for (std::size_t p = 0; p < model_->pairs.size(); ++p) {
    ContactResult& contact = result.contacts[p];
    if (contact.closed) continue;
    searches_[p].find(state.X, kAnywhere * model_->length, minima_, kMerge * model_->length);
    if (minima_.empty()) {
      if (model_->pairs[p].mode == ContactMode::kAuto && searches_[p].has_samples()) {
        result.status = PoseStatus::kLeftPatch;
        result.reason = "contact \"" + model_->pairs[p].name +
                        "\": no known parts of its surfaces face each other";
      }
      continue;
    }
    const GapMinimum& lowest = minima_.front();
    if (lowest.gap < -options_.overlap * model_->length / 30 &&
        model_->pairs[p].mode == ContactMode::kAuto) {
      result.status = PoseStatus::kOverlap;
      result.reason = "contact \"" + model_->pairs[p].name + "\": one body is buried in the other";
    }
    const ContactPair& pair = model_->pairs[p];
    const ContactLinearization at =
        linearize_contact(*pair.on_B, lowest.on_B, *pair.on_A, lowest.on_A, state.X);
    ContactPointResult point;
    point.point_ground = at.B.c;
    point.point_moving = at.A.c;
    point.normal_ground = at.B.n;
    point.gap = at.gap();
    point.relative_curvature = at.relative_curvature;
    point.edge_distance = lowest.edge;
    point.on_edge = lowest.edge < options_.edge_margin;
    contact.points.push_back(point);
  }
}

void EquilibriumSolver::judge(PoseResult& result) const {
  for (std::size_t p = 0; p < result.contacts.size(); ++p) {
    if (!result.contacts[p].closed) continue;
    for (const ContactPointResult& point : result.contacts[p].points) {
      if (point.edge_distance >= 0) continue;
      result.status = PoseStatus::kLeftPatch;
      result.reason =
          "contact \"" + model_->pairs[p].name + "\" lies beyond the known part of its surface";
    }
  }
}

void EquilibriumSolver::explain_failure(PoseResult& result, const Attempt& attempt) const {
  const NewtonReport& newton = attempt.newton;
  if (model_->conditions.size() > kMaxConstraints) {
    result.status = PoseStatus::kSingular;
    result.reason = "more than six conditions: a body has six freedoms";
  } else if (attempt.descent.ran_away) {
    result.status = PoseStatus::kNoEquilibrium;
    result.reason = "the body runs away: nothing carries the load";
  } else if (newton.outcome == NewtonOutcome::kZeroLength) {
    result.status = PoseStatus::kZeroLength;
    result.reason =
        "line element \"" + model_->element_names[newton.zero_element] + "\" has no length";
  } else if (newton.outcome == NewtonOutcome::kSingular) {
    result.status = PoseStatus::kSingular;
    result.reason = "conditions and contacts depend on each other, or nothing resists a motion";
  } else if (newton.outcome == NewtonOutcome::kConverged) {
    result.status = PoseStatus::kOverlap;
    result.reason = "no set of contacts was found that carries without overlap or pull";
  } else if (newton.outcome == NewtonOutcome::kDiverged) {
    result.status = PoseStatus::kDiverged;
    result.reason = "Newton's method diverged";
  } else {
    result.status = PoseStatus::kIterationLimit;
    result.reason = "no equilibrium within the iteration limit; last step " +
                    std::to_string(attempt.descent.step) + " mm";
  }
}

}  // namespace condyle
