#include "condyle/wrapping/path_revision.h"

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/wrapping/chain_system.h"
#include "condyle/wrapping/path_start.h"
#include "condyle/wrapping/solve_chain.h"
#include "condyle/wrapping/unit_pull.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Outcome = WrappedPath::Outcome;

/// Depths and arcs below it are round-off [mm].
constexpr double kTouch = 1e-10;

int count(const PathPose& pose) { return static_cast<int>(pose.surfaces.size()); }

RigidTransform placed(const PathPose& pose, int i) {
  const PathSurface& surface = pose.surfaces[i];
  return surface.on_A ? pose.X_BA * surface.X_WS : surface.X_WS;
}

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

/// The links that are touched, as they were kept.
PathChain kept_chain(const PathPose& pose, const PathState& state) {
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

void remove_link(PathChain& chain, int i) {
  for (int k = i; k + 1 < chain.n; ++k) chain.links[k] = chain.links[k + 1];
  --chain.n;
}

/// The straight piece that passes a surface it does not touch, frame of the surface; and whether its ends
/// are ends of the path.
struct Passing {
  Vector3d U, V;
  bool from_C, to_D;
};

Passing passing(const PathPose& pose, const PathChain& chain, int wrap) {
  int i = 0;
  while (i < chain.n && chain.links[i].wrap < wrap) ++i;
  const Vector3d U = i == 0 ? chain.X : chain.links[i - 1].g.to.x;
  const Vector3d V = i == chain.n ? chain.Y : chain.links[i].g.from.x;
  const RigidTransform X_SG = placed(pose, wrap).inverse();
  return {X_SG * U, X_SG * V, i == 0, i == chain.n};
}

bool ends_inside(const WrapShape& shape, const Passing& line) {
  return (line.from_C && signed_distance(shape, line.U) < -kTouch) ||
         (line.to_D && signed_distance(shape, line.V) < -kTouch);
}

/// How high the path passes over a surface that it does not touch; less than 0 where it has to come to it.
double height(
    const PathPose& pose, const PathChain& chain, int wrap, PathState& state, bool first) {
  const PathSurface& surface = pose.surfaces[wrap];
  const Passing line = passing(pose, chain, wrap);
  if (ends_inside(surface.shape, line)) {
    state.set(Outcome::kEndInside, wrap, 0);
    return 0;
  }
  for (int end = 0; end < 2; ++end) {
    if (pose.ends.end[end].wrap != wrap) continue;
    const Vector3d& P0 = pose.ends.end[end].anchor;
    return ((end == 0 ? line.V : line.U) - P0).dot(normal_at(surface.shape, P0));
  }
  double foot = 0;
  const double g = clearance(surface.shape, line.U, line.V, &foot);
  const bool told = first && surface.side;
  if (g > kTouch && !told)
    state.leave(wrap, normal_at(surface.shape, line.U + foot * (line.V - line.U)));
  return g;
}

/// Nothing is known of the path and the side that was given lies beyond the surface.
bool passes_on_the_other_side(const PathPose& pose, const PathChain& chain, int wrap) {
  const PathSurface& surface = pose.surfaces[wrap];
  if (!surface.side || std::holds_alternative<WrapTorus>(surface.shape)) return false;
  const Passing line = passing(pose, chain, wrap);
  if (ends_inside(surface.shape, line)) return false;
  const Vector3d d = line.V - line.U;
  const Vector3d w = *surface.side - surface.side->dot(d) / d.squaredNorm() * d;
  if (!(w.norm() > 1e-3)) return false;
  const auto touching = touching_line(surface.shape, line.U, line.V, w.normalized());
  return touching && touching->shift > kTouch && touching->foot > 0 && touching->foot < 1;
}

/// The side on which it passed last, else the one that was given; where the shortest way out is on that side,
/// that.
bool insert(const PathPose& pose, PathChain& chain, int wrap, const Vector3d& passed) {
  const PathSurface& surface = pose.surfaces[wrap];
  const ChainLink link = link_of(pose, wrap);
  Vector3d side = passed;
  const bool has_passed = passed.squaredNorm() > 0.5;
  if (!has_passed && surface.side) side = *surface.side;
  const bool has_side = has_passed || surface.side.has_value();
  const Vector3d side_G = link.X_GS.R * side;
  if (!has_side) return insert_link(chain, link, nullptr);
  if (has_passed) {
    PathChain nearest = chain;
    if (insert_link(nearest, link, nullptr)) {
      const ChainLink& found = nearest.links[link_on(nearest, wrap)];
      if (found.g.from.n.dot(side_G) > 0) {
        chain = nearest;
        return true;
      }
    }
  }
  return insert_link(chain, link, &side_G);
}

/// One surface that is left or come to; false where there is none.
bool change_one(const PathPose& pose, PathChain& chain, PathState& state, bool first) {
  int leaves = -1;
  for (int i = 0; i < chain.n; ++i)
    if (chain.links[i].arc < -kTouch &&
        (leaves < 0 || chain.links[i].arc < chain.links[leaves].arc))
      leaves = i;
  if (leaves >= 0) {
    const ChainLink& link = chain.links[leaves];
    state.leave(link.wrap, normal_at(*link.shape, link.P));
    remove_link(chain, leaves);
    if (!solve(chain)) state.set(Outcome::kNotFound, link.wrap, 0);
    return true;
  }
  int comes = -1;
  double deepest = -kTouch;
  for (int wrap = 0; wrap < count(pose); ++wrap) {
    if (pose.ends.passed_over[wrap] || link_on(chain, wrap) >= 0) continue;
    double g = height(pose, chain, wrap, state, first);
    if (first && g > -kTouch && passes_on_the_other_side(pose, chain, wrap)) g = -1;
    if (g < deepest) {
      deepest = g;
      comes = wrap;
    }
  }
  if (comes < 0) return false;
  if (!insert(pose, chain, comes, state.side(comes))) {
    state.set(Outcome::kNotFound, comes, 0);
    return false;
  }
  keep(chain, state);
  return true;
}

/// A torus that one straight piece of a path over it runs through again, if any.
int runs_through(const PathChain& chain) {
  constexpr double kDeep = -1e-7;
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    if (!std::holds_alternative<WrapTorus>(*link.shape)) continue;
    const RigidTransform X_SG = link.X_GS.inverse();
    const auto deep = [&](const Vector3d& U, const Vector3d& V) {
      return clearance(*link.shape, X_SG * U, X_SG * V) < kDeep;
    };
    if (!link.starts_here && deep(before(chain, i), link.g.from.x)) return link.wrap;
    if (!link.ends_here && deep(link.g.to.x, after(chain, i))) return link.wrap;
  }
  return -1;
}

