#include "equilibrium/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "equilibrium/contact_scales.h"
#include "equilibrium/contact_search.h"
#include "equilibrium/contact_shape.h"
#include "equilibrium/dependence.h"
#include "equilibrium/motion_name.h"
#include "equilibrium/stability.h"
#include "math/rotation.h"

namespace condyle {
namespace {

/// Where Newton stopped for a singular matrix: what depends on what, or which motion is free.
std::string why_singular(const Model& model, const NewtonSystem& system, const RigidTransform& X) {
  const std::string dependent = dependent_constraints(model, system);
  if (!dependent.empty()) return dependent;
  const Stability now = stability(model, system);
  if (now.neutral) return "nothing resists " + name_motions(model, X, now.free);
  return "the matrix is singular on the way; softest is " + name_motions(model, X, now.motion);
}

/// The state with every contact that touches or overlaps there, and those that are held closed.
EquilibriumState with_all_contacts(const Model& model,
                                   std::vector<ContactSearch>& searches,
                                   const EquilibriumState& state) {
  constexpr double kTouching = 1e-6;  // of L
  EquilibriumState all{state.X, {}, std::vector<double>(model.conditions.size(), 0.0)};
  std::vector<GapMinimum> minima;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const ContactPair& pair = model.pairs[p];
    if (pair.mode == ContactMode::kOpen) continue;
    const bool held = pair.mode == ContactMode::kClosed;
    const double L = model.length;
    searches[p].find(state.X, held ? kAnywhere * L : kTouching * L, minima, kMerge * L);
    for (const GapMinimum& minimum : minima) {
      ClosedContact contact{static_cast<int>(p), minimum.on_B, minimum.on_A, 0};
      // Deep inside a body the search keeps to its samples.
      for (int k = 0; k < 20; ++k)  // each step leaves less than half
        slide_contact(
            *pair.on_B, contact.on_B, *pair.on_A, contact.on_A,
            linearize_contact(*pair.on_B, contact.on_B, *pair.on_A, contact.on_A, state.X), state.X,
            Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), L);
      all.contacts.push_back(contact);
      if (held) break;
    }
  }
  return all;
}

/// The load that drives the body the way it went.
std::string driving_load(const Model& model, const EquilibriumState& state) {
  const double L = model.length;
  Eigen::Matrix<double, 6, 1> way;
  way << state.X.p - model.start.p, L * log_rotation(state.X.R * model.start.R.transpose());
  double most = 0;
  std::string name;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    Wrench wrench;
    add_load(model.loads[i], state.X, wrench);
    const double work = wrench.f.dot(way.head<3>()) + wrench.m.dot(way.tail<3>()) / L;
    if (!(work > most)) continue;
    most = work;
    name = model.load_names[i];
  }
  return name.empty() ? "what pushes it" : "load " + quoted(name);
}

/// What has a number that is none; empty where all are finite.
std::string overflowed(const Model& model, const EquilibriumState& state) {
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    Wrench wrench;
    add_line_element(model.elements[i], state.X, wrench);
    if (!wrench.f.allFinite() || !wrench.m.allFinite() || !wrench.F1.allFinite())
      return "line element " + quoted(model.element_names[i]);
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    Wrench wrench;
    add_load(model.loads[i], state.X, wrench);
    if (!wrench.f.allFinite() || !wrench.m.allFinite())
      return "load " + quoted(model.load_names[i]);
  }
  return {};
}

/// The condition that asks a middle angle, which turns back at 90 degrees, for more.
std::string angle_out_of_range(const Model& model) {
  for (std::size_t i = 0; i < model.conditions.size(); ++i) {
    const KinematicCondition& condition = model.conditions[i];
    const bool middle = condition.kind == ConditionKind::kAdduction ||
                        (condition.kind == ConditionKind::kRotation && condition.cardan_axis == 0);
    if (middle && std::abs(condition.value) > M_PI / 2)
      return fmt::format("condition {} asks for {:.6g} degrees of an angle that turns back at 90",
                         quoted(model.condition_names[i]), condition.value * 180 / M_PI);
  }
  return {};
}

/// What is farthest from what it should be.
std::string worst_condition(const Model& model, const NewtonSystem& system, double last_step) {
  constexpr double kUnmet = 1e-6;
  double largest = kUnmet * model.length;
  std::string words;
  for (std::size_t i = 0; i < system.conditions().size(); ++i) {
    const double off = condition_weight(model, i) * std::abs(system.conditions()[i].k);
    if (!(off > largest)) continue;
    largest = off;
    const bool angle = is_angle(model.conditions[i].kind);
    words =
        fmt::format("condition {} is {:.3g} {} off", quoted(model.condition_names[i]),
                    system.conditions()[i].k * (angle ? 180 / M_PI : 1), angle ? "degrees" : "mm");
  }
  return words.empty() ? fmt::format("last step {:.3g} mm", last_step) : words;
}

