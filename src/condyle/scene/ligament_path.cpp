#include "condyle/scene/ligament_path.h"

#include <algorithm>

#include "condyle/elements/line_element.h"

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

double ligament_length(const Scene& scene,
                       const LigamentDescription& ligament,
                       const RigidTransform& X_BA) {
  const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
  const LineElement element{x_C, s_D, ligament.law, ligament_path(scene, ligament)};
  return line_element_state(element, X_BA).length;
}

}  // namespace condyle
