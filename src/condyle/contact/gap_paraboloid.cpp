#include "condyle/contact/gap_paraboloid.h"

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/math/decompositions.h"

namespace condyle {
namespace {

constexpr double kSteep = 0.5;  // cosine between the normals below which quadrics say nothing
constexpr double kFlat = 1e-6;  // curvature over one reach: no minimum of its own

}  // namespace

std::optional<PredictedMinimum> predict_minimum(const Eigen::Vector3d& p,
                                                const Eigen::Vector3d& n,
                                                const Eigen::Matrix3d& K,
                                                const SurfacePoint& opposite,
                                                double gap,
                                                double reach) {
  const double facing = -n.dot(opposite.n);
  if (!(facing > kSteep)) return std::nullopt;
  const Eigen::Vector3d e0 = opposite.n.unitOrthogonal(), e1 = opposite.n.cross(e0);
  const Eigen::Vector3d slope = n / facing - opposite.K * (p - opposite.c);
  const Eigen::Vector3d K0 = -(opposite.K * e0 + K * e0), K1 = -(opposite.K * e1 + K * e1);
  Eigen::Matrix2d H;
  H << e0.dot(K0), e0.dot(K1), e0.dot(K1), e1.dot(K1);
  const PlaneEigenvalues principal = plane_eigenvalues(H);
  if (!(principal.values[1] > 0)) return std::nullopt;
  const Eigen::Vector2d gradient(e0.dot(slope), e1.dot(slope));

  PredictedMinimum minimum{p, gap};
  for (const int k : {0, 1}) {
    const Eigen::Vector2d along = principal.vectors.col(k);
    const double bend = principal.values[k], rise = along.dot(gradient);
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
