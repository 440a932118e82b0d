#include "condyle/scene/ligament_path.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/elements/law_rates.h"
#include "condyle/elements/line_element.h"
#include "condyle/input_error.h"
#include "condyle/scene/scene_place.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

WrapShape thickened(const WrapShape& shape, double by) {
  struct Thicken {
    double by;
    WrapShape operator()(const WrapSphere& s) const { return WrapSphere{s.radius + by}; }
    WrapShape operator()(const WrapCylinder& s) const { return WrapCylinder{s.radius + by}; }
    WrapShape operator()(const WrapEllipsoid& s) const {
      return WrapEllipsoid{s.semi_axes + Eigen::Vector3d::Constant(by)};
    }
    WrapShape operator()(const WrapTorus& s) const { return WrapTorus{s.ring, s.tube + by}; }
  };
  return std::visit(Thicken{by}, shape);
}

/// Deepest that an end may lie in a surface for its path to begin at the closest point of it: half
/// of the least radius.
double most_depth(const WrapShape& shape) {
  struct Least {
    double operator()(const WrapSphere& s) const { return s.radius; }
    double operator()(const WrapCylinder& s) const { return s.radius; }
    double operator()(const WrapEllipsoid& s) const { return s.semi_axes.minCoeff(); }
    double operator()(const WrapTorus& s) const { return s.tube; }
  };
  return std::visit(Least{}, shape) / 2;
}

/// Names of the wraps of its own body in which an end lies.
std::vector<std::string> wraps_around(const std::vector<PathWrap>& wraps,
                                      bool moving,
                                      const Eigen::Vector3d& end) {
  std::vector<std::string> names;
  for (const PathWrap& wrap : wraps)
    if (wrap.on_moving == moving && signed_distance(wrap.shape, wrap.placement.inverse() * end) < 0)
      names.push_back(wrap.name);
  return names;
}

}  // namespace

std::array<Eigen::Vector3d, 2> fixed_then_moving(const Scene& scene,
                                                 const std::array<Attachment, 2>& ends) {
  if (ends[0].body == scene.fixed_body()) return {ends[0].at, ends[1].at};
  return {ends[1].at, ends[0].at};
}

std::vector<PathWrap> path_wraps(const Scene& scene, const LigamentDescription& ligament) {
  std::vector<PathWrap> wraps;
  for (std::size_t i = 0; i < ligament.path.wraps.size(); ++i) {
    const WrapDescription& wrap = scene.wraps[static_cast<std::size_t>(ligament.path.wraps[i])];
    PathWrap& last = wraps.emplace_back();
    last.name = wrap.name;
    last.shape = thickened(wrap.shape, ligament.path.thickness / 2);
    last.placement = wrap.placement;
    last.on_moving = wrap.body == scene.moving_body();
    if (wrap.fit) last.side = wrap.fit->side;
    if (!ligament.path.sides.empty()) last.side = ligament.path.sides[i];
  }
  if (ligament.ends[0].body != scene.fixed_body()) std::reverse(wraps.begin(), wraps.end());
  return wraps;
}

int wrap_on_path(const Scene& scene, const LigamentDescription& ligament, int k) {
  const std::vector<int>& wraps = ligament.path.wraps;
  const auto index = static_cast<std::size_t>(k);
  const bool forward = ligament.ends[0].body == scene.fixed_body();
  return wraps[forward ? index : wraps.size() - 1 - index];
}

std::shared_ptr<const WrappedPath> ligament_path(const Scene& scene,
                                                 const LigamentDescription& ligament,
                                                 const BodyOrigins& origins) {
  if (ligament.path.wraps.empty()) return nullptr;
  std::vector<PathWrap> wraps = path_wraps(scene, ligament);
  for (PathWrap& wrap : wraps) {
    const Eigen::Vector3d& origin = wrap.on_moving ? origins.A : origins.B;
    wrap.placement.p -= origin;
    if (wrap.side) *wrap.side -= origin;
  }
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  return make_wrapped_path(
      std::move(wraps), x_C - origins.B, s_D - origins.A,
      ligament.path.anchors_inside ? InsideRule::kAnchor : InsideRule::kStraight);
}

bool has_known_path(const Scene& scene, const LigamentDescription& ligament) {
  return std::all_of(ligament.path.wraps.begin(), ligament.path.wraps.end(), [&](int index) {
    const WrapDescription& wrap = scene.wraps[static_cast<std::size_t>(index)];
    return !wrap.fit || wrap.fit->done;
  });
}

StartPath start_path(const Scene& scene, const LigamentDescription& ligament) {
  const RigidTransform start = start_pose(scene);
  if (ligament.path.wraps.empty()) return {distance_between(scene, ligament.ends, start), {}, {}};
  const std::vector<PathWrap> wraps = path_wraps(scene, ligament);
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  if (ligament.path.anchors_inside) {
    for (const auto& [moving, at] : {std::pair{false, x_C}, {true, s_D}}) {
      const std::vector<std::string> around = wraps_around(wraps, moving, at);
      if (around.size() > 1)
        return {0, "ends",
                fmt::format("an end inside one wrap at most (it lies in \"{}\" and \"{}\")",
                            around[0], around[1])};
    }
    for (const InsideEnd& end : inside_ends(wraps, x_C, s_D)) {
      if (end.wrap < 0) continue;
      const PathWrap& wrap = wraps[static_cast<std::size_t>(end.wrap)];
      if (end.depth > most_depth(wrap.shape))
        return {0, "ends",
                fmt::format("an end outside wrap \"{}\" or close under its surface (it lies {:.3g} "
                            "mm inside)",
                            wrap.name, end.depth)};
    }
  }
  const double length = ligament_length(scene, ligament, start);
  if (!(length > 0) && !ligament.path.sides.empty()) {
    LigamentDescription either = ligament;
    either.path.sides.clear();
    if (ligament_length(scene, either, start) > 0)
      return {0, "side",
              "points on whose sides of the wraps there is a shortest path at the start pose, as "
              "there is without"};
  }
  if (!(length > 0))
    return {0, "wraps", "wraps around which there is a shortest path at the start pose"};
  return {length, {}, {}};
}

std::string start_path_objection(const Scene& scene, const LigamentDescription& ligament) {
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  return path_objection({x_C, s_D, ligament.law, ligament_path(scene, ligament)},
                        start_pose(scene));
}

void settle_fitted_paths(Scene& scene) {
  for (LigamentDescription& ligament : scene.ligaments) {
    const std::vector<int>& wraps = ligament.path.wraps;
    const bool fitted = std::any_of(wraps.begin(), wraps.end(), [&](int index) {
      return scene.wraps[static_cast<std::size_t>(index)].fit.has_value();
    });
    if (!fitted) continue;
    const StartPath start = start_path(scene, ligament);
    if (!start.key.empty())
      throw InputError(
          fmt::format("{}: {}: expected {}", place_of(scene, ligament), start.key, start.expected));
    if (!ligament.reference_strain) continue;
    const std::string objection = start_path_objection(scene, ligament);
    if (!objection.empty())
      throw InputError(fmt::format(
          "{}: reference_strain: expected slack_length in its place: at the start pose {}",
          place_of(scene, ligament), objection));
    set_slack_length(ligament.law, start.length / (1 + *ligament.reference_strain));
  }
}

double ligament_length(const Scene& scene,
                       const LigamentDescription& ligament,
                       const RigidTransform& X_BA) {
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  const LineElement element{x_C, s_D, ligament.law, ligament_path(scene, ligament)};
  return line_element_state(element, X_BA).length;
}

}  // namespace condyle
