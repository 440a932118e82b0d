/// What a run holds of ligaments that wrap, and what the verifier says of it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "condyle/equilibrium/sweep.h"
#include "condyle/results/run_file.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sweep_table.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/verify/verify.h"
#include "support/wrapped_scenes.h"

namespace condyle {
namespace {

condyle::Run run_of(const std::string& text) {
  condyle::Run run;
  run.scene = parse_scene(text, "knee.toml");
  run.sweep = sweep(run.scene, {});
  run.study = SweepStudy{};
  return run;
}

condyle::Run through_a_file(const condyle::Run& run) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) /
                                     ("condyle_wrapped_" + std::to_string(::getpid()) + ".h5");
  write_run(path, run);
  condyle::Run back = read_run(path);
  std::filesystem::remove(path);
  return back;
}

TEST(WrappedRun, GivesBackPathsAndEvents) {
  const condyle::Run run = run_of(test::kHangingBody);
  const condyle::Run back = through_a_file(run);
  ASSERT_EQ(back.sweep.poses.size(), run.sweep.poses.size());
  for (std::size_t i = 0; i < run.sweep.poses.size(); ++i) {
    const std::vector<LigamentPath>&a = run.sweep.poses[i].paths, &b = back.sweep.poses[i].paths;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].points, b[k].points);
      ASSERT_EQ(a[k].touches.size(), b[k].touches.size());
      for (std::size_t w = 0; w < a[k].touches.size(); ++w) {
        const LineTouch &told = a[k].touches[w], &read = b[k].touches[w];
        EXPECT_EQ(told.touching, read.touching);
        EXPECT_EQ(told.on_moving, read.on_moving);
        EXPECT_EQ(told.P, read.P);
        EXPECT_EQ(told.t_Q, read.t_Q);
        EXPECT_EQ(told.side, read.side);
        EXPECT_EQ(told.arc, read.arc);
        EXPECT_NEAR(told.turn, read.turn, 1e-15);
      }
    }
  }
  ASSERT_EQ(back.sweep.events.size(), run.sweep.events.size());
  ASSERT_FALSE(run.sweep.events.empty());
  for (std::size_t k = 0; k < run.sweep.events.size(); ++k) {
    EXPECT_EQ(back.sweep.events[k].ligament, run.sweep.events[k].ligament);
    EXPECT_EQ(back.sweep.events[k].wrap, run.sweep.events[k].wrap);
  }
}

// The strand that goes over both surfaces names its first end on the femur, the strand "egg2" on the
// tibia: either way the surface is told that the scene names.
TEST(WrappedRun, NamesStrandAndSurfaceOfAnEvent) {
  const condyle::Run run = run_of(test::kHangingBody);
  for (const Event& event : run.sweep.events) {
    const std::string subject = event_subject(run.scene, event);
    const std::string& ligament =
        run.scene.ligaments[static_cast<std::size_t>(event.ligament)].name;
    const bool egg = ligament.starts_with("egg") || (ligament == "both" && event.wrap == 1);
    EXPECT_EQ(subject, ligament + (egg ? " on egg" : " on ball"));
  }
}

TEST(WrappedRun, IsVerified) {
  for (const std::string& text : {test::kHangingBody, test::kSlidingStrand}) {
    const Verification v = verify_run(through_a_file(run_of(text)));
    for (const Fault& fault : v.faults) ADD_FAILURE() << fault.text;
    EXPECT_GT(v.checks[static_cast<std::size_t>(Check::kPath)].count, 50);
  }
}

std::string faults_of(const condyle::Run& run) {
  std::string text;
  for (const Fault& fault : verify_run(run).faults) text += fault.text + "\n";
  return text;
}

TEST(WrappedRun, AWrongPathIsFound) {
  const condyle::Run right = run_of(test::kSlidingStrand);
  const auto with_change = [&](auto change) {
    condyle::Run wrong = right;
    change(wrong.sweep.poses.back().paths[0].touches[0]);
    return faults_of(wrong);
  };
  const auto expect = [](const std::string& faults, const char* words) {
    EXPECT_NE(faults.find(words), std::string::npos) << faults;
  };
  expect(with_change([](LineTouch& t) { t.P *= 1.001; }), "on \"post\"");
  expect(with_change([](LineTouch& t) { t.arc += 1e-3; }), "the geodesic ends elsewhere");
  expect(with_change([](LineTouch& t) { t.touching = false; }), "a straight piece runs through it");
  // On the cylinder along another helix.
  expect(
      with_change([](LineTouch& t) { t.t_P = (t.t_P + Eigen::Vector3d(0, 0, 1e-3)).normalized(); }),
      "on \"post\"");
}

}  // namespace
}  // namespace condyle
