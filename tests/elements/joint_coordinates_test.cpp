#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/degree.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

/// Columns lateral, anterior, proximal for a body whose x points to the right, y forwards, z
/// upwards; for a left knee the first axis still points to the right, which keeps the triad
/// right-handed.
JointFrames aligned(double side) {
  JointFrames frames;
  frames.side = side;
  return frames;
}

JointFrames random_frames(Random& random, bool tibia_moves, double side) {
  return {random.pose(20), random.pose(20), tibia_moves, side};
}

TEST(JointCoordinates, AreZeroWhereTheFramesCoincide) {
  const JointCoordinates q = joint_coordinates(aligned(1), {});
  for (const double value : {q.flexion, q.adduction, q.internal_rotation, q.lateral_shift,
                             q.anterior_drawer, q.distraction}) {
    EXPECT_EQ(value, 0);
  }
}

TEST(JointCoordinates, SignsAreAnatomicalOnARightKnee) {
  // Flexion brings the distal end of the tibia, the point (0, 0, -400), backwards.
  const Vector3d distal(0, 0, -400);
  Matrix3d R = rotation_from_joint_angles(aligned(1), 30 * kDegree, 0, 0);
  EXPECT_NEAR((R * distal).y(), -400 * std::sin(30 * kDegree), 1e-10);
  // Adduction brings it towards the midline: medially, to the left.
  R = rotation_from_joint_angles(aligned(1), 0, 10 * kDegree, 0);
  EXPECT_NEAR((R * distal).x(), -400 * std::sin(10 * kDegree), 1e-10);
  // Internal rotation turns the toes, the point (0, 200, 0), medially.
  R = rotation_from_joint_angles(aligned(1), 0, 0, 10 * kDegree);
  EXPECT_NEAR((R * Vector3d(0, 200, 0)).x(), -200 * std::sin(10 * kDegree), 1e-10);
}

TEST(JointCoordinates, TranslationsAreAnatomicalOnARightKnee) {
  const JointCoordinates q =
      joint_coordinates(aligned(1), {Matrix3d::Identity(), Vector3d(1, 2, -3)});
  EXPECT_NEAR(q.lateral_shift, 1, 1e-15);
  EXPECT_NEAR(q.anterior_drawer, 2, 1e-15);
  EXPECT_NEAR(q.distraction, 3, 1e-15);  // the tibia below the femur
}

TEST(JointCoordinates, AngleTripletsSurviveTheRoundTrip) {
  Random random(31);
  for (int i = 0; i < 50; ++i) {
    for (const bool tibia_moves : {true, false}) {
      for (const double side : {1.0, -1.0}) {
        const JointFrames frames = random_frames(random, tibia_moves, side);
        const double flexion = random.between(-3.1, 3.1), adduction = random.between(-1.5, 1.5),
                     rotation = random.between(-3.1, 3.1);
        const Matrix3d R = rotation_from_joint_angles(frames, flexion, adduction, rotation);
        const JointCoordinates q = joint_coordinates(frames, {R, random.vector(10)});
        EXPECT_NEAR(q.flexion, flexion, 1e-12);
        EXPECT_NEAR(q.adduction, adduction, 1e-12);
        EXPECT_NEAR(q.internal_rotation, rotation, 1e-12);
      }
    }
  }
}

TEST(JointCoordinates, DoNotDependOnWhichBodyMoves) {
  Random random(32);
  const JointFrames tibia_moves = random_frames(random, true, 1);
  JointFrames femur_moves = tibia_moves;
  femur_moves.tibia_moves = false;
  const RigidTransform X_FT = random.pose(30);
  const JointCoordinates q = joint_coordinates(tibia_moves, X_FT),
                         p = joint_coordinates(femur_moves, X_FT.inverse());
  EXPECT_NEAR(q.flexion, p.flexion, 1e-12);
  EXPECT_NEAR(q.adduction, p.adduction, 1e-12);
  EXPECT_NEAR(q.internal_rotation, p.internal_rotation, 1e-12);
  EXPECT_NEAR(q.lateral_shift, p.lateral_shift, 1e-11);
  EXPECT_NEAR(q.anterior_drawer, p.anterior_drawer, 1e-11);
  EXPECT_NEAR(q.distraction, p.distraction, 1e-11);
}

TEST(JointCoordinates, MirroredKneeHasTheSameCoordinates) {
  // Mirroring at the sagittal plane, S = diag(-1, 1, 1), turns a pose (R, p) of a right knee into
  // (S R S, S p) of a left one. Its triads (lateral, anterior, proximal) are left-handed; with the
  // first axis turned round they are S F S.
  Random random(33);
  const Matrix3d S = Vector3d(-1, 1, 1).asDiagonal();
  const auto mirrored = [&](const RigidTransform& X) {
    return RigidTransform{S * X.R * S, S * X.p};
  };
  const JointFrames right = random_frames(random, true, 1);
  const JointFrames left{mirrored(right.X_F), mirrored(right.X_T), true, -1};
  const RigidTransform X = random.pose(30);
  const JointCoordinates q = joint_coordinates(right, X), p = joint_coordinates(left, mirrored(X));
  EXPECT_NEAR(q.flexion, p.flexion, 1e-12);
  EXPECT_NEAR(q.adduction, p.adduction, 1e-12);
  EXPECT_NEAR(q.internal_rotation, p.internal_rotation, 1e-12);
  EXPECT_NEAR(q.lateral_shift, p.lateral_shift, 1e-11);
  EXPECT_NEAR(q.anterior_drawer, p.anterior_drawer, 1e-11);
  EXPECT_NEAR(q.distraction, p.distraction, 1e-11);
}

TEST(JointCoordinates, StayFiniteAtARightAngleOfAdduction) {
  const Matrix3d R = rotation_from_joint_angles(aligned(1), 0, std::numbers::pi / 2, 0);
  const JointCoordinates q = joint_coordinates(aligned(1), {R, Vector3d(1, 2, 3)});
  EXPECT_NEAR(q.adduction, std::numbers::pi / 2, 1e-12);
  EXPECT_TRUE(std::isfinite(q.flexion) && std::isfinite(q.internal_rotation) &&
              std::isfinite(q.anterior_drawer));
}

}  // namespace
}  // namespace condyle
