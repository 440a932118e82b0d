#include "condyle/equilibrium/newton.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

// Steps longer than these ask for no more of contact laws and of paths, of L.
constexpr double kRoughly = 1e-5, kRoughPaths = 1e-3;
constexpr double kFreeStep =
    1e-3;  // longest step along a motion that nothing resists, in units of L

/// Forces in units of their sum or distances in units of L, whichever is greater.
double relative(const NewtonReport& report, double distance) {
  const double force = report.force_scale > 0 ? report.residual / report.force_scale : 0;
  const double error = std::max(force, distance);
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

/// NaN where either is, which std::max may drop.
double greater(double a, double b) { return a >= b ? a : b >= a ? b : a + b; }

}  // namespace

void check_state(const EquilibriumState& state, const Model& model) {
  if (state.sigma.size() != model.conditions.size())
    throw std::invalid_argument(
        fmt::format("the state has {} multipliers, expected {} as the model has conditions",
                    state.sigma.size(), model.conditions.size()));
  for (const ClosedContact& contact : state.contacts)
    if (static_cast<std::size_t>(contact.pair) >= model.pairs.size())
      throw std::invalid_argument(
          fmt::format("a contact of the state is of pair {}, expected one of the {} that the model "
                      "has",
                      contact.pair, model.pairs.size()));
}

NewtonSystem::NewtonSystem(const Model& model)
    : model_(model),
      parameters_(parameters_of(model)),
      elements_(parameters_.elements),
      potentials_(model.pairs) {
  contacts_.reserve(kMaxConstraints);
  conditions_.reserve(model.conditions.size());
}

void NewtonSystem::set_parameters(const Parameters& parameters) {
  check_parameters(parameters, model_);
  parameters_ = parameters;
  elements_.set(parameters_.elements);
}

bool NewtonSystem::assemble(const EquilibriumState& state,
                            const Drive& drive,
                            const Roughly& roughly) {
  check_state(state, model_);
  check_drive(drive, model_);
  X_ = state.X;
  wrench_ = Wrench();
  const LineElementBlock::Summary summary =
      elements_.add_to(state.X, state.paths, wrench_, roughly.paths);
  force_scale_ = summary.force_magnitudes;
  zero_element_ = summary.zero_element;
  const Eigen::Vector3d f_elements = wrench_.f, m_elements = wrench_.m;
  for (std::size_t i = 0; i < parameters_.loads.size(); ++i)
    add_load(parameters_.loads[i], drive.scales[i], state.X, wrench_);
  force_scale_ += (wrench_.f - f_elements).norm() + (wrench_.m - m_elements).norm() / model_.length;
  pull_ = force_scale_;
  if (!potentials_.empty())
    force_scale_ += roughly.laws ? potentials_.add_roughly_to(state.X, wrench_)
                                 : potentials_.add_to(state.X, wrench_);

  contacts_.clear();
  for (const ClosedContact& contact : state.contacts) {
    contacts_.push_back(linearize_contact(model_.pairs[contact.pair], contact.places, state.X));
    add_contact_force(contacts_.back(), contact.p, wrench_);
    force_scale_ += std::abs(contact.p);
  }

  conditions_.clear();
  for (std::size_t i = 0; i < model_.conditions.size(); ++i) {
    conditions_.push_back(evaluate(model_.conditions[i], drive.values[i], state.X));
    const ConditionDerivatives& k = conditions_.back();
    const double sigma = state.sigma[i];
    if (sigma == 0) continue;
    wrench_.f -= sigma * k.alpha;
    wrench_.m -= sigma * k.eta;
    wrench_.F1 -= sigma * k.D1;
    wrench_.F2 -= sigma * k.D2;
    wrench_.M1 -= sigma * k.D3;
    wrench_.M2 -= sigma * k.D4;
    force_scale_ += std::abs(sigma) / condition_weight(model_, i);
  }
  return zero_element_ < 0;
}

