#include "condyle/equilibrium/pose_output.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <stdexcept>

#include "condyle/equilibrium/contact_shape.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& words) { throw std::invalid_argument(words); }

[[noreturn]] void refuse_contact(const Linearization& at, std::size_t pair, const char* words) {
  refuse("contact \"" + at.model.pairs[pair].name + "\": " + words);
}

/// The closed contact that is a pair's point; no number below the count: there is none.
std::size_t contact_of(const Linearization& at, std::size_t pair, std::size_t point) {
  std::size_t seen = 0;
  for (std::size_t k = 0; k < at.contacts().size(); ++k)
    if (static_cast<std::size_t>(at.state.contacts[k].pair) == pair && seen++ == point) return k;
  return at.contacts().size();
}

std::size_t point_of(const PoseOutput& output, const Linearization& at) {
  const std::size_t k = contact_of(at, output.index, output.point);
  if (k == at.contacts().size()) refuse_contact(at, output.index, "it has no such closed point");
  const ClosedContact& closed = at.state.contacts[k];
  if (examine_touch(at.pair(k), at.contacts()[k], closed.places, at.state.X, at.model.length)
          .kind == Touch::kLine)
    refuse_contact(
        at, output.index,
        "it is a line, whose ends share its force: only their resultant has a derivative");
  return k;
}

/// Sum of the forces of a pair's points; 0 where it is open.
double force_of(const Linearization& at, std::size_t pair) {
  double force = 0;
  for (const ClosedContact& contact : at.state.contacts)
    if (static_cast<std::size_t>(contact.pair) == pair) force += contact.p;
  return force;
}

void add_motion(double by, const Vector3d& a, const Vector3d& pi, double L, OutputRow& row) {
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] += by * a[static_cast<Eigen::Index>(i)];
    row[3 + i] += by * pi[static_cast<Eigen::Index>(i)] / L;
  }
}

/// A component of the place of a closed contact, T (S1 da + S2 dπ).
void add_place(
    const Linearization& at, std::size_t k, double by, const Vector3d& e, OutputRow& row) {
  const ContactLinearization& contact = at.contacts()[k];
  const Eigen::RowVector2d along = e.transpose() * contact.T;
  add_motion(by, (along * contact.S1).transpose(), (along * contact.S2).transpose(),
             at.model.length, row);
}

/// Σ (dp (c - R) + p dc)/Σp, or dc of the first point where Σp = 0.
void add_resultant(const PoseOutput& output, const Linearization& at, OutputRow& row) {
  const Vector3d e = Vector3d::Unit(output.component);
  const double force = force_of(at, output.index);
  if (force == 0) return add_place(at, point_of({output.kind, output.index}, at), 1, e, row);
  Vector3d resultant = Vector3d::Zero();
  for (std::size_t k = 0; k < at.contacts().size(); ++k)
    if (static_cast<std::size_t>(at.state.contacts[k].pair) == output.index)
      resultant += at.state.contacts[k].p / force * at.contacts()[k].B.c;
  for (std::size_t k = 0; k < at.contacts().size(); ++k) {
    if (static_cast<std::size_t>(at.state.contacts[k].pair) != output.index) continue;
    row[6 + k] += e.dot(at.contacts()[k].B.c - resultant) / force;
    add_place(at, k, at.state.contacts[k].p / force, e, row);
  }
}

void check_layer(const PoseOutput& output, LocalRates& rates) {
  if (rates.layer(output.index) == nullptr)
    refuse_contact(rates.at(), output.index, "it is no layer that is pressed");
}

/// The resultant's line of force, about O_A of the files: arm of that from the model's.
Vector3d arm_of_files(const Linearization& at) { return at.state.X.R * at.model.origins.A; }

void add_layer_moment(const PoseOutput& output, LocalRates& rates, OutputRow& row) {
  const Linearization& at = rates.at();
  const Wrench& own = rates.wrench_of_pair(output.index);
  const Vector3d e = Vector3d::Unit(output.component), b = arm_of_files(at);
  // e.(dm + (dπ x b) x f + b x df)
  const Vector3d w = e.cross(b);
  add_motion(1, own.M1.transpose() * e + own.F1.transpose() * w,
             own.M2.transpose() * e + own.F2.transpose() * w + b.cross(own.f.cross(e)),
             at.model.length, row);
}

