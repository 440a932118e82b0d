#include "condyle/study/mesh_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

std::string complaint(const Scene& scene, int sweeps) {
  try {
    check_uncertainty(scene, {sweeps, 1, 0});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class UncertainPhantom : public ::testing::Test {
 protected:
  static Scene short_scene() {
    Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
    scene.sweep->values = {0.2, 0.6};
    return scene;
  }
  [[nodiscard]] std::shared_ptr<const MeshUncertainty> uncertainty(
      const UncertaintyOptions& options) const {
    StudyProgress silent({});
    return mesh_uncertainty(scene, surfaces, poses, options, silent);
  }

  const Scene scene = short_scene();
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const std::vector<PoseResult> poses = sweep(scene, surfaces).poses;
};

TEST_F(UncertainPhantom, TellsTheRoughnessThatThePhantomHasAndWhatItDoes) {
  const auto all = uncertainty({6, 1, 0});
  ASSERT_EQ(all->surfaces.size(), 4u);
  for (const RoughSurface& surface : all->surfaces) {
    EXPECT_NEAR(surface.texture.rms, 0.2, 0.05) << surface.surface;
    EXPECT_NEAR(surface.texture.correlation, 1.5, 0.6) << surface.surface;
  }
  EXPECT_EQ(all->failed_fits, 0);
  EXPECT_EQ(all->converged, (std::vector<int>{6, 6}));
  for (std::size_t i = 0; i < all->outputs.size(); ++i) {
    if (all->outputs[i].place != "joint/anterior_drawer") continue;
    for (const double sd : all->sd[i]) {
      EXPECT_GT(sd, 0.01);
      EXPECT_LT(sd, 1.0);
    }
  }
}

TEST_F(UncertainPhantom, IsTheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  const auto one = uncertainty({3, 1, 1}), two = uncertainty({3, 1, 2}),
             other = uncertainty({3, 2, 2});
  EXPECT_EQ(one->sd, two->sd);
  EXPECT_EQ(one->shift, two->shift);
  EXPECT_NE(one->sd, other->sd);
}

TEST_F(UncertainPhantom, APatchThatIsTooNarrowIsNamedBeforeTheSweep) {
  Scene narrow = scene;
  narrow.surfaces[0].patch.region_box = {{{-12, -60, -28.4}, {26, 60, -18.8}}};
  try {
    check_noise(narrow, fit_surfaces(narrow));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("surface \"" + narrow.surfaces[0].name + "\": "),
              std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(check_noise(scene, surfaces));
}

TEST_F(UncertainPhantom, StopsWhenItIsTold) {
  StudyProgress stop([](const std::string&, int, int) { return false; });
  EXPECT_EQ(mesh_uncertainty(scene, surfaces, poses, {6, 1, 0}, stop), nullptr);
}

TEST_F(UncertainPhantom, WantsPatchesStepsAndTwoSweeps) {
  EXPECT_EQ(complaint(scene, 2), "");
  EXPECT_EQ(complaint(scene, 1), "--uncertainty=1: expected at least 2 sweeps");
  Scene exact = read_scene(CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml");
  EXPECT_NE(complaint(exact, 20).find("no surface is fitted to a mesh"), std::string::npos);
  Scene path = scene;
  path.sweep->arc_length = true;
  EXPECT_NE(complaint(path, 20).find("expected \"steps\""), std::string::npos);
}

}  // namespace
}  // namespace condyle