int NewtonSystem::fill(const EquilibriumState& state, SmallLu& matrix, double* right_side) const {
  const double L = model_.length;
  const int n = static_cast<int>(state.contacts.size()), m = static_cast<int>(conditions_.size());
  const int size = 6 + n + m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      matrix(i, j) = wrench_.F1(i, j);
      matrix(i, 3 + j) = wrench_.F2(i, j) / L;
      matrix(3 + i, j) = wrench_.M1(i, j) / L;
      matrix(3 + i, 3 + j) = wrench_.M2(i, j) / (L * L);
    }
    right_side[i] = -wrench_.f[i];
    right_side[3 + i] = -wrench_.m[i] / L;
  }
  for (int k = 6; k < size; ++k)
    for (int j = 6; j < size; ++j) matrix(k, j) = 0;
  for (int k = 0; k < n; ++k) {
    const ContactLinearization& contact = contacts_[k];
    for (int i = 0; i < 3; ++i) {
      matrix(i, 6 + k) = matrix(6 + k, i) = contact.B.n[i];
      matrix(3 + i, 6 + k) = matrix(6 + k, 3 + i) = contact.arm[i] / L;
    }
    right_side[6 + k] = -contact.gap();
  }
  for (int k = 0; k < m; ++k) {
    const ConditionDerivatives& condition = conditions_[k];
    const double w = condition_weight(model_, k);
    for (int i = 0; i < 3; ++i) {
      matrix(i, 6 + n + k) = -w * condition.alpha[i];
      matrix(3 + i, 6 + n + k) = -w * condition.eta[i] / L;
      matrix(6 + n + k, i) = w * condition.alpha[i];
      matrix(6 + n + k, 3 + i) = w * condition.eta[i] / L;
    }
    right_side[6 + n + k] = -w * condition.k;
  }
  return size;
}

void NewtonSystem::move(EquilibriumState& state, const double* step) const {
  const double L = model_.length;
  const Eigen::Vector3d da(step[0], step[1], step[2]);
  const Eigen::Vector3d dpi(step[3] / L, step[4] / L, step[5] / L);
  const std::size_t n = state.contacts.size();
  for (std::size_t k = 0; k < n; ++k) {
    ClosedContact& contact = state.contacts[k];
    slide_contact(model_.pairs[contact.pair], contact.places, contacts_[k], state.X, da, dpi, L);
    contact.p += step[6 + k];
  }
  for (std::size_t k = 0; k < state.sigma.size(); ++k)
    state.sigma[k] += condition_weight(model_, k) * step[6 + n + k];
  state.X.p += da;
  state.X.R = exp_rotation(dpi) * state.X.R;
  if (elements_.has_paths()) state.paths = elements_.paths();
}

bool NewtonSystem::revise(EquilibriumState& state) {
  bool changed = !potentials_.empty() && !potentials_.accept(state.X);
  if (elements_.has_paths()) {
    changed |= elements_.revise_paths(state.X);
    state.paths = elements_.paths();
  }
  return changed;
}

bool NewtonSystem::is_assembled_at(const EquilibriumState& state) const {
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison) bits are what is asked for
  return std::memcmp(X_.R.data(), state.X.R.data(), sizeof(double) * 9) == 0 &&
         // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
         std::memcmp(X_.p.data(), state.X.p.data(), sizeof(double) * 3) == 0 &&
         contacts_.size() == state.contacts.size();
}

double NewtonSystem::out_of_balance() const {
  return greater(wrench_.f.norm(), wrench_.m.norm() / model_.length);
}

double NewtonSystem::largest_distance() const {
  double largest = 0;
  for (const ContactLinearization& contact : contacts_) {
    largest = greater(largest, greater(contact.g.norm(), model_.length * contact.h.norm()));
  }
  for (std::size_t k = 0; k < conditions_.size(); ++k)
    largest = greater(largest, condition_weight(model_, k) * std::abs(conditions_[k].k));
  return largest;
}

