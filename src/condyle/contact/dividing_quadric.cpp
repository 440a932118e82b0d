#include "condyle/contact/dividing_quadric.h"

#include <algorithm>
#include <cmath>

#include "condyle/contact/curvature_tensor.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

constexpr double kSteep = 0.3;  // cosine between a cell and the quadric below which only way counts
constexpr double kWay = 1.05;   // a way on the surface, by its chord
constexpr std::size_t kFour = 4;

using Mask = decltype(Four{} < Four{});

}  // namespace

DividingQuadric divide(const SurfacePoint& lower,
                       const SurfacePoint& upper,
                       const Eigen::Vector3d& o) {
  DividingQuadric quadric;
  quadric.n = (lower.n - upper.n).normalized();
  const Eigen::Vector3d& n = quadric.n;
  const Eigen::Vector3d from_lower = o - lower.c, from_upper = o - upper.c;
  const Eigen::Vector3d K_lower = lower.K * from_lower, K_upper = upper.K * from_upper;
  // Heights of both over the plane, to second order: z = -φ of the lower, +φ of the upper one.
  const double z = 0.5 * (-lower.n.dot(from_lower) + 0.5 * from_lower.dot(K_lower) +
                          upper.n.dot(from_upper) - 0.5 * from_upper.dot(K_upper));
  quadric.o = o + z * n;
  quadric.b = off_normal(0.5 * (K_lower - lower.n + upper.n - K_upper), n);
  const Eigen::Matrix3d K = 0.5 * (lower.K - upper.K);
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - n * n.transpose();
  quadric.M = P * K * P;
  quadric.greatest = std::max(0.0, largest_principal(quadric.M));
  quadric.least = std::min(0.0, -largest_principal(-quadric.M));
  return quadric;
}

DividingQuadric moved(const DividingQuadric& quadric, const RigidTransform& X) {
  DividingQuadric there = quadric;
  there.o = X * quadric.o;
  there.n = X.R * quadric.n;
  there.b = X.R * quadric.b;
  there.M = X.R * quadric.M * X.R.transpose();
  return there;
}

void CellColumns::reserve(std::size_t cells) {
  numbers_.reserve((cells + kFour - 1) / kFour * kFour * kColumns);
}

void CellColumns::add(const SurfacePoint& at, double radius, double bend) {
  const std::size_t place = static_cast<std::size_t>(size_++) % kFour;
  if (place == 0) numbers_.resize(numbers_.size() + kColumns * kFour, 0);
  double* group = &numbers_[numbers_.size() - kColumns * kFour] + place;
  const double values[kColumns] = {at.c.x(), at.c.y(), at.c.z(),      at.n.x(),
                                   at.n.y(), at.n.z(), kWay * radius, bend};
  for (std::size_t k = 0; k < kColumns; ++k) group[k * kFour] = values[k];
}

/// Along the surface φ changes by its tangential gradient and by ∇φ·N cᵀKc - cᵀMc; a cell that is
/// steep to the quadric, by no more than the whole gradient.
CONDYLE_FMA_CLONE
void CellColumns::not_on(Side side, const DividingQuadric& quadric, std::vector<int>& cells) const {
  cells.clear();
  const double sign = side == Side::kBelow ? 1 : -1;
  const Eigen::Vector3d &o = quadric.o, &n = quadric.n, &b = quadric.b;
  const Eigen::Matrix3d& M = quadric.M;
  const double bend_of_quadric = side == Side::kBelow ? -quadric.least : quadric.greatest;
  const double stiffest = std::max(quadric.greatest, -quadric.least);
  const Eigen::Vector3d up = n - b;
  for (std::size_t first = 0; first < static_cast<std::size_t>(size_); first += kFour) {
    const double* group = &numbers_[first * kColumns];
    const auto column = [&](Column k) { return load_four(group + kFour * k); };
    const Four x = column(kX) - o.x(), y = column(kY) - o.y(), z = column(kZ) - o.z();
    const Four mx = M(0, 0) * x + M(0, 1) * y + M(0, 2) * z;
    const Four my = M(0, 1) * x + M(1, 1) * y + M(1, 2) * z;
    const Four mz = M(0, 2) * x + M(1, 2) * y + M(2, 2) * z;
    const Four gx = up.x() - mx, gy = up.y() - my, gz = up.z() - mz;
    const Four height = up.x() * x + up.y() * y + up.z() * z - 0.5 * (mx * x + my * y + mz * z);
    const Four facing = sign * (gx * column(kNx) + gy * column(kNy) + gz * column(kNz));
    const Four whole = gx * gx + gy * gy + gz * gz, slope = whole - facing * facing;
    const Four r = column(kRadius), square = r * r;
    Four bend = facing * column(kBend) + bend_of_quadric;
    bend = bend > 0 ? bend : Four{};
    const Four room = -sign * height - 0.5 * bend * square;
    const Four steep_room = -sign * height - stiffest * square;
    const Mask apart = ((room > 0) & (slope * square < room * room) & (facing > kSteep)) |
                       ((steep_room > 0) & (whole * square < steep_room * steep_room));
    if (apart[0] & apart[1] & apart[2] & apart[3]) continue;
    for (std::size_t k = 0; k < kFour; ++k)
      if (!apart[k] && first + k < static_cast<std::size_t>(size_))
        cells.push_back(static_cast<int>(first + k));
  }
}

}  // namespace condyle
