#include <fmt/format.h>

#include <cmath>

#include "condyle/scene/start_pose.h"
#include "random/random_knee.h"

namespace condyle::random_knees {
namespace {

using Eigen::Vector3d;

/// What a condition's coordinate is at the start pose [rad], [mm].
double at_start(const Scene& scene, const ConditionDescription& condition) {
  const RigidTransform X = start_pose(scene);
  switch (condition.kind) {
    case ConditionKind::kTranslation:
      return condition.axis.dot(X.p);
    case ConditionKind::kRotation:
      // R = Rz Rx' Ry''.
      if (condition.cardan_axis == 0) return std::asin(std::clamp(X.R(2, 1), -1.0, 1.0));
      if (condition.cardan_axis == 1) return std::atan2(-X.R(2, 0), X.R(2, 2));
      return std::atan2(-X.R(0, 1), X.R(1, 1));
    case ConditionKind::kDistance:
      return distance_between(scene, condition.ends, X);
    default:
      break;
  }
  const JointCoordinates q = joint_coordinates(joint_frames(scene), X);
  const double all[] = {q.flexion,       q.adduction,       q.internal_rotation,
                        q.lateral_shift, q.anterior_drawer, q.distraction};
  return all[static_cast<std::size_t>(condition.kind)];
}

ConditionDescription condition(Draws& draws, const Scene& scene, int number) {
  ConditionDescription c;
  c.name = fmt::format("condition {}", number);
  if (scene.joint && draws.chance(0.7)) {
    c.kind = static_cast<ConditionKind>(number == 1 ? 0 : draws.below(6));
  } else {
    c.kind =
        static_cast<ConditionKind>(static_cast<int>(ConditionKind::kTranslation) + draws.below(3));
    c.axis = draws.direction();
    c.cardan_axis = draws.below(3);
    c.ends = {Attachment{scene.fixed_body(), Vector3d::Zero()},
              Attachment{scene.moving_body(), draws.within(30)}};
    c.ends[0].at = start_pose(scene) * (c.ends[1].at + 40 * draws.direction());
  }
  c.value = at_start(scene, c);
  return c;
}

/// Steps from the start, or from beside it, of at most a knee's range.
std::vector<double> values(Draws& draws, double start, double range) {
  const int count = 3 + draws.below(6);
  const double from = start + (draws.chance(0.3) ? draws.between(-0.2, 0.2) * range : 0),
               to = start + draws.between(-1, 1) * range;
  std::vector<double> list;
  for (int i = 0; i < count; ++i) list.push_back(from + (to - from) * i / (count - 1));
  return list;
}

}  // namespace

void add_loads(Draws& draws, RandomKnee& knee) {
  Scene& scene = knee.scene;
  const int count = draws.chance(0.1) ? 0 : 1 + draws.below(4);
  // On body 1 downwards: the joint is pressed together.
  const double down =
      (scene.moving_body() == 1 ? -1 : 1) * (knee.ill == Ill::kPulledApart ? -1 : 1);
  for (int i = 0; i < count; ++i) {
    LoadDescription load;
    load.name = fmt::format("load {}", i + 1);
    load.body = scene.moving_body();
    const double size = knee.ill == Ill::kLoad ? draws.of_any_size(1e-9, 1e9) : 1;
    load.at = draws.within(12);
    if (i == 0) {
      load.vector =
          size * draws.of_any_size(10, 1000) * (down * Vector3d::UnitZ() + 0.1 * draws.direction());
    } else {
      load.moment = draws.chance(0.5);
      load.vector = size * draws.between(0, load.moment ? 2000 : 60) * draws.direction();
      load.follows_body = draws.chance(0.4);
    }
    if (load.moment) load.at.setZero();
    if (draws.chance(0.1)) load.scale = draws.between(-1, 2);
    scene.loads.push_back(load);
  }
}

void add_motions(Draws& draws, RandomKnee& knee) {
  Scene& scene = knee.scene;
  const double u = draws.unit();
  const int count = u < 0.15 ? 0 : (u < 0.6 ? 1 : 2 + draws.below(4));
  for (int i = 0; i < count; ++i) scene.conditions.push_back(condition(draws, scene, i + 1));
  if (knee.ill == Ill::kTwice && count > 0) {
    ConditionDescription again = scene.conditions.front();
    again.name = "again";
    if (draws.chance(0.5)) again.value += draws.of_any_size(1e-12, 1e-1);
    scene.conditions.push_back(again);
  }
  if (count == 0 && scene.loads.empty()) {
    scene.loads.emplace_back();
    scene.loads.back().name = "load 1";
    scene.loads.back().body = scene.moving_body();
    scene.loads.back().vector = draws.between(1, 100) * draws.direction();
  }
  SweepDescription& sweep = scene.sweep.emplace();
  sweep.varies_load = count == 0 || (!scene.loads.empty() && draws.chance(0.3));
  if (sweep.varies_load) {
    sweep.index = draws.below(static_cast<int>(scene.loads.size()));
    sweep.vary = scene.loads[static_cast<std::size_t>(sweep.index)].name + ".scale";
    sweep.values = values(draws, 1, 2);
  } else {
    sweep.index = 0;
    const ConditionDescription& first = scene.conditions.front();
    sweep.vary = first.name;
    sweep.values = values(draws, first.value, is_angle(first.kind) ? 1.5 : 10);
  }
  sweep.arc_length = draws.chance(0.05);
}

}  // namespace condyle::random_knees
