#include "condyle/wrapping/chain_system.h"

namespace condyle {

using Eigen::Vector2d;
using Eigen::Vector3d;

FrameRate start_rate(const Geodesic& g, int k) {
  const SurfaceFrame& f = g.from;
  if (k == 0) return {Vector3d::Zero(), Vector3d::Zero(), -f.t};
  if (k == 1) return {f.b, -f.tau * f.t - f.kappa_b * f.b, f.kappa_b * f.n};
  if (k == 2) return {f.t, -f.kappa * f.t - f.tau * f.b, f.tau * f.n};
  return {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
}

FrameRate end_rate(const Geodesic& g, int k) {
  const SurfaceFrame& f = g.to;
  if (k >= 2) return {f.t, -f.kappa * f.t - f.tau * f.b, f.tau * f.n};
  const double y = k == 0 ? g.r : g.a, dy = k == 0 ? g.dr : g.da;
  return {y * f.b, -y * (f.tau * f.t + f.kappa_b * f.b), -dy * f.t + f.kappa_b * y * f.n};
}

ChainVector path_errors(const PathChain& chain) {
  ChainVector rho(4 * chain.n);
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    const Vector3d d1 = link.g.from.x - before(chain, i), d2 = after(chain, i) - link.g.to.x;
    if (link.starts_here)
      rho.segment<2>(4 * i).setZero();
    else
      rho.segment<2>(4 * i) << d1.dot(link.g.from.n) / d1.norm(), d1.dot(link.g.from.b);
    if (link.ends_here) {
      const Vector3d off = link.g.to.x - link.X_GS * link.anchor;
      rho.segment<2>(4 * i + 2) << off.dot(link.g.to.t), off.dot(link.g.to.b);
    } else {
      rho.segment<2>(4 * i + 2) << d2.dot(link.g.to.n) / d2.norm(), d2.dot(link.g.to.b);
    }
  }
  return rho;
}

ChainMatrix path_error_rates(const PathChain& chain) {
  ChainMatrix J = ChainMatrix::Zero(4 * chain.n, 4 * chain.n);
  const FrameRate still{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < chain.n; ++i) {
    const ChainLink& link = chain.links[i];
    const Geodesic& g = link.g;
    const Vector3d d1 = g.from.x - before(chain, i), d2 = after(chain, i) - g.to.x;
    for (int k = 0; k < 4; ++k) {
      const int column = 4 * i + k;
      const FrameRate start = start_rate(g, k), end = end_rate(g, k);
      if (!link.starts_here) {
        J.block<2, 1>(4 * i, column) = error_rate(d1, g.from, start.x, start);
        if (i > 0) {
          const Vector3d dd = -end_rate(chain.links[i - 1].g, k).x;
          J.block<2, 1>(4 * i, column - 4) = error_rate(d1, g.from, dd, still);
        }
      }
      if (link.ends_here) {
        J.block<2, 1>(4 * i + 2, column) = Vector2d(end.x.dot(g.to.t), end.x.dot(g.to.b));
      } else {
        J.block<2, 1>(4 * i + 2, column) = error_rate(d2, g.to, -end.x, end);
        if (i + 1 < chain.n) {
          const Vector3d dd = start_rate(chain.links[i + 1].g, k).x;
          J.block<2, 1>(4 * i + 2, column + 4) = error_rate(d2, g.to, dd, still);
        }
      }
    }
    if (link.starts_here) J(4 * i, 4 * i + 1) = J(4 * i + 1, 4 * i + 2) = 1;
  }
  return J;
}

}  // namespace condyle
