#include "condyle/equilibrium/parameter_effect.h"

#include <Eigen/Geometry>

#include <stdexcept>

#include "condyle/elements/law_rates.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

[[noreturn]] void refuse(const ModelParameter& parameter, const Model& model, const char* why) {
  throw std::invalid_argument(name_of(parameter, model) + ": " + why);
}

void clear(const Linearization& at, ParameterEffect& effect) {
  effect.column.fill(0);
  effect.element = -1;
  effect.length = effect.force = effect.strain = 0;
  effect.points.fill(Vector3d::Zero());
  effect.layers.assign(at.model.pairs.size(),
                       {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()});
}

void add_wrench(const Vector3d& f, const Vector3d& m, double L, ParameterEffect& effect) {
  for (std::size_t i = 0; i < 3; ++i) {
    effect.column[i] += f[static_cast<Eigen::Index>(i)];
    effect.column[3 + i] += m[static_cast<Eigen::Index>(i)] / L;
  }
}

/// How an insertion moves, in the ground frame, and the length and the start length with it.
struct EndMotion {
  Vector3d v;
  const LineEndRates* end;
  double length;
  double start_length;  // relative, where the strain is held
};

EndMotion motion_of_end(const ModelParameter& parameter, LocalRates& rates) {
  const Linearization& at = rates.at();
  const LineRates* ends = rates.ends(parameter.index);
  if (ends == nullptr) refuse(parameter, at.model, "how its path follows that end is not known");
  const bool fixed = parameter.body == OfBody::kFixed;
  EndMotion motion;
  motion.v = Vector3d::Unit(parameter.component);
  if (!fixed) motion.v = at.state.X.R * motion.v;
  motion.end = fixed ? &ends->of_C : &ends->of_D;
  motion.length = motion.end->length.dot(motion.v);
  motion.start_length = 0;
  if (parameter.held == Held::kReferenceStrain) {
    const LocalRates::StartLine& start = rates.start(parameter.index);
    if (!start.knows_ends)
      refuse(parameter, at.model, "how its path at the start pose follows that end is not known");
    motion.start_length = (fixed ? start.by_C : start.by_D)[parameter.component] / start.length;
  }
  return motion;
}

/// Of the slack length, by what is not the slack length itself [mm].
double slack_length_by(const ModelParameter& parameter, double l0, LocalRates& rates) {
  if (parameter.kind == ParameterKind::kReferenceStrain)
    return -l0 * l0 / rates.start(parameter.index).length;
  return parameter.kind == ParameterKind::kSlackLength ? 1 : 0;
}

void add_line(const ModelParameter& parameter, LocalRates& rates, ParameterEffect& effect) {
  const Linearization& at = rates.at();
  const LineElement& element = at.system.parameters().elements[parameter.index];
  const LocalRates::Line& line = rates.line(parameter.index);
  const LawRates law = law_rates(element.law, line.length).value_or(LawRates());
  const double l0 = slack_length(element.law), L = at.model.length;
  double by_l0 = slack_length_by(parameter, l0, rates), force = 0;
  effect.element = static_cast<int>(parameter.index);
  if (parameter.kind == ParameterKind::kStiffness) force = law.stiffness;
  if (parameter.kind == ParameterKind::kTransitionStrain) force = law.transition_strain;
  if (parameter.kind == ParameterKind::kInsertion) {
    const EndMotion motion = motion_of_end(parameter, rates);
    effect.length = motion.length;
    by_l0 = l0 * motion.start_length;
    force = line.tension.slope * motion.length;
    add_wrench(line.tension.force * (motion.end->f * motion.v),
               line.tension.force * (motion.end->m * motion.v), L, effect);
  }
  force += law.slack_length * by_l0;
  effect.force = force;
  if (l0 > 0) effect.strain = (effect.length - line.length / l0 * by_l0) / l0;
  add_wrench(force * line.f, force * line.m, L, effect);
}

void add_load_vector(const ModelParameter& parameter,
                     const Linearization& at,
                     ParameterEffect& effect) {
  Load load = at.system.parameters().loads[parameter.index];
  load.vector = Vector3d::Unit(parameter.component);
  Wrench wrench;
  add_load(load, at.drive.scales[parameter.index], at.state.X, wrench);
  add_wrench(wrench.f, wrench.m, at.model.length, effect);
}