void check(const PoseOutput& output, const Linearization& at) {
  const Model& model = at.model;
  const auto expect = [&output](std::size_t count, const char* things) {
    if (output.index >= count)
      refuse(fmt::format("output {} of {} {} that the model has", output.index, count, things));
  };
  if (output.component < 0 || output.component > 2)
    refuse(fmt::format("component {} of an output, expected 0, 1 or 2", output.component));
  switch (output.kind) {
    case OutputKind::kJointCoordinate:
      return expect(model.joint ? 6 : 0, "joint coordinates");
    case OutputKind::kLigamentLength:
    case OutputKind::kLigamentStrain:
    case OutputKind::kLigamentForce:
      return expect(model.elements.size(), "line elements");
    case OutputKind::kMultiplier:
      return expect(model.conditions.size(), "conditions");
    default:
      return expect(model.pairs.size(), "pairs of surfaces");
  }
}

const ContactPointResult* told_point(const PoseOutput& output, const PoseResult& pose) {
  const std::vector<ContactPointResult>& points = pose.contacts[output.index].points;
  return output.point < points.size() ? &points[output.point] : nullptr;
}

}  // namespace

double value_of(const PoseOutput& output, const PoseResult& pose) {
  const JointCoordinates& q = pose.joint;
  const std::array<double, 6> coordinates = {q.flexion,           q.adduction,
                                             q.internal_rotation, q.lateral_shift,
                                             q.anterior_drawer,   q.distraction};
  const std::size_t i = output.index;
  switch (output.kind) {
    case OutputKind::kJointCoordinate:
      return coordinates.at(i);
    case OutputKind::kContactForce:
      return pose.contacts.at(i).force;
    case OutputKind::kContactResultant:
      return pose.contacts.at(i).resultant_ground[output.component];
    case OutputKind::kPointForce:
      if (const ContactPointResult* point = told_point(output, pose)) return point->force;
      return kNoNumber;
    case OutputKind::kPointGround:
      if (const ContactPointResult* point = told_point(output, pose))
        return point->point_ground[output.component];
      return kNoNumber;
    case OutputKind::kPointMoving:
      if (const ContactPointResult* point = told_point(output, pose))
        return point->point_moving[output.component];
      return kNoNumber;
    case OutputKind::kLayerForce:
      return pose.contacts.at(i).layer ? pose.contacts[i].layer->force[output.component]
                                       : kNoNumber;
    case OutputKind::kLayerMoment:
      return pose.contacts.at(i).layer ? pose.contacts[i].layer->moment[output.component]
                                       : kNoNumber;
    case OutputKind::kLigamentLength:
      return pose.ligaments.at(i).length;
    case OutputKind::kLigamentStrain:
      return pose.ligaments.at(i).strain;
    case OutputKind::kLigamentForce:
      return pose.ligaments.at(i).force;
    case OutputKind::kMultiplier:
      return pose.conditions.at(i).multiplier;
  }
  return kNoNumber;
}

