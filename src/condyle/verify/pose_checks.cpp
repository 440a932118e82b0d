#include "condyle/verify/pose_checks.h"

#include <fmt/format.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/verify/coordinates.h"
#include "condyle/verify/course.h"
#include "condyle/verify/laws.h"
#include "condyle/verify/taut_string.h"

namespace condyle::verification {
namespace {

constexpr const char* kJointNames[] = {"flexion",       "adduction",       "internal rotation",
                                       "lateral shift", "anterior drawer", "distraction"};
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kSameString = 1e-6;  // lengths that differ by less [mm]

std::string named(const char* kind, const std::string& name) {
  return fmt::format("{} \"{}\"", kind, name);
}

double slack_of(const ForceLaw& law) {
  if (const auto* toe = std::get_if<ToeLinearLaw>(&law)) return toe->slack_length;
  if (const auto* quadratic = std::get_if<QuadraticLaw>(&law)) return quadratic->slack_length;
  return 0;
}

/// [mm], led there from the converged pose that is nearest.
std::optional<double> wrapped_length_at(const Run& run,
                                        std::size_t ligament,
                                        const RigidTransform& X_BA) {
  constexpr double kArm = 30;  // [mm]
  const auto far_off = [&](const PoseResult& pose) {
    return (pose.X_BA.p - X_BA.p).norm() + kArm * (pose.X_BA.R - X_BA.R).norm();
  };
  const PoseResult* nearest = nullptr;
  for (const PoseResult& pose : run.sweep.poses)
    if (pose.converged() && (nearest == nullptr || far_off(pose) < far_off(*nearest)))
      nearest = &pose;
  if (nearest == nullptr) return std::nullopt;
  TautString string(run.scene, *nearest, ligament);
  const std::optional<double> length = string.led_to(X_BA);
  if (!length) return std::nullopt;
  // Where the way back leads to another string than that of the pose, one has slipped on the way.
  const std::optional<double> back = string.led_to(nearest->X_BA);
  const double told = course_of(run.scene, *nearest, ligament).length;
  if (!back || !(std::abs(*back - told) < kSameString)) return std::nullopt;
  return length;
}

}  // namespace

double round_off(const LigamentDescription& ligament, const RigidTransform& X_BA) {
  return 1e-14 * (ligament.ends[0].at.norm() + ligament.ends[1].at.norm() + X_BA.p.norm());
}

PairOfSides pair_of(const Subject& subject, std::size_t contact) {
  const Scene& scene = subject.run.scene;
  auto [a, b] = scene.contacts[contact].surfaces;
  if (scene.surfaces[static_cast<std::size_t>(a)].body != scene.fixed_body()) std::swap(a, b);
  return {a, b, subject.sides[static_cast<std::size_t>(a)].get(),
          subject.sides[static_cast<std::size_t>(b)].get()};
}

double prescribed(const Subject& subject, std::size_t condition, const PoseResult& pose) {
  const bool swept = subject.swept.condition == static_cast<int>(condition);
  return swept ? pose.value : subject.run.scene.conditions[condition].value;
}

double load_scale(const Subject& subject, std::size_t load, const PoseResult& pose) {
  return subject.swept.load == static_cast<int>(load) ? pose.value
                                                      : subject.run.scene.loads[load].scale;
}

void check_slack_lengths(const Run& run, Ledger& ledger, std::vector<std::string>& not_checked) {
  const Scene& scene = run.scene;
  const RigidTransform X = start_of(scene);
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    if (!ligament.reference_strain) continue;
    const auto off = [&](double length) {
      return std::abs(length / (1 + *ligament.reference_strain) - slack_of(ligament.law));
    };
    const std::string name = named("ligament", ligament.name);
    if (ligament.path.wraps.empty()) {
      const Vector3d ends[] = {in_ground(scene, ligament.ends[0], X),
                               in_ground(scene, ligament.ends[1], X)};
      ledger.note(Check::kSlack, off((ends[0] - ends[1]).norm()), name);
      continue;
    }
    const std::optional<double> led = wrapped_length_at(run, i, X);
    const std::optional<TautString> first = TautString::first(scene, X, i);
    if (!led && !first) {
      not_checked.push_back("the slack length of " + name +
                            ", whose path does not lead to the start pose");
      continue;
    }
    double least = std::min(led ? off(*led) : INFINITY, first ? off(first->length()) : INFINITY);
    if (least > ledger.allowed(Check::kSlack))
      for (const TautString& other : TautString::about_rings(scene, X, i))
        least = std::min(least, off(other.length()));
    ledger.note(Check::kSlack, least, name);
    if (led && first && std::abs(*led - first->length()) > kSameString)
      ledger.warn("another string " + name, std::abs(*led - first->length()),
                  fmt::format("{} led back to the start pose is {:.3g} mm long, at first it was "
                              "{:.3g}: it has come to lie otherwise",
                              name, *led, first->length()));
  }
}

