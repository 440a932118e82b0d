#include "condyle/verify/taut_string.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/verify/coordinates.h"
#include "condyle/verify/verify.h"
#include "support/wrapped_scenes.h"
#include "verify/computed_run.h"

namespace condyle::verification {
namespace {

const Run& wrapped_run() {
  static const Run run = test::computed_run(test::kSource / "data/phantom/wrapped.toml");
  return run;
}

// From 20 degrees to each other pose: strands lift off and come to touch on the way. The solver finds
// its paths in another way (docs/wrapping.md).
TEST(TautString, LeadsToTheLengthsOfOtherPoses) {
  const condyle::Run& run = wrapped_run();
  const std::vector<PoseResult>& poses = run.sweep.poses;
  int wrapped = 0, changed = 0;
  for (std::size_t i = 0; i < run.scene.ligaments.size(); ++i) {
    if (run.scene.ligaments[i].path.wraps.empty()) continue;
    for (const std::size_t k : {0, 8, 12}) {
      const auto length = TautString(run.scene, poses.at(4), i).led_to(poses.at(k).X_BA);
      ASSERT_TRUE(length) << run.scene.ligaments[i].name << " at pose " << k;
      EXPECT_NEAR(*length, poses[k].ligaments[i].length, 1e-8) << run.scene.ligaments[i].name;
      const auto &from = poses[4].paths[i].touches, &to = poses[k].paths[i].touches;
      ++wrapped;
      for (std::size_t w = 0; w < to.size(); ++w)
        changed += from[w].touching != to[w].touching ? 1 : 0;
    }
  }
  EXPECT_GT(wrapped, 0);
  EXPECT_GT(changed, 0);
}

// 0.01 mm off.
TEST(TautString, AFalseSlackLengthOfALigamentThatWrapsIsFound) {
  condyle::Run run = wrapped_run();
  run.sweep.poses.resize(1);
  for (LigamentDescription& ligament : run.scene.ligaments)
    if (!ligament.path.wraps.empty() && ligament.reference_strain)
      std::get<ToeLinearLaw>(ligament.law).slack_length += 0.01;
  const CheckSummary slack = verify_run(run).checks.at(static_cast<std::size_t>(Check::kSlack));
  EXPECT_GT(slack.failed, 0);
  EXPECT_NEAR(slack.figure, 0.01, 1e-6);
}

// The line runs 12 mm over the axis of a surface of 10 mm (a tube of 2 mm about a ring of 8). A named side beyond it leads the
// string round a cylinder; a ring that is not in the way is passed straight, whichever side is named.
TEST(TautString, ASideThatIsNamedIsLeftToTheProgramButWhereARingIsClear) {
  const auto first = [](const std::string& shape, const std::string& side) {
    const Scene scene =
        parse_scene(test::kWrappedHead + "[[wrap]]\nname = \"post\"\nbody = \"femur\"\n" + shape +
                        "[[ligament]]\nname = \"strand\"\nends = [{ body = \"femur\", at = [-40, "
                        "0, 0] }, { body = "
                        "\"tibia\", at = [40, 0, 0] }]\nwraps = [\"post\"]\nlaw = "
                        "\"toe-linear\"\nstiffness = 1500\n"
                        "slack_length = 70\n" +
                        side,
                    "knee.toml");
    const auto string = TautString::first(scene, start_pose(scene), 0);
    return string ? string->length() : -1;
  };
  const std::string cylinder =
      "kind = \"cylinder\"\npoint = [0, -12, 7]\naxis = [0, 0, 1]\nradius = 10\n";
  const std::string ring =
      "kind = \"torus\"\ncenter = [0, -12, 0]\naxis = [0, 0, 1]\nmajor = 8\nminor = 2\n";
  const std::string beyond = "side = [0, -60, 7]\n";
  for (const std::string& shape : {cylinder, ring}) EXPECT_NEAR(first(shape, ""), 80, 1e-12);
  EXPECT_NEAR(first(ring, beyond), 80, 1e-12);
  EXPECT_EQ(first(cylinder, beyond), -1);
}

// A made-up knee (number 691 of seed 1): strings over small surfaces, and bodies that have their origins metres
// away. A way that turned the femur about its origin would draw them off what they lie on.
TEST(TautString, TheWayDoesNotDependOnWhereTheOriginLies) {
  const condyle::Run run = test::computed_run(test::kSource / "tests/data/far_origins.toml");
  const Verification verified = verify_run(run);
  EXPECT_EQ(verified.converged, 5);
  EXPECT_TRUE(verified.verified());
  EXPECT_GT(verified.checks.at(static_cast<std::size_t>(Check::kSlack)).count, 0);
  for (const std::string& what : verified.not_checked)
    EXPECT_EQ(what.find("slack length"), std::string::npos) << what;
}

// A made-up knee (number 241 of seed 1): a string goes through a ring no larger than itself, and between the
// poses and the start one of its ends is in the ring. The start's own string says what its slack length is.
TEST(TautString, AnEndThatPassesThroughASurfaceEndsTheWay) {
  const condyle::Run run = test::computed_run(test::kSource / "tests/data/threaded_string.toml");
  const std::size_t ligament = 4;
  ASSERT_EQ(run.scene.ligaments.at(ligament).name, "line 5");
  for (const PoseResult& pose : run.sweep.poses) {
    ASSERT_TRUE(pose.converged());
    EXPECT_FALSE(TautString(run.scene, pose, ligament).led_to(start_pose(run.scene)));
  }
  const Verification verified = verify_run(run);
  EXPECT_TRUE(verified.verified());
  for (const std::string& what : verified.not_checked)
    EXPECT_EQ(what.find("slack length"), std::string::npos) << what;
}

// The solver lays its first strings in another way (docs/wrapping.md).
TEST(TautString, TheFirstStringIsThatOfTheSlackLength) {
  int laid = 0;
  const auto look_at = [&](const condyle::Run& run) {
    for (std::size_t i = 0; i < run.scene.ligaments.size(); ++i) {
      const LigamentDescription& ligament = run.scene.ligaments[i];
      if (ligament.path.wraps.empty()) continue;
      const RigidTransform X = start_pose(run.scene);
      const auto first = TautString::first(run.scene, X, i);
      if (!first) continue;
      EXPECT_NEAR(first->length(), ligament_length(run.scene, ligament, X), 1e-8) << ligament.name;
      ++laid;
    }
  };
  look_at(wrapped_run());
  for (const char* file : {"threaded_string.toml", "far_origins.toml"})
    look_at(test::computed_run(test::kSource / "tests/data" / file));
  EXPECT_GE(laid, 5);
}

// Where a line nearly halves a sphere the short way and the long way about it are told apart. In closed form: with
// the angle θ between the ends as the centre sees them, l the tangents, L = l_C + l_D + R (θ - acos(R/c) - acos(R/d)).
TEST(TautString, TheFirstStringGoesTheShortWayAboutASphere) {
  constexpr double kRadius = 8;
  for (const double beside : {0.05, 0.3, 0.7, 0.95}) {
    Scene scene = wrapped_run().scene;
    const RigidTransform X = start_pose(scene);
    const auto with_one_wrap = std::find_if(
        scene.ligaments.begin(), scene.ligaments.end(),
        [](const LigamentDescription& ligament) { return ligament.path.wraps.size() == 1; });
    ASSERT_NE(with_one_wrap, scene.ligaments.end());
    with_one_wrap->path.sides.clear();
    with_one_wrap->path.thickness = 0;
    const Eigen::Vector3d C = in_ground(scene, with_one_wrap->ends[0], X),
                          D = in_ground(scene, with_one_wrap->ends[1], X);
    const Eigen::Vector3d u = (D - C).unitOrthogonal(),
                          center = 0.5 * (C + D) - beside * kRadius * u;
    WrapDescription& wrap = scene.wraps.at(static_cast<std::size_t>(with_one_wrap->path.wraps[0]));
    wrap.fit.reset();
    wrap.shape = WrapSphere{kRadius};
    wrap.placement = {Eigen::Matrix3d::Identity(),
                      wrap.body == scene.moving_body() ? X.inverse() * center : center};
    const double c = (C - center).norm(), d = (D - center).norm();
    ASSERT_GT(std::min(c, d), 1.2 * kRadius);
    const double angle = std::acos((C - center).dot(D - center) / (c * d));
    const double length = std::sqrt(c * c - kRadius * kRadius) +
                          std::sqrt(d * d - kRadius * kRadius) +
                          kRadius * (angle - std::acos(kRadius / c) - std::acos(kRadius / d));
    const auto first = TautString::first(
        scene, X, static_cast<std::size_t>(with_one_wrap - scene.ligaments.begin()));
    ASSERT_TRUE(first) << beside;
    EXPECT_NEAR(first->length(), length, 1e-8) << beside;
  }
}

TEST(TautString, PushesAreTriedOnLigamentsThatWrap) {
  condyle::Run run = wrapped_run();
  run.sweep.poses.resize(3);
  VerifyOptions options;
  options.pushes = true;
  const Verification verified = verify_run(run, options);
  EXPECT_TRUE(verified.verified());
  EXPECT_EQ(verified.checks.at(static_cast<std::size_t>(Check::kStability)).count, 3);
  EXPECT_TRUE(verified.warnings.empty());
}

}  // namespace
}  // namespace condyle::verification
