#include "condyle/wrapping/path_start.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/wrapping/chain_system.h"
#include "condyle/wrapping/path_pose.h"
#include "condyle/wrapping/solve_chain.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// What is displaced at first, in full at λ = 1: the surface of link i, and the ends of the path.
struct Displacement {
  int link;
  Vector3d surface, X, Y;
};

/// λ from 1 to 0 with `chain` solved at each; the steps adapt. The chain stands displaced at the start.
bool bring_back(PathChain& chain, const Displacement& by) {
  const Vector3d surface = chain.links[by.link].X_GS.p - by.surface, X = chain.X - by.X,
                 Y = chain.Y - by.Y;
  PathChain solved = chain;
  double lambda = 1, step = 0.25;
  for (int k = 0; k < 80 && lambda > 0; ++k) {
    const double next = std::max(0.0, lambda - step);
    chain.links[by.link].X_GS.p = surface + next * by.surface;
    chain.X = X + next * by.X;
    chain.Y = Y + next * by.Y;
    if (solve(chain, 14)) {
      lambda = next;
      solved = chain;
      step *= 1.5;
    } else {
      chain = solved;
      step *= 0.4;
      if (step < 1e-4) return false;
    }
  }
  return lambda == 0;
}

/// w at right angles to d, unit; nothing where it has no such part.
std::optional<Vector3d> across(const Vector3d& w, const Vector3d& d) {
  const Vector3d part = w - w.dot(d) / d.squaredNorm() * d;
  if (!(part.norm() > 1e-6 * w.norm())) return std::nullopt;
  return part.normalized();
}

/// An anchored link: the path begins in the tangent plane of the anchor, as far off as the next point is
/// below it.
bool insert_anchored(PathChain& chain, int i, const Vector3d& U, const Vector3d& V) {
  ChainLink& link = chain.links[i];
  const Vector3d n = link.X_GS.R * normal_at(*link.shape, link.anchor);
  const Vector3d d = V - U;
  link.P = link.anchor;
  link.t = link.X_GS.R.transpose() * d;
  link.arc = 0;
  const double below = link.starts_here ? -d.dot(n) : d.dot(n);
  const Vector3d aside = -std::max(0.0, below) * n;
  link.X_GS.p += aside;
  return bring_back(chain, {i, aside, Vector3d::Zero(), Vector3d::Zero()});
}

/// From where it touches: free ends beyond which it does are drawn out first, and drawn in when the surface
/// is back.
bool bring_in(
    PathChain& chain, int i, const Vector3d& U, const Vector3d& V, const TouchingLine& line) {
  ChainLink& link = chain.links[i];
  const Vector3d d = V - U;
  link.P = line.point;
  link.t = link.X_GS.R.transpose() * d;
  link.arc = 0;
  const Vector3d aside = -line.shift * (link.X_GS.R * line.w);
  const double beyond_U = std::max(0.0, 0.05 - line.part);
  const double beyond_V = std::max(0.0, line.part - 0.95);
  const bool can_draw_U = i == 0, can_draw_V = i + 1 == chain.n;
  if ((line.part < 0.001 && !can_draw_U) || (line.part > 0.999 && !can_draw_V)) return false;
  const Vector3d draw_X = can_draw_U ? Vector3d(-beyond_U * d) : Vector3d::Zero();
  const Vector3d draw_Y = can_draw_V ? Vector3d(beyond_V * d) : Vector3d::Zero();
  chain.X += draw_X;
  chain.Y += draw_Y;
  link.X_GS.p += aside;
  if (!bring_back(chain, {i, aside, Vector3d::Zero(), Vector3d::Zero()})) return false;
  if (draw_X.isZero(0) && draw_Y.isZero(0)) return true;
  return bring_back(chain, {i, Vector3d::Zero(), draw_X, draw_Y});
}

/// On the side told, else on the nearest, else on the first of eight that leads to a path.
bool insert_free(
    PathChain& chain, int i, const Vector3d& U, const Vector3d& V, const Vector3d* side) {
  const ChainLink& link = chain.links[i];
  const RigidTransform X_SG = link.X_GS.inverse();
  const Vector3d U_S = X_SG * U, V_S = X_SG * V;
  const PathChain untouched = chain;
  const auto come = [&](const std::optional<TouchingLine>& line) {
    if (!line) return false;
    chain = untouched;
    return bring_in(chain, i, U, V, *line);
  };
  if (side != nullptr) {
    const auto w = across(*side, V - U);
    return w && come(touching_line(*link.shape, U_S, V_S, X_SG.R * *w));
  }
  const auto nearest = nearest_touching_line(*link.shape, U_S, V_S);
  if (come(nearest)) return true;
  if (!nearest) return false;
  const Vector3d w2 = (V_S - U_S).normalized().cross(nearest->w);
  for (const int k : {1, -1, 2, -2, 3, -3, 4}) {
    const Vector3d w = std::cos(k * M_PI / 4) * nearest->w + std::sin(k * M_PI / 4) * w2;
    if (come(touching_line(*untouched.links[i].shape, U_S, V_S, w))) return true;
  }
  return false;
}

}  // namespace

bool insert_link(PathChain& chain, const ChainLink& link, const Vector3d* side) {
  const PathChain before_it = chain;
  const RigidTransform placed = link.X_GS;
  const int i = add_link(chain, link);
  const Vector3d U = link.starts_here ? link.X_GS * link.anchor : before(chain, i);
  const Vector3d V = link.ends_here ? link.X_GS * link.anchor : after(chain, i);
  const bool done = link.starts_here || link.ends_here ? insert_anchored(chain, i, U, V)
                                                       : insert_free(chain, i, U, V, side);
  if (!done) {
    chain = before_it;
    return false;
  }
  chain.links[i].X_GS = placed;
  return true;
}

}  // namespace condyle
