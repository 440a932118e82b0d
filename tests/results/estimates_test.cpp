/// Shapes of contacts, contact pressure and joint stiffness survive the way through a run file.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "condyle/results/hdf5_file.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

/// The made-up run with a soft ball; the third pose touches along a line.
Run run_with_estimates() {
  Run run = made_up_run();
  run.scene =
      parse_scene(small_scene_with("radius = 20", "radius = 20\nmodulus = 12"), "knee.toml");
  run.scene.sweep->values = {0, 0.1, 0.2};
  ContactResult& first = run.sweep.poses[0].contacts[0];
  first.resultant_ground = {1, 2, 3};
  first.points[0].hertz = HertzEstimate{{4, 3}, {0, 0, 1}, 2.5, 0.4};
  ContactResult& third = run.sweep.poses[2].contacts[0];
  third.shape = ContactShape::kLine;
  third.resultant_ground = {4, 5, 6};
  third.points[1].hertz = HertzEstimate{{8, 6}, {1, 0, 0}, 5, 0.8};
  JointStiffness joint;
  for (int i = 0; i < 36; ++i) {
    joint.stiffness(i / 6, i % 6) = 100 + i;
    joint.compliance(i / 6, i % 6) = 0.01 * i;
  }
  run.sweep.poses[2].joint_stiffness = joint;
  return run;
}

class Estimates : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) /
                                ("condyle_estimates_" + std::to_string(::getpid()) + ".h5");
};

TEST_F(Estimates, ComeBackFromTheFile) {
  write_run(path_, run_with_estimates());
  const condyle::Run run = read_run(path_);
  const std::vector<PoseResult>& poses = run.sweep.poses;
  EXPECT_EQ(poses[0].contacts[0].shape, ContactShape::kPoint);
  EXPECT_EQ(poses[2].contacts[0].shape, ContactShape::kLine);
  EXPECT_EQ(poses[2].contacts[0].resultant_ground, Eigen::Vector3d(4, 5, 6));
  ASSERT_TRUE(poses[0].contacts[0].points[0].hertz);
  EXPECT_EQ(poses[0].contacts[0].points[0].hertz->semi_axes, (std::array<double, 2>{4, 3}));
  EXPECT_FALSE(poses[2].contacts[0].points[0].hertz);
  ASSERT_TRUE(poses[2].contacts[0].points[1].hertz);
  EXPECT_EQ(poses[2].contacts[0].points[1].hertz->peak_pressure, 5);
  EXPECT_EQ(poses[2].contacts[0].points[1].hertz->major_axis, Eigen::Vector3d::UnitX());
  EXPECT_FALSE(poses[0].joint_stiffness);
  ASSERT_TRUE(poses[2].joint_stiffness);
  EXPECT_EQ(poses[2].joint_stiffness->stiffness(1, 2), 108);
  EXPECT_EQ(poses[2].joint_stiffness->compliance(5, 5), 0.01 * 35);
}

// What scripts rely on: the main point's estimate, units, meanings, and NaN where there is none.
TEST_F(Estimates, StandUnderTheirNames) {
  write_run(path_, run_with_estimates());
  const Hdf5Reader reader(path_);
  const Hdf5Group sweep = reader.root().open("sweep");
  const Hdf5Group contact = sweep.open("contacts").open("medial"), hertz = contact.open("hertz");
  EXPECT_EQ(contact.read_integers("shape", {3}), (std::vector<int>{0, -1, 1}));
  const std::vector<double> pressure = hertz.read("peak_pressure", {3});
  EXPECT_EQ(pressure[0], 2.5);
  EXPECT_TRUE(std::isnan(pressure[1]));
  EXPECT_EQ(pressure[2], 5);
  EXPECT_EQ(hertz.read_attribute("peak_pressure", "units"), "N/mm^2");
  EXPECT_EQ(hertz.read("semi_axes", {3, 2})[0], 4);
  EXPECT_EQ(contact.open("points").open("hertz").read("approach", {3, 2})[5], 0.8);
  const std::vector<double> stiffness = sweep.open("joint").read("stiffness", {3, 6, 6});
  EXPECT_TRUE(std::isnan(stiffness[0]));
  EXPECT_EQ(stiffness[2 * 36 + 7], 107);
}

// Rigid surfaces have no pressure: no datasets that are empty throughout.
TEST_F(Estimates, AreLeftOutWhereNothingIsElastic) {
  write_run(path_, made_up_run());
  const Hdf5Reader reader(path_);
  const Hdf5Group sweep = reader.root().open("sweep");
  EXPECT_FALSE(sweep.open("contacts").open("medial").has("hertz"));
  EXPECT_FALSE(sweep.open("joint").has("stiffness"));
}

}  // namespace
}  // namespace condyle
