#include "condyle/pictures/camera.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "condyle/input_error.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Letters at the right and the upper edge of a view.
std::string edges(double side, View view) {
  const Anatomy anatomy = anatomy_of(block_scene(side));
  const Eigen::Matrix3d R = view_rotation(view, anatomy);
  return direction_letter(anatomy, R.row(0).transpose()) +
         direction_letter(anatomy, R.row(1).transpose());
}

TEST(Camera, DirectionsThatNobodyHasSaidAreAxes) {
  Scene scene = block_scene(1);
  scene.joint.reset();
  const Anatomy anatomy = anatomy_of(scene);
  EXPECT_FALSE(anatomy.known);
  EXPECT_EQ(direction_letter(anatomy, {0.9, 0.1, 0}), "x");
  EXPECT_EQ(direction_letter(anatomy, {0, -1, 0.2}), "−y");
  EXPECT_EQ(direction_letter(anatomy, {0, 0, 1}), "z");
}

TEST(Camera, RightKneeShowsEachSideWhereAnatomyHasIt) {
  // Facing the patient's right knee, its lateral side is at the viewer's left; from behind at the
  // viewer's right.
  EXPECT_EQ(edges(1, View::kAnterior), "MS");
  EXPECT_EQ(edges(1, View::kPosterior), "LS");
  // Standing between the legs the front of the right knee is at the left; outside of it at the
  // right.
  EXPECT_EQ(edges(1, View::kMedial), "PS");
  EXPECT_EQ(edges(1, View::kLateral), "AS");
  // From above with the toes up, right stays right.
  EXPECT_EQ(edges(1, View::kPlateau), "LA");
}

TEST(Camera, LeftKneeIsTheMirrorImage) {
  EXPECT_EQ(edges(-1, View::kAnterior), "LS");
  EXPECT_EQ(edges(-1, View::kPosterior), "MS");
  EXPECT_EQ(edges(-1, View::kMedial), "AS");
  EXPECT_EQ(edges(-1, View::kLateral), "PS");
  EXPECT_EQ(edges(-1, View::kPlateau), "MA");
}

TEST(Camera, NeverMirrorsSpace) {
  for (const double side : {1.0, -1.0}) {
    for (int view = 0; view < kViewCount; ++view) {
      const Eigen::Matrix3d R =
          view_rotation(static_cast<View>(view), anatomy_of(block_scene(side)));
      EXPECT_NEAR(R.determinant(), 1, 1e-12) << name(static_cast<View>(view));
    }
  }
}

TEST(Camera, FitsAllPointsIntoTheFrameAndTouchesIt) {
  const Frame frame{100, 50, 500, 250};
  const std::vector<Vector3d> points = {{0, 0, 0}, {80, 10, 5}, {40, 30, -60}};
  const Camera camera = fit_camera(Eigen::Matrix3d::Identity(), points, frame);
  // 80 mm over 400 pixels is coarser than 30 mm over 200.
  EXPECT_DOUBLE_EQ(camera.mm_per_pixel, 0.2);
  EXPECT_NEAR(camera.project(points[0]).x(), 100, 1e-9);
  EXPECT_NEAR(camera.project(points[1]).x(), 500, 1e-9);
  for (const Vector3d& p : points) {
    EXPECT_GE(camera.project(p).y(), 50);
    EXPECT_LE(camera.project(p).y(), 250);
  }
  EXPECT_GT(camera.project(points[0]).y(), camera.project(points[2]).y())
      << "up is towards smaller y";
}

TEST(Camera, AnUnknownViewIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(view_from_name("plateau"), View::kPlateau);
  try {
    (void)view_from_name("front");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("anterior, posterior, medial, lateral, plateau"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace condyle
