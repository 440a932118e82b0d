/// No place bends by more than is said of those about it.

#include "condyle/surface/patch_bends.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

#include "support/bumpy_patches.h"
#include "support/height_patch.h"

namespace condyle {
namespace {

/// Towards the side of the normal [1/mm].
double curvature(const Patch& patch, const Eigen::Vector2d& at) {
  const Eigen::Matrix3d K = patch.evaluate(Patch::place(at.x(), at.y())).K;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(0.5 * (K + K.transpose())).eigenvalues()[2];
}

// From anywhere by lines in the plane of parameters of either length: what is longer than their
// images is allowed to leave the bound.
TEST(PatchBends, HoldForAllPlacesWithinTheWay) {
  test::Random random(20);
  int looked_at = 0;
  for (int k = 0; k < 6; ++k) {
    const ContactPair pair = test::bumpy_pair(random, 0.2);
    for (const auto& surface : {pair.on_B, pair.on_A}) {
      const auto& patch = dynamic_cast<const Patch&>(*surface);
      const PatchCells cells(patch);
      const PatchBends bends(cells);
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector2d from(random.between(-12, 12), random.between(-10, 10));
        const BendBound& bound = bends.about(from.x(), from.y());
        const double angle = random.between(0, 2 * M_PI);
        Eigen::Vector2d at = from;
        for (double way = 0; way < bound.way; ++looked_at) {
          EXPECT_LT(curvature(patch, at), bound.most + 1e-15)
              << from.transpose() << " to " << at.transpose();
          const Eigen::Vector2d next = at + 0.1 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
          way += (patch.derivatives(next.x(), next.y()).c - patch.derivatives(at.x(), at.y()).c)
                     .norm();
          at = next;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 3000);
}

// Radius 20 mm, knots 1.5 mm apart.
TEST(PatchBends, AreNearTheCurvaturesOfACupAndNoneOfABall) {
  const auto height = [](double u, double v) { return 20 - std::sqrt(400 - u * u - v * v); };
  PatchData data = height_patch(10, 10, 1.5, height);
  const Patch cup(data);
  data.orientation = -1;
  const Patch ball(data);
  const PatchCells of_cup(cup), of_ball(ball);
  const BendBound in_cup = PatchBends(of_cup).about(1, 2),
                  on_ball = PatchBends(of_ball).about(1, 2);
  EXPECT_GT(in_cup.most, 0.05);
  EXPECT_LT(in_cup.most, 0.07);  // of the hulls; half as long cells halve the rest
  EXPECT_GT(in_cup.way, 1.3);
  EXPECT_EQ(on_ball.most, 0);
  EXPECT_EQ(PatchBends(of_cup).about(9.9, 0).way, 0);  // beside the edge
  EXPECT_EQ(PatchBends(of_cup).about(11, 0).way, 0);
}

}  // namespace
}  // namespace condyle