void find_row(const PoseOutput& output, LocalRates& rates, OutputRow& row) {
  const Linearization& at = rates.at();
  check(output, at);
  row.fill(0);
  const double L = at.model.length;
  const std::size_t i = output.index;
  const Vector3d e = Vector3d::Unit(output.component);
  switch (output.kind) {
    case OutputKind::kJointCoordinate: {
      const auto& J = rates.joint();
      const auto of = static_cast<Eigen::Index>(i);
      return add_motion(1, J.row(of).head<3>().transpose(), J.row(of).tail<3>().transpose(), L,
                        row);
    }
    case OutputKind::kContactForce:
      if (rates.layer(i) != nullptr) {
        const Wrench& own = rates.wrench_of_pair(i);
        const Vector3d along = own.f.normalized();
        return add_motion(1, own.F1.transpose() * along, own.F2.transpose() * along, L, row);
      }
      if (at.model.pairs[i].law && rates.wrench_of_pair(i).f.norm() > 0)
        refuse_contact(at, i, "its law does not tell how it depends on the pose");
      for (std::size_t k = 0; k < at.contacts().size(); ++k)
        if (static_cast<std::size_t>(at.state.contacts[k].pair) == i) row[6 + k] = 1;
      return;
    case OutputKind::kContactResultant:
      if (const ContactRates* layer = rates.layer(i))
        return add_motion(1, layer->resultant.leftCols<3>().transpose() * e,
                          layer->resultant.rightCols<3>().transpose() * e, L, row);
      return add_resultant(output, at, row);
    case OutputKind::kPointForce:
      row[6 + point_of(output, at)] = 1;
      return;
    case OutputKind::kPointGround:
      return add_place(at, point_of(output, at), 1, e, row);
    case OutputKind::kPointMoving: {
      const std::size_t k = point_of(output, at);
      const Vector3d r = at.state.X.R * e;
      add_place(at, k, 1, r, row);
      return add_motion(-1, r, at.contacts()[k].s.cross(r), L, row);
    }
    case OutputKind::kLayerForce: {
      check_layer(output, rates);
      const Wrench& own = rates.wrench_of_pair(i);
      return add_motion(1, own.F1.transpose() * e, own.F2.transpose() * e, L, row);
    }
    case OutputKind::kLayerMoment:
      check_layer(output, rates);
      return add_layer_moment(output, rates, row);
    case OutputKind::kLigamentLength:
    case OutputKind::kLigamentStrain:
    case OutputKind::kLigamentForce: {
      const LocalRates::Line& line = rates.line(i);
      const double l0 = slack_length(at.system.parameters().elements[i].law);
      const double by = output.kind == OutputKind::kLigamentForce    ? line.tension.slope
                        : output.kind == OutputKind::kLigamentLength ? 1
                        : l0 > 0                                     ? 1 / l0
                                                                     : 0;
      return add_motion(-by, line.f, line.m, L, row);
    }
    case OutputKind::kMultiplier:
      row[6 + at.contacts().size() + i] = condition_weight(at.model, i);
      return;
  }
}

double explicit_part(const PoseOutput& output, LocalRates& rates, const ParameterEffect& effect) {
  const Linearization& at = rates.at();
  const std::size_t i = output.index;
  const bool own_element = effect.element == static_cast<int>(i);
  const Vector3d e = Vector3d::Unit(output.component);
  switch (output.kind) {
    case OutputKind::kLigamentLength:
      return own_element ? effect.length : 0;
    case OutputKind::kLigamentStrain:
      return own_element ? effect.strain : 0;
    case OutputKind::kLigamentForce:
      return own_element ? effect.force : 0;
    case OutputKind::kContactForce:
      return rates.layer(i) == nullptr
                 ? 0
                 : rates.wrench_of_pair(i).f.normalized().dot(effect.layers[i].f);
    case OutputKind::kContactResultant: {
      if (rates.layer(i) != nullptr) return effect.layers[i].resultant[output.component];
      const double force = force_of(at, i);
      if (force == 0) return effect.points[contact_of(at, i, 0)][output.component];
      double sum = 0;
      for (std::size_t k = 0; k < at.contacts().size(); ++k)
        if (static_cast<std::size_t>(at.state.contacts[k].pair) == i)
          sum += at.state.contacts[k].p / force * effect.points[k][output.component];
      return sum;
    }
    case OutputKind::kPointGround:
      return effect.points[contact_of(at, i, output.point)][output.component];
    case OutputKind::kPointMoving:
      return (at.state.X.R * e).dot(effect.points[contact_of(at, i, output.point)]);
    case OutputKind::kLayerForce:
      return effect.layers[i].f[output.component];
    case OutputKind::kLayerMoment:
      return e.dot(effect.layers[i].m + arm_of_files(at).cross(effect.layers[i].f));
    default:
      return 0;
  }
}

}  // namespace condyle
