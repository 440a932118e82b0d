#include "condyle/pictures/knee_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "condyle/input_error.h"
#include "pictures/bare_picture.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

/// The middle of the strain colours, a magenta, which nothing else in a picture has: bone and slack
/// grey do not.
bool is_strain_color(Rgb c) { return c[0] > c[1] + 30 && c[2] > c[1] - 40 && c[0] > 90; }

double white_fraction(const Image& image) {
  int white = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) white += is_white(image.at(x, y)) ? 1 : 0;
  }
  return static_cast<double>(white) / (image.width * image.height);
}

/// Mean x of the pixels in the colour of a taut ligament, or -1.
double taut_x(const Image& image) {
  double sum = 0;
  int n = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (is_strain_color(image.at(x, y))) sum += x, ++n;
    }
  }
  return n > 20 ? sum / n : -1;
}

TEST(KneePicture, HasTheSizeAskedForAndMostlyWhitePaper) {
  const Image image = draw_knee(block_run(), View::kAnterior, 0);
  EXPECT_EQ(image.width, 1200);
  EXPECT_EQ(image.height, 900);
  EXPECT_GT(white_fraction(image), 0.4);
  EXPECT_LT(white_fraction(image), 0.9);
}

// Names may have a hundred letters.
TEST(KneePicture, LongNamesStayOnThePageAndOffTheScales) {
  auto run = block_run();
  const PictureOptions small = {.width = 700, .height = 520};
  for (const View view : {View::kAnterior, View::kMedial, View::kLateral}) {
    const Image with_short = draw_knee(run, view, 0, small);
    auto named = run;
    for (LigamentDescription& ligament : named.scene.ligaments)
      ligament.name = "WW" + std::string(90, 'W') + ligament.name;
    const Image with_long = draw_knee(named, view, 0, small);
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < 5; ++x) ASSERT_TRUE(is_white(with_long.at(x, y))) << x << " " << y;
      for (int x = small.width - 60; x < small.width; ++x)
        ASSERT_EQ(with_long.at(x, y), with_short.at(x, y)) << x << " " << y;
    }
  }
}

