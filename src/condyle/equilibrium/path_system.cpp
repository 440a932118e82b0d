#include "condyle/equilibrium/path_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/math/pose_step.h"

namespace condyle {
namespace {

constexpr int kMostIterations = 12;
constexpr double kTolerance = 1e-12;  // relative
constexpr double kFarthest = 0.3;     // a correction that leads farther [L] has lost the path

}  // namespace

PathSystem::PathSystem(const Model& model, const Swept& swept, const Drive& drive, double range)
    : model_(model), swept_(swept), drive_(drive), weight_(model.length / range), system_(model) {
  check_drive(drive_, model);
  (void)swept_.in(drive_);
}

bool PathSystem::assemble(const PathPoint& point) {
  swept_.in(drive_) = point.value;
  return system_.assemble(point.state, drive_);
}

/// Newton's matrix and the column of the swept value; the last row is left to the caller. Returns
/// the number of rows with it.
int PathSystem::fill(const PathPoint& point, double* right_side) {
  const int rows = system_.fill(point.state, matrix_, right_side);
  std::array<double, SmallLu::kMaxSize> column;
  fill_drive_column(linearization(point), swept_, column.data());
  for (int i = 0; i < rows; ++i) matrix_(i, rows) = column[static_cast<std::size_t>(i)];
  for (int j = 0; j <= rows; ++j) matrix_(rows, j) = 0;
  return rows + 1;
}

void PathSystem::apply(PathPoint& point, const double* step) const {
  system_.move(point.state, step);
  point.value += step[6 + point.state.contacts.size() + point.state.sigma.size()];
}

double PathSystem::product(const Direction& a, const Direction& b) const {
  double sum = weight_ * weight_ * a.value() * b.value();
  for (std::size_t i = 0; i < 6; ++i) sum += a.d[i] * b.d[i];
  return sum;
}

double PathSystem::distance(const PathPoint& a, const PathPoint& b) const {
  return std::hypot(distance_between(a.state.X, b.state.X, model_.length),
                    weight_ * (b.value - a.value));
}

double PathSystem::gap_rate(const ContactLinearization& contact, const Direction& direction) const {
  double rate = 0;
  for (int i = 0; i < 3; ++i)
    rate += contact.B.n[i] * direction.d[static_cast<std::size_t>(i)] +
            contact.arm[i] / model_.length * direction.d[static_cast<std::size_t>(i) + 3];
  return rate;
}

bool PathSystem::tangent(const PathPoint& at, Direction& tangent) {
  if (!assemble(at)) return false;
  // The last row fixes one component; one in which the path really moves makes the matrix regular.
  // The swept value comes first: elsewhere than near limit points it does move.
  bool found = false;
  for (int fixed = 6; fixed >= 0; --fixed) {
    Direction trial;
    trial.size = fill(at, trial.d.data());
    if (trial.size > SmallLu::kMaxSize) return false;
    const int last = trial.size - 1;
    trial.d.fill(0);
    trial.d[static_cast<std::size_t>(last)] = 1;
    matrix_(last, fixed == 6 ? last : fixed) = fixed == 6 ? weight_ : 1;
    if (!matrix_.factor(trial.size)) continue;
    matrix_.solve(trial.d.data());
    const double norm = std::sqrt(product(trial, trial));
    if (!std::isfinite(norm) || norm == 0) continue;
    for (double& d : trial.d) d /= norm;
    // A component that is small makes a poor anchor: go on with the larger ones.
    const double anchor =
        fixed == 6 ? weight_ * trial.value() : trial.d[static_cast<std::size_t>(fixed)];
    if (!found || std::abs(anchor) > 0.3) tangent = trial;
    found = true;
    if (std::abs(anchor) > 0.3) return true;
  }
  return found;
}

bool PathSystem::correct(PathPoint& point, const Direction& tangent, bool hold_value) {
  const double L = model_.length;
  double last_step = INFINITY, way = 0;
  std::array<double, SmallLu::kMaxSize> step{};
  system_.prepare(point.state.X);
  for (int iteration = 0;; ++iteration) {
    if (!assemble(point)) return false;
    const double residual = system_.out_of_balance(), distance = system_.largest_distance();
    if (!std::isfinite(residual) || !std::isfinite(distance)) return false;
    const double slack = last_step < kTolerance * L ? 1e3 : 1;
    if (residual <= slack * kTolerance * system_.force_scale() &&
        distance <= slack * kTolerance * L) {
      if (!system_.revise(point.state)) return true;
      last_step = INFINITY;
      if (iteration == kMostIterations) return false;
      continue;
    }
    if (iteration == kMostIterations) return false;
    const int size = fill(point, step.data()), last = size - 1;
    step[static_cast<std::size_t>(last)] = 0;
    matrix_(last, last) = hold_value ? weight_ : weight_ * weight_ * tangent.value();
    for (int i = 0; i < 6 && !hold_value; ++i)
      matrix_(last, i) = tangent.d[static_cast<std::size_t>(i)];
    if (!matrix_.factor(size)) return false;
    matrix_.solve(step.data());
    last_step = std::sqrt(std::inner_product(step.begin(), step.begin() + 6, step.begin(), 0.0));
    way += last_step;
    if (!(way < kFarthest * L)) return false;
    apply(point, step.data());
  }
}

PathPoint PathSystem::ahead(const PathPoint& from, const Direction& direction, double length) {
  assemble(from);
  PathPoint point = from;
  Direction step = direction;
  for (double& d : step.d) d *= length;
  apply(point, step.d.data());
  return point;
}

}  // namespace condyle
