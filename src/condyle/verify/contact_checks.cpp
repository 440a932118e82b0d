#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/verify/coordinates.h"
#include "condyle/verify/course.h"
#include "condyle/verify/laws.h"
#include "condyle/verify/pose_checks.h"

namespace condyle::verification {
namespace {

std::string place(const Vector3d& p) {
  return fmt::format("[{:.4f}, {:.4f}, {:.4f}] mm", p.x(), p.y(), p.z());
}

/// Forces and moments on the moving body about a point of the ground frame, and how much of each
/// there is.
struct Sums {
  Vector3d about, force = Vector3d::Zero(), moment = Vector3d::Zero();
  double forces = 0, moments = 0;
  void pull(const Vector3d& at, const Vector3d& f) {
    force += f;
    forces += f.norm();
    twist((at - about).cross(f), (at - about).norm() * f.norm());
  }
  void twist(const Vector3d& m, double magnitude) {
    moment += m;
    moments += magnitude;
  }
};

/// The middle of all points where a force acts.
Vector3d middle_of(const Scene& scene, const PoseResult& pose) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const LigamentDescription& ligament : scene.ligaments)
    for (const Attachment& end : ligament.ends) sum += in_ground(scene, end, pose.X_BA), ++count;
  for (const ConditionDescription& condition : scene.conditions)
    if (condition.kind == ConditionKind::kDistance)
      for (const Attachment& end : condition.ends) sum += in_ground(scene, end, pose.X_BA), ++count;
  for (const ContactResult& contact : pose.contacts)
    if (contact.closed)
      for (const ContactPointResult& point : contact.points) sum += point.point_ground, ++count;
  for (const LoadDescription& load : scene.loads)
    if (!load.moment) sum += pose.X_BA * load.at, ++count;
  return count > 0 ? Vector3d(sum / count) : pose.X_BA.p;
}

void add_ligaments(const Scene& scene, const PoseResult& pose, Sums& sums) {
  // Of a line so steep or so short that rounding is felt, along or across, no sum is better known than that.
  constexpr double kAllowed = 2e-9;  // of the sums
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    const Course course = course_of(scene, pose, i);
    const Vector3d way = course.on_B - course.on_A;
    if (!(way.norm() > 0)) continue;
    sums.pull(course.on_A, pose.ligaments[i].force * way.normalized());
    const double rounding = 1e-13 + 0.1 * round_off(ligament, pose.X_BA);
    const double stiffness = std::abs(slope_at(ligament.law, course.length)) +
                             std::abs(pose.ligaments[i].force) / way.norm();
    const double felt = stiffness * rounding / kAllowed;
    sums.forces += felt;
    sums.moments += (course.on_A - sums.about).norm() * felt;
  }
}

void add_loads(const Subject& subject, const PoseResult& pose, Sums& sums) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadDescription& load = scene.loads[i];
    Vector3d vector = load_scale(subject, i, pose) * load.vector;
    if (load.follows_body) vector = pose.X_BA.R * vector;
    if (load.moment)
      sums.twist(vector, vector.norm());
    else
      sums.pull(pose.X_BA * load.at, vector);
  }
}

/// Of a layer the force at its centre of pressure, and the moment that is left about it.
void add_layer(const PoseResult& pose, const ContactResult& contact, Sums& sums) {
  const Vector3d &at = contact.resultant_ground, &force = contact.layer->force;
  const Vector3d twist = contact.layer->moment - (at - pose.X_BA.p).cross(force);
  sums.pull(at, force);
  sums.twist(twist, twist.norm());
}

void add_contacts(const PoseResult& pose, Sums& sums) {
  for (const ContactResult& contact : pose.contacts)
    if (contact.layer)
      add_layer(pose, contact, sums);
    else if (contact.closed)
      for (const ContactPointResult& point : contact.points)
        sums.pull(point.point_ground, point.force * point.normal_ground);
}

/// A multiplier does the work -σ dk. That of a distance pulls at its end, as a ligament does.
void add_reactions(const Scene& scene, const PoseResult& pose, Sums& sums) {
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    const double sigma = pose.conditions[i].multiplier;
    const Eigen::Matrix<double, 6, 1> dk =
        gradient(scene, scene.conditions[i], pose.X_BA, sums.about);
    if (scene.conditions[i].kind == ConditionKind::kDistance) {
      sums.pull(end_on_moving(scene, scene.conditions[i], pose.X_BA), -sigma * dk.head<3>());
      continue;
    }
    sums.force -= sigma * dk.head<3>();
    sums.forces += std::abs(sigma) * dk.head<3>().norm();
    sums.twist(-sigma * dk.tail<3>(), std::abs(sigma) * dk.tail<3>().norm());
  }
}

Sums everything(const Subject& subject, const PoseResult& pose) {
  const Scene& scene = subject.run.scene;
  Sums sums{.about = middle_of(scene, pose)};
  add_ligaments(scene, pose, sums);
  add_loads(subject, pose, sums);
  add_contacts(pose, sums);
  add_reactions(scene, pose, sums);
  return sums;
}