TEST(KneePicture, ATautLigamentIsColouredAtItsMiddleAndASlackOneIsGrey) {
  auto run = block_run();
  KneePictures pictures(run, kBare);
  // LCL below its middle, seen from its own side, where nothing is in front of it and no contact is
  // marked.
  const Eigen::Vector3d at = pictures.camera(View::kLateral).project({0, -10, 36});
  const auto middle = [&](const Image& image) {
    return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  EXPECT_TRUE(is_strain_color(middle(pictures.draw(View::kLateral, 0))));
  run.sweep.poses[1].ligaments[0] = {40, 0, 0};
  const Rgb slack = middle(pictures.draw(View::kLateral, 1));
  EXPECT_LT(
      *std::max_element(slack.begin(), slack.end()) - *std::min_element(slack.begin(), slack.end()),
      25);
}

TEST(KneePicture, TheLateralSideIsWhereAnatomyHasIt) {
  // LCL is the only taut ligament. Of a right knee it is at the left in front, at the right from
  // behind and above.
  const auto right = block_run(1), left = block_run(-1);
  const double middle = 0.5 * (150 + 1200 - 235) / 2;  // of the frame, at half size
  EXPECT_LT(taut_x(draw_knee(right, View::kAnterior, 0, kBare)), middle);
  EXPECT_GT(taut_x(draw_knee(right, View::kPosterior, 0, kBare)), middle);
  EXPECT_GT(taut_x(draw_knee(right, View::kPlateau, 0, kBare)), middle);
  EXPECT_GT(taut_x(draw_knee(left, View::kAnterior, 0, kBare)), middle);
  EXPECT_LT(taut_x(draw_knee(left, View::kPosterior, 0, kBare)), middle);
  EXPECT_LT(taut_x(draw_knee(left, View::kPlateau, 0, kBare)), middle);
}

TEST(KneePicture, ALeftKneeIsTheMirrorImageOfARightOne) {
  const auto right_run = block_run(1), left_run = block_run(-1);
  const Image right = draw_knee(right_run, View::kAnterior, 1, kBare),
              left = draw_knee(left_run, View::kAnterior, 1, kBare);
  // The frame is not in the middle of the page: pixel x goes to left + right - 1 - x. Light comes
  // from one side, so only what is covered is compared.
  const int sum = static_cast<int>(0.5 * (150 + 1200 - 235)) - 1;
  int different = 0;
  for (int y = 0; y < right.height; ++y) {
    for (int x = 0; x <= sum; ++x)
      different += is_white(right.at(x, y)) != is_white(left.at(sum - x, y)) ? 1 : 0;
  }
  EXPECT_LT(different, 0.01 * right.width * right.height);
}

TEST(KneePicture, TheSameRunGivesTheSameBytes) {
  const auto run = block_run();
  EXPECT_EQ(draw_knee(run, View::kMedial, 1).rgb, draw_knee(run, View::kMedial, 1).rgb);
  KneePictures pictures(run, {});
  (void)pictures.draw(View::kPlateau, 2);
  EXPECT_EQ(pictures.draw(View::kMedial, 1).rgb, draw_knee(run, View::kMedial, 1).rgb)
      << "whatever was drawn before";
}

TEST(KneePicture, ThePlateauIsSeenWithoutTheFemur) {
  auto run = block_run();
  const Image with = draw_knee(run, View::kPlateau, 0, kBare);
  run.bodies[0].mesh = {};
  EXPECT_EQ(with.rgb, draw_knee(run, View::kPlateau, 0, kBare).rgb);
}

TEST(KneePicture, ThePathLiesWhereTheContactsWere) {
  const auto run = block_run();
  KneePictures pictures(run, kBare);
  const Image image = pictures.draw(View::kPlateau, 2);
  // Between the medial contacts of the first two poses, on the tibia: (-2, 0, -15). Bone is light
  // and hardly coloured, the colours of flexion are not.
  const Eigen::Vector3d at = pictures.camera(View::kPlateau).project({-2, 0, -15});
  const Rgb c = image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  EXPECT_GT(*std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()), 30);
  const Eigen::Vector3d beside = pictures.camera(View::kPlateau).project({10, 0, -15});
  const Rgb bone = image.at(static_cast<int>(beside.x()), static_cast<int>(beside.y()));
  EXPECT_LT(bone[0] - bone[2], 60);
  EXPECT_GT(bone[0], 120);
}

TEST(KneePicture, WordsStandAroundTheSameKnee) {
  const auto run = block_run();
  const Image bare = draw_knee(run, View::kAnterior, 0, {1200, 900, false});
  const Image words = draw_knee(run, View::kAnterior, 0, {1200, 900, true});
  EXPECT_LT(white_fraction(words), white_fraction(bare));
  int title = 0;
  for (int y = 20; y < 80; ++y) {
    for (int x = 20; x < 300; ++x) {
      title += is_white(words.at(x, y)) ? 0 : 1;
      EXPECT_TRUE(is_white(bare.at(x, y)));
    }
  }
  EXPECT_GT(title, 500);
}

TEST(KneePicture, ARunThatCannotBeDrawnIsRefused) {
  auto run = block_run();
  for (PoseResult& pose : run.sweep.poses) pose.status = PoseStatus::kDiverged;
  EXPECT_THROW(KneePictures(run, {}), InputError);
  EXPECT_THROW(KneePictures(block_run(), {100, 100, true}), InputError);
  EXPECT_THROW(KneePictures(block_run(), {1200, 90000, true}), InputError);
}

TEST(KneePicture, SmallAndTallPagesWork) {
  const auto run = block_run();
  for (const PictureOptions& options :
       {PictureOptions{200, 200, true}, {301, 777, true}, {1501, 333, true}}) {
    const Image image = draw_knee(run, View::kMedial, 0, options);
    EXPECT_EQ(image.width, options.width);
    EXPECT_EQ(image.height, options.height);
    EXPECT_LT(white_fraction(image), 0.98);
  }
}

}  // namespace
}  // namespace condyle
