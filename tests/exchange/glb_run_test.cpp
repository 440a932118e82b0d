/// The animated scene, read back by a reader of its own: where things are at each keyframe.

#include "condyle/exchange/glb_run.h"

#include <gtest/gtest.h>

#include "condyle/exchange/shown_poses.h"
#include "condyle/input_error.h"
#include "exchange/glb_reader.h"
#include "exchange/phantom_run.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::GlbReader;
using test::phantom_run;

constexpr double kFloat = 1e-8;  // [m], a few roundings of a float of 0.1 m

TEST(GlbRun, PutsEveryVertexOfABoneWhereThePoseSays) {
  const condyle::Run& run = phantom_run();
  const GlbReader glb(glb_of_run(run, "run.h5"));
  const int bone = glb.node("tibia bone"), tibia = glb.node("tibia");
  ASSERT_GE(bone, 0);
  const std::vector<Vector3d> vertices = glb.positions(bone);
  ASSERT_EQ(vertices.size(), run.bodies[1].mesh.vertices.size());
  for (std::size_t key = 0; key < 3; ++key) {
    const RigidTransform& X = run.sweep.poses[key].X_BA;
    const Eigen::Affine3d place = glb.place(tibia, key);
    double worst = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vector3d there = 1e-3 * (X * run.bodies[1].mesh.vertices[i]);
      worst = std::max(worst, (place * vertices[i] - there).norm());
    }
    EXPECT_LT(worst, 3 * kFloat) << key;
  }
}

