#include "condyle/verify/course.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/verify/coordinates.h"
#include "condyle/verify/parts.h"
#include "condyle/verify/wrap_field.h"

namespace condyle::verification {
namespace {

using Eigen::Vector3d;

/// Of a touch in the ground frame.
struct TouchAt {
  std::size_t wrap;
  bool on_moving;
  Vector3d P, Q, t_P, t_Q;
  double arc;
};

std::vector<TouchAt> touches_at(const PoseResult& pose, std::size_t ligament) {
  std::vector<TouchAt> touches;
  if (ligament >= pose.paths.size()) return touches;
  const std::vector<LineTouch>& told = pose.paths[ligament].touches;
  for (std::size_t w = 0; w < told.size(); ++w) {
    if (!told[w].touching) continue;
    const RigidTransform X = told[w].on_moving ? pose.X_BA : RigidTransform{};
    touches.push_back({w, told[w].on_moving, X * told[w].P, X * told[w].Q, X.R * told[w].t_P,
                       X.R * told[w].t_Q, told[w].arc});
  }
  return touches;
}

constexpr double kNoticed = 0.1;  // [mm]

}  // namespace

std::vector<WrapAt> wraps_at(const Scene& scene, const RigidTransform& X_BA, std::size_t ligament) {
  const LigamentDescription& described = scene.ligaments[ligament];
  std::vector<WrapAt> wraps;
  for (const int index : described.path.wraps) {
    const WrapDescription& wrap = scene.wraps[static_cast<std::size_t>(index)];
    const RigidTransform body = wrap.body == scene.moving_body() ? X_BA : RigidTransform{};
    wraps.push_back({&wrap, described.path.thickness / 2, body * wrap.placement});
  }
  if (described.ends[0].body != scene.fixed_body()) std::reverse(wraps.begin(), wraps.end());
  return wraps;
}

BeginAt begin_of(const Scene& scene,
                 const RigidTransform& X_BA,
                 std::size_t ligament,
                 bool moving,
                 const std::vector<WrapAt>& wraps) {
  const LigamentDescription& described = scene.ligaments[ligament];
  const bool first = (described.ends[0].body == scene.moving_body()) == moving;
  const Attachment& end = described.ends[first ? 0 : 1];
  const Vector3d at = in_ground(scene, end, X_BA);
  if (!described.path.anchors_inside) return {at};
  for (std::size_t w = 0; w < wraps.size(); ++w) {
    const WrapAt& wrap = wraps[w];
    if (wrap.wrap->body != end.body) continue;
    if (field_at(wrap.wrap->shape, wrap.larger, wrap.own(at)).f < 0)
      return {wrap.X * closest_on(wrap.wrap->shape, wrap.larger, wrap.own(at)),
              static_cast<int>(w)};
  }
  return {at};
}

bool passed_over(const LigamentDescription& ligament,
                 const WrapAt& wrap,
                 const RigidTransform& X_BA,
                 const Scene& scene) {
  if (ligament.path.anchors_inside) return false;
  return std::any_of(ligament.ends.begin(), ligament.ends.end(), [&](const Attachment& end) {
    const Vector3d x = wrap.own(in_ground(scene, end, X_BA));
    return end.body == wrap.wrap->body && field_at(wrap.wrap->shape, wrap.larger, x).f < 0;
  });
}

Deepest runs_into(const WrapAt& wrap, const Vector3d& from, const Vector3d& to) {
  constexpr int kFewest = 200, kMost = 2000;
  constexpr double kStep = 0.25;  // of the least radius
  const double wanted = (to - from).norm() / (kStep * least_radius(wrap.wrap->shape));
  const int places = parts_of(wanted, kFewest, kMost);
  const auto depth_at = [&](double k) {
    const Vector3d x = from + (to - from) * k / places;
    const Field field = field_at(wrap.wrap->shape, wrap.larger, wrap.own(x));
    return -field.f / std::max(1e-12, field.gradient.norm());
  };
  double depth = -std::numeric_limits<double>::infinity(), at = 0;
  for (int k = 1; k < places; ++k) {
    const double here = depth_at(k);
    if (here > depth) depth = here, at = k;
  }
  // By thirds of what is left between its neighbours: a place in the surface may lie between two that are not.
  for (double reach = 1; reach > 1e-4; reach *= 2.0 / 3) {
    for (const double beside : {at - reach / 3, at + reach / 3}) {
      const double k = std::clamp(beside, 0.0, static_cast<double>(places)), here = depth_at(k);
      if (here > depth) depth = here, at = k;
    }
  }
  if (!(depth > 0)) return {0, from};
  return {depth, from + (to - from) * at / places};
}

Course course_of(const Scene& scene, const PoseResult& pose, std::size_t ligament) {
  const std::vector<WrapAt> wraps = wraps_at(scene, pose.X_BA, ligament);
  Course course;
  course.on_B = begin_of(scene, pose.X_BA, ligament, false, wraps).x;
  const Vector3d end = begin_of(scene, pose.X_BA, ligament, true, wraps).x;
  course.on_A = end;
  Vector3d last = course.on_B;
  bool crossed = false;
  for (const TouchAt& touch : touches_at(pose, ligament)) {
    course.length += (touch.P - last).norm() + touch.arc;
    if (!touch.on_moving) course.on_B = touch.Q;
    if (touch.on_moving && !crossed) course.on_A = touch.P, crossed = true;
    last = touch.Q;
  }
  course.length += (end - last).norm();
  return course;
}

void check_path(const Scene& scene, const PoseResult& pose, std::size_t ligament, Ledger& ledger) {
  const std::vector<WrapAt> wraps = wraps_at(scene, pose.X_BA, ligament);
  const std::string& name = scene.ligaments[ligament].name;
  const auto note = [&](double off, const WrapAt& wrap, const char* what) {
    ledger.note(Check::kPath, off,
                fmt::format("ligament \"{}\" on \"{}\": {}", name, wrap.wrap->name, what));
  };
  // Of a piece of no length the direction is not known.
  const auto bend = [](const Vector3d& piece, const Vector3d& tangent) {
    return piece.norm() > 1e-6 ? (piece.normalized() - tangent).norm() * std::min(1.0, piece.norm())
                               : 0.0;
  };
  const std::vector<TouchAt> touches = touches_at(pose, ligament);
  const Vector3d end = begin_of(scene, pose.X_BA, ligament, true, wraps).x;
  Vector3d from = begin_of(scene, pose.X_BA, ligament, false, wraps).x;
  for (std::size_t k = 0; k <= touches.size(); ++k) {
    const Vector3d to = k < touches.size() ? touches[k].P : end;
    // Wraps come in their order: each lies at the piece between those that are touched about it.
    const std::size_t first = k > 0 ? touches[k - 1].wrap : 0;
    const std::size_t last = k < touches.size() ? touches[k].wrap : wraps.size() - 1;
    for (std::size_t w = 0; w < wraps.size(); ++w) {
      if (passed_over(scene.ligaments[ligament], wraps[w], pose.X_BA, scene)) continue;
      const double depth = runs_into(wraps[w], from, to).depth;
      if (w >= first && w <= last)
        note(depth, wraps[w], "a straight piece runs through it");
      else if (depth > kNoticed)
        ledger.warn("order " + name + wraps[w].wrap->name, depth,
                    fmt::format("ligament \"{}\" runs {:.1f} mm through \"{}\", but not where that "
                                "comes in the order of its wraps",
                                name, depth, wraps[w].wrap->name));
    }
    if (k > 0)
      note(bend(to - from, touches[k - 1].t_Q), wraps[touches[k - 1].wrap], "leaves it bent");
    if (k == touches.size()) break;
    const TouchAt& touch = touches[k];
    const WrapAt& wrap = wraps[touch.wrap];
    note(bend(to - from, touch.t_P), wrap, "comes to it bent");
    Vector3d x = wrap.own(touch.P), t = wrap.X.R.transpose() * touch.t_P;
    note(std::abs(field_at(wrap.wrap->shape, wrap.larger, x).f), wrap, "the first point is off it");
    follow_geodesic(wrap.wrap->shape, wrap.larger, touch.arc, x, t);
    note((x - wrap.own(touch.Q)).norm(), wrap, "the geodesic ends elsewhere");
    note((t - wrap.X.R.transpose() * touch.t_Q).norm(), wrap, "the geodesic ends otherwise");
    note(std::max(0.0, -touch.arc), wrap, "the arc is negative");
    from = touch.Q;
  }
}

}  // namespace condyle::verification