void check_point(const PairOfSides& pair,
                 const Scene& scene,
                 const RigidTransform& X,
                 const ContactPointResult& point,
                 const std::string& element,
                 bool closed,
                 Ledger& ledger) {
  const ClosestPoint on_B = pair.fixed->closest(point.point_ground),
                     on_A = pair.moving->closest(point.point_moving);
  const auto body = [&](int surface) {
    return scene
        .bodies[static_cast<std::size_t>(scene.surfaces[static_cast<std::size_t>(surface)].body)]
        .name;
  };
  const double far = 1e-14 * (point.point_ground.norm() + X.p.norm() + point.point_moving.norm());
  // An open gap may be least where surfaces go on beyond what is known of them, which no file holds.
  const double beyond = -std::min(on_B.edge, on_A.edge);
  if (!closed && beyond > 1e-6) {
    ledger.warn(
        "beyond " + element, beyond,
        fmt::format("{} is open and nearest {:.2g} mm beyond the known part of its surfaces, "
                    "where that is not checked",
                    element, beyond));
    return;
  }
  const auto on_surface = [&](const ClosestPoint& closest, const Vector3d& p, int surface) {
    const double off = (p - closest.point).norm();
    ledger.note(
        Check::kOnSurface, off, element,
        fmt::format("{} of {} lies {:.3g} mm beside surface \"{}\"", place(p), body(surface), off,
                    scene.surfaces[static_cast<std::size_t>(surface)].name),
        1e-8 + 100 * far);
    if (!closed) return;
    ledger.note(Check::kKnown, -closest.edge, element,
                fmt::format("{} of {} lies {:.3g} mm beyond the known part of surface \"{}\"",
                            place(p), body(surface), -closest.edge,
                            scene.surfaces[static_cast<std::size_t>(surface)].name));
  };
  on_surface(on_B, point.point_ground, pair.fixed_surface);
  on_surface(on_A, point.point_moving, pair.moving_surface);

  const Vector3d way = X * point.point_moving - point.point_ground;
  const double gap = point.normal_ground.dot(way);
  const double apart = closed ? way.norm() : std::abs(gap - point.gap);
  ledger.note(Check::kTogether, apart, element,
              fmt::format("{} of {} is {:.6g} mm from the point of {}, {:.6g} mm along the normal; "
                          "the file says {:.6g} mm",
                          place(point.point_ground), body(pair.fixed_surface), way.norm(),
                          body(pair.moving_surface), gap, point.gap),
              1e-8 + 100 * far);
  if (closed) ledger.note(Check::kTogether, std::abs(point.gap), element, "", 1e-8 + 100 * far);

  const Vector3d& n = point.normal_ground;
  // Where an open gap is smallest at an edge the normals need not agree.
  const double off = std::max(
      {(n - on_B.n).norm(), closed ? (n + X.R * on_A.n).norm() : 0.0, std::abs(n.norm() - 1)});
  ledger.note(Check::kNormal, off, element,
              fmt::format("the normal at {} of {} is off by {:.3g} rad from those of the surfaces",
                          place(point.point_ground), body(pair.fixed_surface), off));
}

}  // namespace

void check_contacts(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Scene& scene = subject.run.scene;
  double scale = everything(subject, pose).forces;
  if (!(scale > 0)) scale = 1;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const ContactResult& contact = pose.contacts[i];
    if (scene.contacts[i].layer) continue;  // layer_checks.h
    const std::string element = fmt::format("contact \"{}\"", scene.contacts[i].name);
    const PairOfSides pair = pair_of(subject, i);
    const bool may_pull =
        scene.contacts[i].state != ContactState::kAuto && contact.points.size() == 1;
    double sum = 0, magnitudes = 0;
    Vector3d moment = Vector3d::Zero();
    for (const ContactPointResult& point : contact.points) {
      sum += point.force;
      magnitudes += std::abs(point.force);
      moment += point.force * point.point_ground;
      check_point(pair, scene, pose.X_BA, point, element, contact.closed, ledger);
      if (!may_pull)
        ledger.note(
            Check::kPush, -point.force / scale, element,
            fmt::format("pulls with {:.6g} N at {} of {}", -point.force, place(point.point_ground),
                        scene.bodies[static_cast<std::size_t>(scene.fixed_body())].name));
      if (!contact.closed)
        ledger.note(Check::kPush, std::abs(point.force) / scale, element,
                    fmt::format("is open and carries {:.6g} N", point.force));
    }
    ledger.note(Check::kPush, std::abs(sum - contact.force) / scale, element,
                fmt::format("carries {:.12g} N, its points {:.12g} N", contact.force, sum));
    if (!contact.closed || magnitudes == 0) continue;
    const double off = (sum * contact.resultant_ground - moment).norm() / magnitudes;
    ledger.note(Check::kTogether, off, element,
                fmt::format("acts at {} of {}, its points at {}", place(contact.resultant_ground),
                            scene.bodies[static_cast<std::size_t>(scene.fixed_body())].name,
                            place(moment / sum)),
                1e-8 + 1e-12 * contact.resultant_ground.norm());
  }
}

void check_balance(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Sums sums = everything(subject, pose);
  const double force = sums.force.norm(), moment = sums.moment.norm();
  // Where only the one acts, the other is compared with it by way of an arm: 1 m, and 1 um.
  const double forces = sums.forces + 1e-3 * sums.moments,
               moments = sums.moments + 1e-3 * sums.forces;
  ledger.note(Check::kForces, force == 0 ? 0 : force / forces, "",
              fmt::format("forces add up to {:.3g} N of {:.6g} N that act", force, forces));
  ledger.note(
      Check::kMoments, moment == 0 ? 0 : moment / moments, "",
      fmt::format("moments add up to {:.3g} N mm of {:.6g} N mm that act", moment, moments));
}

}  // namespace condyle::verification
