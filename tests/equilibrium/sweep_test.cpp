#include "condyle/equilibrium/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "condyle/contact/contact_search.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

/// Lowest signed distance between the known parts of two surfaces, by projecting a dense grid of
/// one onto the other: no code of the contact search.
double lowest_gap(const Surface& on_B,
                  const Surface& on_A,
                  const RigidTransform& X,
                  double spacing) {
  double lowest = INFINITY;
  for (const Place& place : on_A.samples(spacing)) {
    const Eigen::Vector3d p = X * on_A.evaluate(place).c;
    const Place opposite = on_B.closest(p, on_B.seed(p));
    if (on_B.edge_distance(opposite) < 0) continue;
    const SurfacePoint at = on_B.evaluate(opposite);
    const double gap = (p - at.c).dot(at.n);
    if (gap > -10)
      lowest = std::min(lowest, gap);  // farther behind an open patch is not inside the bone
  }
  return lowest;
}

struct Knee {
  Scene scene;
  std::vector<FittedSurface> surfaces;
};

Knee load(const std::filesystem::path& file) {
  Knee knee{read_scene(file), {}};
  knee.surfaces = fit_surfaces(knee.scene);
  return knee;
}

/// What must hold at every pose that calls itself converged.
void check_converged_poses(const Knee& knee, const SweepResult& result) {
  const RigidTransform identity;
  for (const PoseResult& pose : result.poses) {
    if (!pose.converged()) {
      EXPECT_FALSE(pose.reason.empty());
      continue;
    }
    double force_scale = 0;
    for (const LigamentResult& ligament : pose.ligaments) force_scale += ligament.force;
    for (std::size_t c = 0; c < pose.contacts.size(); ++c) {
      const ContactDescription& contact = knee.scene.contacts[c];
      for (const ContactPointResult& point : pose.contacts[c].points) {
        EXPECT_GE(point.force, 0);
        EXPECT_TRUE(!pose.contacts[c].closed || std::abs(point.gap) < 1e-9) << point.gap;
      }
      force_scale += pose.contacts[c].force;
      const Surface& first = *knee.surfaces[static_cast<std::size_t>(contact.surfaces[0])].surface;
      const Surface& second = *knee.surfaces[static_cast<std::size_t>(contact.surfaces[1])].surface;
      EXPECT_GT(lowest_gap(first, second, pose.X_BA, 0.7), -1e-6)
          << contact.name << " at " << pose.value / kDegree << " degrees";
    }
    EXPECT_LT(pose.residual, 1e-9 * std::max(1.0, force_scale));
  }
}

TEST(Sweep, PhantomConvergesAtEveryPoseWithoutAnyOverlap) {
  const Knee knee = load(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  const SweepResult result = sweep(knee.scene, knee.surfaces);
  ASSERT_EQ(result.poses.size(), 25u);
  EXPECT_EQ(result.count_converged(), 25);
  check_converged_poses(knee, result);
}

class SpecimenSweep : public testing::TestWithParam<const char*> {};

TEST_P(SpecimenSweep, ConvergesAtEveryPoseOrSaysWhyNot) {
  const std::filesystem::path file =
      std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/specimens" / GetParam() / "knee.toml";
  if (!std::filesystem::exists(file))
    GTEST_SKIP() << "no specimen " << GetParam() << " beside the project";
  const Knee knee = load(file);
  const SweepResult result = sweep(knee.scene, knee.surfaces);
  ASSERT_EQ(result.poses.size(), 19u);
  EXPECT_EQ(result.count_converged(), 19);
  check_converged_poses(knee, result);
}

INSTANTIATE_TEST_SUITE_P(Real, SpecimenSweep, testing::Values("lenhart2015", "clouthier2019_ssm"));

// A pose does not depend on the way to it.
TEST(Sweep, ASingleStepLandsWhereSmallStepsLand) {
  Knee knee = load(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  knee.scene.sweep->values = {0, 60 * kDegree};
  const SweepResult jump = sweep(knee.scene, knee.surfaces);
  knee.scene.sweep->values.clear();
  for (int k = 0; k <= 60; ++k) knee.scene.sweep->values.push_back(k * kDegree);
  const SweepResult walk = sweep(knee.scene, knee.surfaces);
  ASSERT_TRUE(jump.poses.back().converged()) << jump.poses.back().reason;
  ASSERT_TRUE(walk.poses.back().converged()) << walk.poses.back().reason;
  EXPECT_LT((jump.poses.back().X_BA.p - walk.poses.back().X_BA.p).norm(), 1e-8);
  EXPECT_LT((jump.poses.back().X_BA.R - walk.poses.back().X_BA.R).norm(), 1e-9);
}

}  // namespace
}  // namespace condyle