bool check_motion(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Eigen::Matrix3d& R = pose.X_BA.R;
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm();
  const bool finite = R.allFinite() && pose.X_BA.p.allFinite() && R.determinant() > 0;
  ledger.note(Check::kPose, finite ? off : std::nan(""), "",
              finite ? "" : "the pose is no rotation and translation");
  if (!finite) return false;
  if (!subject.run.scene.joint) return true;
  const std::array<double, 6> q = grood_suntay(subject.run.scene, pose.X_BA);
  const JointCoordinates& j = pose.joint;
  const double stored[] = {j.flexion,       j.adduction,       j.internal_rotation,
                           j.lateral_shift, j.anterior_drawer, j.distraction};
  const double node = std::max(1e-3, std::cos(q[1]));  // at 90 degrees of adduction there is none
  for (std::size_t i = 0; i < 6; ++i) {
    const double off_by = i < 3 ? kDegrees * std::remainder(stored[i] - q[i], 2 * std::numbers::pi)
                                : stored[i] - q[i];
    ledger.note(
        Check::kJoint, std::abs(off_by) * node, kJointNames[i],
        fmt::format("is stored {:.3g} {} off what the pose gives", off_by, i < 3 ? "deg" : "mm"));
  }
  return true;
}

void check_ligaments(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Scene& scene = subject.run.scene;
  const bool viscous = subject.moving() && scene.simulation && scene.simulation->viscous_time > 0;
  double greatest = 0;
  for (const LigamentResult& ligament : pose.ligaments)
    greatest = std::max(greatest, std::abs(ligament.force));
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    const LigamentResult& stored = pose.ligaments[i];
    const std::string element = named("ligament", ligament.name);
    const bool wraps = !ligament.path.wraps.empty();
    if (wraps) check_path(scene, pose, i, ledger);
    const Vector3d a = in_ground(scene, ligament.ends[0], pose.X_BA),
                   b = in_ground(scene, ligament.ends[1], pose.X_BA);
    const double length = wraps ? course_of(scene, pose, i).length : (a - b).norm();
    const double rounding = round_off(ligament, pose.X_BA);
    ledger.note(Check::kLength, std::abs(stored.length - length), element, "",
                1e-9 + 10 * rounding);
    const double slack = slack_of(ligament.law);
    const double strain = slack > 0 ? (length - slack) / slack : 0;
    ledger.note(Check::kStrain, std::abs(stored.strain - strain), element, "",
                1e-10 + (slack > 0 ? (1e-9 + 10 * rounding) / slack : 0));
    if (viscous) continue;
    // A law may be so steep that the rounding of the length is felt.
    const double force = force_at(ligament.law, length);
    const double scale = std::max(std::abs(force), 1e-3 * greatest) +
                         std::abs(slope_at(ligament.law, length)) * (1e-4 + 1e9 * rounding);
    const double off = std::abs(stored.force - force);
    ledger.note(Check::kLaw, off == 0 ? 0 : off / scale, element,
                off <= 1e-9 * scale
                    ? ""
                    : fmt::format("force = {:.12g} N, but its law gives {:.12g} N at {:.10g} mm",
                                  stored.force, force, length));
  }
}

void check_conditions(const Subject& subject, const PoseResult& pose, Ledger& ledger) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    const ConditionDescription& condition = scene.conditions[i];
    if (subject.moving() && scene.simulation) {
      const std::vector<int>& hold = scene.simulation->hold;
      if (std::find(hold.begin(), hold.end(), static_cast<int>(i)) == hold.end()) continue;
    }
    const double unit = is_angle(condition.kind) ? kDegrees : 1;
    const double now = coordinate(scene, condition, pose.X_BA);
    const double wanted =
        subject.moving() ? pose.conditions[i].value : prescribed(subject, i, pose);
    const double off = unit * std::abs(difference(condition, now, wanted));
    const double allowed = 1e-8 + unit * 1e-13 * pose.X_BA.p.norm();
    ledger.note(Check::kCondition, off, named("condition", condition.name),
                fmt::format("is {:.12g} {}, expected {:.12g}", unit * now,
                            is_angle(condition.kind) ? "deg" : "mm", unit * wanted),
                allowed);
    ledger.note(Check::kCondition,
                unit * std::abs(difference(condition, now, pose.conditions[i].value)),
                named("condition", condition.name), "", allowed);
  }
}

}  // namespace condyle::verification