std::string names_of_pairs(const Model& model) {
  std::vector<std::string> names;
  for (const ContactPair& pair : model.pairs)
    if (pair.mode != ContactMode::kOpen) names.push_back(quoted(pair.name));
  return (names.size() == 1 ? "contact " : "contacts ") + joined(names);
}

void set(PoseResult& result, PoseStatus status, std::string reason) {
  result.status = status;
  result.reason = std::move(reason);
}

bool too_many_conditions(const Model& model, PoseResult& result) {
  if (model.conditions.size() <= kMaxConstraints) return false;
  std::vector<std::string> names;
  for (const std::string& name : model.condition_names) names.push_back(quoted(name));
  set(result, PoseStatus::kSingular,
      "more than six conditions for the six freedoms of a body: " + joined(names));
  return true;
}

/// Contacts and conditions that cannot all hold where the descent ended: a body that does not fit.
bool explain_contradiction(const Model& model,
                           NewtonSystem& system,
                           std::vector<ContactSearch>& searches,
                           const EquilibriumState& state,
                           PoseResult& result) {
  const EquilibriumState all = with_all_contacts(model, searches, state);
  system.assemble(all);
  const Dependence dependence = find_dependence(model, system);
  if (!dependence.contradiction) return false;
  bool overlap = false;
  for (const std::size_t k : dependence.culprits)
    overlap |=
        k < all.contacts.size() &&
        model.pairs[static_cast<std::size_t>(all.contacts[k].pair)].mode == ContactMode::kAuto;
  set(result, overlap ? PoseStatus::kOverlap : PoseStatus::kSingular,
      in_words(model, system, dependence));
  return true;
}

}  // namespace

void explain_failure(const Model& model,
                     NewtonSystem& system,
                     std::vector<ContactSearch>& searches,
                     const EquilibriumState& state,
                     const Attempt& attempt,
                     PoseResult& result) {
  if (too_many_conditions(model, result)) return;
  const NewtonReport& newton = attempt.newton;
  const std::string overflow = overflowed(model, state);
  if (!overflow.empty()) {
    set(result, PoseStatus::kDiverged, overflow + " has no finite force at the last pose");
    return;
  }
  if (const std::optional<Objection> why = objection_at(model, searches, state.X)) {
    set(result, why->status, why->reason);
    return;
  }
  if (const std::optional<std::size_t> pair = conforming_pair(model, searches, state.X)) {
    const Objection why = *objection(Touch::kConforming, model.pairs[*pair].name);
    set(result, why.status, why.reason);
    return;
  }
  // Newton left the system where it failed.
  const std::string singular =
      newton.outcome == NewtonOutcome::kSingular ? why_singular(model, system, state.X) : "";
  const int without_length = system.assemble(state) ? attempt.zero_element : system.zero_element();
  const std::string out_of_range = angle_out_of_range(model);
  if (!out_of_range.empty()) {
    set(result, PoseStatus::kNoEquilibrium, out_of_range);
  } else if (without_length >= 0) {
    set(result, PoseStatus::kZeroLength,
        "line element " + quoted(model.element_names[static_cast<std::size_t>(without_length)]) +
            " has no length");
  } else if (attempt.descent.ran_away) {
    set(result, PoseStatus::kNoEquilibrium,
        "the body runs away: nothing carries " + driving_load(model, state));
  } else if (explain_contradiction(model, system, searches, state, result)) {
    return;
  } else if (!singular.empty()) {
    set(result, PoseStatus::kSingular, singular);
  } else if (newton.outcome == NewtonOutcome::kConverged) {
    set(result, PoseStatus::kOverlap,
        "no points of " + names_of_pairs(model) + " were found that carry without overlap or pull");
  } else if (newton.outcome == NewtonOutcome::kDiverged) {
    set(result, PoseStatus::kDiverged,
        "Newton's method left all bounds: " + worst_condition(model, system, attempt.descent.step));
  } else {
    set(result, PoseStatus::kIterationLimit,
        "nothing settled within the iteration limit: " +
            worst_condition(model, system, attempt.descent.step));
  }
}

}  // namespace condyle