TEST(GlbRun, ShowsTenDegreesASecond) {
  const GlbReader glb(glb_of_run(phantom_run(), "run.h5"));
  const std::vector<double> times = glb.times();
  ASSERT_EQ(times.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(times[i], 3.0 * static_cast<double>(i), 1e-6);
  const auto& extras = glb.json["scenes"][0]["extras"];
  EXPECT_EQ(extras["unit"], "deg");
  EXPECT_NEAR(extras["flexion_deg"][2].get<double>(), 60, 1e-9);
}

TEST(GlbRun, EndsItsLigamentsOnTheirInsertions) {
  const condyle::Run& run = phantom_run();
  const GlbReader glb(glb_of_run(run, "run.h5"));
  for (std::size_t i = 0; i < run.scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = run.scene.ligaments[i];
    const int node = glb.node("ligament " + ligament.name);
    ASSERT_GE(node, 0) << ligament.name;
    for (std::size_t key = 0; key < 3; ++key) {
      const PoseResult& pose = run.sweep.poses[key];
      const Eigen::Affine3d place = glb.place(node, key);
      const Vector3d a = 1e-3 * insertion(run.scene, pose, ligament.ends[0]);
      const Vector3d b = 1e-3 * insertion(run.scene, pose, ligament.ends[1]);
      EXPECT_LT((place * Vector3d(0, 0, 0) - a).norm(), 3 * kFloat);
      EXPECT_LT((place * Vector3d(0, 1, 0) - b).norm(), 3 * kFloat);
    }
    EXPECT_EQ(glb.json["nodes"][node]["extras"]["strain"][1].get<double>(),
              run.sweep.poses[1].ligaments[i].strain);
  }
}

TEST(GlbRun, TurnsALigamentUpsideDown) {
  condyle::Run run = phantom_run();
  const PoseResult& pose = run.sweep.poses[0];
  LigamentDescription& ligament = run.scene.ligaments[0];
  ligament.ends[1] = ligament.ends[0];
  ligament.ends[1].at -=
      body_pose(run.scene, pose.X_BA, ligament.ends[0].body).R.transpose() * Vector3d(0, 20, 0);
  const GlbReader glb(glb_of_run(run, "run.h5"));
  const Eigen::Affine3d place = glb.place(glb.node("ligament " + ligament.name), 0);
  const Vector3d a = 1e-3 * insertion(run.scene, pose, ligament.ends[0]);
  EXPECT_LT((place * Vector3d(0, 0, 0) - a).norm(), 3 * kFloat);
  EXPECT_LT((place * Vector3d(0, 1, 0) - (a - Vector3d(0, 0.02, 0))).norm(), 3 * kFloat);
}

TEST(GlbRun, NeverTurnsAQuaternionToItsOpposite) {
  const GlbReader glb(glb_of_run(phantom_run(), "run.h5"));
  for (std::size_t node = 0; node < glb.json["nodes"].size(); ++node) {
    const std::vector<double> q = glb.keys(static_cast<int>(node), "rotation");
    for (std::size_t k = 4; k + 3 < q.size(); k += 4) {
      const Eigen::Map<const Eigen::Vector4d> before(&q[k - 4]), here(&q[k]);
      EXPECT_GT(before.dot(here), 0) << glb.json["nodes"][node]["name"];
      EXPECT_NEAR(here.norm(), 1, 1e-6);
    }
  }
}

TEST(GlbRun, HidesAContactWhereItIsOpen) {
  condyle::Run run = phantom_run();
  run.sweep.poses[1].contacts[0].closed = false;
  const GlbReader glb(glb_of_run(run, "run.h5"));
  const int node = glb.node("contact medial");
  const std::vector<double> scale = glb.keys(node, "scale");
  EXPECT_EQ(scale, (std::vector<double>{1, 1, 1, 0, 0, 0, 1, 1, 1}));
  const Vector3d point = 1e-3 * strongest_point(run.sweep.poses[2].contacts[0])->point_ground;
  EXPECT_LT((glb.place(node, 2).translation() - point).norm(), kFloat);
}

TEST(GlbRun, HidesAContactOnTheWayThroughAJump) {
  condyle::Run run = phantom_run();
  run.sweep.events = {{0.6, EventKind::kJump, 1}};  // between 30 and 60 deg
  const GlbReader glb(glb_of_run(run, "run.h5"));
  const std::vector<double> scale = glb.keys(glb.node("contact lateral"), "scale");
  EXPECT_EQ(scale, (std::vector<double>{1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 1, 1}));
}

/// Keyframes are floats: late in a fast motion a thousandth of a frame is nothing to them.
TEST(GlbRun, TimesOfKeyframesIncreaseAlsoWhereFloatsAreAsCoarseAsFrames) {
  condyle::Run run = phantom_run();
  run.sweep.events = {{0.6, EventKind::kJump, 1}};
  for (const double start : {0.0, 20.0, 16000.0}) {
    std::vector<ShownPose> shown = shown_poses(run, "run.h5");
    for (std::size_t i = 0; i < shown.size(); ++i)
      shown[i].time = start + 1e-3 * static_cast<double>(i);
    const GlbReader glb(glb_of_poses(run, shown));
    const std::vector<double> times = glb.times_of(glb.node("contact lateral"), "scale");
    EXPECT_EQ(times.size(), start < 1000 ? 4U : 3U) << start;  // at 16,000 s floats are 1 ms apart
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]) << start;
  }
}

TEST(GlbRun, MarksAPoseBeyondAnEdgeByADiamondAndItsStatus) {
  condyle::Run run = phantom_run();
  EXPECT_LT(GlbReader(glb_of_run(run, "run.h5")).node("contact medial beyond the edge"), 0);
  run.sweep.poses[1].status = PoseStatus::kLeftPatch;
  run.sweep.poses[1].contacts[0].points[0].edge_distance = -2;
  const GlbReader glb(glb_of_run(run, "run.h5"));
  EXPECT_EQ(glb.json["scenes"][0]["extras"]["status"], (std::vector<double>{0, 4, 0}));
  const int node = glb.node("contact medial beyond the edge");
  ASSERT_GE(node, 0);
  // Seen at that pose, and gone right after it.
  EXPECT_EQ(glb.keys(node, "scale"), (std::vector<double>{0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0}));
  const Vector3d point = 1e-3 * run.sweep.poses[1].contacts[0].points[0].point_ground;
  EXPECT_LT((glb.place(node, 1).translation() - point).norm(), kFloat);
}

