/// A path that was followed at one pose bounds its length at others, and a strand whose bound is below
/// its slack length is passed over while a pose is solved.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/elements/line_element_block.h"
#include "condyle/math/rotation.h"
#include "condyle/wrapping/wrapped_path.h"
#include "support/allocation_count.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::Random;

const WrapEllipsoid kFlatEllipsoid{{30, 18, 12}};
const RigidTransform kBeside{Eigen::Matrix3d::Identity(), {30, -25, 0}};

struct Case {
  const char* name;
  std::vector<PathWrap> wraps;
  Vector3d x_C, s_D;
};

std::vector<Case> cases() {
  const auto one = [](const WrapShape& shape, bool on_A) {
    return std::vector<PathWrap>{{"surface", shape, {}, on_A, {}}};
  };
  const Vector3d X(-24, 20, 3), Y(22, -6, 15), inside(-6, 10, 9);
  const PathWrap second{"second", WrapSphere{12}, kBeside, true, Vector3d(30, -25, 20)};
  return {{"ellipsoid on B", one(kFlatEllipsoid, false), X, Y},
          {"ellipsoid on A", one(kFlatEllipsoid, true), X, Y},
          {"cylinder on B", one(WrapCylinder{13}, false), X, Y},
          {"sphere on A", one(WrapSphere{14}, true), X, Y},
          {"torus on B", one(WrapTorus{12, 8}, false), X, Y},
          {"anchored at C", one(kFlatEllipsoid, false), inside, Y},
          {"anchored at D", one(kFlatEllipsoid, true), Y, inside},
          {"off the surface", one(WrapSphere{5}, false), X, Y},
          {"on both", {{"first", kFlatEllipsoid, {}, false, {}}, second}, X, {40, -45, 5}}};
}

RigidTransform moved(Random& random, double much) {
  return {exp_rotation(0.02 * much * random.vector(1)), much * random.vector(1)};
}

TEST(SlackBound, IsNeverBelowTheLengthThatIsHeld) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto path = make_wrapped_path(c.wraps, c.x_C, c.s_D);
    const LineElement line{c.x_C, c.s_D, ToeLinearLaw{1000, 0.06, 60}, path};
    Random random(7);
    int found = 0;
    for (int k = 0; k < 300; ++k) {
      const RigidTransform X_0 = moved(random, 3), X = moved(random, k % 2 == 0 ? 0.3 : 6);
      auto kept = unknown_path();
      EXPECT_EQ(path->at_most(ends_of(line, X), X, kept.data()), INFINITY);
      if (!(path->length(ends_of(line, X_0), X_0, kept.data()) > 0)) continue;
      const double bound = path->at_most(ends_of(line, X), X, kept.data());
      const double L = path->length(ends_of(line, X), X, kept.data());
      if (path->finding(ends_of(line, X), X, kept.data()).outcome != WrappedPath::Outcome::kFound)
        continue;
      ++found;
      EXPECT_GE(bound, L - 1e-9);
    }
    EXPECT_GT(found, 200);
  }
}

// Without a surface between them the bound is the distance of the ends.
TEST(SlackBound, OfAStraightPathIsItsLength) {
  const auto path =
      make_wrapped_path({{"surface", WrapSphere{5}, {}, false, {}}}, {-24, 20, 3}, {22, -6, 15});
  const LineElement line{{-24, 20, 3}, {22, -6, 15}, ToeLinearLaw{1000, 0.06, 60}, path};
  auto kept = unknown_path();
  (void)path->length(ends_of(line, {}), {}, kept.data());
  const RigidTransform X{Eigen::Matrix3d::Identity(), {4, 3, -2}};
  EXPECT_NEAR(path->at_most(ends_of(line, X), X, kept.data()), (X * line.s_D - line.x_C).norm(),
              1e-12);
}

// The length at a pose that was pulled at is told again; elsewhere it is followed.
TEST(SlackBound, LengthsAreThoseOfAFreshPath) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const auto path = make_wrapped_path(c.wraps, c.x_C, c.s_D);
    const LineElement line{c.x_C, c.s_D, ToeLinearLaw{1000, 0.06, 60}, path};
    auto kept = unknown_path(), fresh = kept;
    const RigidTransform X{exp_rotation({0.01, -0.02, 0.01}), {0.4, -0.3, 0.2}};
    Wrench unit;
    (void)path->length(ends_of(line, {}), {}, kept.data());
    const double pulled = path->pull(ends_of(line, X), X, kept.data(), unit);
    EXPECT_EQ(path->length(ends_of(line, X), X, kept.data()), pulled);
    EXPECT_NEAR(path->length(ends_of(line, X), X, fresh.data()), pulled, 1e-9);
  }
}

// Slack by 3 mm, moved by less: no force, no stiffness, and the path is left where it was until the
// pose is solved; then it is that of the pose.
TEST(SlackBound, ASlackStrandIsPassedOverAndFollowedWhereThePoseIsSolved) {
  const Case c = cases()[0];
  const auto path = make_wrapped_path(c.wraps, c.x_C, c.s_D);
  auto kept = unknown_path();
  const double L = path->length({c.x_C, c.s_D, c.s_D}, {}, kept.data());
  const std::vector<LineElement> lines = {{c.x_C, c.s_D, ToeLinearLaw{1000, 0.06, L + 3}, path}};
  LineElementBlock block(lines);
  const std::vector<double> before(kept.begin(), kept.begin() + path->numbers());
  const RigidTransform X{Eigen::Matrix3d::Identity(), {0.5, 0.5, -0.5}};
  Wrench wrench;
  const test::AllocationCount count;
  const LineElementBlock::Summary summary = block.add_to(X, before, wrench);
  EXPECT_EQ(summary.force_magnitudes, 0);
  EXPECT_EQ(summary.zero_element, -1);
  EXPECT_EQ(wrench.f.norm() + wrench.F1.norm() + wrench.M2.norm(), 0);
  EXPECT_EQ(block.paths(), before);
  EXPECT_FALSE(block.revise_paths(X));
  if (test::allocations_are_counted()) {
    EXPECT_EQ(count.since_start(), 0);
  }
  EXPECT_NE(block.paths(), before);
  auto fresh = unknown_path();
  const double there = path->length(ends_of(lines[0], X), X, fresh.data());
  EXPECT_NEAR(path->at_most(ends_of(lines[0], X), X, block.paths().data()), there, 1e-10);
}

}  // namespace
}  // namespace condyle
