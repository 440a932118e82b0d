#include "condyle/anatomy/align_surfaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr double kShift = 4, kTurn = 3 * M_PI / 180;  // of frames [mm], [rad]
constexpr double kSize = 0.2;  // logarithm of the size of one person's bone over another's

/// Squares of what is known beforehand: the shift, the turn, the size and its differences
/// (`proportion`: standard deviation of the logarithm of a single factor against their mean).
void add_expected(const Alignment& now, double proportion, Matrix9d& A, Vector9d& b) {
  const auto add = [&](const Vector9d& direction, double value, double deviation) {
    const double w = 1 / (deviation * deviation);
    A += w * direction * direction.transpose();
    b -= w * value * direction;
  };
  const Vector3d turn = log_rotation(now.turn), logs = now.size.array().log();
  for (int k = 0; k < 3; ++k) {
    add(Vector9d::Unit(k), now.shift[k], kShift);
    add(Vector9d::Unit(3 + k), turn[k], kTurn);
    Vector9d other = Vector9d::Unit(6 + k);
    other.tail<3>().array() -= 1.0 / 3;
    add(other, logs[k] - logs.mean(), proportion);
  }
  Vector9d mean = Vector9d::Zero();
  mean.tail<3>().setConstant(1.0 / 3);
  add(mean, logs.mean(), kSize);
}

/// One step of Gauss and Newton. With y on the plane of normal n, the gap n·(x' - y) changes by
/// n·dt + (turned x' × n)·dω + n·(R (s x)_k) d log s_k.
void step(const std::vector<PointPair>& pairs, double rms, double proportion, Alignment& now) {
  Matrix9d A = Matrix9d::Zero();
  Vector9d b = Vector9d::Zero();
  double sum = 0;
  for (const PointPair& pair : pairs) {
    const Vector3d sized = now.size.cwiseProduct(pair.from), arm = now.turn * sized;
    const Vector3d local = now.turn.transpose() * pair.normal;
    Vector9d J;
    J << pair.normal, arm.cross(pair.normal), local.cwiseProduct(sized);
    A += pair.weight * J * J.transpose();
    b -= pair.weight * pair.normal.dot(now.shift + arm - pair.to) * J;
    sum += pair.weight;
  }
  if (!(sum > 0)) return;
  // Bones differ in shape by bumps of some 20 mm: so much surface is one independent gap. Each area is
  // seen from both sides.
  constexpr double kIndependent = 2 * 400, kLeastDeviation = 0.1;  // [mm²], [mm]
  const double deviation = std::max(rms, kLeastDeviation);
  const double weight = 1 / (kIndependent * deviation * deviation);
  A *= weight;
  b *= weight;
  add_expected(now, proportion, A, b);
  const Vector9d x = symmetric_solution(A, b);
  now.shift += x.head<3>();
  now.turn = exp_rotation(x.segment<3>(3)) * now.turn;
  now.size = now.size.array() * x.tail<3>().array().exp();
}

MovedSurface placed(const SurfaceSamples& samples, const Alignment& by) {
  SurfaceSamples now = moved(samples, by);
  return {samples, std::move(now.points), std::move(now.normals)};
}

}  // namespace

SurfaceSamples moved(const SurfaceSamples& samples, const Alignment& by) {
  SurfaceSamples out = samples;
  for (Vector3d& p : out.points) p = by.at(p);
  for (Vector3d& n : out.normals) n = by.normal(n);
  return out;
}

Alignment align_surfaces(const SurfaceSamples& coarse,
                         const SurfaceSamples& fine,
                         const SurfaceSamples& other_coarse,
                         const SampledSurface& other) {
  constexpr int kSteps = 24;
  constexpr double kAlike = 0.01, kProportion = 0.05;
  Alignment now;
  for (int i = 0; i < kSteps; ++i) {
    const double reach = std::max(8.0, 20.0 - i);
    const SurfacePairs found =
        pair_surfaces(placed(coarse, now), placed(fine, now), other_coarse, other, reach);
    step(found.pairs, found.rms, i < kSteps / 3 ? kAlike : kProportion, now);
  }
  return now;
}

}  // namespace condyle
