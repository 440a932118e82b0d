/// The 16 equations: their derivatives against differences, their angles against the engine's, and
/// their number.

#include "condyle/reference/wismans_system.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "condyle/math/rotation.h"
#include "condyle/reference/joint_rotation.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::Random;

JointFrames some_frames(Random& random, bool tibia_moves, double side) {
  JointFrames frames;
  frames.X_F = {exp_rotation(random.vector(0.4)), random.vector(10)};
  frames.X_T = {exp_rotation(random.vector(0.4)), random.vector(10)};
  frames.tibia_moves = tibia_moves;
  frames.side = side;
  return frames;
}

HeightSurface some_surface(Random& random) {
  HeightSurface surface;
  surface.origin = random.vector(20);
  surface.axes = exp_rotation(random.vector(0.5));
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      surface.terms.push_back({i, j, random.between(-1, 1) * std::pow(0.1, i + j)});
  surface.solid_below = random.between(0, 1) > 0.5;
  return surface;
}

WismansModel some_model(Random& random, bool tibia_moves, double side) {
  WismansModel model;
  model.joint = some_frames(random, tibia_moves, side);
  model.flexion = 0.7;
  for (int k = 0; k < 4; ++k) {
    model.springs.push_back(
        {random.vector(30), random.vector(30) + Vector3d(0, 0, 60), QuadraticLaw{12, 20}});
    Load load;
    load.moment = k % 2 == 1;
    load.follows_body = k / 2 == 1;
    load.vector = random.vector(100);
    load.at = random.vector(30);
    load.scale = 0.8;
    model.loads.push_back(load);
  }
  for (WismansContact& contact : model.contacts)
    contact = {"contact", some_surface(random), some_surface(random), 0};
  return model;
}

WismansVector some_unknowns(Random& random) {
  WismansVector z;
  for (int i = 0; i < kWismansUnknowns; ++i) z[i] = random.between(-3, 3);
  z[wismans::kAdduction] *= 0.1;
  z[wismans::kInternalRotation] *= 0.1;
  z.segment<2>(wismans::kForce) *= 40;
  z[wismans::kMoment] *= 1000;
  return z;
}

TEST(WismansSystem, HasAsManyEquationsAsUnknowns) {
  // 5 of the pose, 8 surface coordinates, 2 forces, 1 moment; 6 coincidence, 4 normals, 6
  // equilibrium [Wismans 1980].
  EXPECT_EQ(kWismansUnknowns, 5 + 8 + 2 + 1);
  EXPECT_EQ(kWismansUnknowns, 6 + 4 + 6);
}

TEST(WismansSystem, HasTheDerivativesOfItsEquations) {
  for (const bool tibia_moves : {true, false}) {
    for (const double side : {1.0, -1.0}) {
      Random random(7);
      const WismansModel model = some_model(random, tibia_moves, side);
      const WismansVector z = some_unknowns(random);
      const WismansMatrix jacobian = assemble(model, z).jacobian;
      for (int j = 0; j < kWismansUnknowns; ++j) {
        const double h = 1e-3 * std::max(1.0, std::abs(z[j])) * (j == 3 || j == 4 ? 0.1 : 1);
        const auto at = [&](double steps) {
          WismansVector moved = z;
          moved[j] += steps * h;
          return assemble(model, moved).residual;
        };
        // Fourth order: the error is h^4 times a fifth derivative, far below the bound.
        const WismansVector difference = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
        for (int i = 0; i < kWismansUnknowns; ++i) {
          EXPECT_NEAR(jacobian(i, j), difference[i],
                      1e-7 * std::max({1.0, jacobian.col(j).cwiseAbs().maxCoeff(),
                                       jacobian.row(i).cwiseAbs().maxCoeff()}))
              << "row " << i << " column " << j;
        }
      }
    }
  }
}

TEST(WismansSystem, HasTheRotationThatTheJointAnglesMean) {
  for (const bool tibia_moves : {true, false}) {
    for (const double side : {1.0, -1.0}) {
      Random random(3);
      const JointFrames frames = some_frames(random, tibia_moves, side);
      const JointRotation rotation = joint_rotation(frames, {1.1, -0.2, 0.3});
      EXPECT_TRUE(rotation.R.isApprox(rotation_from_joint_angles(frames, 1.1, -0.2, 0.3), 1e-14));
    }
  }
}

TEST(WismansSystem, HasSecondDerivativesOfTheRotation) {
  Random random(5);
  const JointFrames frames = some_frames(random, false, -1);
  const Vector3d angles(0.9, 0.1, -0.3);
  const JointRotation rotation = joint_rotation(frames, angles);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    const JointRotation plus = joint_rotation(frames, angles + step),
                        minus = joint_rotation(frames, angles - step);
    EXPECT_LT((rotation.d[i] - (plus.R - minus.R) / (2 * kStep)).norm(), 1e-9);
    for (int j = 0; j < 3; ++j)
      EXPECT_LT((rotation.dd[j][i] - (plus.d[j] - minus.d[j]) / (2 * kStep)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace condyle
