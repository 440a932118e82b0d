#include "condyle/wrapping/path_pose.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

RigidTransform placed(const PathPose& pose, int i) {
  const PathSurface& surface = pose.surfaces[i];
  return surface.on_A ? pose.X_BA * surface.X_WS : surface.X_WS;
}

/// Most ends lie outside, which is told at less cost than how far.
bool is_inside(const WrapShape& shape, const Vector3d& x) {
  const auto* ellipsoid = std::get_if<WrapEllipsoid>(&shape);
  if (ellipsoid != nullptr && x.cwiseQuotient(ellipsoid->semi_axes).squaredNorm() >= 1)
    return false;
  return signed_distance(shape, x) < -kTouch;
}

}  // namespace

ChainLink link_of(const PathPose& pose, int i) {
  ChainLink link;
  link.wrap = i;
  link.shape = &pose.surfaces[i].shape;
  link.on_A = pose.surfaces[i].on_A;
  link.X_GS = placed(pose, i);
  link.starts_here = pose.ends.end[0].wrap == i;
  link.ends_here = pose.ends.end[1].wrap == i;
  if (link.starts_here) link.anchor = pose.ends.end[0].anchor;
  if (link.ends_here) link.anchor = pose.ends.end[1].anchor;
  return link;
}

PathChain without_links(const PathPose& pose) {
  PathChain chain;
  chain.X = pose.ends.end[0].at;
  chain.Y = pose.X_BA * pose.ends.end[1].at;
  return chain;
}

PathChain kept_chain(const PathPose& pose, const PathNumbers& state) {
  PathChain chain = without_links(pose);
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    ChainLink& link = chain.links[chain.n++];
    link = link_of(pose, i);
    const ArcPlace place = state.place(i);
    link.P = link.starts_here ? link.anchor : place.P;
    link.t = place.t;
    link.arc = place.arc;
  }
  return chain;
}

void keep(const PathChain& chain, PathState& state) {
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    state.touch(link.wrap, {link.P, link.t, link.arc});
  }
}

int link_on(const PathChain& chain, int wrap) {
  for (int i = 0; i < chain.n; ++i)
    if (chain.links[i].wrap == wrap) return i;
  return -1;
}

int add_link(PathChain& chain, const ChainLink& link) {
  int i = 0;
  while (i < chain.n && chain.links[i].wrap < link.wrap) ++i;
  for (int k = chain.n; k > i; --k) chain.links[k] = chain.links[k - 1];
  chain.links[i] = link;
  ++chain.n;
  return i;
}

void remove_link(PathChain& chain, int i) {
  for (int k = i; k + 1 < chain.n; ++k) chain.links[k] = chain.links[k + 1];
  --chain.n;
}

Passing passing(const PathPose& pose, const PathChain& chain, int wrap) {
  int i = 0;
  while (i < chain.n && chain.links[i].wrap < wrap) ++i;
  const Vector3d U = i == 0 ? chain.X : chain.links[i - 1].g.to.x;
  const Vector3d V = i == chain.n ? chain.Y : chain.links[i].g.from.x;
  const RigidTransform X_SG = placed(pose, wrap).inverse();
  return {X_SG * U, X_SG * V, i == 0, i == chain.n};
}

bool ends_inside(const WrapShape& shape, const Passing& line) {
  return (line.from_C && is_inside(shape, line.U)) || (line.to_D && is_inside(shape, line.V));
}

}  // namespace condyle
