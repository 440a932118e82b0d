#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_covers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "condyle/contact/contact_scales.h"
#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/diagnosis.h"
#include "condyle/equilibrium/edge_in_words.h"
#include "condyle/equilibrium/second_equilibrium.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

/// Where the way from the last pose ended: what a failure is explained by.
struct Failed {
  EquilibriumState state;
  NewtonReport newton;
  DescentReport descent;
  std::string singular;  ///< why the matrix was, where it was
  ResidualHistory residuals;
};

bool same_state(const EquilibriumState& a, const EquilibriumState& b) {
  const auto same_contact = [](const ClosedContact& x, const ClosedContact& y) {
    return x.pair == y.pair && x.places == y.places && x.p == y.p;
  };
  return a.X.p == b.X.p && a.X.R == b.X.R && a.sigma == b.sigma && a.paths == b.paths &&
         std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    same_contact);
}

}  // namespace

EquilibriumSolver::EquilibriumSolver(std::shared_ptr<const Model> model,
                                     const ContactCovers& covers,
                                     EquilibriumOptions options)
    : model_(std::move(model)),
      covers_(covers),
      options_(options),
      searches_(make_searches(*model_, covers_)),
      rules_(*model_, searches_),
      newton_(*model_, options_.newton),
      descent_(*model_, searches_, newton_, options_.descent),
      predictor_(*model_) {
  for (std::size_t p = 0; p < model_->pairs.size(); ++p)
    passed_.emplace_back(model_->pairs[p], model_->length, searches_[p].deepest());
  state_.contacts.reserve(kMaxConstraints);
  minima_.reserve(kMinimaOfAPair);
  reset();
}

EquilibriumSolver::EquilibriumSolver(const std::shared_ptr<const Model>& model,
                                     EquilibriumOptions options)
    : EquilibriumSolver(model, cover_pairs(*model), options) {}

EquilibriumSolver::EquilibriumSolver(Model model, EquilibriumOptions options)
    : EquilibriumSolver(std::make_shared<const Model>(std::move(model)), options) {}

/// All but the searches.
void EquilibriumSolver::forget() {
  state_.X = model_->start;
  state_.contacts.clear();
  state_.sigma.assign(model_->conditions.size(), 0);
  state_.paths.clear();
  has_state_ = has_edge_ = on_the_way_ = from_elsewhere_ = false;
  spent_ = {};
  predictor_.clear();
  newton_.system().reset();
  for (PassedThrough& passed : passed_) passed.reset();
}

void EquilibriumSolver::reset() {
  forget();
  for (ContactSearch& search : searches_) search.reset();
}

void EquilibriumSolver::reset(const std::vector<ContactSearch>& searches) {
  if (searches.size() != searches_.size())
    throw std::invalid_argument("searches of another model, expected one for each pair");
  forget();
  for (std::size_t p = 0; p < searches_.size(); ++p) searches_[p].go_back(searches[p]);
}

void EquilibriumSolver::set_parameters(const Parameters& parameters) {
  newton_.system().set_parameters(parameters);
  predictor_.clear();
}

void EquilibriumSolver::set_state(const EquilibriumState& state, const Drive& drive) {
  check_state(state, *model_);
  check_drive(drive, *model_);
  if (has_state_ && drive == solved_ && same_state(state, state_)) return;
  predictor_.clear();
  state_ = state;
  solved_ = drive;
  has_state_ = true;
}

void EquilibriumSolver::go_back(const Standing& standing) {
  if (standing.has_state) {
    check_state(standing.state, *model_);
    check_drive(standing.solved, *model_);
  }
  predictor_.clear();
  state_ = standing.state;
  solved_ = standing.solved;
  has_state_ = standing.has_state;
}

void EquilibriumSolver::set_drive(const Drive& from, const Drive& to, double t) {
  const auto between = [t](double a, double b) { return t == 1 ? b : a + t * (b - a); };
  for (std::size_t i = 0; i < to.values.size(); ++i)
    drive_.values[i] = between(from.values[i], to.values[i]);
  for (std::size_t i = 0; i < to.scales.size(); ++i)
    drive_.scales[i] = between(from.scales[i], to.scales[i]);
}

/// The contact that lies farthest beyond the known part of a surface, and how far [mm]; -1 where
/// none does. A line lies at edges by its nature.
std::pair<int, double> EquilibriumSolver::farthest_beyond(const EquilibriumState& state) const {
  std::pair<int, double> farthest{-1, 0};
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& contact = state.contacts[k];
    const ContactPair& pair = model_->pairs[static_cast<std::size_t>(contact.pair)];
    const double beyond = -edge_distance(pair, contact.places);
    if (beyond <= farthest.second) continue;
    const Touch touch =
        examine_touch(pair, newton_.system().contacts()[k], contact.places, state.X, model_->length)
            .kind;
    if (touch != Touch::kLine) farthest = {static_cast<int>(k), beyond};
  }
  return farthest;
}

