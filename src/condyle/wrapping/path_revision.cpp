#include "condyle/wrapping/path_revision.h"

#include <Eigen/Geometry>

#include "condyle/wrapping/chain_system.h"
#include "condyle/wrapping/path_start.h"
#include "condyle/wrapping/solve_chain.h"
#include "condyle/wrapping/swept_string.h"
#include "condyle/wrapping/touching_line.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Outcome = WrappedPath::Outcome;

/// The path goes over a surface at a place; false where it does not stay there.
bool lay_on(const PathPose& pose, PathChain& chain, int wrap, const ArcPlace& place) {
  PathChain laid = chain;
  ChainLink link = link_of(pose, wrap);
  link.P = place.P;
  link.t = place.t;
  link.arc = place.arc;
  const int at = add_link(laid, link);
  if (!solve(laid) || !(laid.links[at].arc > kTouch) || !(conjugate(laid) > 0)) return false;
  chain = laid;
  return true;
}

/// The path comes to lie on a surface on the straight way since the statuses were last revised, and does so still
/// where it passes `height` over it now [mm]. The chain goes over it then.
bool hangs_on(const PathPose& pose,
              PathChain& chain,
              int wrap,
              const PathState& state,
              const Passing& line,
              double height) {
  const std::optional<StraightPiece> before = state.line(wrap);
  const StraightPiece now{line.U, line.V};
  if (!before || comes_clear(*before, now, height)) return false;
  const std::optional<ArcPlace> place = swept_onto(pose.surfaces[wrap].shape, *before, now);
  return place && lay_on(pose, chain, wrap, *place);
}

/// How often a line with corners goes through the hole of a ring: it crosses the disc that the middle circle
/// bounds, upwards counted as 1, downwards as -1.
template <std::size_t n>
int times_through(const WrapTorus& ring, const std::array<Vector3d, n>& corners) {
  int times = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const Vector3d &a = corners[k], &b = corners[k + 1];
    if ((a.z() < 0) == (b.z() < 0)) continue;
    const Vector3d x = a + a.z() / (a.z() - b.z()) * (b - a);
    if (x.head<2>().norm() < ring.ring) times += a.z() < 0 ? 1 : -1;
  }
  return times;
}

/// The shortest of the paths over a ring, looked for in all directions, that go through its hole so many times.
/// False where there is none; then the chain is as it was.
bool lay_through(const PathPose& pose, PathChain& chain, int wrap, int times) {
  constexpr int kWays = 16;
  const auto& ring = std::get<WrapTorus>(pose.surfaces[wrap].shape);
  const ChainLink link = link_of(pose, wrap);
  const Passing line = passing(pose, chain, wrap);
  const Vector3d d = (link.X_GS.R * (line.V - line.U)).normalized(), u = d.unitOrthogonal(),
                 v = d.cross(u);
  PathChain best = chain;
  for (int k = 0; k < kWays; ++k) {
    const double angle = 2 * M_PI * k / kWays;
    const Vector3d side = std::cos(angle) * u + std::sin(angle) * v;
    PathChain trial = chain;
    if (!insert_link(trial, link, &side)) continue;
    const ChainLink& laid = trial.links[link_on(trial, wrap)];
    const RigidTransform X_SG = laid.X_GS.inverse();
    const Geodesic half = shoot(*laid.shape, frame_at(*laid.shape, laid.P, laid.t), laid.arc / 2);
    const bool stays =
        laid.arc > kTouch && conjugate(trial) > 0 &&
        times_through<5>(ring, {line.U, laid.P, half.to.x, X_SG * laid.g.to.x, line.V}) == times;
    if (stays && (best.n == chain.n || length(trial) < length(best))) best = trial;
  }
  if (best.n == chain.n) return false;
  chain = best;
  return true;
}

/// The path leaves a surface that it would have to pull at. Through a ring it goes as often as before, if it can.
void leave(const PathPose& pose, PathChain& chain, int at, PathState& state) {
  const ChainLink link = chain.links[at];
  const Vector3d n = normal_at(*link.shape, link.P);
  remove_link(chain, at);
  if (!solve(chain)) {
    state.leave(link.wrap, n);
    return state.set(Outcome::kNotFound, link.wrap, 0);
  }
  const Passing line = passing(pose, chain, link.wrap);
  state.leave(link.wrap, n, StraightPiece{line.U, line.V});
  const auto* ring = std::get_if<WrapTorus>(link.shape);
  if (ring == nullptr || link.starts_here || link.ends_here || ends_inside(*link.shape, line))
    return;
  const Geodesic half = shoot(*link.shape, frame_at(*link.shape, link.P, link.t), link.arc / 2);
  const Vector3d Q = link.X_GS.inverse() * link.g.to.x;
  const int times = times_through<5>(*ring, {line.U, link.P, half.to.x, Q, line.V});
  const bool clear = clearance(*link.shape, line.U, line.V) > -kTouch;
  if (clear && times_through<2>(*ring, {line.U, line.V}) == times) return;
  if (lay_through(pose, chain, link.wrap, times)) keep(chain, state);
}

