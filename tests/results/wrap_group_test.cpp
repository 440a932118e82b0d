/// A run whose wrap was fitted to the bone: the scene's text does not tell the ellipsoid, the run does.

#include "condyle/results/wrap_group.h"

#include <gtest/gtest.h>

#include "condyle/input_error.h"
#include "condyle/results/run_file.h"
#include "condyle/scene/ligament_path.h"
#include "scene/fitted_wrap_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

/// As fit_wraps leaves it.
Scene fitted_scene() {
  Scene scene = test::fitted_wrap_scene();
  WrapDescription& wrap = scene.wraps[0];
  wrap.shape = WrapEllipsoid{{6, 5, 4}};
  wrap.placement.p = {3, 5, 0.5};
  wrap.placement.R.col(0) = -Eigen::Vector3d::UnitY();
  wrap.placement.R.col(1) = Eigen::Vector3d::UnitX();
  BoneFit& fit = *wrap.fit;
  fit.done = true;
  fit.region = 4;
  fit.vertices = 123;
  fit.rms = 0.25;
  fit.max = 0.75;
  fit.length_rms = 0.0625;
  fit.length_max = 0.125;
  fit.side = {-20, 5, 0};
  fit.strings = {{0, 0.5, 30, 2, 30.5, 30.25}};
  settle_fitted_paths(scene);
  return scene;
}

TEST(FittedWrapInARun, ComesBackWithTheSlackLength) {
  const auto path = test::fresh_folder("wrap group") / "run.h5";
  condyle::Run run;
  run.scene = fitted_scene();
  run.study = FitStudy{};
  write_run(path, run);
  const Scene back = read_run(path).scene;
  const WrapDescription &a = run.scene.wraps[0], &b = back.wraps[0];
  EXPECT_EQ(std::get<WrapEllipsoid>(a.shape).semi_axes, std::get<WrapEllipsoid>(b.shape).semi_axes);
  EXPECT_EQ(a.placement.p, b.placement.p);
  EXPECT_EQ(a.placement.R, b.placement.R);
  ASSERT_TRUE(b.fit && b.fit->done);
  EXPECT_EQ(a.fit->side, b.fit->side);
  EXPECT_EQ(a.fit->vertices, b.fit->vertices);
  EXPECT_EQ(a.fit->rms, b.fit->rms);
  EXPECT_EQ(a.fit->length_max, b.fit->length_max);
  ASSERT_EQ(b.fit->strings.size(), 1U);
  EXPECT_NEAR(b.fit->strings[0].flexion, 0.5, 1e-15);
  EXPECT_EQ(b.fit->strings[0].length, 30.5);
  EXPECT_EQ(slack_length(run.scene.ligaments[0].law), slack_length(back.ligaments[0].law));
  EXPECT_GT(slack_length(back.ligaments[0].law), 30.0001 / 1.1);
}

TEST(FittedWrapInARun, ThatIsNotThereIsNamed) {
  const auto path = test::fresh_folder("wrap group") / "run.h5";
  condyle::Run run;
  run.scene = test::fitted_wrap_scene();  // fitted to nothing
  run.study = FitStudy{};
  write_run(path, run);
  try {
    (void)read_run(path);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("wraps"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace condyle
