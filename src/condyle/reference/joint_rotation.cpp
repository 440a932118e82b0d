#include "condyle/reference/joint_rotation.h"

#include <cmath>

namespace condyle {
namespace {

using Eigen::Matrix3d;

/// The n-th derivative of the rotation by `sign` times an angle about a coordinate axis.
Matrix3d turn(int axis, double sign, double angle, int n) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const double quarter = M_PI / 2;
  const double c = std::cos(angle + n * quarter), s = sign * std::sin(angle + n * quarter);
  Matrix3d R = Matrix3d::Zero();
  R(axis, axis) = n == 0 ? 1 : 0;
  R(j, j) = R(k, k) = c;
  R(k, j) = s;
  R(j, k) = -s;
  return R;
}

}  // namespace

JointRotation joint_rotation(const JointFrames& frames, const Eigen::Vector3d& angles) {
  const double signs[3] = {-1, frames.side, frames.side};
  Matrix3d factors[3][3];  // [angle][order of the derivative]
  for (int angle = 0; angle < 3; ++angle)
    for (int n = 0; n < 3; ++n) factors[angle][n] = turn(angle, signs[angle], angles[angle], n);
  const auto rotation = [&](int n0, int n1, int n2) -> Matrix3d {
    const Matrix3d G = factors[0][n0] * factors[1][n1] * factors[2][n2];
    if (frames.tibia_moves) return frames.X_F.R * G * frames.X_T.R.transpose();
    return frames.X_T.R * G.transpose() * frames.X_F.R.transpose();
  };
  JointRotation result;
  result.R = rotation(0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    result.d[i] = rotation(i == 0, i == 1, i == 2);
    for (int j = 0; j < 3; ++j)
      result.dd[i][j] = rotation((i == 0) + (j == 0), (i == 1) + (j == 1), (i == 2) + (j == 2));
  }
  return result;
}

}  // namespace condyle
