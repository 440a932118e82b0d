#include "condyle/results/sweep_record.h"

#include <algorithm>

#include "condyle/results/exact_words.h"

namespace condyle {

template <>
inline constexpr std::size_t kCountOf<PoseStatus> = kPoseStatusCount;
template <>
inline constexpr std::size_t kCountOf<PoseRoute> = kPoseRouteCount;
template <>
inline constexpr std::size_t kCountOf<PoseOrigin> = kPoseOriginCount;
template <>
inline constexpr std::size_t kCountOf<EventKind> = kEventKindCount;
template <>
inline constexpr std::size_t kCountOf<ContactShape> = 3;

template <class Door, Is<JointCoordinates> Value>
void members(Door& door, Value& q) {
  door(q.flexion, q.adduction, q.internal_rotation, q.lateral_shift, q.anterior_drawer,
       q.distraction);
}
template <class Door, Is<HertzEstimate> Value>
void members(Door& door, Value& hertz) {
  door(hertz.semi_axes, hertz.major_axis, hertz.peak_pressure, hertz.approach);
}
template <class Door, Is<ContactPointResult> Value>
void members(Door& door, Value& point) {
  door(point.force, point.point_ground, point.point_moving, point.normal_ground, point.gap,
       point.relative_curvature, point.edge_distance, point.on_edge, point.hertz);
}
template <class Door, Is<LayerResult> Value>
void members(Door& door, Value& layer) {
  door(layer.area, layer.mean_pressure, layer.peak_pressure, layer.deepest, layer.energy,
       layer.error, layer.lost, layer.lateral, layer.points, layer.force, layer.moment);
}
template <class Door, Is<PressurePoint> Value>
void members(Door& door, Value& point) {
  door(point.on_A, point.place, point.point, point.pressure, point.depth, point.area);
}
template <class Door, Is<ContactResult> Value>
void members(Door& door, Value& contact) {
  door(contact.closed, contact.shape, contact.force, contact.resultant_ground, contact.points,
       contact.layer, contact.pressures);
}
template <class Door, Is<LigamentResult> Value>
void members(Door& door, Value& ligament) {
  door(ligament.length, ligament.strain, ligament.force);
}
template <class Door, Is<ConditionResult> Value>
void members(Door& door, Value& condition) {
  door(condition.value, condition.multiplier);
}
template <class Door, Is<LineTouch> Value>
void members(Door& door, Value& touch) {
  door(touch.touching, touch.on_moving, touch.P, touch.Q, touch.t_P, touch.t_Q, touch.side,
       touch.arc, touch.turn);
}
template <class Door, Is<LigamentPath> Value>
void members(Door& door, Value& path) {
  door(path.points, path.touches);
}
template <class Door, Is<JointStiffness> Value>
void members(Door& door, Value& joint) {
  door(joint.stiffness, joint.compliance);
}
void members(ExactWriter& door, const ResidualHistory& history) {
  door(std::vector<double>(history.begin(), history.end()));
}
void members(ExactReader& door, ResidualHistory& history) {
  std::vector<double> values;
  door(values);
  history.clear();
  for (const double value : values) history.add(value);
}
template <class Door, Is<PoseTrace> Value>
void members(Door& door, Value& trace) {
  door(trace.route, trace.origin, trace.parts, trace.residuals, trace.searches, trace.closings,
       trace.openings);
}
template <class Door, Is<PoseResult> Value>
void members(Door& door, Value& pose) {
  door(pose.value, pose.status, pose.reason, pose.remark, pose.X_BA, pose.joint, pose.contacts,
       pose.ligaments, pose.conditions, pose.paths, pose.stability, pose.lowest_stiffness,
       pose.joint_stiffness, pose.iterations, pose.residual, pose.trace, pose.seconds,
       pose.event_seconds);
}
template <class Door, Is<Event> Value>
void members(Door& door, Value& event) {
  door(event.value, event.kind, event.contact, event.ligament, event.wrap);
}
template <class Door, Is<SweepResult> Value>
void members(Door& door, Value& sweep) {
  door(sweep.poses, sweep.events);
}

namespace {

bool belongs_to(const Scene& scene, const Event& event) {
  if (event.contact < -1 || event.contact >= static_cast<int>(scene.contacts.size())) return false;
  if (event.ligament < 0) return true;
  if (event.ligament >= static_cast<int>(scene.ligaments.size())) return false;
  const LigamentDescription& ligament = scene.ligaments[static_cast<std::size_t>(event.ligament)];
  return event.wrap >= 0 && event.wrap < static_cast<int>(ligament.path.wraps.size());
}

/// A ligament lies on no more surfaces than it wraps on.
bool paths_belong_to(const Scene& scene, const PoseResult& pose) {
  if (pose.paths.size() > scene.ligaments.size()) return false;
  for (std::size_t i = 0; i < pose.paths.size(); ++i)
    if (pose.paths[i].touches.size() > scene.ligaments[i].path.wraps.size()) return false;
  return true;
}

bool belongs_to(const Scene& scene, const PoseResult& pose) {
  return paths_belong_to(scene, pose) &&
         (!pose.solved() || (pose.contacts.size() == scene.contacts.size() &&
                             pose.ligaments.size() == scene.ligaments.size() &&
                             pose.conditions.size() == scene.conditions.size()));
}

}  // namespace

void put_sweep(const SweepResult& sweep, std::string& out) { ExactWriter{out}(sweep); }

SweepResult take_sweep(WordTaker& take) {
  SweepResult sweep;
  ExactReader{take}(sweep);
  return sweep;
}

bool belongs_to(const Scene& scene, const SweepResult& sweep) {
  return std::all_of(sweep.poses.begin(), sweep.poses.end(),
                     [&](const PoseResult& pose) { return belongs_to(scene, pose); }) &&
         std::all_of(sweep.events.begin(), sweep.events.end(),
                     [&](const Event& event) { return belongs_to(scene, event); });
}

bool belongs_to(const Scene& scene, const KnownPose& known) {
  return paths_belong_to(scene, known.pose) &&
         std::all_of(known.events.begin(), known.events.end(),
                     [&](const Event& event) { return belongs_to(scene, event); });
}

}  // namespace condyle
