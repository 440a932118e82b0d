/// Wrenches of unit tension and their blocks against differences, for surfaces on either body.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/elements/end_rates.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"
#include "support/string_over.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

/// A string from x_C on B to s_D on A over surfaces that it touches at X_BA.
struct PathStrand {
  Vector3d x_C, s_D;
  std::shared_ptr<const WrappedPath> path;
  std::array<double, kMostPathNumbers> kept = unknown_path();

  [[nodiscard]] LineEnds ends(const RigidTransform& X) const {
    const Vector3d q = X.R * s_D;
    return {x_C, X.p + q, q};
  }
  /// Statuses held, the path warm.
  [[nodiscard]] double pull(const RigidTransform& X, Wrench& unit) const {
    auto warm = kept;
    return path->pull(ends(X), X, warm.data(), unit);
  }
};

void expect_exact(const PathStrand& strand, const RigidTransform& X) {
  const auto length = [&](const RigidTransform& at) -> Vector3d {
    Wrench unit;
    return {strand.pull(at, unit), 0, 0};
  };
  const auto force = [&](const RigidTransform& at) {
    Wrench unit;
    EXPECT_GT(strand.pull(at, unit), 0);
    return unit.f;
  };
  const auto moment = [&](const RigidTransform& at) {
    Wrench unit;
    EXPECT_GT(strand.pull(at, unit), 0);
    return unit.m;
  };
  Wrench unit;
  ASSERT_GT(strand.pull(X, unit), 0);
  const double h = 1e-3, turn = 1e-4;  // mm, rad: the strands are up to 140 mm long
  const Vector3d by_a = test::jacobian_of_translation(length, X, h).row(0);
  const Vector3d by_pi = test::jacobian_of_rotation(length, X, turn).row(0);
  EXPECT_LT((unit.f + by_a).norm(), 1e-9);
  EXPECT_LT((unit.m + by_pi).norm(), 1e-8);
  const auto difference = [](const Matrix3d& found, const Matrix3d& expected) {
    return (found - expected).norm() / (1 + expected.norm());
  };
  EXPECT_LT(difference(unit.F1, test::jacobian_of_translation(force, X, h)), 1e-8);
  EXPECT_LT(difference(unit.F2, test::jacobian_of_rotation(force, X, turn)), 1e-8);
  EXPECT_LT(difference(unit.M1, test::jacobian_of_translation(moment, X, h)), 1e-8);
  EXPECT_LT(difference(unit.M2, test::jacobian_of_rotation(moment, X, turn)), 1e-8);
}

/// The rates by the motion v of an end in the ground frame.
void expect_exact_ends(const PathStrand& strand, const RigidTransform& X) {
  LineRates rates;
  ASSERT_TRUE(strand.path->end_rates(strand.ends(X), X, strand.kept.data(), rates));
  for (const bool at_C : {true, false}) {
    const auto pull = [&](const Vector3d& v) {
      PathStrand moved = strand;
      if (at_C)
        moved.x_C += v;
      else
        moved.s_D += X.R.transpose() * v;
      Wrench unit;
      const double L = moved.pull(X, unit);
      Eigen::Matrix<double, 7, 1> all;
      all << unit.f, unit.m, L;
      return all;
    };
    const Eigen::Matrix<double, 7, 3> J = test::jacobian_at_zero<7, 3>(pull, 1e-3);
    const LineEndRates& found = at_C ? rates.of_C : rates.of_D;
    const Matrix3d f = J.topRows<3>(), m = J.middleRows<3>(3);
    EXPECT_LT((found.f - f).norm(), 1e-8 * (1 + f.norm())) << at_C;
    EXPECT_LT((found.m - m).norm(), 1e-8 * (1 + m.norm())) << at_C;
    EXPECT_LT((found.length - J.row(6).transpose()).norm(), 1e-9) << at_C;
  }
}

WrapShape random_low_shape(Random& random, int kind) {
  if (kind == 0) return WrapSphere{random.between(8, 14)};
  if (kind == 1) return WrapCylinder{random.between(6, 12)};
  if (kind == 2)
    return WrapEllipsoid{{random.between(10, 16), random.between(8, 14), random.between(6, 10)}};
  return WrapTorus{random.between(9, 10), random.between(7, 8)};
}

