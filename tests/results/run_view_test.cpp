/// What is asked of a run by all who show it.

#include "condyle/results/run_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "condyle/compare/laxity.h"
#include "condyle/input_error.h"
#include "condyle/network/simulate.h"
#include "condyle/results/strain_scale.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

TEST(RunView, AnEquilibriumBeyondAnEdgeHasAPlaceAndOtherFailuresHaveNone) {
  PoseResult pose = made_up_pose(1);
  EXPECT_TRUE(has_place(pose));
  pose.status = PoseStatus::kLeftPatch;
  EXPECT_TRUE(has_place(pose));
  for (const PoseStatus status :
       {PoseStatus::kSingular, PoseStatus::kOverlap, PoseStatus::kDiverged}) {
    pose.status = status;
    EXPECT_FALSE(has_place(pose)) << name(status);
  }
  // Files of version 0.1.0 hold no number of it.
  pose.status = PoseStatus::kLeftPatch;
  pose.X_BA.p.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(has_place(pose));
}

TEST(RunView, WhatIsSweptGoesByItsKindAndNotByItsName) {
  condyle::Run run = made_up_run();
  const auto index = static_cast<std::size_t>(run.scene.sweep->index);
  ASSERT_EQ(run.scene.conditions[index].kind, ConditionKind::kFlexion);
  run.scene.conditions[index].name = run.scene.sweep->vary = "adduction";
  EXPECT_TRUE(is_swept(run, 0));
  EXPECT_FALSE(is_swept(run, 1));
}

TEST(RunView, TellsHowFarAContactLiesBeyondItsEdge) {
  PoseResult pose = made_up_pose(1);
  EXPECT_EQ(beyond_edge(pose), 0) << "surfaces without an edge";
  pose.contacts[0].points[0].edge_distance = 4;
  EXPECT_EQ(beyond_edge(pose), 0);
  pose.contacts[0].points[1].edge_distance = -2.5;
  EXPECT_DOUBLE_EQ(beyond_edge(pose), 2.5);
  pose.contacts[0].closed = false;
  EXPECT_EQ(beyond_edge(pose), 0);
}

TEST(RunView, TheNearestPoseMayLieABitBeyondTheRun) {
  condyle::Run run = made_up_run();  // 0, 5.73 and 11.46 deg
  EXPECT_EQ(nearest_pose_of(run, "run.h5", 5), 1U);
  EXPECT_EQ(nearest_pose_of(run, "run.h5", 11.9), 2U);
  EXPECT_THROW((void)nearest_pose_of(run, "run.h5", 12), InputError);
  // Seconds are not rounded to the half: a motion of 0.2 s has nothing at 0.6 s.
  run.study = std::make_shared<const Simulation>();
  EXPECT_EQ(nearest_pose_of(run, "run.h5", 0.2), 2U);
  EXPECT_THROW((void)nearest_pose_of(run, "run.h5", 0.6), InputError);
}

TEST(RunView, TimesHaveAUnitThatSuitsThem) {
  EXPECT_EQ(short_time(7.54e-6, "us"), "7.54 us");
  EXPECT_EQ(short_time(0.0877, "us"), "87.7 ms");
  EXPECT_EQ(short_time(0.0009996, "us"), "1 ms");
  EXPECT_EQ(short_time(1.7017, "us"), "1.70 s");
  EXPECT_EQ(short_time(1234.4, "us"), "1234 s");
}

// A scene may hold the tables of several commands.
TEST(RunView, TheKindOfARunSaysWhatIsSweptAndNotItsScene) {
  condyle::Run run = made_up_run();
  run.scene.simulation.emplace();
  EXPECT_EQ(run.kind(), RunKind::kSweep);
  EXPECT_EQ(swept_quantity(run).heading(), "bend [deg]");
  run.study = std::make_shared<const Comparison>();
  EXPECT_EQ(run.kind(), RunKind::kComparison);
  EXPECT_EQ(swept_quantity(run).name, "bend");
  run.study = std::make_shared<const LaxityResult>();
  EXPECT_EQ(run.kind(), RunKind::kLaxity);
  EXPECT_EQ(run.comparison(), nullptr);
  EXPECT_NE(run.laxity(), nullptr);
  run.study = std::make_shared<const Simulation>();
  EXPECT_EQ(run.kind(), RunKind::kSimulation);
  EXPECT_EQ(swept_quantity(run).heading(), "time [s]");
  run.study = FitStudy{};
  EXPECT_EQ(run.kind(), RunKind::kFit);
  EXPECT_EQ(swept_quantity(run).unit.name, "1");
}

TEST(RunView, TheMovingBodyStandsWhereThePoseSaysAndTheFixedOneInTheGround) {
  const condyle::Run run = made_up_run();
  const RigidTransform X_BA = run.sweep.poses[2].X_BA;
  EXPECT_EQ(body_pose(run.scene, X_BA, run.scene.moving_body()).p, X_BA.p);
  EXPECT_EQ(body_pose(run.scene, X_BA, run.scene.fixed_body()).p, Eigen::Vector3d::Zero());
  EXPECT_EQ(tibia_body(run.scene), run.scene.moving_body());
  ASSERT_NE(patch_of(run, "ball"), nullptr);
  EXPECT_EQ(patch_of(run, "ball")->data.nu, 5);
  EXPECT_EQ(patch_of(run, "plateau"), nullptr);
}

TEST(RunView, ThePlaceOfInterestIsWhereMostIsCarried) {
  const condyle::Run run = made_up_run();  // two points at the last pose only
  EXPECT_EQ(place_of_interest(run, run.scene.moving_body()), made_up_point(1).point_moving);
  condyle::Run later = run;
  later.sweep.poses.erase(later.sweep.poses.begin());
  EXPECT_EQ(place_of_interest(later, later.scene.fixed_body()), made_up_point(4).point_ground);

  // A damaged file may hold anything.
  later = run;
  later.sweep.poses[0].contacts[0].points[0].point_moving.x() = std::nan("");
  const Eigen::Vector3d place = place_of_interest(later, later.scene.moving_body());
  EXPECT_TRUE(place.allFinite());
  EXPECT_NE(place, made_up_point(1).point_moving);
}

TEST(StrainScale, EndsAtTenPerCentWhateverOneStrandDoes) {
  condyle::Run run = made_up_run();
  run.sweep.poses[2].ligaments[0].strain = 0.034;
  EXPECT_DOUBLE_EQ(strain_scale(run).top, 0.04);
  EXPECT_FALSE(strain_scale(run).exceeded());
  run.sweep.poses[2].ligaments[0].strain = 0.5;
  EXPECT_DOUBLE_EQ(strain_scale(run).top, 0.10);
  EXPECT_DOUBLE_EQ(strain_scale(run).greatest, 0.5);
  EXPECT_TRUE(strain_scale(run).exceeded());
  run.sweep.poses[2].status = PoseStatus::kSingular;
  EXPECT_FALSE(strain_scale(run).exceeded()) << "what failed says nothing";
}

}  // namespace
}  // namespace condyle