void add_load_point(const ModelParameter& parameter,
                    const Linearization& at,
                    ParameterEffect& effect) {
  const Load& load = at.system.parameters().loads[parameter.index];
  const Vector3d u = at.state.X.R.col(parameter.component);
  Vector3d force = at.drive.scales[parameter.index] * load.vector;
  if (load.follows_body) force = at.state.X.R * force;
  add_wrench(Vector3d::Zero(), u.cross(force), at.model.length, effect);
}

void add_drive(const Swept& swept, const Linearization& at, ParameterEffect& effect) {
  fill_drive_column(at, swept, effect.column.data());
}

/// Of one pair, its surface on A or on B moved by u.
void add_shift(
    std::size_t pair, bool on_A, const Vector3d& u, LocalRates& rates, ParameterEffect& effect) {
  const Linearization& at = rates.at();
  const Wrench& own = rates.wrench_of_pair(pair);
  const double sign = on_A ? 1 : -1;
  const Vector3d f = sign * (own.F1 * u);
  Vector3d m = sign * (own.M1 * u);
  if (on_A) m += u.cross(own.f);
  add_wrench(f, m, at.model.length, effect);
  for (std::size_t k = 0; k < at.contacts().size(); ++k) {
    if (static_cast<std::size_t>(at.state.contacts[k].pair) != pair) continue;
    const ContactLinearization& contact = at.contacts()[k];
    effect.column[6 + k] += sign * contact.B.n.dot(u);
    effect.points[k] += sign * (contact.T * (contact.S1 * u));
    if (!on_A) effect.points[k] += u;
  }
  if (const ContactRates* layer = rates.layer(pair)) {
    ParameterEffect::Layer& told = effect.layers[pair];
    told.f += f;
    told.m += m;
    told.resultant += sign * (layer->resultant.leftCols<3>() * u);
    if (!on_A) told.resultant += u;
  }
}

void add_surface(const ModelParameter& parameter, LocalRates& rates, ParameterEffect& effect) {
  const Linearization& at = rates.at();
  const bool on_A = parameter.body == OfBody::kMoving;
  const auto surface = [on_A](const ContactPair& pair) {
    return on_A ? pair.on_A.get() : pair.on_B.get();
  };
  Vector3d u = Vector3d::Unit(parameter.component);
  if (on_A) u = at.state.X.R * u;
  const Surface* moved = surface(at.model.pairs[parameter.index]);
  for (std::size_t pair = 0; pair < at.model.pairs.size(); ++pair)
    if (surface(at.model.pairs[pair]) == moved) add_shift(pair, on_A, u, rates, effect);
}

void add_modulus(const ModelParameter& parameter, LocalRates& rates, ParameterEffect& effect) {
  const Linearization& at = rates.at();
  const ContactPotential* potential = at.system.potentials().of(parameter.index);
  if (potential == nullptr || !potential->knows_rates())
    refuse(parameter, at.model, "what its law does with a modulus is not known");
  const ContactRates* layer = rates.layer(parameter.index);
  if (layer == nullptr) return;  // nothing is pressed
  ParameterEffect::Layer& told = effect.layers[parameter.index];
  for (const std::size_t side : {0, 1}) {
    const OfBody own = side == 0 ? OfBody::kFixed : OfBody::kMoving;
    if (parameter.body != OfBody::kBoth && parameter.body != own) continue;
    told.f += layer->stiffer[side].f;
    told.m += layer->stiffer[side].m;
    told.resultant += layer->stiffer[side].resultant;
  }
  add_wrench(told.f, told.m, at.model.length, effect);
}

}  // namespace

void find_effect(const ModelParameter& parameter, LocalRates& rates, ParameterEffect& effect) {
  const Linearization& at = rates.at();
  check_parameter(parameter, at.model, at.system.parameters());
  clear(at, effect);
  switch (parameter.kind) {
    case ParameterKind::kReferenceStrain:
    case ParameterKind::kSlackLength:
    case ParameterKind::kStiffness:
    case ParameterKind::kTransitionStrain:
    case ParameterKind::kInsertion:
      return add_line(parameter, rates, effect);
    case ParameterKind::kLoadScale:
      return add_drive(load_scale(parameter.index), at, effect);
    case ParameterKind::kConditionValue:
      return add_drive(condition_value(parameter.index), at, effect);
    case ParameterKind::kLoadVector:
      return add_load_vector(parameter, at, effect);
    case ParameterKind::kLoadPoint:
      return add_load_point(parameter, at, effect);
    case ParameterKind::kSurfaceShift:
      return add_surface(parameter, rates, effect);
    case ParameterKind::kLayerModulus:
      return add_modulus(parameter, rates, effect);
  }
}

}  // namespace condyle
