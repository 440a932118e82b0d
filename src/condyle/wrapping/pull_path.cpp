#include "condyle/wrapping/pull_path.h"

#include <Eigen/Geometry>

#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/path_revision.h"
#include "condyle/wrapping/solve_chain.h"
#include "condyle/wrapping/unit_pull.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Outcome = WrappedPath::Outcome;

double straight(const PathPose& pose, Wrench* unit) {
  const Vector3d q = pose.X_BA.R * pose.ends.end[1].at;
  const Vector3d d = pose.X_BA.p + q - pose.ends.end[0].at;
  const double L = d.norm();
  if (unit != nullptr && L > 0) {
    const Vector3d e = d / L;
    *unit = pull_at_moving_end(e, (Eigen::Matrix3d::Identity() - e * e.transpose()) / L, q);
  }
  return L;
}

/// The wrap that alone is touched, its end D free of it; -1 where there is none.
int only_one(const PathPose& pose, const PathState& state, int& touched) {
  int one = -1;
  touched = 0;
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    one = i;
    ++touched;
  }
  const bool free = pose.ends.end[1].wrap != one;
  return touched == 1 && free ? one : -1;
}

/// In the frame of the surface; 0 where the path was not found or is not the shortest.
double pull_over_one(const PathPose& pose, int wrap, PathState& state, Wrench* unit) {
  const PathSurface& surface = pose.surfaces[wrap];
  const RigidTransform& X_BA = pose.X_BA;
  const Vector3d &C = pose.ends.end[0].at, &D = pose.ends.end[1].at;
  const Vector3d q = X_BA.R * D, x_D = X_BA.p + q;
  const bool anchored = pose.ends.end[0].wrap == wrap;
  ArcPlace place = state.place(wrap);
  if (anchored) place.P = pose.ends.end[0].anchor;
  const Vector3d X =
      surface.X_SW * (surface.on_A ? Vector3d(X_BA.R.transpose() * (C - X_BA.p)) : C);
  const Vector3d Y = surface.X_SW * (surface.on_A ? D : x_D);
  std::optional<ArcEnd> end = state.end(wrap);
  const OneSurfacePath path = path_over(surface.shape, X, Y, anchored, place, end);
  if (!path.found || !path.shortest) return 0;
  state.touch(wrap, place);
  if (end) state.set_end(wrap, *end);
  state.set(Outcome::kFound, -1, path.B / path.length);
  if (unit == nullptr) return path.length;
  if (surface.on_A) {
    const Eigen::Matrix3d R = X_BA.R * surface.X_WS.R;
    *unit = pull_at_fixed_end(R * path.e_X, R * path.H_XX() * R.transpose(), C - X_BA.p);
  } else {
    const Eigen::Matrix3d& R = surface.X_WS.R;
    *unit = pull_at_moving_end(R * path.e_Y, R * path.H_YY() * R.transpose(), q);
  }
  return path.length;
}

double fail(const PathPose& pose, PathState& state) {
  const PathChain chain = without_links(pose);
  for (int i = 0; i < count(pose); ++i) {
    const bool own = pose.ends.end[0].wrap == i || pose.ends.end[1].wrap == i;
    if (!state.touches(i) || own) continue;
    if (ends_inside(pose.surfaces[i].shape, passing(pose, chain, i))) {
      state.set(Outcome::kEndInside, i, 0);
      return 0;
    }
  }
  int blamed = state.finding().wrap;
  for (int i = count(pose) - 1; i >= 0; --i)
    if (state.touches(i)) blamed = i;
  state.set(Outcome::kNotFound, blamed, 0);
  return 0;
}

double pull_chain(const PathPose& pose, PathState& state, Wrench* unit) {
  PathChain chain = kept_chain(pose, state);
  if (!solve(chain) && !rescue_path(pose, state, chain)) {
    chain = start_path(pose, state);
    if (state.finding().outcome != Outcome::kFound) return fail(pose, state);
  }
  double least = chain.n > 0 ? conjugate(chain) : 1;
  if (least <= 0 && state.finding().outcome != Outcome::kNotShortest && find_shorter(pose, chain))
    least = conjugate(chain);
  keep(chain, state);
  const bool shortest = least > 0;
  state.set(shortest ? Outcome::kFound : Outcome::kNotShortest,
            shortest || chain.n == 0 ? -1 : chain.links[0].wrap, least);
  if (unit != nullptr) *unit = unit_pull(chain, pose.X_BA.p);
  return length(chain);
}

}  // namespace

double pull_path(const PathPose& pose, PathState state, Wrench* unit) {
  if (!state.known() || state.finding().outcome == Outcome::kNotFound) {
    start_path(pose, state);
    if (state.finding().outcome == Outcome::kNotFound) return 0;
  }
  int touched = 0;
  const int one = only_one(pose, state, touched);
  if (touched == 0) return straight(pose, unit);
  if (one >= 0) {
    const double L = pull_over_one(pose, one, state, unit);
    if (L > 0) return L;
  }
  return pull_chain(pose, state, unit);
}

}  // namespace condyle