/// How high the path passes over a surface that it does not touch; less than 0 where it has to come to it.
/// The chain goes over it already where it hangs on it.
double height(const PathPose& pose, PathChain& chain, int wrap, PathState& state, bool first) {
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
  double part = 0;
  const double g = clearance(surface.shape, line.U, line.V, &part);
  const bool told = first && surface.side;
  if (g < -kTouch && hangs_on(pose, chain, wrap, state, line, g)) return g;
  if (g > kTouch && !told && !hangs_on(pose, chain, wrap, state, line, g))
    state.leave(wrap, normal_at(surface.shape, line.U + part * (line.V - line.U)),
                StraightPiece{line.U, line.V});
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
  return touching && touching->shift > kTouch && touching->part > 0 && touching->part < 1;
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
    leave(pose, chain, leaves, state);
    return true;
  }
  int comes = -1;
  double deepest = -kTouch;
  for (int wrap = 0; wrap < count(pose); ++wrap) {
    if (pose.ends.passed_over[wrap] || link_on(chain, wrap) >= 0) continue;
    double g = height(pose, chain, wrap, state, first);
    if (link_on(chain, wrap) >= 0) {
      keep(chain, state);
      return true;
    }
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

bool has_lone_convex(const PathPose& pose) {
  return count(pose) == 1 && !std::holds_alternative<WrapTorus>(pose.surfaces[0].shape);
}

/// A lone convex surface that the path, straight from end to end, passes; no end is anchored on it.
std::optional<Passing> passes_lone_convex(const PathPose& pose, const PathNumbers& state) {
  if (!has_lone_convex(pose) || state.touches(0)) return std::nullopt;
  if (pose.ends.end[0].wrap >= 0 || pose.ends.end[1].wrap >= 0) return std::nullopt;
  const PathSurface& surface = pose.surfaces[0];
  const Vector3d &C = pose.ends.end[0].at, &D = pose.ends.end[1].at;
  const RigidTransform& X = pose.X_BA;
  if (!surface.on_A) return Passing{surface.X_SW * C, surface.X_SW * (X * D), true, true};
  return Passing{surface.X_SW * (X.R.transpose() * (C - X.p)), surface.X_SW * D, true, true};
}

/// Nothing changes of a path that stays off its lone surface.
bool stays_off(const PathPose& pose, const Passing& line, PathState& state) {
  if (pose.ends.passed_over[0]) return true;
  const WrapShape& shape = pose.surfaces[0].shape;
  if (state.finding().outcome != Outcome::kFound || ends_inside(shape, line)) return false;
  double part = 0;
  const double height = clearance(shape, line.U, line.V, &part);
  const StraightPiece now{line.U, line.V};
  if (height > kTouch) {
    const std::optional<StraightPiece> before = state.line(0);
    if (before && !comes_clear(*before, now, height) && swept_onto(shape, *before, now))
      return false;
    state.leave(0, normal_at(shape, line.U + part * (line.V - line.U)), now);
  }
  return height >= -kTouch;
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
  for (int i = 0; i < chain.n; ++i)
    if (chain.links[i].arc < -kTouch) state.set(Outcome::kNotFound, chain.links[i].wrap, 0);
  const int through = runs_through(chain);
  if (through >= 0) state.set(Outcome::kNotFound, through, 0);
  return changed;
}

}  // namespace

int surface_run_through(const PathPose& pose, const PathNumbers& state) {
  constexpr double kDeep = -1e-7;                            // [mm]
  if (has_lone_convex(pose) && state.touches(0)) return -1;  // lines that touch it do not run in
  if (const std::optional<Passing> line = passes_lone_convex(pose, state)) {
    if (pose.ends.passed_over[0]) return -1;
    return clearance(pose.surfaces[0].shape, line->U, line->V) < kDeep ? 0 : -1;
  }
  PathChain chain = kept_chain(pose, state);
  if (!solve(chain)) return -1;
  for (int wrap = 0; wrap < count(pose); ++wrap) {
    const WrapShape& shape = pose.surfaces[wrap].shape;
    // A line that leaves an anchor does not come back to a convex surface.
    const bool leaves = (pose.ends.end[0].wrap == wrap || pose.ends.end[1].wrap == wrap) &&
                        !std::holds_alternative<WrapTorus>(shape);
    if (pose.ends.passed_over[wrap] || leaves || link_on(chain, wrap) >= 0) continue;
    const Passing line = passing(pose, chain, wrap);
    if (clearance(shape, line.U, line.V) < kDeep) return wrap;
  }
  return runs_through(chain);
}

PathChain start_path(const PathPose& pose, PathState& state) {
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

bool rescue_path(const PathPose& pose, PathState& state, PathChain& chain) {
  chain = without_links(pose);
  for (int i = 0; i < count(pose); ++i) {
    if (!state.touches(i)) continue;
    const Vector3d side = normal_at(pose.surfaces[i].shape, state.place(i).P);
    if (!insert(pose, chain, i, side)) return false;
  }
  return true;
}

bool revise_path(const PathPose& pose, PathState state) {
  if (!state.known()) return false;
  // Of a lone convex surface that is touched the last pull knows all: it stays while its arc is not
  // negative.
  if (has_lone_convex(pose) && state.touches(0) && state.finding().outcome == Outcome::kFound &&
      state.place(0).arc >= -kTouch)
    return false;
  if (const std::optional<Passing> line = passes_lone_convex(pose, state))
    if (stays_off(pose, *line, state)) return false;
  PathChain chain = kept_chain(pose, state);
  if (!solve(chain)) return false;
  if (state.finding().outcome != Outcome::kNotShortest)
    state.set(Outcome::kFound, -1, state.finding().conjugate);
  const bool changed = settle(pose, chain, state, false);
  keep(chain, state);
  return changed;
}

}  // namespace condyle
