#include "condyle/equilibrium/diagnosis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/contact/contact_scales.h"
#include "condyle/contact/contact_search.h"
#include "condyle/contact/settle_places.h"
#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/dependence.h"
#include "condyle/equilibrium/edge_in_words.h"
#include "condyle/equilibrium/motion_name.h"
#include "condyle/equilibrium/stability.h"
#include "condyle/math/pose_step.h"

namespace condyle {
namespace {

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
    if (held)
      searches[p].find_nearest(state.X, kAnywhere * L, minima, kMerge * searches[p].length(L));
    else
      searches[p].find(state.X, kTouching * L, minima, kMerge * searches[p].length(L));
    for (const GapMinimum& minimum : minima) {
      // Deep inside a body the search keeps to its samples.
      ContactPlaces places = minimum.places;
      ContactLinearization at;
      const bool settled = settle_places(pair, state.X, {L}, places, at) == Settled::kThere;
      all.contacts.push_back({static_cast<int>(p), settled ? places : minimum.places, 0});
      if (held) break;
    }
  }
  return all;
}

/// The load that drives the body the way it went.
std::string driving_load(const Model& model,
                         const Parameters& parameters,
                         const EquilibriumState& state,
                         const Drive& drive) {
  const double L = model.length;
  const Eigen::Matrix<double, 6, 1> way = step_between(model.start, state.X, L);
  double most = 0;
  std::string name;
  for (std::size_t i = 0; i < parameters.loads.size(); ++i) {
    Wrench wrench;
    add_load(parameters.loads[i], drive.scales[i], state.X, wrench);
    const double work = wrench.f.dot(way.head<3>()) + wrench.m.dot(way.tail<3>()) / L;
    if (!(work > most)) continue;
    most = work;
    name = model.load_names[i];
  }
  return name.empty() ? "what pushes it" : "load " + quoted(name);
}

/// The condition that asks a middle angle, which turns back at 90 degrees, for more.
std::string angle_out_of_range(const Model& model, const Drive& drive) {
  for (std::size_t i = 0; i < model.conditions.size(); ++i) {
    const KinematicCondition& condition = model.conditions[i];
    const bool middle = condition.kind == ConditionKind::kAdduction ||
                        (condition.kind == ConditionKind::kRotation && condition.cardan_axis == 0);
    if (middle && std::abs(drive.values[i]) > M_PI / 2)
      return fmt::format("condition {} asks for {:.6g} degrees of an angle that turns back at 90",
                         quoted(model.condition_names[i]), drive.values[i] * 180 / M_PI);
  }
  return {};
}

/// The condition that is farthest from what it should be; empty where all hold.
std::string unmet_condition(const Model& model, const NewtonSystem& system) {
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
  return words;
}

std::string names_of_pairs(const Model& model) {
  std::vector<std::string> names;
  for (const ContactPair& pair : model.pairs)
    if (pair.mode != ContactMode::kOpen) names.push_back(quoted(pair.name));
  return (names.size() == 1 ? "contact " : "contacts ") + joined(names);
}

/// What is known of a pose that was not solved.
struct Failure {
  const Model& model;
  NewtonSystem& system;
  std::vector<ContactSearch>& searches;
  const EquilibriumState& state;  ///< the last that was tried
  const Drive& drive;
  const Attempt& attempt;
  std::string singular;          ///< why Newton's matrix was, where it was
  std::optional<Objection> why;  ///< what rigid contact cannot say about a contact there
  mutable std::optional<EquilibriumState> all = {};

  /// The state with all contacts, searched for once.
  [[nodiscard]] const EquilibriumState& with_contacts() const {
    if (!all) all = with_all_contacts(model, searches, state);
    return *all;
  }
};

std::string too_many_conditions(const Failure& f) {
  if (f.model.conditions.size() <= kMaxConstraints) return {};
  std::vector<std::string> names;
  for (const std::string& name : f.model.condition_names) names.push_back(quoted(name));
  return "more than six conditions for the six freedoms of a body: " + joined(names);
}

std::string overflowed_force(const Failure& f) {
  const std::string what = overflowed(f.model, f.system, f.state, f.drive);
  if (!what.empty()) return what + " has no finite force at the last pose";
  return f.attempt.overflow.empty() ? "" : f.attempt.overflow + " has no finite force on the way";
}

std::string passed_through(const Failure& f) {
  if (f.attempt.passed_pair < 0) return {};
  const ContactPair& pair = f.model.pairs[static_cast<std::size_t>(f.attempt.passed_pair)];
  return fmt::format("contact {}: the surfaces have passed through each other by {:.0f} mm",
                     quoted(pair.name), f.attempt.depth);
}

template <PoseStatus status>
std::string touch_without_answer(const Failure& f) {
  return f.why && f.why->status == status ? f.why->reason : "";
}

