#include "condyle/equilibrium/descent.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/math/pose_step.h"

namespace condyle {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr int kFewSteps = 10;  // by then most descents have come near enough for Newton
// Constraints: more than a knee has at once.
constexpr std::size_t kMemorySize = 24;  // material points
constexpr std::size_t kMostMinima = 12;  // of one pair

// Lengths [L].
constexpr double kNewtonReach = 0.05;  // a shorter step is worth an attempt of Newton
constexpr double kLeastReach = 1e-4;   // of a step: below, nothing more is gained
constexpr double kAtRest = 1e-6;       // nor where the programme asks for no more than this
constexpr double kFarAway = 50;        // from the start: nothing carries the load
constexpr double kHeldWithin = 20;     // a contact that is held closed is looked for
constexpr double kSameRefused = 1e-6;  // two equilibria that were refused are one,
constexpr double kThere = 0.01;        // and the descent has come to it
constexpr double kLongestFree = 10;    // step where nothing is near

// Of the length of the pair (ContactSearch::length).
constexpr double kSameMinimum = 0.003;  // minima nearer than this are one constraint
constexpr double kSamePoint = 0.01;     // a material point beside a minimum says nothing new,
constexpr double kPointsApart = 0.02;   // nor one so near to another
constexpr double kNearPoint = 0.02;     // a minimum with a smaller gap becomes a material point

// Of a trust region [Nocedal and Wright 2006, ch. 4, 18.5].
constexpr double kGrow = 2;           // of the reach after a step that gained,
constexpr double kShrink = 0.35;      // and after one that did not
constexpr double kAnew = 0.1;         // of the longest step, without the material points
constexpr double kLookAhead = 2;      // reaches within which gaps may close in the next step
constexpr double kFirstFloor = 1e-2;  // stiffness that shortens a step, of the greatest,
constexpr double kStiffer = 4;        // and so much more at each try,
constexpr int kMostStiffer = 12;      // at most, until
constexpr double kFits = 1.1;         // a step fits the reach as nearly as this

// Of the l1 merit [Nocedal and Wright 2006, 15.4].
constexpr double kOverMultiplier = 1.5;  // penalty over the greatest multiplier: above 1 the merit
                                         // has its minimum where the programme has
constexpr double kForget = 0.9;          // of the penalty, in each step
constexpr double kLeastPenalty = 0.1;    // multiplier of a body that nothing presses yet [forces]
constexpr double kRoundOff = 1e-10;      // of the forces' work over a step
constexpr double kRestores = 0.9;        // of the violation: a step that leaves less restores it,
constexpr double kCostlier = 2;          // and is judged by so many times the penalty
constexpr double kLongestSecond = 2;     // second-order correction, of the step [15.6]

constexpr int kPatience = 2;       // iterations between attempts of Newton
constexpr double kCarries = 1e-9;  // multiplier of a contact that carries, of the greatest

}  // namespace

Descent::Descent(const Model& model,
                 std::vector<ContactSearch>& searches,
                 Newton& newton,
                 DescentOptions options)
    : model_(model), searches_(searches), newton_(newton), options_(options) {}

DescentReport Descent::solve(EquilibriumState& state,
                             const Drive& drive,
                             const Accept& accept,
                             const GoesOn& goes_on,
                             const Work& most) {
  check_drive(drive, model_);
  drive_ = &drive;
  DescentReport report;
  const Eigen::Vector3d origin = state.X.p;
  paths_ = paths_from_ = paths_to_ = state.paths;
  const auto looked_at = [&] { return points_until_now(searches_, newton_.system().potentials()); };
  const long before = looked_at();
  start(state.X);
  bool asked = false;
  // Attempts of Newton's method within count as well.
  while (report.steps < options_.max_steps && report.iterations < 2 * options_.max_steps &&
         most.after({report.iterations, looked_at() - before}).any()) {
    const bool few = report.steps < kFewSteps && report.iterations < 2 * kFewSteps;
    if (!few && !std::exchange(asked, true) && !goes_on()) break;
    if (!iterate(accept, report)) break;
    report.ran_away = (X_.p - origin).norm() > kFarAway * model_.length;
    if (report.ran_away) break;
  }
  report.searches = searches_made_;
  state.X = X_;
  if (report.converged) state = result_;
  return report;
}

