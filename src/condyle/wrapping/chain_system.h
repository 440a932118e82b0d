#pragma once

/// Path errors of a chain and their derivatives: of each link, with d1 from what is before to P and d2
/// from Q to what follows,
///     ρ1 = d1.n/l1    ρ2 = d1.b    ρ3 = d2.n_Q/l2    ρ4 = d2.b_Q
/// and where the path starts on a link its P stays, where it ends on one its Q is the anchor.

#include <Eigen/LU>

#include "condyle/wrapping/path_chain.h"

namespace condyle {

inline constexpr int kMostUnknowns = 4 * kMostWraps;
using ChainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;
using ChainMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;

/// How a point moves and its normal and binormal turn.
struct FrameRate {
  Eigen::Vector3d x, n, b;
};

/// By the unknown k of a link (0 turn, 1 shift along b, 2 along t, 3 arc), at its start and its end.
[[nodiscard]] FrameRate start_rate(const Geodesic& g, int k);
[[nodiscard]] FrameRate end_rate(const Geodesic& g, int k);

/// Where the piece before link i begins, and where the piece after it ends.
[[nodiscard]] inline const Eigen::Vector3d& before(const PathChain& c, int i) {
  return i == 0 ? c.X : c.links[i - 1].g.to.x;
}
[[nodiscard]] inline const Eigen::Vector3d& after(const PathChain& c, int i) {
  return i + 1 == c.n ? c.Y : c.links[i + 1].g.from.x;
}

/// Change of ρ1, ρ2 while the piece d1 changes by `dd` and n, b by those of `rate`; likewise ρ3, ρ4.
[[nodiscard]] inline Eigen::Vector2d error_rate(const Eigen::Vector3d& d,
                                                const SurfaceFrame& f,
                                                const Eigen::Vector3d& dd,
                                                const FrameRate& rate) {
  const double l = d.norm();
  return {(dd.dot(f.n) + d.dot(rate.n)) / l - d.dot(f.n) * d.dot(dd) / (l * l * l),
          dd.dot(f.b) + d.dot(rate.b)};
}

[[nodiscard]] ChainVector path_errors(const PathChain& chain);
[[nodiscard]] ChainMatrix path_error_rates(const PathChain& chain);

}  // namespace condyle