/// Surfaces along x, 35 mm apart, each with its top near the line or somewhat above it.
PathStrand random_strand(Random& random,
                         const RigidTransform& X,
                         const std::vector<bool>& on_A,
                         int kind) {
  const double span = 35;
  std::vector<PathWrap> wraps;
  for (std::size_t i = 0; i < on_A.size(); ++i) {
    const int shape_kind = (kind + static_cast<int>(i)) % 4;
    RigidTransform X_GS{exp_rotation(random.vector(0.3)),
                        {span * (static_cast<double>(i) + 1), 0, 0}};
    if (shape_kind % 2 == 1) X_GS.R = X_GS.R * exp_rotation(Vector3d(M_PI / 2, 0, 0));
    const WrapShape shape = random_low_shape(random, shape_kind);
    // 2 to 3 mm of it stand above the line, of inner ones more.
    double top = 0;
    for (double z = -40; z < 40; z += 0.1)
      if (signed_distance(shape, X_GS.inverse() * (X_GS.p + Vector3d(0, 0, z))) < 0) top = z;
    const bool inner = i > 0 && i + 1 < on_A.size();
    X_GS.p.z() = -top + random.between(2, 3) + (inner ? 0.7 : 0);
    PathWrap wrap{"w", shape, on_A[i] ? X.inverse() * X_GS : X_GS, on_A[i], {}};
    wrap.side = wrap.placement * (X_GS.inverse() * (X_GS.p + Vector3d(0, 0, top + 1)));
    wraps.push_back(wrap);
  }
  PathStrand strand;
  strand.x_C = random.vector(2);
  const Vector3d x_D =
      Vector3d(span * static_cast<double>(on_A.size() + 1), 0, 0) + random.vector(2);
  strand.s_D = X.inverse() * x_D;
  strand.path = make_wrapped_path(wraps, strand.x_C, strand.s_D);
  Wrench unit;
  strand.path->pull(strand.ends(X), X, strand.kept.data(), unit);
  return strand;
}

int touched(const PathStrand& strand, const RigidTransform& X) {
  int count = 0;
  for (const auto& touch : strand.path->touches(strand.ends(X), X, strand.kept.data()))
    count += touch.touching ? 1 : 0;
  return count;
}

void expect_exact_for(const std::vector<bool>& on_A, unsigned seed) {
  Random random(seed);
  int all = 0;
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(k);
    const RigidTransform X = random.pose(20);
    const PathStrand strand = random_strand(random, X, on_A, k);
    const auto finding = strand.path->finding(strand.ends(X), X, strand.kept.data());
    ASSERT_EQ(finding.outcome, WrappedPath::Outcome::kFound) << finding.wrap;
    if (touched(strand, X) == static_cast<int>(on_A.size())) ++all;
    expect_exact(strand, X);
    expect_exact_ends(strand, X);
  }
  EXPECT_GT(all, 6);
}

TEST(WrappedPathDerivatives, OneSurfaceOnB) { expect_exact_for({false}, 1); }
TEST(WrappedPathDerivatives, OneSurfaceOnA) { expect_exact_for({true}, 2); }
TEST(WrappedPathDerivatives, TwoSurfacesOnB) { expect_exact_for({false, false}, 3); }
TEST(WrappedPathDerivatives, TwoSurfacesOnA) { expect_exact_for({true, true}, 4); }
TEST(WrappedPathDerivatives, OneOnEach) { expect_exact_for({false, true}, 5); }
TEST(WrappedPathDerivatives, ThreeSurfaces) {
  expect_exact_for({false, true, true}, 6);
  expect_exact_for({false, false, true}, 7);
}
TEST(WrappedPathDerivatives, AStringThatCrossesToAAndBackAndOverAgain) {
  expect_exact_for({true, false, true}, 8);
}

// The ends stand inside a surface of their own body, at its top, and are anchored there.
TEST(WrappedPathDerivatives, AnchoredEnds) {
  Random random(9);
  int wrapped = 0;
  for (int k = 0; k < 12; ++k) {
    SCOPED_TRACE(k);
    const RigidTransform X = random.pose(20);
    const bool at_C = k % 2 == 0;
    PathStrand strand;
    strand.x_C = Vector3d(0, 0, at_C ? -0.5 : -4);
    const Vector3d x_D = Vector3d(50, 3, at_C ? -4 : -0.5);
    strand.s_D = X.inverse() * x_D;
    const WrapShape shape = random_low_shape(random, k / 2 % 3);
    RigidTransform X_GS{random.rotation(), at_C ? strand.x_C : x_D};
    double top = 0;
    for (double z = 0; z < 40; z += 0.1)
      if (signed_distance(shape, X_GS.R.transpose() * Vector3d(0, 0, z)) < 0) top = z;
    X_GS.p.z() -= top - 0.5;
    const RigidTransform X_AS = X.inverse() * X_GS;
    strand.path =
        make_wrapped_path({{"w", shape, at_C ? X_GS : X_AS, !at_C, {}}}, strand.x_C, strand.s_D);
    Wrench unit;
    ASSERT_GT(strand.path->pull(strand.ends(X), X, strand.kept.data(), unit), 0)
        << static_cast<int>(strand.path->finding(strand.ends(X), X, strand.kept.data()).outcome);
    if (touched(strand, X) == 1) ++wrapped;
    expect_exact(strand, X);
    const auto finding = strand.path->finding(strand.ends(X), X, strand.kept.data());
    if (finding.outcome == WrappedPath::Outcome::kFound) expect_exact_ends(strand, X);
  }
  EXPECT_GT(wrapped, 6);
}

}  // namespace
}  // namespace condyle
