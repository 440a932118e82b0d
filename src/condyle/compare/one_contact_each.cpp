#include "condyle/compare/one_contact_each.h"

#include "condyle/elements/strain.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/describe_pose.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

ContactResult describe(const Model& model, const EquilibriumState& state, std::size_t index) {
  const ClosedContact& contact = state.contacts[index];
  const ContactPair& pair = model.pairs[static_cast<std::size_t>(contact.pair)];
  const ContactLinearization at =
      linearize_contact(*pair.on_B, contact.on_B, *pair.on_A, contact.on_A, state.X);
  ContactResult result;
  result.closed = true;
  result.points = {describe_point(at, contact.p, edge_distance(pair, contact.on_B, contact.on_A))};
  set_resultant(result);
  return result;
}

void describe(const Model& model,
              const EquilibriumState& state,
              const Drive& drive,
              PoseResult& pose) {
  pose.status = PoseStatus::kConverged;
  pose.X_BA = state.X;
  pose.joint = joint_coordinates(*model.joint, state.X);
  pose.contacts.resize(model.pairs.size());
  for (std::size_t c = 0; c < state.contacts.size(); ++c)
    pose.contacts[static_cast<std::size_t>(state.contacts[c].pair)] = describe(model, state, c);
  for (const LineElement& element : model.elements) {
    const LineElementState spring = line_element_state(element, state.X);
    pose.ligaments.push_back({spring.length, strain(element.law, spring.length), spring.force});
  }
  for (std::size_t k = 0; k < model.conditions.size(); ++k)
    pose.conditions.push_back({drive.values[k], state.sigma[k]});
  to_file_frames(model.origins, pose);
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
      if (report.outcome == NewtonOutcome::kConverged) describe(model, state, drive, pose);
    }
    result.poses.push_back(std::move(pose));
  }
  return result;
}

}  // namespace condyle