std::string conforming(const Failure& f) {
  const std::optional<std::size_t> pair = conforming_pair(f.model, f.searches, f.state.X);
  return pair ? objection(Touch::kConforming, f.model.pairs[*pair].name)->reason : "";
}

std::string asked_out_of_range(const Failure& f) { return angle_out_of_range(f.model, f.drive); }

/// The line element on which the pose failed that has no length, or none that could be found.
int blamed_element(const Failure& f) {
  return f.system.assemble(f.state, f.drive) ? f.attempt.zero_element : f.system.zero_element();
}

std::string without_path(const Failure& f) {
  const int index = blamed_element(f);
  const std::vector<LineElement>& elements = f.system.parameters().elements;
  if (index < 0 || !elements[static_cast<std::size_t>(index)].path) return {};
  const LineElement& element = elements[static_cast<std::size_t>(index)];
  auto kept = unknown_path();
  const LineEnds ends = ends_of(element, f.state.X);
  const double length = element.path->length(ends, f.state.X, kept.data());
  const std::string words = element.path->objection(ends, f.state.X, kept.data());
  return "ligament " + quoted(f.model.element_names[static_cast<std::size_t>(index)]) + ": " +
         (words.empty() || length > kLeastLength
              ? "no shortest path was found on the way from the pose before"
              : words);
}

std::string without_length(const Failure& f) {
  const int element = blamed_element(f);
  if (element < 0) return {};
  return "line element " + quoted(f.model.element_names[static_cast<std::size_t>(element)]) +
         " has no length";
}

/// A contact that carries and has come to an edge: on the way there, or where the descent ended.
std::string at_an_edge(const Failure& f) {
  const std::optional<OffSurfaces>& off = f.attempt.off ? f.attempt.off : f.attempt.off_on_the_way;
  constexpr const char* kNone = ", and no equilibrium was found with the values asked for";
  constexpr const char* kOnTheWay = " on the way from the pose before";
  if (off && off->rim)
    return rim_in_words(f.model, *off->rim, off->beyond) + (f.attempt.off ? "" : kOnTheWay) + kNone;
  if (off && off->contact >= 0)
    return edge_in_words(f.model, off->state.contacts[static_cast<std::size_t>(off->contact)]) +
           (f.attempt.off ? "" : kOnTheWay) + kNone;
  constexpr double kTouching = 1e-4, kNear = 0.02;  // of L
  std::vector<GapMinimum> minima;
  for (std::size_t p = 0; p < f.model.pairs.size(); ++p) {
    if (f.model.pairs[p].mode == ContactMode::kOpen) continue;
    f.searches[p].find(f.state.X, kTouching * f.model.length, minima,
                       kMerge * f.searches[p].length(f.model.length));
    for (const GapMinimum& minimum : minima) {
      const ContactPair& pair = f.model.pairs[p];
      if (minimum.edge > kNear * f.model.length ||
          is_line(linearize_contact(pair, minimum.places, f.state.X), f.state.X.R))
        continue;
      return edge_in_words(f.model, {static_cast<int>(p), minimum.places, 0}) + kNone;
    }
  }
  return {};
}

std::string runs_away(const Failure& f) {
  if (!f.attempt.descent.ran_away) return {};
  return "the body runs away: nothing carries " +
         driving_load(f.model, f.system.parameters(), f.state, f.drive);
}

/// Contacts and conditions that cannot all hold where the descent ended: with a contact among them
/// the body does not fit.
template <bool with_contact>
std::string contradiction(const Failure& f) {
  const EquilibriumState& all = f.with_contacts();
  f.system.assemble(all, f.drive);
  const Linearization at = linearization(f.system, all, f.drive);
  const Dependence dependence = find_dependence(at);
  if (!dependence.contradiction) return {};
  bool contact = false;
  for (const std::size_t k : dependence.culprits)
    contact |=
        k < all.contacts.size() &&
        f.model.pairs[static_cast<std::size_t>(all.contacts[k].pair)].mode == ContactMode::kAuto;
  return contact == with_contact ? in_words(at, dependence) : "";
}

std::string singular_matrix(const Failure& f) { return f.singular; }

std::string no_set_of_contacts(const Failure& f) {
  if (f.attempt.newton.outcome != NewtonOutcome::kConverged) return {};
  return "no points of " + names_of_pairs(f.model) +
         " were found that carry without overlap or pull";
}

/// The motion along which the body was still driven while its contacts and conditions kept, and by
/// how much; empty where it was not.
std::string still_driven(const Failure& f) {
  constexpr double kDriven = 1e-3;  // of all forces
  const EquilibriumState& all = f.with_contacts();
  if (!f.system.assemble(all, f.drive)) return {};
  const Motions free = admissible_motions(linearization(f.system, all, f.drive));
  const Motions driven =
      free * (free.transpose() * scaled_wrench(f.system.wrench(), f.model.length));
  if (!(driven.norm() > kDriven * f.system.force_scale())) return {};
  return fmt::format("the body was still driven along {}, {:.2g} N out of balance",
                     name_motions(f.model, f.state.X, driven.normalized()), driven.norm());
}

