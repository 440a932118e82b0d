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

bool is_convex(const WrapShape& shape) { return !std::holds_alternative<WrapTorus>(shape); }

double straight(const PathPose& pose, Wrench* unit, LastPiece& last) {
  last.rest = 0;
  const Vector3d q = pose.X_BA.R * pose.ends.end[1].at;
  const Vector3d d = pose.X_BA.p + q - pose.ends.end[0].at;
  const double L = d.norm();
  if (unit != nullptr && L > 0) {
    const Vector3d e = d / L;
    *unit = pull_at_moving_end(e, (Eigen::Matrix3d::Identity() - e * e.transpose()) / L, q);
  }
  return L;
}

/// The wrap that alone is touched; -1 where there is none.
int only_one(const PathPose& pose, const PathNumbers& state, int& touched) {
  int one = -1;
  touched = 0;
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    one = i;
    ++touched;
  }
  return touched == 1 ? one : -1;
}

/// The same geodesic run the other way: of its Jacobi fields, whose Wronskian is 1, a and r' change
/// places.
void reverse(const WrapShape& shape, ArcPlace& place, std::optional<ArcEnd>& end) {
  if (!end) {
    const Geodesic g = shoot(shape, frame_at(shape, place.P, place.t), place.arc);
    end = {g.to.x, g.to.t, g.a, g.da, g.r, g.dr};
  }
  const ArcPlace forwards = place;
  place = {end->Q, -end->t, forwards.arc};
  end = {forwards.P, -forwards.t, end->dr, end->da, end->r, end->a, end->size};
}

/// Where the insertion was moved on its body the geodesic ends elsewhere than it did.
void anchor_at(const Vector3d& anchor, ArcPlace& place, std::optional<ArcEnd>& end) {
  if (!((place.P - anchor).squaredNorm() < kTouch * kTouch)) end.reset();
  place.P = anchor;
}

bool has_closed_form(const WrapShape& shape) {
  return std::holds_alternative<WrapSphere>(shape) || std::holds_alternative<WrapCylinder>(shape);
}

/// Its end D, on A, is anchored on the surface: seen from there it is anchored where it begins. 0 as
/// of pull_over_one.
double pull_from_anchor(
    const PathPose& pose, int wrap, PathState& state, Wrench* unit, LastPiece& last, double small) {
  const PathSurface& surface = pose.surfaces[wrap];
  const RigidTransform& X_BA = pose.X_BA;
  const Vector3d& C = pose.ends.end[0].at;
  const Vector3d& X = pose.ends.end[1].anchor;
  const Vector3d Y = surface.X_SW * (X_BA.R.transpose() * (C - X_BA.p));
  ArcPlace place = state.place(wrap);
  std::optional<ArcEnd> end = state.end(wrap);
  reverse(surface.shape, place, end);
  anchor_at(X, place, end);
  const OneSurfacePath path = path_over(surface.shape, X, Y, true, place, end, small);
  if (!path.found || !path.shortest) return 0;
  if (has_closed_form(surface.shape)) end.reset();
  reverse(surface.shape, place, end);
  state.touch(wrap, place);
  state.set_end(wrap, *end);
  state.set(Outcome::kFound, -1, path.B / path.length);
  if (is_convex(surface.shape))
    last = {surface.X_WS * (Y - path.l2 * path.e_Y), surface.X_WS.R * path.n_Q,
            path.length - path.l2};
  if (unit == nullptr) return path.length;
  const Eigen::Matrix3d R = X_BA.R * surface.X_WS.R;
  *unit = pull_at_fixed_end(R * -path.e_Y, path.H_YY(R), C - X_BA.p);
  return path.length;
}

/// In the frame of the surface; 0 where the path was not found or is not the shortest.
double pull_over_one(
    const PathPose& pose, int wrap, PathState& state, Wrench* unit, LastPiece& last, double small) {
  const PathSurface& surface = pose.surfaces[wrap];
  const RigidTransform& X_BA = pose.X_BA;
  const Vector3d &C = pose.ends.end[0].at, &D = pose.ends.end[1].at;
  const Vector3d q = X_BA.R * D, x_D = X_BA.p + q;
  const bool anchored = pose.ends.end[0].wrap == wrap;
  ArcPlace place = state.place(wrap);
  const Vector3d X =
      surface.X_SW * (surface.on_A ? Vector3d(X_BA.R.transpose() * (C - X_BA.p)) : C);
  const Vector3d Y = surface.X_SW * (surface.on_A ? D : x_D);
  std::optional<ArcEnd> end = state.end(wrap);
  if (anchored) anchor_at(pose.ends.end[0].anchor, place, end);
  const OneSurfacePath path = path_over(surface.shape, X, Y, anchored, place, end, small);
  if (!path.found || !path.shortest) return 0;
  state.touch(wrap, place);
  if (end) state.set_end(wrap, *end);
  state.set(Outcome::kFound, -1, path.B / path.length);
  if (is_convex(surface.shape) && surface.on_A)
    last = {surface.X_WS * (X + path.l1 * path.e_X), surface.X_WS.R * path.n,
            path.length - path.l1};
  else if (is_convex(surface.shape))
    last = {surface.X_WS * (Y - path.l2 * path.e_Y), surface.X_WS.R * path.n_Q,
            path.length - path.l2};
  if (unit == nullptr) return path.length;
  if (surface.on_A) {
    const Eigen::Matrix3d R = X_BA.R * surface.X_WS.R;
    *unit = pull_at_fixed_end(R * path.e_X, path.H_XX(R), C - X_BA.p);
  } else {
    const Eigen::Matrix3d& R = surface.X_WS.R;
    *unit = pull_at_moving_end(R * path.e_Y, path.H_YY(R), q);
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

double pull_path(
    const PathPose& pose, PathState state, Wrench* unit, LastPiece& last, double small) {
  if (!state.known() || state.finding().outcome == Outcome::kNotFound) {
    start_path(pose, state);
    if (state.finding().outcome == Outcome::kNotFound) return 0;
  }
  int touched = 0;
  const int one = only_one(pose, state, touched);
  if (touched == 0) {
    // What was said of the surfaces that it lay on before does not hold for a straight line.
    if (state.finding().outcome == Outcome::kNotShortest ||
        state.finding().outcome == Outcome::kFound)
      state.set(Outcome::kFound, -1, 1);
    return straight(pose, unit, last);
  }
  if (one >= 0) {
    const bool from_anchor = pose.ends.end[1].wrap == one;
    const double L = from_anchor ? pull_from_anchor(pose, one, state, unit, last, small)
                                 : pull_over_one(pose, one, state, unit, last, small);
    if (L > 0) return L;
  }
  return pull_chain(pose, state, unit);
}

}  // namespace condyle
