/// Frames from the shape of two meshes: the phantom's are known by construction, those of a moved, mirrored or
/// rescaled knee from the knee.

#include "condyle/anatomy/recognise_knee.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/mesh_files/load_mesh.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

KneeMeshes phantom() {
  const std::string folder = CONDYLE_SOURCE_DIR "/meshes/";
  return {load_mesh(folder + "femur.stl", 1), load_mesh(folder + "tibia.stl", 1), {}, {}};
}

template <class Map>
KneeMeshes mapped(KneeMeshes meshes, const Map& map) {
  for (TriangleMesh* mesh : {&meshes.femur, &meshes.tibia})
    for (Vector3d& p : mesh->vertices) p = map(p);
  return meshes;
}

double angle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

void expect_frame(const BoneFrame& found,
                  const BoneFrame& truth,
                  double angle_tolerance,
                  double tolerance) {
  EXPECT_LT(angle(found.lateral, truth.lateral), angle_tolerance);
  EXPECT_LT(angle(found.anterior, truth.anterior), angle_tolerance);
  EXPECT_LT(angle(found.proximal, truth.proximal), angle_tolerance);
  EXPECT_LT((found.origin - truth.origin).norm(), tolerance);
}

BoneFrame phantom_frame() {
  BoneFrame frame;
  frame.anterior = Vector3d::UnitX();
  frame.proximal = Vector3d::UnitY();
  frame.lateral = Vector3d::UnitZ();
  return frame;
}

}  // namespace

TEST(RecogniseKnee, FindsTheFramesThatThePhantomWasBuiltIn) {
  const RecognisedKnee knee = recognise_knee(phantom());
  EXPECT_EQ(knee.to_mm, 1);
  EXPECT_EQ(knee.side, Side::kRight);
  EXPECT_GT(knee.side_confidence, 0.95);
  expect_frame(knee.femur.frame, phantom_frame(), 3 * kDegree, 4);
  expect_frame(knee.tibia.frame, phantom_frame(), 3 * kDegree, 4);
}

// Turned anyhow, metres away, in another unit: frames move along.
TEST(RecogniseKnee, MovesAndScalesWithTheMeshes) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2.1, Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  const Vector3d d(-3100, 1700, 4200);
  for (const double unit : {1.0, 10.0, 25.4, 1000.0}) {
    const RecognisedKnee moved = recognise_knee(
        mapped(meshes, [&](const Vector3d& p) { return Vector3d((R * p + d) / unit); }));
    EXPECT_EQ(moved.to_mm, unit);
    EXPECT_EQ(moved.side, knee.side);
    for (const auto& [found, from] :
         {std::pair(&moved.femur, &knee.femur), std::pair(&moved.tibia, &knee.tibia)}) {
      BoneFrame carried = from->frame;
      carried.origin = R * carried.origin + d;
      carried.lateral = R * carried.lateral;
      carried.anterior = R * carried.anterior;
      carried.proximal = R * carried.proximal;
      expect_frame(found->frame, carried, 1e-6, 1e-5);
    }
  }
}

TEST(RecogniseKnee, AMirrorImageIsALeftKnee) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  const RecognisedKnee mirrored = recognise_knee(
      mapped(meshes, [](const Vector3d& p) { return Vector3d(p.x(), p.y(), -p.z()); }));
  EXPECT_EQ(mirrored.side, Side::kLeft);
  EXPECT_NEAR(mirrored.side_confidence, knee.side_confidence, 1e-6);
  const Vector3d mirror(1, 1, -1);
  BoneFrame truth = knee.femur.frame;
  truth.origin.array() *= mirror.array();
  truth.lateral.array() *= mirror.array();
  truth.anterior.array() *= mirror.array();
  truth.proximal.array() *= mirror.array();
  expect_frame(mirrored.femur.frame, truth, 1e-6, 1e-5);
}

TEST(RecogniseKnee, NamesAnEmptyMesh) {
  EXPECT_THROW((void)recognise_knee(KneeMeshes{}), InputError);
}

}  // namespace condyle