void Descent::start(const RigidTransform& X) {
  X_ = X;
  newton_.system().prepare(X);
  memory_.clear();
  reach_ = options_.longest_step * model_.length;
  penalty_ = 0;
  patience_ = 0;
  searches_made_ = 0;
  has_forgotten_ = false;
  refused_.reset();
  gather(X_, constraints_);
}

/// Material points that are kept too long spoil the convergence: once more without them.
bool Descent::start_anew() {
  if (has_forgotten_ || memory_.empty()) return false;
  has_forgotten_ = true;
  memory_.clear();
  gather(X_, constraints_);
  reach_ = kAnew * options_.longest_step * model_.length;
  return true;
}

/// One quadratic programme and its step; false when there is nothing more to gain.
bool Descent::iterate(const Accept& accept, DescentReport& report) {
  ++report.steps;
  ++report.iterations;
  const double L = model_.length;
  Programme programme;
  set_forces(programme);
  set_rows(programme);
  SmallQpSolution solution = solve_qp(programme.qp);
  if (add_contact_curvature(programme, solution)) solution = solve_qp(programme.qp);
  if (!solution.x.allFinite()) return false;
  const Multipliers forces = multipliers(programme, solution);

  const double full = solution.x.norm();
  const bool settled = full < kNewtonReach * L && patience_-- <= 0;
  if (settled || reach_ < kLeastReach * L) {
    if (try_newton(forces, constraints_, accept, report)) return false;
    patience_ = kPatience;
    if (full < kAtRest * L) return false;
  }
  if (reach_ < kLeastReach * L) return start_anew();
  const Vector6 step = full > reach_ ? step_within_reach(programme) : solution.x;
  penalty_ =
      std::max(kForget * penalty_,
               kOverMultiplier * std::max(forces.largest, kLeastPenalty * programme.force_scale));
  remember(constraints_);
  take_step(programme, step, report);
  return true;
}

/// The programme for a step no longer than the reach: conditions and gaps are asked to close no
/// farther than that, and the stiffness is raised until the step fits [Levenberg].
Descent::Vector6 Descent::step_within_reach(Programme& programme) const {
  SmallQp& qp = programme.qp;
  if (qp.b.norm() > reach_) qp.b *= reach_ / qp.b.norm();
  qp.d = qp.d.cwiseMin(reach_);
  Vector6 step = solve_qp(qp).x;
  qp.floor = std::max(qp.floor, kFirstFloor * programme.stiffness_scale);
  for (int k = 0; k < kMostStiffer && step.norm() > kFits * reach_; ++k) {
    qp.floor *= kStiffer;
    step = solve_qp(qp).x;
  }
  if (step.norm() > reach_) step *= reach_ / step.norm();
  return step;
}

Descent::Constraint Descent::constrain(int pair,
                                       const ContactPlaces& places,
                                       const RigidTransform& X) const {
  const SurfacePoint B = model_.pairs[pair].on_B->evaluate(places.on_B);
  const Eigen::Vector3d s = X.R * model_.pairs[pair].on_A->evaluate(places.on_A).c;
  Constraint constraint{pair, places, B.n.dot(X.p + s - B.c), Vector6(), false, false};
  constraint.row << B.n, s.cross(B.n) / model_.length;
  return constraint;
}

/// What the next step must not pass through. It is at most as long as the reach may grow, which it
/// does beyond the longest step only where nothing is near.
void Descent::gather(const RigidTransform& X, std::vector<Constraint>& constraints) {
  const double L = model_.length, grown = kGrow * reach_, longest = options_.longest_step * L;
  const double ahead = kLookAhead * std::max(kNewtonReach * L, grown);
  if (reach_ <= longest && longest < grown) {
    gather_within(kLookAhead * longest, X, constraints);
    if (!constraints.empty()) return;
  }
  gather_within(ahead, X, constraints);
}

