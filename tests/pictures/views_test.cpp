/// Facts of the views that take the knee apart, of ellipses, strips and lines.

#include <gtest/gtest.h>

#include <cstdlib>

#include "pictures/annotate.h"
#include "pictures/block_knee.h"
#include "pictures/knee_picture.h"
#include "pictures/png_file.h"
#include "pictures/strip.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr PictureOptions kBare = {600, 450, false};

Rgb seen_at(KneePictures& pictures, const Image& image, View view, const Vector3d& p) {
  const Vector3d at = pictures.camera(view).project(p);
  return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
}

bool is_white(Rgb c) { return c[0] > 252 && c[1] > 252 && c[2] > 252; }
bool is_hertz_color(Rgb c) { return c[0] > c[1] + 60 && c[1] > c[2] + 20; }

int count(const Image& image, bool (*is)(Rgb)) {
  int n = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) n += is(image.at(x, y)) ? 1 : 0;
  return n;
}

Run with_ellipse(double side = 1) {
  Run run = block_run(side);
  for (PoseResult& pose : run.sweep.poses)
    pose.contacts[1].points[0].hertz = HertzEstimate{{8, 3}, {1, 0, 0}, 2.5, 0.1};
  return run;
}

TEST(Views, TheCondylesAreSeenWithoutTheTibia) {
  auto run = block_run();
  const Image with = draw_knee(run, View::kCondyles, 1, kBare);
  EXPECT_LT(count(with, is_white), 0.9 * with.width * with.height);
  run.bodies[1].mesh = {};
  EXPECT_EQ(with.rgb, draw_knee(run, View::kCondyles, 1, kBare).rgb);
}

TEST(Views, TheCondylesOfALeftKneeAreTheMirrorImage) {
  // The lateral contact is the one at 15 mm: from below, anterior up, at the left of a right knee.
  for (const double side : {1.0, -1.0}) {
    const auto run = block_run(side);
    KneePictures pictures(run, kBare);
    const double lateral = pictures.camera(View::kCondyles).project({0, 0, 15 * side}).x();
    const double medial = pictures.camera(View::kCondyles).project({0, 0, -15 * side}).x();
    EXPECT_GT(side * (medial - lateral), 0);
    EXPECT_GT(pictures.camera(View::kCondyles).project({-10, 0, 0}).y(),
              pictures.camera(View::kCondyles).project({10, 0, 0}).y())
        << "anterior is up";
  }
}

TEST(Views, TheExplodedKneeShowsBothSurfacesApart) {
  const auto run = block_run();
  const Staging staging = staging_of(run, View::kExploded);
  EXPECT_GE(staging.lifted, 40);
  const Eigen::Matrix3d R = view_rotation(View::kExploded, anatomy_of(run.scene));
  EXPECT_GT(R.row(2).dot(Vector3d(0, 1, 0)), 0.3) << "the plateau faces the viewer";
  const Vector3d below = staging.lift.R * Vector3d(0, -1, 0);
  EXPECT_GT(R.row(2).dot(below), 0.3) << "and so do the condyles";
  KneePictures pictures(run, kBare);
  const Camera& camera = pictures.camera(View::kExploded);
  EXPECT_LT(camera.project(staging.lift * Vector3d(0, 0, 15)).y(),
            camera.project({0, 0, 15}).y() - 100)
      << "the femur's side of a contact stands well above the tibia's";
}

TEST(Views, TheExplodedLeftKneeIsTheMirrorImage) {
  const auto right = block_run(1), left = block_run(-1);
  KneePictures right_pictures(right, kBare), left_pictures(left, kBare);
  const Camera &a = right_pictures.camera(View::kExploded),
               &b = left_pictures.camera(View::kExploded);
  const double sum = a.center.x() + b.center.x();
  for (const Vector3d& p : {Vector3d(10, 5, 20), Vector3d(-5, -20, 3)}) {
    const Vector3d in_right = a.project(p), in_left = b.project({p.x(), p.y(), -p.z()});
    EXPECT_NEAR(in_right.x() + in_left.x(), sum, 1);
    EXPECT_NEAR(in_right.y(), in_left.y(), 1);
  }
}

