#include "condyle/equilibrium/describe_pose.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/contact/contact_scales.h"
#include "condyle/contact/hertz.h"
#include "condyle/equilibrium/admissible_motions.h"
#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/edge_in_words.h"
#include "condyle/equilibrium/joint_stiffness.h"
#include "condyle/equilibrium/motion_name.h"
#include "condyle/equilibrium/second_equilibrium.h"
#include "condyle/equilibrium/stability.h"

namespace condyle {
namespace {

std::optional<HertzEstimate> estimate_pressure(const ContactPair& pair,
                                               const ContactLinearization& at,
                                               double force,
                                               const Eigen::Matrix3d& R_BA) {
  const std::optional<ElasticContact> elastic =
      elastic_contact(force, at.relative_curvature, pair.elastic_B, pair.elastic_A);
  if (!elastic) return std::nullopt;
  return HertzEstimate{{elastic->semi_major, elastic->semi_minor},
                       direction_of_least_curvature(at, R_BA),
                       elastic->peak_pressure,
                       elastic->approach};
}

/// Whichever contact comes first, the same objection stays: an equilibrium beyond an edge is the least, of others that
/// whose status has the lowest value.
void set_status(PoseResult& result, const Objection& objection) {
  const auto rank = [](PoseStatus status) {
    return status == PoseStatus::kConverged ? 0 : status == PoseStatus::kLeftPatch ? 1 : 2;
  };
  if (rank(objection.status) < rank(result.status) ||
      (rank(objection.status) == rank(result.status) && objection.status >= result.status))
    return;
  result.status = objection.status;
  result.reason = objection.reason;
}

/// A line carries at its ends, whichever two of its points were solved for: the lever rule shares
/// out their resultant. The points of a line are the last ones of the contact.
void carry_by_ends(const ContactPair& pair,
                   const RigidTransform& X_BA,
                   const TouchReport& touch,
                   PoseResult& result,
                   ContactResult& contact) {
  constexpr double kPull = -1e-9;  // of the force: round-off
  const double force = contact.force;
  const std::array<GapMinimum, 2>& ends = touch.ends;
  const Eigen::Vector3d way = ends[1].point_B - ends[0].point_B;
  if (!(way.squaredNorm() > 0)) return;  // no longer than a point
  const double share = way.dot(contact.resultant_ground - ends[0].point_B) / way.squaredNorm();
  contact.points.clear();
  for (const std::size_t k : {0, 1}) {
    const ContactLinearization at = linearize_contact(pair, ends[k].places, X_BA);
    add_closed_point(describe_point(at, force * (k == 0 ? 1 - share : share), ends[k].edge),
                     contact);
    contact.points.back().on_edge = ends[k].edge < 0;
  }
  if (pair.mode == ContactMode::kAuto && std::min(share, 1 - share) < kPull)
    set_status(result, tips_over(pair.name));
}

/// Does something else keep the bodies from turning out of the line that contact k lies on? Then its one point may lie
/// anywhere along it. Else the balance of moments says where its force acts.
bool is_held_parallel(const Linearization& at, std::size_t k, const TouchReport& touch) {
  constexpr double kHeld = 1e-6;  // of the turn that is left
  const ContactLinearization& contact = at.contacts()[k];
  const auto way = [&](const GapMinimum& end) { return (end.point_B - contact.B.c).norm(); };
  const GapMinimum& far = touch.ends[way(touch.ends[0]) < way(touch.ends[1]) ? 1 : 0];
  const Eigen::Vector3d turn = (far.point_B - contact.B.c).cross(contact.B.n);
  if (!(turn.norm() > 0)) return false;
  Eigen::Matrix<double, 6, 1> apart = Eigen::Matrix<double, 6, 1>::Zero();
  apart.tail<3>() = turn.normalized();
  return (admissible_motions(at).transpose() * apart).norm() < kHeld;
}

TouchReport touch_of(const Linearization& at, std::size_t k) {
  const ClosedContact& closed = at.state.contacts[k];
  return examine_touch(at.pair(k), at.contacts()[k], closed.places, at.state.X, at.model.length);
}

void describe_closed_point(const Linearization& pose,
                           std::size_t k,
                           double edge_margin,
                           PoseResult& result) {
  const ClosedContact& closed = pose.state.contacts[k];
  const ContactPair& pair = pose.pair(k);
  const ContactLinearization& at = pose.contacts()[k];
  const double edge = edge_distance(pair, closed.places);
  const Touch touch = touch_of(pose, k).kind;
  ContactResult& contact = result.contacts[static_cast<std::size_t>(closed.pair)];
  // A line lies at edges by its nature.
  add_closed_point(describe_point(at, closed.p, edge), contact);
  contact.points.back().on_edge = edge < (touch == Touch::kLine ? 0 : edge_margin);
  contact.points.back().hertz = estimate_pressure(pair, at, closed.p, pose.state.X.R);
  if (touch == Touch::kLine) contact.shape = ContactShape::kLine;
  if (touch == Touch::kConforming) contact.shape = ContactShape::kConforming;
  if (const std::optional<Objection> reason = objection(touch, pair.name)) {
    set_status(result, *reason);
  } else if (edge < 0 && touch != Touch::kLine) {
    set_status(result, {PoseStatus::kLeftPatch, edge_in_words(pose.model, closed)});
  }
}

void describe_closed(const Linearization& at, double edge_margin, PoseResult& result) {
  for (std::size_t k = 0; k < at.state.contacts.size(); ++k)
    describe_closed_point(at, k, edge_margin, result);
  for (std::size_t k = 0; k < at.state.contacts.size(); ++k) {
    ContactResult& contact = result.contacts[static_cast<std::size_t>(at.state.contacts[k].pair)];
    if (contact.shape != ContactShape::kLine || contact.points.size() > 2) continue;
    const TouchReport touch = touch_of(at, k);
    if (touch.kind != Touch::kLine) continue;
    if (contact.points.size() == 1 && is_held_parallel(at, k, touch))
      set_status(result, held_parallel(at.pair(k).name));
    else
      carry_by_ends(at.pair(k), at.state.X, touch, result, contact);
  }
}

/// Of a contact whose surfaces bend nearly alike in some direction: it lies where errors of a
/// hundredth of a millimetre put it, √(2δ/κ) aside.
std::string nearly_conforming(const ContactPair& pair,
                              const ContactLinearization& at,
                              const Eigen::Matrix3d& R_BA) {
  constexpr double kAlike = 0.05;      // of the curvature of either surface
  constexpr double kDeviation = 0.01;  // [mm]
  const double least = at.relative_curvature[0];
  if (!(least > 0) || least > kAlike * std::max(at.B.K.norm(), at.A.K.norm())) return {};
  const Eigen::Vector3d e = direction_of_least_curvature(at, R_BA), e_A = R_BA.transpose() * e;
  if (least > kAlike * std::max(std::abs(e.dot(at.B.K * e)), std::abs(e_A.dot(at.A.K * e_A))))
    return {};
  return fmt::format(
      "contact {} nearly conforms: relative curvature {:.2g} 1/mm, {:g} mm on either surface move "
      "it by {:.1f} mm",
      quoted(pair.name), least, kDeviation, std::sqrt(2 * kDeviation / least));
}

/// The nearest place of an open contact; one that is nowhere, or buried, or that should be held closed, lowers the
/// status. One with a law of its own that touches there is closed, and carries nothing yet.
void describe_open(const ContactPair& pair,
                   const EquilibriumState& state,
                   ContactSearch& search,
                   double L,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   ContactResult& contact,
                   PoseResult& result) {
  const OpenPair lies = look_at_open_pair(pair, search, state.X, L, minima);
  const bool watched = pair.mode != ContactMode::kOpen || pair.law;
  if (lies == OpenPair::kApart) {
    if (!watched || !search.has_samples()) return;
    return set_status(
        result, {PoseStatus::kLeftPatch,
                 "contact \"" + pair.name + "\": no known parts of its surfaces face each other"});
  }
  const GapMinimum& lowest = minima.front();
  add_remark(result, overlap_of_held_open(pair, lowest.gap));
  if (watched && lies == OpenPair::kBuried) {
    set_status(result, {PoseStatus::kOverlap,
                        "contact \"" + pair.name + "\": one body is buried in the other"});
  } else if (pair.mode == ContactMode::kClosed) {
    set_status(result, {PoseStatus::kNoEquilibrium,
                        "contact \"" + pair.name + "\" is to be held closed, and touches nowhere"});
  }
  const ContactLinearization at = linearize_contact(pair, lowest.places, state.X);
  set_nearest_point(describe_point(at, 0, lowest.edge), contact);
  contact.points.back().on_edge = lowest.edge < options.edge_margin;
  contact.closed = pair.law && lowest.gap < 0;
}

/// A contact with a law of its own.
void describe_law(const Linearization& at,
                  std::size_t p,
                  ContactSearch& search,
                  std::vector<GapMinimum>& minima,
                  PoseResult& result) {
  ContactPotential& potential = *at.system.potentials().of(p);
  std::optional<Objection> reason = potential.describe(at.state.X, result.contacts[p]);
  if (!reason && !result.solved()) return;
  if (!reason)
    reason = deeper_than_borne(at.model.pairs[p], potential, search, at.state.X, at.model.length,
                               minima);
  if (!reason) reason = potential.uncertain(at.state.X, at.force_scale());
  if (reason) set_status(result, *reason);
}

/// A condition whose axes are parallel has no direction along which it could carry: it may hold where it carries nothing.
void judge_conditions(const Linearization& at, PoseResult& result) {
  constexpr double kParallel = 1e-7;  // the node is known to 1e-9 of its direction
  constexpr double kNothing = 1e-9;   // of the forces that act
  for (std::size_t i = 0; i < at.conditions().size(); ++i) {
    const double arm = is_angle(at.model.conditions[i].kind) ? at.model.length : 1;
    const bool carries = std::abs(at.state.sigma[i]) > kNothing * at.force_scale() * arm;
    if (carries && at.conditions()[i].node < kParallel)
      set_status(result, {PoseStatus::kSingular,
                          "condition " + quoted(at.model.condition_names[i]) +
                              ": its first and last axes are parallel here, so it cannot carry"});
  }
}

/// A path of which something speaks against it lowers the status.
void judge_paths(const Linearization& at, PoseResult& result) {
  const std::vector<LineElement>& elements = at.system.parameters().elements;
  if (result.paths.empty()) return;
  std::vector<double> kept = at.state.paths;
  KeptPaths next(elements, kept);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double* numbers = next.of(elements[i]);
    if (!elements[i].path) continue;
    const LineEnds ends = ends_of(elements[i], at.state.X);
    const auto of_ligament = [&](const std::string& words) {
      return "ligament " + quoted(at.model.element_names[i]) + ": " + words;
    };
    const std::string words = elements[i].path->objection(ends, at.state.X, numbers);
    if (!words.empty()) set_status(result, {PoseStatus::kNoPath, of_ligament(words)});
    const std::string remark = elements[i].path->remark(ends, at.state.X, numbers);
    if (!remark.empty()) add_remark(result, of_ligament(remark));
  }
}

}  // namespace