double NewtonSystem::largest_gap() const {
  double largest = 0;
  for (const ContactLinearization& contact : contacts_)
    largest = std::max(largest, contact.g.norm());
  return largest;
}

Newton::Newton(const Model& model, NewtonOptions options)
    : model_(model), options_(options), system_(model) {}

NewtonReport Newton::solve(EquilibriumState& state, const Drive& drive) {
  system_.prepare(state.X);
  const NewtonReport report = iterate(state, drive);
  if (report.outcome != NewtonOutcome::kConverged) stopped_ = {state, drive};
  return report;
}

NewtonReport Newton::iterate(EquilibriumState& state, const Drive& drive) {
  NewtonReport report;
  residuals_.clear();
  const double L = model_.length;
  double last_step = INFINITY;
  double step[SmallLu::kMaxSize];
  if (6 + state.contacts.size() + state.sigma.size() > SmallLu::kMaxSize) {
    report.outcome = NewtonOutcome::kSingular;
    return report;
  }
  NewtonSystem::Roughly roughly{!system_.potentials().empty(), system_.has_paths()};
  for (;; ++report.iterations) {
    roughly.laws &= last_step > kRoughly * L;
    roughly.paths &= last_step > kRoughPaths * L;
    const bool has_directions = system_.assemble(state, drive, roughly);
    report.residual = system_.out_of_balance();
    report.gap = system_.largest_gap();
    report.force_scale = system_.force_scale();
    if (!has_directions) {
      report.outcome = NewtonOutcome::kZeroLength;
      report.zero_element = system_.zero_element();
      return report;
    }
    const double distance = system_.largest_distance();
    residuals_.add(relative(report, distance / L));
    if (!std::isfinite(report.residual) || !std::isfinite(distance)) {
      report.outcome = NewtonOutcome::kDiverged;
      return report;
    }
    // Round-off may keep a stiff model above the tolerance: then a step that no longer moves it is
    // as good.
    const double slack = last_step < 1e-12 * L ? 1e3 : 1;
    if (report.residual <= slack * options_.tolerance * report.force_scale &&
        distance <= slack * options_.tolerance * L) {
      if (roughly.laws || roughly.paths) {  // looked at more closely
        roughly = {false, false};
        --report.iterations;
        continue;
      }
      if (!system_.revise(state)) {
        report.outcome = NewtonOutcome::kConverged;
        return report;
      }
      if (is_exhausted(report)) return report;
      last_step = INFINITY;
      continue;
    }
    if (is_exhausted(report)) return report;

    const int size = system_.fill(state, matrix_, step);
    const bool free = !matrix_.factor(size);
    if (free && !factor_softened(state, step)) {
      report.outcome = NewtonOutcome::kSingular;
      return report;
    }
    matrix_.solve(step);
    double square = 0;
    for (int i = 0; i < 6; ++i) square += step[i] * step[i];
    last_step = std::sqrt(square);
    if (!(last_step < 1e6 * L)) {
      report.outcome = NewtonOutcome::kDiverged;
      return report;
    }
    if (free && last_step > kFreeStep * L) {
      report.outcome = NewtonOutcome::kSingular;
      return report;
    }
    if (last_step > options_.longest_step * L) {
      const double scale = options_.longest_step * L / last_step;
      for (int i = 0; i < 6; ++i) step[i] *= scale;
    }
    system_.move(state, step);
  }
}

bool Newton::is_exhausted(const NewtonReport& report) const {
  return report.iterations == options_.max_iterations ||
         (!system_.potentials().empty() && system_.potentials().looked_at() >= most_of_laws_);
}

/// A motion that nothing resists is held by next to nothing, in case nothing asks for it.
bool Newton::factor_softened(const EquilibriumState& state, double* step) {
  constexpr double kHold = 1e-9;
  const int size = system_.fill(state, matrix_, step);
  for (int i = 0; i < 6; ++i) matrix_(i, i) -= kHold * system_.force_scale() / model_.length;
  return matrix_.factor(size);
}

}  // namespace condyle
