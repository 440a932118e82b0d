#include "equilibrium/gap_paraboloid.h"

#include <Eigen/Geometry>

#include <cmath>

namespace condyle {
namespace {

constexpr double kSteep = 0.5;  // cosine between the normals below which quadrics say nothing
constexpr double kFlat = 1e-6;  // curvature over one reach: no minimum of its own

/// Unit eigenvector of [a b; b d] for the eigenvalue that is not `other`.
Eigen::Vector2d principal_direction(double a, double b, double d, double other) {
  Eigen::Vector2d e(a - other, b), f(b, d - other);
  if (f.squaredNorm() > e.squaredNorm()) e = f;
  const double length = e.norm();
  return length > 0 ? Eigen::Vector2d(e / length) : Eigen::Vector2d(1, 0);
}

}  // namespace

std::optional<PredictedMinimum> predict_minimum(const Eigen::Vector3d& p,
                                                const Eigen::Vector3d& n,
                                                const Eigen::Matrix3d& K,
                                                const SurfacePoint& foot,
                                                double gap,
                                                double reach) {
  const double facing = -n.dot(foot.n);
  if (!(facing > kSteep)) return std::nullopt;
  const Eigen::Vector3d e0 = foot.n.unitOrthogonal(), e1 = foot.n.cross(e0);
  const Eigen::Vector3d slope = n / facing - foot.K * (p - foot.c);
  const Eigen::Vector3d K0 = -(foot.K * e0 + K * e0), K1 = -(foot.K * e1 + K * e1);
  const double a = e0.dot(K0), b = e0.dot(K1), d = e1.dot(K1);
  const double mean = 0.5 * (a + d), spread = std::hypot(0.5 * (a - d), b);
  const Eigen::Vector2d high = principal_direction(a, b, d, mean - spread);
  const Eigen::Vector2d gradient(e0.dot(slope), e1.dot(slope));

  PredictedMinimum minimum{p, gap};
  for (const bool first : {true, false}) {
    const Eigen::Vector2d along = first ? high : Eigen::Vector2d(-high.y(), high.x());
    const double bend = first ? mean + spread : mean - spread, rise = along.dot(gradient);
    if (!(std::abs(bend) * reach > kFlat)) return std::nullopt;
    double step = -std::copysign(0.5 * reach, rise);
    if (bend > 0) {
      step = -rise / bend;
      if (std::abs(step) > reach) return std::nullopt;
    }
    minimum.point += step * (along.x() * e0 + along.y() * e1);
    minimum.gap += rise * step + 0.5 * bend * step * step;
  }
  return minimum;
}

}  // namespace condyle