void Descent::gather_within(double ahead,
                            const RigidTransform& X,
                            std::vector<Constraint>& constraints) {
  constraints.clear();
  const double L = model_.length;
  for (int p = 0; p < static_cast<int>(model_.pairs.size()); ++p) {
    const ContactMode mode = model_.pairs[p].mode;
    if (mode == ContactMode::kOpen) continue;
    const bool held = mode == ContactMode::kClosed;
    const double same = kSameMinimum * searches_[p].length(L);
    if (held)
      searches_[p].find_nearest(X, kHeldWithin * L, minima_, same);
    else
      searches_[p].find(X, ahead, minima_, same);
    ++searches_made_;
    minima_.resize(std::min(minima_.size(), kMostMinima));
    const std::size_t first = constraints.size();
    for (const GapMinimum& minimum : minima_) {  // the lowest first
      if (held && constraints.size() > first && !minimum.refined) continue;
      constraints.push_back(constrain(p, minimum.places, X));
      constraints.back().refined = minimum.refined;
      constraints.back().bilateral = held && constraints.size() == first + 1;
    }
    if (!held) add_memory(p, first, X, constraints);
  }
}

void Descent::add_memory(int pair,
                         std::size_t first,
                         const RigidTransform& X,
                         std::vector<Constraint>& constraints) {
  const Surface& on_A = *model_.pairs[pair].on_A;
  const Surface& on_B = *model_.pairs[pair].on_B;
  const double same = kSamePoint * searches_[pair].length(model_.length);
  for (const auto& [owner, place] : memory_) {
    if (owner != pair) continue;
    const Eigen::Vector3d point = X * on_A.evaluate(place).c;
    const Place opposite = on_B.closest(point, on_B.seed(point));
    if (on_B.edge_distance(opposite) < 0) continue;
    const bool isolated =
        std::all_of(constraints.begin() + static_cast<std::ptrdiff_t>(first), constraints.end(),
                    [&](const Constraint& c) {
                      return (X * on_A.evaluate(c.places.on_A).c - point).norm() > same;
                    });
    const Constraint constraint = constrain(pair, {opposite, place}, X);
    if (isolated && constraint.gap < kLookAhead * options_.longest_step * model_.length) {
      constraints.push_back(constraint);
    }
  }
}

void Descent::remember(const std::vector<Constraint>& constraints) {
  for (const Constraint& constraint : constraints) {
    const bool held = model_.pairs[constraint.pair].mode == ContactMode::kClosed;
    const double length = searches_[constraint.pair].length(model_.length);
    if (held || !constraint.refined || constraint.gap > kNearPoint * length) continue;
    const Surface& on_A = *model_.pairs[constraint.pair].on_A;
    const Eigen::Vector3d c = on_A.evaluate(constraint.places.on_A).c;
    const bool known = std::any_of(memory_.begin(), memory_.end(), [&](const auto& entry) {
      return entry.first == constraint.pair &&
             (on_A.evaluate(entry.second).c - c).norm() < kPointsApart * length;
    });
    if (known) continue;
    if (memory_.size() == kMemorySize) memory_.erase(memory_.begin());
    memory_.emplace_back(constraint.pair, constraint.places.on_A);
  }
}

double Descent::violation(const std::vector<Constraint>& constraints,
                          const RigidTransform& X) const {
  double sum = 0;
  for (const Constraint& constraint : constraints)
    sum += constraint.bilateral ? std::abs(constraint.gap) : std::max(0.0, -constraint.gap);
  for (std::size_t i = 0; i < model_.conditions.size(); ++i)
    sum += condition_weight(model_, i) * std::abs(condition(i, X).k);
  return sum;
}

double Descent::energy_change(const RigidTransform& from, const RigidTransform& to) {
  double change = 0;
  const std::vector<LineElement>& elements = parameters().elements;
  KeptPaths at_from(elements, paths_from_), at_to(elements, paths_to_);
  for (const LineElement& element : elements)
    change += line_element_state(element, to, at_to.of(element)).energy -
              line_element_state(element, from, at_from.of(element)).energy;
  ContactPotentials& potentials = newton_.system().potentials();
  if (!potentials.empty()) change += potentials.energy(to) - potentials.energy(from);
  Wrench before, after;
  for (std::size_t i = 0; i < parameters().loads.size(); ++i) {
    add_load(parameters().loads[i], drive_->scales[i], from, before);
    add_load(parameters().loads[i], drive_->scales[i], to, after);
  }
  const Vector6 mean =
      0.5 * (scaled_wrench(before, model_.length) + scaled_wrench(after, model_.length));
  return change - mean.dot(step_between(from, to, model_.length));
}

