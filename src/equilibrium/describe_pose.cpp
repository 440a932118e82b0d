#include "equilibrium/describe_pose.h"

#include "equilibrium/contact_scales.h"
#include "equilibrium/stability.h"

namespace condyle {
namespace {

void describe_elements(const Model& model,
                       const NewtonSystem& system,
                       const EquilibriumState& state,
                       PoseResult& result) {
  for (const LineElement& element : model.elements) {
    const LineElementState now = line_element_state(element, state.X);
    const double slack = slack_length(element.law);
    result.ligaments.push_back({now.length, slack > 0 ? now.length / slack - 1 : 0, now.force});
  }
  for (std::size_t i = 0; i < model.conditions.size(); ++i)
    result.conditions.push_back({system.conditions()[i].coordinate, state.sigma[i]});
}

ContactPointResult describe_point(const ContactLinearization& at,
                                  double force,
                                  double edge,
                                  double edge_margin) {
  ContactPointResult point;
  point.force = force;
  point.point_ground = at.B.c;
  point.point_moving = at.A.c;
  point.normal_ground = at.B.n;
  point.gap = at.gap();
  point.relative_curvature = at.relative_curvature;
  point.edge_distance = edge;
  point.on_edge = edge < edge_margin;
  return point;
}

void describe_closed(const Model& model,
                     const NewtonSystem& system,
                     const EquilibriumState& state,
                     double edge_margin,
                     PoseResult& result) {
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const ClosedContact& closed = state.contacts[k];
    ContactResult& contact = result.contacts[closed.pair];
    const double edge = edge_distance(model.pairs[closed.pair], closed.on_B, closed.on_A);
    contact.closed = true;
    contact.force += closed.p;
    contact.points.push_back(
        describe_point(system.contacts()[k], closed.p, edge, edge_margin));
    if (edge >= 0) continue;
    result.status = PoseStatus::kLeftPatch;
    result.reason = "contact \"" + model.pairs[closed.pair].name +
                    "\" lies beyond the known part of its surface";
  }
}

/// The nearest place of an open contact; one that is nowhere, or buried, lowers the status.
void describe_open(const ContactPair& pair,
                   const EquilibriumState& state,
                   ContactSearch& search,
                   double L,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   ContactResult& contact,
                   PoseResult& result) {
  search.find(state.X, kAnywhere * L, minima, kMerge * L);
  const bool watched = pair.mode == ContactMode::kAuto;
  if (minima.empty()) {
    if (!watched || !search.has_samples()) return;
    result.status = PoseStatus::kLeftPatch;
    result.reason =
        "contact \"" + pair.name + "\": no known parts of its surfaces face each other";
    return;
  }
  const GapMinimum& lowest = minima.front();
  if (watched && lowest.gap < -options.overlap * L / 30) {
    result.status = PoseStatus::kOverlap;
    result.reason = "contact \"" + pair.name + "\": one body is buried in the other";
  }
  const ContactLinearization at =
      linearize_contact(*pair.on_B, lowest.on_B, *pair.on_A, lowest.on_A, state.X);
  contact.points.push_back(describe_point(at, 0, lowest.edge, options.edge_margin));
}

}  // namespace

void clear(PoseResult& result) {
  result.ligaments.clear();
  result.conditions.clear();
  for (ContactResult& contact : result.contacts) {
    contact.points.clear();
    contact.closed = false;
    contact.shape = ContactShape::kPoint;
    contact.force = 0;
    contact.resultant_ground = ContactResult().resultant_ground;
  }
  result.status = PoseStatus::kNotComputed;
  result.reason.clear();
  result.remark.clear();
  result.joint = JointCoordinates();
  result.stability = -1;
  result.lowest_stiffness = PoseResult().lowest_stiffness;
  result.softest_motion.setZero();
  result.joint_stiffness.reset();
}

void describe_pose(const Model& model,
                   const NewtonSystem& system,
                   const EquilibriumState& state,
                   std::vector<ContactSearch>& searches,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   PoseResult& result) {
  result.X_BA = state.X;
  result.residual = system.out_of_balance();
  if (model.joint) result.joint = joint_coordinates(*model.joint, state.X);
  describe_elements(model, system, state, result);
  result.contacts.resize(model.pairs.size());
  describe_closed(model, system, state, options.edge_margin, result);
  for (std::size_t p = 0; p < model.pairs.size(); ++p)
    if (!result.contacts[p].closed)
      describe_open(model.pairs[p], state, searches[p], model.length, options, minima,
                    result.contacts[p], result);
  if (options.stability) {
    const Stability s = stability(model, system);
    result.lowest_stiffness = s.lowest_stiffness;
    result.softest_motion = s.motion;
    result.stability = s.lowest_stiffness > 0 ? 1 : 0;
  }
}

}  // namespace condyle
