#include "condyle/pictures/knee_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/pictures/ligament_groups.h"
#include "condyle/pictures/seen_insertions.h"
#include "condyle/results/run_view.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

double length_of(const std::vector<Vector3d>& line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

TEST(KneeShapes, TheTibiaStandsStillWhicheverBodyMoves) {
  Scene scene = block_scene(1);
  RigidTransform X_BA;
  X_BA.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  X_BA.p = {1, 2, 3};
  const auto tibia_moves = body_poses(scene, X_BA);
  EXPECT_TRUE(tibia_moves[1].R.isIdentity(1e-15));
  EXPECT_LT(tibia_moves[1].p.norm(), 1e-15);
  // A point of the femur at f lies at X_BA⁻¹ f in the tibia's frame.
  EXPECT_LT((tibia_moves[0] * (X_BA * Vector3d(4, 5, 6)) - Vector3d(4, 5, 6)).norm(), 1e-12);

  std::swap(scene.bodies[0].fixed, scene.bodies[1].fixed);
  const auto femur_moves = body_poses(scene, X_BA);
  EXPECT_LT(femur_moves[1].p.norm(), 1e-15);
  EXPECT_LT((femur_moves[0] * Vector3d(4, 5, 6) - X_BA * Vector3d(4, 5, 6)).norm(), 1e-12);
}

TEST(KneeShapes, ContactForcePushesTheFemurUp) {
  auto run = block_run();
  // The normal out of the fixed femur points down; the tibia pushes the femur up.
  for (const ContactMark& mark : contact_marks(run.scene, run.sweep.poses[0]))
    EXPECT_GT(mark.toward_femur.y(), 0.99);
  // With the tibia fixed the normal out of the fixed body already points up.
  std::swap(run.scene.bodies[0].fixed, run.scene.bodies[1].fixed);
  for (ContactResult& contact : run.sweep.poses[0].contacts)
    contact.points[0].normal_ground = {0, 1, 0};
  for (const ContactMark& mark : contact_marks(run.scene, run.sweep.poses[0]))
    EXPECT_GT(mark.toward_femur.y(), 0.99);
}

// Of a layer the point is where it is pressed most; the resultant acts elsewhere.
TEST(KneeShapes, ALayerIsMarkedAtItsCentreOfPressure) {
  auto run = block_run();
  PoseResult& pose = run.sweep.poses[0];
  const Vector3d before = contact_marks(run.scene, pose)[0].point;
  pose.contacts[0].layer.emplace();
  pose.contacts[0].resultant_ground = pose.contacts[0].points[0].point_ground + Vector3d(1, 0, 2);
  EXPECT_NEAR((contact_marks(run.scene, pose)[0].point - before).norm(), std::sqrt(5.0), 1e-12);
  const auto place = acting_place(pose.contacts[0], pose.X_BA, true);
  ASSERT_TRUE(place);
  EXPECT_LT((pose.X_BA * *place - pose.contacts[0].resultant_ground).norm(), 1e-12);
}

TEST(KneeShapes, OpenContactsHaveNoMark) {
  auto run = block_run();
  run.sweep.poses[0].contacts[0].closed = false;
  EXPECT_EQ(contact_marks(run.scene, run.sweep.poses[0]).size(), 1u);
}

/// A pose of which all ligaments have these numbers.
PoseResult pose_with(const LigamentResult& all) {
  PoseResult pose;
  pose.ligaments.assign(2, all);
  return pose;
}

TEST(KneeShapes, ATautLigamentIsStraightAndASlackOneHasItsSlackLength) {
  const auto run = block_run();
  const auto X_P = body_poses(run.scene, {});
  EXPECT_EQ(ligament_line(run.scene, X_P, 0, pose_with({40, 0.05, 30})).size(), 2u);
  // At -5 % strain the ligament is 40 / 0.95 = 42.105 mm long; the parabola meets that to second
  // order.
  const auto slack = ligament_line(run.scene, X_P, 1, pose_with({40, -0.05, 0}));
  EXPECT_NEAR(length_of(slack), 42.105, 0.15);
  EXPECT_LT(slack[slack.size() / 2].z(), -36) << "a medial ligament bows away from the knee";
}

TEST(KneeShapes, AVerySlackLigamentStaysNearTheKnee) {
  const auto run = block_run();
  for (const double strain : {-0.3, -0.7, -0.99, -5.0}) {
    for (const Vector3d& p :
         ligament_line(run.scene, body_poses(run.scene, {}), 1, pose_with({40, strain, 0}))) {
      EXPECT_TRUE(p.allFinite());
      EXPECT_LT(p.norm(), 60);
    }
  }
}

TEST(KneeShapes, ScalesIgnorePosesThatFailed) {
  auto run = block_run();
  run.sweep.poses[2].status = PoseStatus::kDiverged;
  run.sweep.poses[2].ligaments[0].strain = 1e6;
  run.sweep.poses[2].contacts[0].force = 1e9;
  const PictureScales scales = picture_scales(run);
  EXPECT_DOUBLE_EQ(scales.ligament_top, 0.025);
  EXPECT_DOUBLE_EQ(scales.force_top, 200);
  EXPECT_DOUBLE_EQ(scales.sweep_high, 0.5);
}

TEST(KneeShapes, LigamentsWithoutASlackLengthAreColouredByForce) {
  auto run = block_run();
  for (LigamentDescription& ligament : run.scene.ligaments)
    ligament.law = PolynomialLaw{{0, 1}, true};
  const PictureScales scales = picture_scales(run);
  EXPECT_FALSE(scales.strain_known);
  EXPECT_FALSE(scales.some_unstrained);
  const LigamentDescription& ligament = run.scene.ligaments[0];
  EXPECT_NE(ligament_color(scales, ligament, {40, 0, 30}),
            ligament_color(scales, ligament, {40, 0, 10}));
}

TEST(KneeShapes, OneLigamentWithoutASlackLengthAmongOthersHasAColourOfItsOwn) {
  auto run = block_run();
  EXPECT_FALSE(picture_scales(run).some_unstrained);
  run.scene.ligaments[0].law = PolynomialLaw{{0, 1}, true};
  const PictureScales scales = picture_scales(run);
  EXPECT_TRUE(scales.strain_known);
  EXPECT_TRUE(scales.some_unstrained);
  EXPECT_EQ(ligament_color(scales, run.scene.ligaments[0], {40, 0, 30}), kUnstrainedColor);
  EXPECT_EQ(ligament_color(scales, run.scene.ligaments[0], {40, 0, 0}), kSlackColor);
  EXPECT_EQ(ligament_color(scales, run.scene.ligaments[1], {40, 0, 30}),
            map_color(ColorMap::kStrain, 0));
}

TEST(KneeShapes, ThePathEndsWhereTheContactOpens) {
  auto run = block_run();
  const auto vertices = [&] {
    return contact_paths(run, tibia_body(run.scene), picture_scales(run)).vertices.size();
  };
  const std::size_t whole = vertices();
  run.sweep.poses[1].contacts[0].closed = false;  // the medial path falls apart into two dots
  EXPECT_LT(vertices(), whole);
  run.sweep.poses[0].contacts[0].closed = run.sweep.poses[2].contacts[0].closed = false;
  const std::size_t lateral_only = vertices();
  run.scene.contacts.pop_back();
  EXPECT_GT(lateral_only, 0u);
  EXPECT_EQ(vertices(), 0u);
}

TEST(KneeShapes, RunsWithoutMeshesAndPatchesAreDrawable) {
  auto run = block_run();
  run.bodies.clear();
  EXPECT_TRUE(body_shapes(run).empty());
  run.bodies = {{"femur", {}}, {"somebody else", box({0, 0, 0}, {1, 1, 1})}};
  EXPECT_TRUE(body_shapes(run).empty());
}

TEST(KneeShapes, OneStrandOfFiftyPerCentDoesNotMakeTheOthersBlack) {
  auto run = block_run();
  const LigamentDescription& strand = run.scene.ligaments[0];
  const Rgb before = ligament_color(picture_scales(run), strand, {40, 0.05, 30});
  run.sweep.poses[1].ligaments[1] = {60, 0.5, 3000};
  const PictureScales scales = picture_scales(run);
  EXPECT_DOUBLE_EQ(scales.ligament_top, 0.10);
  EXPECT_DOUBLE_EQ(scales.ligament_greatest, 0.5);
  EXPECT_EQ(ligament_color(scales, strand, {60, 0.5, 3000}), map_color(ColorMap::kStrain, 1));
  EXPECT_EQ(ligament_color(scales, strand, {40, 0.05, 30}), map_color(ColorMap::kStrain, 0.5));
  EXPECT_NE(before, ligament_color(scales, strand, {40, 0.05, 30})) << "5 % was the end before";
}

TEST(KneeShapes, ThePathIsNotDrawnThroughAJump) {
  auto run = block_run();
  const auto vertices = [&] {
    return contact_paths(run, tibia_body(run.scene), picture_scales(run)).vertices.size();
  };
  const std::size_t whole = vertices();
  run.sweep.events = {{0.75, EventKind::kJump, 0}};  // of the medial contact, between two poses
  const std::size_t parted = vertices();
  EXPECT_LT(parted, whole);
  run.sweep.events.push_back({0.75, EventKind::kJump, 1});
  EXPECT_EQ(parted - vertices(), whole - parted) << "one piece of line each";
}

TEST(KneeShapes, PointsBeyondAnEdgeAreCrossed) {
  auto run = block_run();
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(edge_crosses(contact_marks(run.scene, run.sweep.poses[0]), R, picture_scales(run))
                  .vertices.empty());
  run.sweep.poses[0].contacts[0].points[0].edge_distance = -2;
  const ShadedMesh cross =
      edge_crosses(contact_marks(run.scene, run.sweep.poses[0]), R, picture_scales(run));
  ASSERT_FALSE(cross.vertices.empty());
  const Vector3d point = contact_marks(run.scene, run.sweep.poses[0])[0].point;
  Vector3d middle = Vector3d::Zero();
  for (const ShadedVertex& v : cross.vertices)
    middle += v.position.cast<double>() / static_cast<double>(cross.vertices.size());
  EXPECT_LT((middle - point).norm(), 0.05);
}

TEST(KneeShapes, MarksOfASmallSceneAreSmall) {
  auto run = block_run();
  run.sweep.poses[0].contacts[0].points[0].edge_distance = -2;
  const std::vector<ContactMark> marks = contact_marks(run.scene, run.sweep.poses[0]);
  const auto reach = [&](const ShadedMesh& mesh) {
    double farthest = 0;
    for (const ShadedVertex& v : mesh.vertices)
      farthest = std::max(farthest, (v.position.cast<double>() - marks[0].point).norm());
    return farthest;
  };
  const PictureScales knee = picture_scales(run), small = picture_scales(run, 0.25);
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  EXPECT_NEAR(reach(edge_crosses(marks, R, small)), reach(edge_crosses(marks, R, knee)) / 4, 1e-3);
  const std::vector<ContactMark> first = {marks[0]};
  EXPECT_NEAR(reach(force_arrows(first, small)), reach(force_arrows(first, knee)) / 4, 1e-3);
  EXPECT_DOUBLE_EQ(small.tube_radius, knee.tube_radius / 4);
}

TEST(LigamentGroups, NumberedStrandsAreOneLigament) {
  const auto groups = ligament_groups(block_scene(1));
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].name, "LCL");
  EXPECT_EQ(groups[1].name, "MCL");
  EXPECT_EQ(groups[1].members, (std::vector<std::size_t>{1, 2}));
  Scene scene = block_scene(1);
  scene.ligaments.pop_back();
  EXPECT_EQ(ligament_groups(scene)[1].name, "MCL1") << "a single one keeps its number";
}

TEST(SeenFromAbove, InsertionsBelowThePlateauAreNot) {
  auto run = block_run();
  run.scene.ligaments.push_back(strand("below", {0, 10, 0}, {0, -30, 10}));
  run.scene.ligaments.push_back(strand("on top", {0, 10, 0}, {0, -2.5, 10}));
  const auto seen = seen_insertions(run.scene, body_shapes(run), tibia_body(run.scene),
                                    view_rotation(View::kPlateau, anatomy_of(run.scene)));
  // LCL and MCL insert beside the block, 6 mm clear of it.
  EXPECT_EQ(seen, (std::vector<bool>{true, true, true, false, true}));
}

}  // namespace
}  // namespace condyle