/// False where a contact lies beyond the known part of a surface, or the surfaces of an open pair
/// are not over each other, buried, or have passed through each other. Such an equilibrium is kept
/// in the attempt.
bool EquilibriumSolver::on_surfaces(const EquilibriumState& state, Attempt& attempt) {
  OffSurfaces off;
  std::tie(off.contact, off.beyond) = farthest_beyond(state);
  if (off.contact < 0) {
    if (faces(state, attempt)) return true;
    if (attempt.passed_pair >= 0) return false;  // no equilibrium to be told of
    off.beyond = OffSurfaces().beyond;
  }
  off.state = state;
  keep_off_surfaces(off, attempt);
  return false;
}

/// Of several the one least beyond an edge; on the way the first.
void EquilibriumSolver::keep_off_surfaces(const OffSurfaces& off, Attempt& attempt) const {
  std::optional<OffSurfaces>& kept = on_the_way_ ? attempt.off_on_the_way : attempt.off;
  if (kept && (on_the_way_ || off.beyond >= kept->beyond)) return;
  kept = off;
  kept->trace = attempt.trace;
  kept->trace.residuals = newton_.residuals();
}

/// An equilibrium whose only overlaps are at rims: a point at the edge of a known part has no normal
/// in common with the other surface, and cannot carry.
void EquilibriumSolver::note_rim(const EquilibriumState& state,
                                 const ContactChanges& rims,
                                 Attempt& attempt) const {
  if (rims.off_minimum || farthest_beyond(state).first >= 0) return;
  const ClosedContact& rim = rims.closes[rims.deepest];
  OffSurfaces off;
  off.state = state;
  off.beyond = rims.depth;
  off.rim = rim;
  keep_off_surfaces(off, attempt);
}

/// Are the surfaces of open pairs on their right sides?
bool EquilibriumSolver::faces(const EquilibriumState& state, Attempt& attempt) {
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_->pairs[p].mode != ContactMode::kAuto || !searches_[p].has_samples()) continue;
    const bool closed =
        std::any_of(state.contacts.begin(), state.contacts.end(),
                    [p](const ClosedContact& c) { return c.pair == static_cast<int>(p); });
    const std::optional<double> depth = closed ? passed_[p].depth_of_touching_pose(state.X)
                                               : passed_[p].depth_of_clear_pose(state.X);
    if (depth) {
      attempt.passed_pair = static_cast<int>(p);
      attempt.depth = *depth;
      return false;
    }
    if (closed) continue;
    ++attempt.trace.searches;
    if (look_at_open_pair(model_->pairs[p], searches_[p], state.X, model_->length, minima_) !=
        OpenPair::kClear)
      return false;
  }
  return true;
}

/// A force that is no number at a pose that still is one.
void EquilibriumSolver::note_overflow(const EquilibriumState& state, Attempt& attempt) {
  constexpr double kReasonable = 10;  // of L, from the pose before
  const bool at_a_pose = distance(*model_, state.X, state_.X) < kReasonable;
  if (at_a_pose && attempt.overflow.empty())
    attempt.overflow = overflowed(*model_, newton_.system(), state, drive_);
}

/// The rule of contact on a state that Newton has just solved.
const ContactChanges& EquilibriumSolver::changes(const EquilibriumState& state, Attempt& attempt) {
  const ContactChanges& changes = rules_.changes(linearization(newton_.system(), state, drive_));
  attempt.trace.searches += changes.searches;
  return changes;
}

bool EquilibriumSolver::is_admissible(const EquilibriumState& state, Attempt& attempt) {
  return changes(state, attempt).none_needed() && on_surfaces(state, attempt);
}

/// Is Newton's first solution one from where contacts have not settled before?
bool EquilibriumSolver::leads_nowhere(const RigidTransform& X, Attempt& attempt) const {
  constexpr double kSame = 1e-9;  // of L
  attempt.first_solution = X;
  return attempt.not_settled && distance(*model_, X, *attempt.not_settled) < kSame;
}

