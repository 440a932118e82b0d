#include "condyle/reference/wismans_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/math/decompositions.h"
#include "condyle/reference/wismans_system.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kConverged = 1e-13;  ///< of the largest relative error
constexpr double kSettled = 1e-10;    ///< below it an error that no longer falls is round-off
constexpr double kDiverged = 1e4;     ///< [mm]
constexpr int kWorkRow = 10;

/// What makes each equation a number without a unit: lengths over L, forces over their sum.
WismansVector row_scales(const WismansModel& model, double force) {
  const double L = model.length, F = std::max(force, 1e-3);
  WismansVector scale;
  for (int c = 0; c < 2; ++c) scale.segment<5>(5 * c) << 1 / L, 1 / L, 1 / L, 1, 1;
  scale.tail<6>() << 1 / F, 1 / F, 1 / F, 1 / (F * L), 1 / (F * L), 1 / (F * L);
  return scale;
}

WismansVector column_scales(const WismansModel& model, double force) {
  const double L = model.length, F = std::max(force, 1e-3);
  WismansVector scale = WismansVector::Constant(L);
  scale[wismans::kAdduction] = scale[wismans::kInternalRotation] = 1;
  scale.segment<2>(wismans::kForce).setConstant(F);
  scale[wismans::kMoment] = F * L;
  return scale;
}

/// The part of a step that keeps its translations, turns and slides within bounds.
double damping(const WismansVector& step, const WismansOptions& options) {
  const double longest =
      std::max(step.head<3>().cwiseAbs().maxCoeff(), step.segment<8>(5).cwiseAbs().maxCoeff());
  const double turn = step.segment<2>(wismans::kAdduction).cwiseAbs().maxCoeff();
  return std::min({1.0, options.longest_step / std::max(longest, 1e-300),
                   options.largest_turn / std::max(turn, 1e-300)});
}

double out_of_balance(const WismansModel& model, const WismansSystem& system) {
  return std::max(system.residual.segment<3>(kWorkRow).cwiseAbs().maxCoeff(),
                  system.residual.tail<3>().cwiseAbs().maxCoeff() / model.length);
}

/// The nearest pair of places of two surfaces, over grids on both.
void nearest_places(const WismansContact& contact,
                    const RigidTransform& X_BA,
                    Vector2d& at_B,
                    Vector2d& at_A) {
  constexpr double kGridSpacing = 1.5;  // [mm]
  double least = std::numeric_limits<double>::infinity();
  for (const Vector2d& at : grid_within(contact.on_A, kGridSpacing)) {
    const HeightPoint A = evaluate(contact.on_A, at);
    const Vector3d p = X_BA * A.c;
    const Vector2d below = coordinates_of(contact.on_B, p);
    if (distance_to_outline(contact.on_B, below) < 0) continue;
    const HeightPoint B = evaluate(contact.on_B, below);
    const double gap = B.n.dot(p - B.c);
    if (!(gap < least)) continue;
    least = gap;
    at_A = at;
    at_B = below;
  }
}

/// A pose is one of equilibrium between solids only where they face each other.
bool faces(const WismansModel& model, const WismansVector& unknowns) {
  const RigidTransform X = pose_of(model, unknowns);
  for (int c = 0; c < 2; ++c) {
    const WismansContact& contact = model.contacts[static_cast<std::size_t>(c)];
    const Vector3d n = evaluate(contact.on_B, unknowns.segment<2>(wismans::on_B(c))).n;
    const Vector3d m = X.R * evaluate(contact.on_A, unknowns.segment<2>(wismans::on_A(c))).n;
    if (n.dot(m) > 0) return false;
  }
  return true;
}

}  // namespace

WismansSolution solve(const WismansModel& model,
                      const WismansVector& start,
                      const WismansOptions& options) {
  WismansSolution solution;
  solution.unknowns = start;
  double before = std::numeric_limits<double>::infinity();
  for (;; ++solution.iterations) {
    const WismansSystem system = assemble(model, solution.unknowns);
    const WismansVector rows = row_scales(model, system.force_scale);
    const WismansVector columns = column_scales(model, system.force_scale);
    const WismansVector scaled = rows.cwiseProduct(system.residual);
    const double error = scaled.cwiseAbs().maxCoeff();
    solution.residual = out_of_balance(model, system);
    if (!std::isfinite(error) || solution.unknowns.head<3>().norm() > kDiverged) {
      solution.status = PoseStatus::kDiverged;
      return solution;
    }
    if (error < kConverged || (error < kSettled && error >= before)) {
      solution.status =
          faces(model, solution.unknowns) ? PoseStatus::kConverged : PoseStatus::kNoEquilibrium;
      return solution;
    }
    if (solution.iterations == options.max_iterations) {
      solution.status = PoseStatus::kIterationLimit;
      return solution;
    }
    before = error;
    const WismansMatrix J = rows.asDiagonal() * system.jacobian * columns.asDiagonal();
    const WismansVector step =
        -columns.cwiseProduct(WismansVector(partially_pivoted_solution(J, scaled)));
    if (!step.allFinite()) {
      solution.status = PoseStatus::kSingular;
      return solution;
    }
    solution.unknowns += damping(step, options) * step;
  }
}

WismansVector first_guess(const WismansModel& model, const RigidTransform& X_BA) {
  const JointCoordinates joint = joint_coordinates(model.joint, X_BA);
  WismansVector guess = WismansVector::Zero();
  guess.head<3>() = X_BA.p;
  guess[wismans::kAdduction] = joint.adduction;
  guess[wismans::kInternalRotation] = joint.internal_rotation;
  const RigidTransform X = pose_of(model, guess);  // with the flexion that is prescribed
  for (int c = 0; c < 2; ++c) {
    Vector2d at_B(0, 0), at_A(0, 0);
    nearest_places(model.contacts[static_cast<std::size_t>(c)], X, at_B, at_A);
    guess.segment<2>(wismans::on_B(c)) = at_B;
    guess.segment<2>(wismans::on_A(c)) = at_A;
  }
  // Forces and moment enter the equations of equilibrium linearly.
  const WismansSystem system = assemble(model, guess);
  const WismansVector rows = row_scales(model, system.force_scale);
  const Eigen::Matrix<double, 6, 3> A =
      rows.tail<6>().asDiagonal() * system.jacobian.block<6, 3>(kWorkRow, wismans::kForce);
  const Eigen::Matrix<double, 6, 1> b = rows.tail<6>().cwiseProduct(system.residual.tail<6>());
  guess.tail<3>() = -least_norm_solution(A, b).x;
  return guess;
}

}  // namespace condyle
