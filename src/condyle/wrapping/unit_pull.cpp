#include "condyle/wrapping/unit_pull.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "condyle/wrapping/chain_system.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A motion (da, dπ) of A about a, as its points and what is fixed to them feel it, and of where
/// the path begins and ends on its bodies.
struct Motion {
  Vector3d a, da = Vector3d::Zero(), dpi = Vector3d::Zero();
  Vector3d dX = Vector3d::Zero(), dY = Vector3d::Zero();

  [[nodiscard]] Vector3d of_point(bool on_A, const Vector3d& x) const {
    return on_A ? Vector3d(da + dpi.cross(x - a)) : Vector3d::Zero();
  }
  [[nodiscard]] FrameRate of_frame(bool on_A, const SurfaceFrame& f) const {
    if (!on_A) return {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
    return {of_point(true, f.x), dpi.cross(f.n), dpi.cross(f.b)};
  }
};

/// A point of the path, its body, and how it moves.
struct MovingPoint {
  Vector3d x, dx;
  bool on_A;
};

MovingPoint carried(const Motion& motion, bool on_A, const Vector3d& x) {
  return {x, motion.of_point(on_A, x), on_A};
}
MovingPoint start_of(const PathChain& chain, const Motion& motion) {
  return {chain.X, motion.dX, false};
}
MovingPoint end_of(const PathChain& chain, const Motion& motion) {
  return {chain.Y, motion.of_point(true, chain.Y) + motion.dY, true};
}
MovingPoint point_before(const PathChain& chain, int i, const Motion& motion) {
  return i == 0 ? start_of(chain, motion)
                : carried(motion, chain.links[i - 1].on_A, before(chain, i));
}
MovingPoint point_after(const PathChain& chain, int i, const Motion& motion) {
  return i + 1 == chain.n ? end_of(chain, motion)
                          : carried(motion, chain.links[i + 1].on_A, after(chain, i));
}

/// How the path errors change while the geodesics are carried along by their bodies.
ChainVector carried_errors(const PathChain& chain, const Motion& motion) {
  ChainVector rate = ChainVector::Zero(4 * chain.n);
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    if (!link.starts_here) {
      const MovingPoint from = point_before(chain, i, motion);
      const FrameRate start = motion.of_frame(link.on_A, link.g.from);
      rate.segment<2>(4 * i) =
          error_rate(link.g.from.x - from.x, link.g.from, start.x - from.dx, start);
    } else {
      rate.segment<2>(4 * i) << -motion.dX.dot(link.g.from.b), -motion.dX.dot(link.g.from.t);
    }
    if (!link.ends_here) {
      const MovingPoint to = point_after(chain, i, motion);
      const FrameRate end = motion.of_frame(link.on_A, link.g.to);
      rate.segment<2>(4 * i + 2) = error_rate(to.x - link.g.to.x, link.g.to, to.dx - end.x, end);
    } else {
      rate.segment<2>(4 * i + 2) << -motion.dY.dot(link.g.to.t), -motion.dY.dot(link.g.to.b);
    }
  }
  return rate;
}

/// The pull of the piece from u to v on A, and its change; nothing where both lie on one body.
struct PieceRate {
  Vector3d F = Vector3d::Zero(), M = F, dF = F, dM = F;
};

PieceRate rate_of_piece(const MovingPoint& u, const MovingPoint& v, const Motion& motion) {
  PieceRate rate;
  if (u.on_A == v.on_A) return rate;
  const MovingPoint& on_A = v.on_A ? v : u;
  const double l = (v.x - u.x).norm(), sign = v.on_A ? -1 : 1;
  const Vector3d e = (v.x - u.x) / l, d = v.dx - u.dx, arm = on_A.x - motion.a;
  rate.F = sign * e;
  rate.M = arm.cross(rate.F);
  rate.dF = sign * (d - e.dot(d) * e) / l;
  rate.dM = (on_A.dx - motion.da).cross(rate.F) + arm.cross(rate.dF);
  return rate;
}

void add(const PieceRate& piece, PieceRate& sum) {
  sum.F += piece.F;
  sum.M += piece.M;
  sum.dF += piece.dF;
  sum.dM += piece.dM;
}

/// The pull of the chain and its change, the geodesics following the motion.
PieceRate rate_of_pull(const PathChain& chain,
                       const Eigen::PartialPivLU<ChainMatrix>& lu,
                       const Motion& motion) {
  const ChainVector carried_rate = carried_errors(chain, motion);
  const ChainVector step = -lu.solve(carried_rate);
  PieceRate sum;
  MovingPoint last = start_of(chain, motion);
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    MovingPoint P = carried(motion, link.on_A, link.g.from.x);
    MovingPoint Q = carried(motion, link.on_A, link.g.to.x);
    for (int unknown = 0; unknown < 4; ++unknown) {
      P.dx += step[4 * i + unknown] * start_rate(link.g, unknown).x;
      Q.dx += step[4 * i + unknown] * end_rate(link.g, unknown).x;
    }
    if (!link.starts_here) add(rate_of_piece(last, P, motion), sum);
    last = Q;
  }
  if (chain.n == 0 || !chain.links[chain.n - 1].ends_here)
    add(rate_of_piece(last, end_of(chain, motion), motion), sum);
  return sum;
}

}  // namespace

Wrench unit_pull(const PathChain& chain, const Vector3d& a) {
  const Eigen::PartialPivLU<ChainMatrix> lu(path_error_rates(chain));
  Wrench unit;
  for (int k = 0; k < 6; ++k) {
    Motion motion{a};
    (k < 3 ? motion.da : motion.dpi)[k % 3] = 1;
    const PieceRate rate = rate_of_pull(chain, lu, motion);
    unit.f = rate.F;
    unit.m = rate.M;
    (k < 3 ? unit.F1 : unit.F2).col(k % 3) = rate.dF;
    (k < 3 ? unit.M1 : unit.M2).col(k % 3) = rate.dM;
  }
  return unit;
}

LineRates chain_end_rates(const PathChain& chain, const Vector3d& a) {
  const Eigen::PartialPivLU<ChainMatrix> lu(path_error_rates(chain));
  const ChainLink &first = chain.links[0], &last = chain.links[chain.n - 1];
  LineRates rates;
  rates.of_C.length =
      first.starts_here ? Vector3d(-first.g.from.t) : (chain.X - first.g.from.x).normalized();
  rates.of_D.length = last.ends_here ? last.g.to.t : Vector3d((chain.Y - last.g.to.x).normalized());
  for (int k = 0; k < 6; ++k) {
    Motion motion{a};
    (k < 3 ? motion.dX : motion.dY)[k % 3] = 1;
    const PieceRate rate = rate_of_pull(chain, lu, motion);
    LineEndRates& end = k < 3 ? rates.of_C : rates.of_D;
    end.f.col(k % 3) = rate.dF;
    end.m.col(k % 3) = rate.dM;
  }
  return rates;
}

}  // namespace condyle