void describe_pose(const Linearization& at,
                   std::vector<ContactSearch>& searches,
                   const PoseDescriptionOptions& options,
                   std::vector<GapMinimum>& minima,
                   PoseResult& result) {
  const Model& model = at.model;
  result.residual = at.system.out_of_balance();
  begin_pose({at.state.X, model.joint ? &*model.joint : nullptr, at.system.parameters().elements,
              at.state.paths, model.pairs.size()},
             result);
  for (std::size_t i = 0; i < model.conditions.size(); ++i)
    result.conditions.push_back({at.conditions()[i].coordinate, at.state.sigma[i]});
  judge_conditions(at, result);
  describe_closed(at, options.edge_margin, result);
  judge_paths(at, result);
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    if (result.contacts[p].closed) continue;
    if (at.system.potentials().of(p) != nullptr) {
      describe_law(at, p, searches[p], minima, result);
      if (result.contacts[p].closed || !result.contacts[p].points.empty()) continue;
    }
    describe_open(model.pairs[p], at.state, searches[p], model.length, options, minima,
                  result.contacts[p], result);
  }
  if (options.joint_stiffness) result.joint_stiffness = joint_stiffness(at);
  if (options.stability) {
    const Stability s = stability(at);
    result.lowest_stiffness = s.lowest_stiffness;
    result.stability = s.stable() ? 1 : 0;
    add_remark(result, stability_remark(at, s));
    for (std::size_t k = 0; k < at.contacts().size(); ++k)
      add_remark(result, nearly_conforming(at.pair(k), at.contacts()[k], at.state.X.R));
  }
  if (result.solved() && !has_finite_numbers(result))
    set_status(result, {PoseStatus::kDiverged, "a number of the solved pose is not finite"});
  to_file_frames(model.origins, result);
}

}  // namespace condyle
