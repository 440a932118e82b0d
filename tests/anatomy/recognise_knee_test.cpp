/// Frames from the shape of two meshes: the phantom's are known by construction, those of a moved, mirrored, cut or
/// roughened knee from the knee.

#include "condyle/anatomy/recognise_knee.h"

#include <gtest/gtest.h>

#include "anatomy/knee_variants.h"
#include "condyle/anatomy/cross_section.h"
#include "support/closed_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::axes_apart;
using test::drawn_out;
using test::expect_frame;
using test::joined;
using test::mapped;
using test::part;
using test::phantom;
using test::roughened;

void expect_as(const RecognisedKnee& found,
               const RecognisedKnee& truth,
               double degrees,
               double mm) {
  EXPECT_EQ(found.side, truth.side);
  EXPECT_GT(found.side_confidence, 0.95);
  expect_frame(found.femur.frame, truth.femur.frame, degrees, mm);
  expect_frame(found.tibia.frame, truth.tibia.frame, degrees, mm);
}

}  // namespace

TEST(RecogniseKnee, FindsTheFramesThatThePhantomWasBuiltIn) {
  const RecognisedKnee knee = recognise_knee(phantom());
  EXPECT_EQ(knee.to_mm, 1);
  EXPECT_EQ(knee.side, Side::kRight);
  EXPECT_GT(knee.side_confidence, 0.95);
  EXPECT_TRUE(knee.doubts.empty());
  expect_frame(knee.femur.frame, test::phantom_frame(), 3, 4);
  expect_frame(knee.tibia.frame, test::phantom_frame(), 3, 4);
}

// Turned anyhow, metres away, in another unit: frames move along.
TEST(RecogniseKnee, MovesAndScalesWithTheMeshes) {
  const RecognisedKnee knee = recognise_knee(phantom());
  const Eigen::Isometry3d X = Eigen::Translation3d(-3100, 1700, 4200) *
                              Eigen::AngleAxisd(2.1, Vector3d(0.3, -0.8, 0.5).normalized());
  for (const double unit : {1.0, 10.0, 25.4, 1000.0}) {
    const RecognisedKnee moved = recognise_knee(
        mapped(phantom(), [&](const Vector3d& p) { return Vector3d(X * p / unit); }));
    EXPECT_EQ(moved.to_mm, unit);
    EXPECT_EQ(moved.side, knee.side);
    expect_frame(moved.femur.frame, test::moved(knee.femur.frame, X), 1e-5, 1e-5);
    expect_frame(moved.tibia.frame, test::moved(knee.tibia.frame, X), 1e-5, 1e-5);
  }
}

TEST(RecogniseKnee, AMirrorImageIsALeftKnee) {
  const RecognisedKnee knee = recognise_knee(phantom());
  const Eigen::DiagonalMatrix<double, 3> mirror(1, 1, -1);
  const RecognisedKnee left =
      recognise_knee(mapped(phantom(), [&](const Vector3d& p) { return Vector3d(mirror * p); }));
  EXPECT_EQ(left.side, Side::kLeft);
  EXPECT_NEAR(left.side_confidence, knee.side_confidence, 1e-6);
  for (const auto& [found, from] :
       {std::pair(&left.femur, &knee.femur), std::pair(&left.tibia, &knee.tibia)}) {
    const BoneFrame& f = from->frame;
    expect_frame(found->frame,
                 {.origin = mirror * f.origin,
                  .lateral = mirror * f.lateral,
                  .anterior = mirror * f.anterior,
                  .proximal = mirror * f.proximal},
                 1e-5, 1e-5);
  }
}

// Each bone's axes are its own: the tibia takes its along wherever the scan has it.
TEST(RecogniseKnee, FramesBelongToTheBones) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  for (const double flexion : {10.0, 20.0, 30.0}) {
    const Eigen::Isometry3d X = Eigen::Translation3d(-2, -4, 1) *
                                Eigen::AngleAxisd(-flexion * kDegree, Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(0.1, Vector3d::UnitY());
    KneeMeshes flexed = meshes;
    flexed.tibia = mapped(meshes.tibia, [&](const Vector3d& p) { return Vector3d(X * p); });
    const RecognisedKnee found = recognise_knee(flexed);
    expect_frame(found.femur.frame, knee.femur.frame, 0.1, 0.1);
    EXPECT_LT(axes_apart(found.tibia.frame, test::moved(knee.tibia.frame, X)) / kDegree, 0.1);
    EXPECT_FALSE(found.doubts.empty()) << "scanned flexed";
  }
}