bool EquilibriumSolver::settle(EquilibriumState& state, Attempt& attempt) {
  constexpr int kRounds = 8;  // of changes of contact; real knees take one or two
  attempt.first_solution.reset();
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0 && !left(attempt).any()) return false;
    attempt.newton = newton_.solve(state, drive_);
    attempt.spent.iterations += attempt.newton.iterations;
    if (attempt.newton.outcome == NewtonOutcome::kZeroLength)
      attempt.zero_element = attempt.newton.zero_element;
    if (attempt.newton.outcome == NewtonOutcome::kDiverged) note_overflow(state, attempt);
    if (attempt.newton.outcome != NewtonOutcome::kConverged) return false;
    if (round == 0 && leads_nowhere(state.X, attempt)) return false;
    const ContactChanges& found = changes(state, attempt);
    if (found.too_many) return false;
    if (!found.any()) {
      attempt.trace.residuals = newton_.residuals();
      return found.none_needed() && on_surfaces(state, attempt);
    }
    if (found.rims) note_rim(state, found, attempt);
    found.apply(state);
    attempt.trace.openings += found.opens >= 0 || found.gives_way >= 0 ? 1 : 0;
    attempt.trace.closings += static_cast<int>(found.closes.size());
  }
  return false;
}

void EquilibriumSolver::solve(const Drive& drive, PoseResult& result, Patience patience) {
  const auto begin = std::chrono::steady_clock::now();
  check_drive(drive, *model_);
  drive_ = target_ = drive;
  Attempt attempt;
  attempt.points_before = looked_at();
  attempt.most = most(patience);
  newton_.bound_laws(newton_.system().potentials().looked_at() + attempt.most.points);
  from_elsewhere_ = false;
  bool solved = false, at_once = false;
  if (has_state_) {
    solved = solve_from_last(next_, attempt, patience);
  } else {
    state_.X.R = orthonormalized(state_.X.R);
    next_ = state_;
    at_once = starts_passed_through(attempt);
    solved = !at_once && solve_first(next_, target_, attempt);
  }
  std::optional<Failed> failed;
  if (!solved && patience >= Patience::kAll) {
    drive_ = target_;
    failed = {next_, attempt.newton, attempt.descent, {}, newton_.residuals()};
    if (attempt.newton.outcome == NewtonOutcome::kSingular)
      failed->singular = why_singular(newton_);
    if (!at_once) solved = solve_from_elsewhere(next_, attempt) || solve_from_edge(next_, attempt);
  }
  drive_ = target_;
  newton_.bound_laws(std::numeric_limits<long>::max());
  const bool off_surfaces = !solved && take_off_surfaces(next_, attempt);
  clear(result);
  result.iterations = attempt.spent.iterations;
  result.residual = attempt.newton.residual;
  if (!solved && !off_surfaces) attempt.begin(PoseRoute::kNone, PoseOrigin::kNone);
  if (!solved && !off_surfaces && failed) attempt.trace.residuals = failed->residuals;
  result.trace = attempt.trace;
  if (solved || off_surfaces) {
    describe(attempt, off_surfaces, result);
  } else if (failed) {
    attempt.newton = failed->newton;
    attempt.descent = failed->descent;
    explain_failure(*model_, newton_.system(), searches_, failed->state, drive_, attempt,
                    failed->singular, result);
  } else {
    result.status = PoseStatus::kIterationLimit;
  }
  spent_ = {attempt.spent.iterations, looked_at() - attempt.points_before};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void EquilibriumSolver::describe(const Attempt& attempt, bool off_surfaces, PoseResult& result) {
  result.status = PoseStatus::kConverged;
  describe_pose(linearization(newton_.system(), next_, drive_), searches_, options_.description,
                minima_, result);
  if (off_surfaces && attempt.off->rim && result.converged()) {
    result.status = PoseStatus::kLeftPatch;
    result.reason = rim_in_words(*model_, *attempt.off->rim, attempt.off->beyond);
  }
  if (result.status == PoseStatus::kLeftPatch && attempt.off) {
    edge_ = *attempt.off;
    has_edge_ = true;
  }
  if (result.converged()) {
    keep(next_);
    if (attempt.other)
      add_remark(result,
                 second_equilibrium(*model_, next_.X, *attempt.other, "from another start"));
  }
}

void EquilibriumSolver::keep(const EquilibriumState& state) {
  state_ = state;
  state_.X.R = orthonormalized(state.X.R);
  solved_ = target_;
  has_state_ = true;
  has_edge_ = false;
  predictor_.add(target_, state_);
}

Linearization EquilibriumSolver::linearized_solution() const {
  return linearization(newton_.system(), next_, target_);
}

PoseResult EquilibriumSolver::solve(const Drive& drive, Patience patience) {
  PoseResult result;
  solve(drive, result, patience);
  return result;
}

}  // namespace condyle