std::string left_all_bounds(const Failure& f) {
  if (f.attempt.newton.outcome != NewtonOutcome::kDiverged) return {};
  f.system.assemble(f.state, f.drive);
  const std::string unmet = unmet_condition(f.model, f.system);
  return "Newton's method left all bounds: " +
         (unmet.empty() ? "no pose was found from where it started" : unmet);
}

std::string unsettled(const Failure& f) {
  const std::string driven = still_driven(f);
  f.system.assemble(f.state, f.drive);
  const std::string unmet = unmet_condition(f.model, f.system);
  return "nothing settled within the iteration limit: " +
         (unmet.empty() ? fmt::format("last step {:.3g} mm", f.attempt.descent.step) : unmet) +
         (driven.empty() ? "" : "; " + driven);
}

/// What may be to blame, causes before what follows from them. The first that has words is it.
struct Cause {
  PoseStatus status;
  std::string (*words)(const Failure&);
};
constexpr Cause kCauses[] = {
    {PoseStatus::kSingular, too_many_conditions},
    {PoseStatus::kDiverged, overflowed_force},
    {PoseStatus::kOverlap, passed_through},
    {PoseStatus::kSingular, touch_without_answer<PoseStatus::kSingular>},
    {PoseStatus::kLeftPatch, touch_without_answer<PoseStatus::kLeftPatch>},
    {PoseStatus::kSingular, conforming},
    {PoseStatus::kNoEquilibrium, asked_out_of_range},
    {PoseStatus::kNoPath, without_path},
    {PoseStatus::kZeroLength, without_length},
    {PoseStatus::kNoEquilibrium, at_an_edge},
    {PoseStatus::kNoEquilibrium, runs_away},
    {PoseStatus::kOverlap, contradiction<true>},
    {PoseStatus::kSingular, contradiction<false>},
    {PoseStatus::kSingular, singular_matrix},
    {PoseStatus::kOverlap, no_set_of_contacts},
    {PoseStatus::kDiverged, left_all_bounds},
    {PoseStatus::kIterationLimit, unsettled},
};

}  // namespace

std::string overflowed(const Model& model,
                       NewtonSystem& system,
                       const EquilibriumState& state,
                       const Drive& drive) {
  const Parameters& parameters = system.parameters();
  for (std::size_t i = 0; i < parameters.elements.size(); ++i) {
    Wrench wrench;
    add_line_element(parameters.elements[i], state.X, wrench);
    if (!wrench.f.allFinite() || !wrench.m.allFinite() || !wrench.F1.allFinite())
      return "line element " + quoted(model.element_names[i]);
  }
  for (std::size_t i = 0; i < parameters.loads.size(); ++i) {
    Wrench wrench;
    add_load(parameters.loads[i], drive.scales[i], state.X, wrench);
    if (!wrench.f.allFinite() || !wrench.m.allFinite())
      return "load " + quoted(model.load_names[i]);
  }
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    Wrench wrench;
    if (ContactPotential* potential = system.potentials().of(p)) potential->add_to(state.X, wrench);
    if (!wrench.f.allFinite() || !wrench.m.allFinite())
      return "contact " + quoted(model.pairs[p].name);
  }
  return {};
}

std::string why_singular(Newton& newton) {
  const auto& [state, drive] = newton.stopped();
  newton.system().assemble(state, drive);
  const Linearization at = linearization(newton.system(), state, drive);
  std::string dependent = dependent_constraints(at);
  if (!dependent.empty()) return dependent;
  const Stability now = stability(at);
  if (now.neutral) return "nothing resists " + name_motions(at.model, state.X, now.free);
  if (!now.motion.isZero())
    return "the matrix is singular on the way; softest is " +
           name_motions(at.model, state.X, now.motion);
  const std::vector<LineElement>& elements = newton.system().parameters().elements;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (const std::string words = path_objection(elements[i], state.X); !words.empty())
      return "the matrix is singular on the way; ligament " + quoted(at.model.element_names[i]) +
             ": " + words;
  return "the matrix is singular on the way, where no motion is left";
}

void explain_failure(const Model& model,
                     NewtonSystem& system,
                     std::vector<ContactSearch>& searches,
                     const EquilibriumState& state,
                     const Drive& drive,
                     const Attempt& attempt,
                     std::string singular,
                     PoseResult& result) {
  const Failure failure{model,
                        system,
                        searches,
                        state,
                        drive,
                        attempt,
                        std::move(singular),
                        objection_at(model, searches, state.X)};
  for (const Cause& cause : kCauses) {
    result.reason = cause.words(failure);
    if (result.reason.empty()) continue;
    result.status = cause.status;
    return;
  }
}

}  // namespace condyle
