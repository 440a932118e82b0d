#include "condyle/pictures/renderer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>

#include "condyle/pictures/picture_error.h"
#include "condyle/pictures/solids.h"
#include "support/block_knee.h"

namespace condyle {
namespace {

constexpr int kSize = 240;

/// Looks along -z at [-60, 60] x [-60, 60] mm.
Camera plain_camera() {
  Camera camera;
  camera.center = {kSize / 2.0, kSize / 2.0};
  camera.mm_per_pixel = 0.5;
  return camera;
}

Rgb pixel(const Image& image, const Camera& camera, const Eigen::Vector3d& p) {
  const Eigen::Vector3d at = camera.project(p);
  return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
}

ShadedMesh slab(Rgb color) { return shade(box({-40, -40, 0}, {40, 40, 10}), {color, 0}, 0); }

/// Red over green: large for red, about 1 for grey.
double redness(Rgb c) { return (c[0] + 1.0) / (c[1] + 1.0); }

TEST(Renderer, APointIsSeenWhereTheCameraSaysAndPaperIsWhite) {
  Renderer renderer(kSize, kSize);
  const int id = renderer.add(ball({30, 20, 0}, 4, {{200, 30, 30}, 1}));
  const Image image = renderer.render(plain_camera(), {{id, {}, Layer::kSolid, 0}});
  EXPECT_GT(redness(pixel(image, plain_camera(), {30, 20, 0})), 2);
  const Rgb white = {255, 255, 255};
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(-30, 20, 0), Eigen::Vector3d(30, -20, 0), Eigen::Vector3d(-30, -20, 0)}) {
    EXPECT_EQ(pixel(image, plain_camera(), p), white) << "neither mirrored nor upside down";
  }
}

TEST(Renderer, MeshesFollowTheirPose) {
  Renderer renderer(kSize, kSize);
  const int id = renderer.add(ball({10, 0, 0}, 4, {{200, 30, 30}, 1}));
  RigidTransform X;
  X.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // a quarter turn: x to y
  X.p = {-20, 0, 0};
  const Image image = renderer.render(plain_camera(), {{id, X, Layer::kSolid, 0}});
  EXPECT_GT(redness(pixel(image, plain_camera(), {-20, 10, 0})), 2);
}

TEST(Renderer, SolidsShowThroughBoneAsFarAsTheirColourSays) {
  const Camera camera = plain_camera();
  std::vector<double> red;
  for (const double through : {0.0, 0.5, 1.0}) {
    Renderer renderer(kSize, kSize);
    const int bone = renderer.add(slab({220, 220, 220}));
    const int solid = renderer.add(ball({0, 0, -10}, 8, {{220, 10, 10}, through}));
    const Image image =
        renderer.render(camera, {{solid, {}, Layer::kSolid, 0}, {bone, {}, Layer::kBone, 0}});
    red.push_back(redness(pixel(image, camera, {0, 0, 0})));
    EXPECT_NEAR(redness(pixel(image, camera, {30, 30, 0})), 1, 0.1) << "bone beside it stays bone";
  }
  EXPECT_NEAR(red[0], 1, 0.1);
  EXPECT_GT(red[1], 1.2);
  EXPECT_GT(red[2], 2 * red[1]);
}

TEST(Renderer, SolidsInFrontOfBoneHideIt) {
  Renderer renderer(kSize, kSize);
  const int bone = renderer.add(slab({220, 220, 220}));
  const int solid = renderer.add(ball({0, 0, 20}, 8, {{220, 10, 10}, 0}));
  const Image image =
      renderer.render(plain_camera(), {{solid, {}, Layer::kSolid, 0}, {bone, {}, Layer::kBone, 0}});
  EXPECT_GT(redness(pixel(image, plain_camera(), {0, 0, 20})), 2);
}