/// Until nothing changes, in as many changes at most as there are ways to.
bool settle(const PathPose& pose, PathChain& chain, PathState& state, bool first) {
  bool changed = false;
  for (int k = 0; k < 2 * count(pose) + 2; ++k) {
    if (!change_one(pose, chain, state, first && k <= count(pose))) break;
    changed = true;
    if (state.finding().outcome == Outcome::kNotFound) break;
  }
  const int through = runs_through(chain);
  if (through >= 0) state.set(Outcome::kNotFound, through, 0);
  return changed;
}

/// Statuses and path anew; `state` may hold the sides passed.
PathChain start(const PathPose& pose, PathState& state) {
  PathChain chain = without_links(pose);
  const bool known = state.known();
  for (int i = 0; i < count(pose); ++i) {
    const Vector3d side = !known             ? Vector3d::Zero()
                          : state.touches(i) ? normal_at(pose.surfaces[i].shape, state.place(i).P)
                                             : state.side(i);
    state.leave(i, side);
  }
  state.set(Outcome::kFound, -1, 1);
  settle(pose, chain, state, !known);
  keep(chain, state);
  return chain;
}

/// Another path near one that is stationary but not the shortest: starts from sides turned about the line.
bool find_shorter(const PathPose& pose, PathChain& chain) {
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    if (link.starts_here || link.ends_here) continue;
    const Vector3d U = before(chain, i), V = after(chain, i), axis = (V - U).normalized();
    PathChain rest = chain;
    remove_link(rest, i);
    if (!solve(rest)) continue;
    for (const double angle : {0.4, -0.4, 0.8, -0.8, 1.2, -1.2, 1.6, -1.6}) {
      const Vector3d side = Eigen::AngleAxisd(angle, axis) * link.g.from.n;
      PathChain other = rest;
      if (insert_link(other, link_of(pose, link.wrap), &side) && conjugate(other) > 0 &&
          length(other) < length(chain)) {
        chain = other;
        return true;
      }
    }
  }
  return false;
}

/// The statuses held; each link from scratch.
bool rescue(const PathPose& pose, PathState& state, PathChain& chain) {
  chain = without_links(pose);
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    const Vector3d side = normal_at(pose.surfaces[i].shape, state.place(i).P);
    if (!insert(pose, chain, i, side)) return false;
  }
  return true;
}

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

/// The wrap that alone is touched, both ends of the path being free of it; -1 where there is none.
int only_free_one(const PathPose& pose, const PathState& state, int& touched) {
  int one = -1;
  touched = 0;
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    one = i;
    ++touched;
  }
  const bool free = pose.ends.end[0].wrap != one && pose.ends.end[1].wrap != one;
  return touched == 1 && free ? one : -1;
}

/// In the frame of the surface; 0 where the path was not found or is not the shortest.
double pull_over_one(const PathPose& pose, int wrap, PathState& state, Wrench* unit) {
  const PathSurface& surface = pose.surfaces[wrap];
  const RigidTransform& X_BA = pose.X_BA;
  const Vector3d &C = pose.ends.end[0].at, &D = pose.ends.end[1].at;
  const Vector3d q = X_BA.R * D, x_D = X_BA.p + q;
  ArcPlace place = state.place(wrap);
  const Vector3d X =
      surface.X_SW * (surface.on_A ? Vector3d(X_BA.R.transpose() * (C - X_BA.p)) : C);
  const Vector3d Y = surface.X_SW * (surface.on_A ? D : x_D);
  std::optional<ArcEnd> end = state.end(wrap);
  const OneSurfacePath path = path_over(surface.shape, X, Y, place, end);
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
  if (!solve(chain) && !rescue(pose, state, chain)) {
    chain = start(pose, state);
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
    start(pose, state);
    if (state.finding().outcome == Outcome::kNotFound) return 0;
  }
  int touched = 0;
  const int one = only_free_one(pose, state, touched);
  if (touched == 0) return straight(pose, unit);
  if (one >= 0) {
    const double L = pull_over_one(pose, one, state, unit);
    if (L > 0) return L;
  }
  return pull_chain(pose, state, unit);
}

bool revise_path(const PathPose& pose, PathState state) {
  if (!state.known()) return false;
  PathChain chain = kept_chain(pose, state);
  if (!solve(chain)) return false;
  if (state.finding().outcome != Outcome::kNotShortest)
    state.set(Outcome::kFound, -1, state.finding().conjugate);
  const bool changed = settle(pose, chain, state, false);
  keep(chain, state);
  return changed;
}

}  // namespace condyle