TEST(RecogniseKnee, CutShaftsHaveTheFramesOfLongOnes) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  for (const double femur : {0.8, 0.75, 0.7})
    for (const double tibia : {1.2, 0.9}) {
      KneeMeshes cut = meshes;
      cut.femur =
          part(meshes.femur, [&](const Vector3d& p) { return p.y() < femur * knee.femur.width; });
      cut.tibia =
          part(meshes.tibia, [&](const Vector3d& p) { return p.y() > -tibia * knee.femur.width; });
      expect_as(recognise_knee(cut), knee, 1, 1);
    }
}

// Shafts drawn out to 400 mm, a ball for the femoral head on its neck, another for the malleolus, a fibula beside the
// tibia in one mesh with it.
TEST(RecogniseKnee, WholeBonesHaveTheFramesOfCutOnes) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  const auto ball = [](double radius, const Vector3d& at) {
    return mapped(test::ellipsoid_solid(Vector3d::Constant(radius), 3),
                  [&](const Vector3d& p) { return Vector3d(p + at); });
  };
  const TriangleMesh fibula = mapped(test::cylinder_solid(6.5, 340, 3), [](const Vector3d& p) {
    return Vector3d(p.x() - 20, p.z() - 220, -p.y() + 30);
  });
  KneeMeshes whole = meshes;
  whole.femur = joined(drawn_out(meshes.femur, 400), ball(24, {0, 405, -40}));
  whole.tibia = joined(joined(drawn_out(meshes.tibia, -400), ball(26, {0, -395, 0})), fibula);
  expect_as(recognise_knee(whole), knee, 1, 1);
}

TEST(RecogniseKnee, RoughSurfacesHaveTheFramesOfSmoothOnes) {
  const KneeMeshes meshes = phantom();
  const RecognisedKnee knee = recognise_knee(meshes);
  for (const unsigned seed : {1u, 2u})
    expect_as(
        recognise_knee(
            {roughened(meshes.femur, 0.2, seed), roughened(meshes.tibia, 0.2, seed + 10), {}, {}}),
        knee, 1, 1);
}

// A section of a shaft then has several gaps.
TEST(RecogniseKnee, MissingTrianglesTurnNoFrame) {
  const KneeMeshes whole = phantom();
  const RecognisedKnee of_whole = recognise_knee(whole);
  for (const std::size_t of_thousand : {3, 10}) {
    SCOPED_TRACE(of_thousand);
    const auto torn = [&](const TriangleMesh& mesh) {
      std::vector<bool> kept;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        kept.push_back(t * 7919 % 1000 >= of_thousand);
      return clean_mesh(sub_mesh(mesh, kept).mesh).mesh;
    };
    const RecognisedKnee knee =
        recognise_knee({torn(whole.femur), torn(whole.tibia), std::nullopt, std::nullopt});
    EXPECT_GT(knee.femur.shaft, 0);
    EXPECT_GT(knee.tibia.shaft, 0);
    expect_frame(knee.femur.frame, of_whole.femur.frame, 0.3, 0.3);
    expect_frame(knee.tibia.frame, of_whole.tibia.frame, 0.3, 0.3);
  }
}

TEST(RecogniseKnee, TakesAGivenUnitAndSideAsTheyAre) {
  const RecognisedKnee knee = recognise_knee(phantom(), {.to_mm = 1.0, .side = Side::kLeft});
  EXPECT_EQ(knee.side, Side::kLeft);
  EXPECT_LT(knee.side_confidence, 0.05);
  EXPECT_FALSE(knee.doubts.empty());
  EXPECT_TRUE(side_in_words(knee).starts_with("left, as --side says; right by its shape, "))
      << side_in_words(knee);
  EXPECT_TRUE(side_in_words(recognise_knee(phantom())).starts_with("right, "));
}

TEST(CrossSection, OfACylinderIsADisc) {
  const TriangleMesh cylinder = test::cylinder_solid(10, 100, 0.5);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : cylinder.vertices)
    middle += p / static_cast<double>(cylinder.vertices.size());
  const Vector3d along = Vector3d(0.3, 0, 1).normalized();
  const std::vector<SectionLoop> loops = cross_section(cylinder, middle, along);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_NEAR(loops[0].area, M_PI * 100 / along.z(), 0.5);
  EXPECT_LT((loops[0].centroid - middle).norm(), 1e-6);
  EXPECT_LT(loops[0].opening, 1e-9);
}

}  // namespace condyle