TEST(Views, AnEllipseIsDrawnToScaleWhereAskedFor) {
  const auto run = with_ellipse();
  PictureOptions options = kBare;
  EXPECT_EQ(count(draw_knee(run, View::kPlateau, 0, options), is_hertz_color), 0);
  options.hertz = true;
  KneePictures pictures(run, options);
  const Image image = pictures.draw(View::kPlateau, 0);
  // Semi-axes 8 mm along x (anterior) and 3 mm along z, about the lateral contact (0, 0, 15); the
  // rim is 0.16 mm to either side, the dot in the middle 0.7 mm.
  const auto hertz_at = [&](double x, double z) {
    return is_hertz_color(seen_at(pictures, image, View::kPlateau, {x, 0, 15 + z}));
  };
  EXPECT_TRUE(hertz_at(7.2, 0));
  EXPECT_TRUE(hertz_at(-7.2, 0));
  EXPECT_TRUE(hertz_at(0, 2.2));
  EXPECT_FALSE(hertz_at(0, 4));
  EXPECT_FALSE(hertz_at(9, 0));
  const double pixel = pictures.camera(View::kPlateau).mm_per_pixel;
  const double area = M_PI * 8 * 3 - M_PI * 0.7 * 0.7;
  EXPECT_NEAR(count(image, is_hertz_color) * pixel * pixel, area, 0.12 * area);
}

TEST(Views, EllipsesOfTheCondylesLieOnTheSameContact) {
  const auto run = with_ellipse();
  PictureOptions options = kBare;
  options.hertz = true;
  KneePictures pictures(run, options);
  const Image image = pictures.draw(View::kCondyles, 0);
  EXPECT_TRUE(is_hertz_color(seen_at(pictures, image, View::kCondyles, {6, 0, 15})));
}

TEST(Views, ALineContactIsALineBetweenItsEnds) {
  auto run = block_run();
  ContactResult& contact = run.sweep.poses[0].contacts[1];
  contact.shape = ContactShape::kLine;
  ContactPointResult other = contact.points[0];
  contact.points[0].point_ground = contact.points[0].point_moving = {-12, 0, 15};
  other.point_ground = other.point_moving = {12, 0, 15};
  contact.points.push_back(other);
  KneePictures pictures(run, kBare);
  const Image image = pictures.draw(View::kPlateau, 0);
  EXPECT_LT(seen_at(pictures, image, View::kPlateau, {6, 0, 15})[0], 110);
  contact.shape = ContactShape::kPoint;
  const Image points = pictures.draw(View::kPlateau, 0);
  EXPECT_GT(seen_at(pictures, points, View::kPlateau, {6, 0, 15})[0], 140);
}

TEST(Views, AStripHoldsThePosesSideBySide) {
  const auto run = block_run();
  const PictureOptions size = strip_size(View::kAnterior, 3);
  const Image strip = draw_strip(run, View::kAnterior, {0, 1, 2}, size);
  EXPECT_EQ(strip.width, size.width);
  EXPECT_EQ(strip.height, size.height);
  const int panel = (size.width - 96) / 3;  // 96: 120 of 800 for the bars at a height of 640
  for (int i = 0; i < 3; ++i) {
    int ink = 0;
    for (int y = 150; y < 500; ++y)
      for (int x = i * panel; x < (i + 1) * panel; ++x) ink += is_white(strip.at(x, y)) ? 0 : 1;
    EXPECT_GT(ink, 0.25 * panel * 350) << i;
  }
  EXPECT_EQ(strip.rgb, draw_strip(run, View::kAnterior, {0, 1, 2}, size).rgb) << "the same bytes";
}

/// Kept in tests/pictures/data; made by
///     CONDYLE_KEEP_PICTURES=yes build/condyle_tests --gtest_filter=Views.LooksAsTheKeptPicture
TEST(Views, LooksAsTheKeptPicture) {
  const std::string file = CONDYLE_SOURCE_DIR "/tests/pictures/data/blocks_lateral.png";
  PictureOptions options = {320, 240, false};
  options.panel = true;
  const Image image = draw_knee(with_ellipse(), View::kLateral, 1, options);
  if (std::getenv("CONDYLE_KEEP_PICTURES")) write_png(file, image);
  const Image kept = read_png(file);
  ASSERT_EQ(image.rgb.size(), kept.rgb.size());
  double sum = 0;
  for (std::size_t i = 0; i < kept.rgb.size(); ++i)
    sum += std::abs(static_cast<int>(image.rgb[i]) - static_cast<int>(kept.rgb[i]));
  // Other versions of Mesa round edges differently: far below one level of 255 in the mean.
  EXPECT_LT(sum / static_cast<double>(kept.rgb.size()), 1);
}

}  // namespace
}  // namespace condyle