/// Second-order correction: the same programme with the rows and gaps found at the end of the step.
Vector6 Descent::corrected_step(const Programme& programme,
                                const Vector6& step,
                                const RigidTransform& to,
                                const std::vector<Constraint>& there) const {
  SmallQp qp = programme.qp;
  for (std::size_t i = 0; i < model_.conditions.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    qp.b[row] = qp.C.row(row).dot(step) - condition_weight(model_, i) * condition(i, to).k;
  }
  qp.A.resize(static_cast<Eigen::Index>(there.size()), 6);
  qp.d.resize(qp.A.rows());
  for (std::size_t k = 0; k < there.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    qp.A.row(row) = there[k].row.transpose();
    qp.d[row] = there[k].row.dot(step) - there[k].gap;
  }
  return solve_qp(qp).x;
}

/// Goes where the merit falls: the step itself, or with a second-order correction; else the reach
/// shrinks.
void Descent::take_step(const Programme& programme, const Vector6& step, DescentReport& report) {
  const double L = model_.length;
  const double violation_before = violation(constraints_, X_);
  double energy = 0, violation_after = 0;
  const auto improves = [&](const RigidTransform& to, double tolerance) {
    gather(to, trial_);
    energy = energy_change(X_, to);
    violation_after = violation(trial_, to);
    return energy + penalty_ * (violation_after - violation_before) < tolerance;
  };
  const auto accept = [&](const RigidTransform& to, double length) {
    X_ = to;
    constraints_.swap(trial_);
    report.step = length;
    // Where nothing is near, nothing limits the next step but patience; a soft contact may be, and
    // is no constraint.
    const bool free = constraints_.empty() && newton_.system().potentials().empty();
    reach_ = std::min(kGrow * reach_, (free ? kLongestFree : options_.longest_step) * L);
  };
  const RigidTransform to = moved_by(X_, step, L);
  if (improves(to, kRoundOff * programme.force_scale * step.norm())) return accept(to, step.norm());
  // Restoring the constraints may cost more energy than the forces of this moment suggest.
  if (violation_after < kRestores * violation_before) {
    penalty_ *= kCostlier;
    if (energy + penalty_ * (violation_after - violation_before) < 0)
      return accept(to, step.norm());
  }
  const Vector6 second = corrected_step(programme, step, to, trial_);
  if (second.allFinite() && second.norm() < kLongestSecond * step.norm()) {
    const RigidTransform corrected = moved_by(X_, second, L);
    if (improves(corrected, 0)) return accept(corrected, second.norm());
  }
  reach_ = kShrink * std::min(reach_, step.norm());
}

/// True where there is nothing more to gain.
bool Descent::try_newton(const Multipliers& multipliers,
                         const std::vector<Constraint>& constraints,
                         const Accept& accept,
                         DescentReport& report) {
  EquilibriumState trial;
  trial.X = X_;
  trial.sigma = multipliers.sigma;
  trial.paths = paths_;
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    if (!constraints[k].bilateral && multipliers.p[k] <= kCarries * multipliers.largest) continue;
    trial.contacts.push_back({constraints[k].pair, constraints[k].places, multipliers.p[k]});
  }
  if (trial.sigma.size() > kMaxConstraints) return false;
  if (trial.contacts.size() > kMaxConstraints - trial.sigma.size()) {  // the strongest ones
    std::sort(trial.contacts.begin(), trial.contacts.end(),
              [](const ClosedContact& a, const ClosedContact& b) { return a.p > b.p; });
    trial.contacts.resize(kMaxConstraints - trial.sigma.size());
  }
  report.newton = newton_.solve(trial, *drive_);
  report.iterations += report.newton.iterations;
  report.converged = report.newton.outcome == NewtonOutcome::kConverged && accept(trial);
  if (report.converged) result_ = trial;
  const bool refused = !report.converged && report.newton.outcome == NewtonOutcome::kConverged;
  return report.converged || (refused && stays_refused(trial.X));
}

/// Does Newton come to an equilibrium once more that was not accepted, from as good as there?
bool Descent::stays_refused(const RigidTransform& found) {
  const double L = model_.length;
  const bool again = refused_ && step_between(*refused_, found, L).norm() < kSameRefused * L;
  refused_ = found;
  return again && step_between(X_, found, L).norm() < kThere * L;
}

}  // namespace condyle
