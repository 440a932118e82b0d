/// First estimates of contact points ([[contact]] start): they shorten the way to the first pose,
/// and change nothing where they lead nowhere.

#include <gtest/gtest.h>

#include <filesystem>

#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

PoseResult first_pose(const std::string& name, const std::vector<Eigen::Vector3d>& start) {
  Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data" / name);
  scene.contacts[0].start = start;
  scene.sweep->values.resize(1);
  const PoseResult pose = sweep(scene, fit_surfaces(scene)).poses.at(0);
  EXPECT_TRUE(pose.converged()) << pose.reason;
  return pose;
}

// Problem 1 of the report begins where the ball touches the wall at (20, 0, 0) mm.
TEST(ContactEstimates, ShortenTheWayToTheFirstPose) {
  const PoseResult with = first_pose("dortmans/problem1.toml", {{20, 0, 0}});
  const PoseResult without = first_pose("dortmans/problem1.toml", {});
  EXPECT_LT(with.iterations, without.iterations);
  EXPECT_LT((with.X_BA.p - without.X_BA.p).norm(), 1e-9);
  EXPECT_NEAR(with.contacts[0].force, without.contacts[0].force, 1e-9);
}

// One point off the floor, and more of them than can touch.
TEST(ContactEstimates, ThatLeadNowhereChangeNothing) {
  const PoseResult without = first_pose("hard/two-pits.toml", {});
  for (const std::vector<Eigen::Vector3d>& start :
       {std::vector<Eigen::Vector3d>{{0, 24, 90}}, std::vector<Eigen::Vector3d>(9, {-10, 0, -1})}) {
    const PoseResult with = first_pose("hard/two-pits.toml", start);
    EXPECT_LT((with.X_BA.p - without.X_BA.p).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace condyle
