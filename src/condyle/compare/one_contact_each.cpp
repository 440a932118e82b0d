#include "condyle/compare/one_contact_each.h"

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/linearization.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

void describe(const Linearization& at, PoseResult& pose) {
  pose.status = PoseStatus::kConverged;
  begin_pose(
      {at.state.X, &*at.model.joint, at.model.elements, at.state.paths, at.model.pairs.size()},
      pose);
  for (std::size_t c = 0; c < at.contacts().size(); ++c) {
    const ClosedContact& contact = at.state.contacts[c];
    add_closed_point(
        describe_point(at.contacts()[c], contact.p, edge_distance(at.pair(c), contact.places)),
        pose.contacts[static_cast<std::size_t>(contact.pair)]);
  }
  for (std::size_t k = 0; k < at.conditions().size(); ++k)
    pose.conditions.push_back({at.conditions()[k].coordinate, at.state.sigma[k]});
  to_file_frames(at.model.origins, pose);
}

/// So that Newton has something to solve.
void step_aside(EquilibriumState& state) {
  state.X.p += Eigen::Vector3d(0.05, -0.05, 0.05);                              // mm
  state.X.R = exp_rotation(Eigen::Vector3d(0.001, -0.001, 0.001)) * state.X.R;  // rad
  for (ClosedContact& contact : state.contacts) contact.p *= 0.98;
  for (double& sigma : state.sigma) sigma *= 0.98;
}

}  // namespace

SweepResult sweep_one_contact_each(const Scene& scene,
                                   const std::vector<FittedSurface>& surfaces,
                                   const SweepResult& reference) {
  const Model model = build_model(scene, surfaces);
  Newton newton(model);
  Drive drive = drive_of(model);
  double& swept = swept_of(*scene.sweep).in(drive);
  SweepResult result;
  for (const PoseResult& from : reference.poses) {
    PoseResult pose;
    pose.value = swept = from.value;
    if (from.converged() && can_restore(model, from)) {
      EquilibriumState state = restore_state(model, from);
      step_aside(state);
      const NewtonReport report = newton.solve(state, drive);
      pose.iterations = report.iterations;
      pose.residual = report.residual;
      if (report.outcome == NewtonOutcome::kConverged)
        describe(linearization(newton.system(), state, drive), pose);
    }
    result.poses.push_back(std::move(pose));
  }
  return result;
}

}  // namespace condyle