TEST(Renderer, CartilageOnTheMeshOfItsBoneIsNotPiercedByIt) {
  // A sheet 0.3 mm below the face of the slab, as a smooth fit may lie below the roughness of
  // segmentation.
  Renderer renderer(kSize, kSize);
  const int bone = renderer.add(slab({220, 220, 220}));
  const int sheet = renderer.add(shade(box({-20, -20, 9}, {20, 20, 9.7}), {{220, 10, 10}, 0}, 0));
  const Image image =
      renderer.render(plain_camera(), {{sheet, {}, Layer::kSolid, 0}, {bone, {}, Layer::kBone, 0}});
  EXPECT_GT(redness(pixel(image, plain_camera(), {0, 0, 0})), 2);
}

TEST(Renderer, MarksAreSeenThroughEverything) {
  Renderer renderer(kSize, kSize);
  const int wall = renderer.add(shade(box({-40, -40, 0}, {40, 40, 10}), {{230, 230, 230}, 1}, 0));
  const int mark = renderer.add(ball({10, 10, -30}, 6, {{10, 10, 10}, 1}));
  const Image image =
      renderer.render(plain_camera(), {{wall, {}, Layer::kSolid, 0}, {mark, {}, Layer::kMark, 0}});
  EXPECT_LT(pixel(image, plain_camera(), {10, 10, 0})[0], 120);
  EXPECT_GT(pixel(image, plain_camera(), {-10, -10, 0})[0], 150);
}

TEST(Renderer, AStepShadesTheFloorBesideIt) {
  // A floor seen from above, without and with a step of 5 mm at its side: the step takes light from
  // its foot, not from places farther away than light is looked for.
  Renderer renderer(kSize, kSize);
  const int floor = renderer.add(shade(box({-40, -40, -10}, {40, 40, 0}), {{200, 200, 200}, 1}, 0));
  const int step = renderer.add(shade(box({20, -40, 0}, {40, 40, 5}), {{200, 200, 200}, 1}, 0));
  const Image open = renderer.render(plain_camera(), {{floor, {}, Layer::kSolid, 0}});
  const Image shaded = renderer.render(
      plain_camera(), {{floor, {}, Layer::kSolid, 0}, {step, {}, Layer::kSolid, 0}});
  const auto loss = [&](double x) {
    return pixel(open, plain_camera(), {x, 0, 0})[1] - pixel(shaded, plain_camera(), {x, 0, 0})[1];
  };
  EXPECT_GT(loss(18.5), 8);
  EXPECT_EQ(loss(0), 0);
}

TEST(Renderer, TwoRenderersCanTakeTurns) {
  Renderer one(kSize, kSize), two(kSize, kSize);
  const int a = one.add(ball({0, 0, 0}, 10, {{200, 30, 30}, 1}));
  const int b = two.add(ball({0, 0, 0}, 10, {{30, 200, 30}, 1}));
  const Image red = one.render(plain_camera(), {{a, {}, Layer::kSolid, 0}});
  const Image green = two.render(plain_camera(), {{b, {}, Layer::kSolid, 0}});
  EXPECT_GT(redness(pixel(red, plain_camera(), {0, 0, 0})), 2);
  EXPECT_LT(redness(pixel(green, plain_camera(), {0, 0, 0})), 0.5);
  EXPECT_EQ(one.render(plain_camera(), {{a, {}, Layer::kSolid, 0}}).rgb, red.rgb);
}

// The compiler under Mesa would end the program.
TEST(RendererDeathTest, SaysThatThereIsNotEnoughMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  const auto draw_in_little = [] {
    const rlimit little{400 << 20, 400 << 20};
    setrlimit(RLIMIT_AS, &little);
    try {
      const Renderer renderer(kSize, kSize);
    } catch (const PictureError& error) {
      std::fputs(error.what(), stderr);
      std::_Exit(7);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(draw_in_little(), testing::ExitedWithCode(7),
              "^not enough memory for pictures, expected");
}

}  // namespace
}  // namespace condyle