// Of the phantom: x anterior, y proximal, z lateral, and lateral is the right side of a right knee.
TEST(GlbRun, StandsUprightAndIsNoMirrorImage) {
  const Eigen::Matrix3d R = upright(phantom_run().scene);
  EXPECT_NEAR(R.determinant(), 1, 1e-15);
  EXPECT_LT((R * Vector3d::UnitY() - Vector3d::UnitY()).norm(), 1e-15);  // superior is up
  EXPECT_LT((R * Vector3d::UnitX() - Vector3d::UnitZ()).norm(), 1e-15);  // anterior faces us
  EXPECT_LT((R * Vector3d::UnitZ() + Vector3d::UnitX()).norm(), 1e-15);  // right is to our left
  const GlbReader glb(glb_of_run(phantom_run(), "run.h5"));
  const auto& q = glb.json["nodes"][0]["rotation"];
  const Eigen::Quaterniond root(q[3], q[0], q[1], q[2]);
  EXPECT_LT((root.toRotationMatrix() - R).norm(), 1e-15);
}

TEST(GlbRun, TurnsItsPatchesOutOfTheBone) {
  const condyle::Run& run = phantom_run();
  const GlbReader glb(glb_of_run(run, "run.h5"));
  for (const SurfaceDescription& surface : run.scene.surfaces) {
    const int node = glb.node(surface.name);
    ASSERT_GE(node, 0) << surface.name;
    const std::vector<Vector3d> p = glb.positions(node);
    const std::vector<double> n = glb.floats(glb.primitive(node)["attributes"]["NORMAL"]);
    const std::vector<std::uint32_t> corners = glb.corners(glb.primitive(node)["indices"]);
    ASSERT_GT(corners.size(), 300U);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      const Vector3d normal =
          (p[corners[i + 1]] - p[corners[i]]).cross(p[corners[i + 2]] - p[corners[i]]);
      const Vector3d given(n[3 * corners[i]], n[3 * corners[i] + 1], n[3 * corners[i] + 2]);
      ASSERT_GT(normal.dot(given), -1e-12) << surface.name;  // slivers at the edge have no area
    }
  }
}

TEST(GlbRun, ShowsNoBoneAbovePatchesThatReplaceIt) {
  const condyle::Run& run = phantom_run();
  const GlbReader glb(glb_of_run(run, "run.h5"));
  const int bone = glb.node("tibia bone");
  const std::vector<std::uint32_t> corners = glb.corners(glb.primitive(bone)["indices"]);
  const std::vector<Vector3d> p = glb.positions(bone);
  const Patch patch(run.patches[1].data);
  ASSERT_EQ(run.patches[1].surface, "medial plateau");
  int inside = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vector3d middle = 1e3 * (p[corners[i]] + p[corners[i + 1]] + p[corners[i + 2]]) / 3;
    const Place place = patch.closest(middle, patch.seed(middle));
    if ((patch.evaluate(place).c - middle).norm() < 0.8 && patch.edge_distance(place) > 3) ++inside;
  }
  EXPECT_EQ(inside, 0);
  EXPECT_GT(corners.size() / 3, run.bodies[1].mesh.triangles.size() * 3 / 4);
}

TEST(GlbRun, LeavesOutPosesThatFailed) {
  const condyle::Run run = made_up_run();
  EXPECT_EQ(GlbReader(glb_of_run(run, "run.h5")).times().size(), 2U);
}

TEST(GlbRun, NeedsAPoseThatConverged) {
  condyle::Run run = made_up_run();
  run.sweep.poses = {run.sweep.poses[1]};
  try {
    (void)glb_of_run(run, "run.h5");
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "run.h5: holds no pose that converged, expected the result of condyle sweep or "
                 "simulate");
  }
}

TEST(GlbRun, ThinsOutBonesWithoutMovingTheirVertices) {
  ShapeOptions options;
  options.bone_triangles = 3000;
  const std::vector<RunShape> shapes = run_shapes(phantom_run(), options);
  ASSERT_TRUE(shapes[0].bone);
  EXPECT_LT(shapes[0].mesh.triangles.size(), 3100U);
  EXPECT_GT(shapes[0].mesh.triangles.size(), 1500U);
  const std::vector<Vector3d>& whole = phantom_run().bodies[0].mesh.vertices;
  for (std::size_t i = 0; i < shapes[0].mesh.vertices.size(); i += 50)
    EXPECT_NE(std::find(whole.begin(), whole.end(), shapes[0].mesh.vertices[i]), whole.end());
}

}  // namespace
}  // namespace condyle
