#include "condyle/anatomy/lattice_field.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

using Eigen::Vector3d;

const Vector3d kLow(-50, -20, -30), kHigh(60, 25, 40);  // of a box of 6 x 3 x 4 cells [mm]

/// On a wavy sheet through the box, each moved by `shift`; mirrored where `mirror` says so.
template <typename Shift>
std::vector<PointPair> pairs_on_sheet(const Shift& shift, const Vector3d& mirror) {
  std::vector<PointPair> pairs;
  for (double x = -48; x < 60; x += 6)
    for (double z = -28; z < 40; z += 6) {
      const double tilt = 0.4 * std::cos(x / 15);
      const Vector3d from(x, 6 * std::sin(x / 15), z);
      pairs.push_back({mirror.cwiseProduct(from), mirror.cwiseProduct(from + shift(from)),
                       mirror.cwiseProduct(Vector3d(-tilt, 1, 0).normalized()), 0, 1 + z / 100});
    }
  return pairs;
}

LatticeField fitted(const std::vector<PointPair>& pairs, const Vector3d& mirror) {
  const Vector3d one = mirror.cwiseProduct(kLow), other = mirror.cwiseProduct(kHigh);
  LatticeField field(one.cwiseMin(other), one.cwiseMax(other), 18);
  field.fit(pairs, {100});
  return field;
}

Vector3d wave(const Vector3d& p) {
  return {std::sin(p.x() / 20), 2 * std::cos(p.z() / 15), 0.02 * p.x()};
}

// A shift neither bends nor stretches anything.
TEST(LatticeField, AShiftOfThePairsIsThatOfTheWholeField) {
  const Vector3d shift(1, -2, 0.5);
  const LatticeField field = fitted(
      pairs_on_sheet([&](const Vector3d&) { return shift; }, Vector3d::Ones()), Vector3d::Ones());
  for (const Vector3d& p : {kLow, kHigh, Vector3d(0, 3, 7)}) {
    EXPECT_LT((field.at(p) - shift).norm(), 1e-9);
    EXPECT_LT(field.gradient(p).norm(), 1e-10);
  }
}

// Its nodes come in the opposite order.
TEST(LatticeField, IsMirroredWithThePairs) {
  const LatticeField field = fitted(pairs_on_sheet(wave, Vector3d::Ones()), Vector3d::Ones());
  for (const Vector3d& mirror : {Vector3d(-1, 1, 1), Vector3d(-1, -1, 1), Vector3d(1, -1, -1)}) {
    const LatticeField mirrored = fitted(pairs_on_sheet(wave, mirror), mirror);
    for (const Vector3d& p : {kLow, kHigh, Vector3d(0, 3, 7), Vector3d(30, -10, -20)})
      EXPECT_LT((mirror.cwiseProduct(field.at(p)) - mirrored.at(mirror.cwiseProduct(p))).norm(),
                1e-10);
  }
  EXPECT_GT((field.at({0, 0, 0}) - field.at({30, 0, 20})).norm(), 0.5);
}

TEST(LatticeField, ItsGradientIsThatOfDifferences) {
  const LatticeField field = fitted(pairs_on_sheet(wave, Vector3d::Ones()), Vector3d::Ones());
  constexpr double h = 1e-5;
  for (const Vector3d& p : {Vector3d(0, 3, 7), Vector3d(30, -10, -20)})
    for (int k = 0; k < 3; ++k) {
      const Vector3d step = h * Vector3d::Unit(k);
      EXPECT_LT(
          (field.gradient(p).col(k) - (field.at(p + step) - field.at(p - step)) / (2 * h)).norm(),
          1e-9);
    }
}

}  // namespace
}  // namespace condyle
