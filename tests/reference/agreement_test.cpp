/// Two ways to one answer: on the same polynomials, springs and closed contacts the engine and the
/// reference model agree, though neither shares a line of its solver with the other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/equilibrium/sweep.h"
#include "condyle/reference/build_wismans.h"
#include "condyle/reference/polynomial_surface.h"
#include "condyle/reference/wismans_solver.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

constexpr const char* kKnee = CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml";

struct BothWays {
  SweepResult engine, reference;
};

BothWays solve_both(const Scene& described, int degree) {
  const Scene scene = with_closed_contacts(with_quadratic_springs(described));
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const std::vector<HeightFit> heights = fit_heights(scene, surfaces, degree);
  SweepOptions plain;
  plain.stability = plain.events = false;
  return {sweep(scene, with_polynomials(surfaces, heights), plain),
          sweep(build_wismans_model(scene, heights), {}, scene.sweep->values)};
}

/// To 1e-9 mm, rad, N (and of the force where it is large; moments over 30 mm).
void expect_agreement(const PoseResult& a, const PoseResult& b) {
  constexpr double kClose = 1e-9;
  ASSERT_TRUE(a.converged()) << a.reason;
  ASSERT_TRUE(b.converged()) << b.reason;
  EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), kClose);
  EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), kClose);
  double force = 1;
  for (const LigamentResult& ligament : a.ligaments) force = std::max(force, ligament.force);
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    ASSERT_EQ(a.contacts[c].points.size(), 1U);
    const ContactPointResult &p = a.contacts[c].points[0], &q = b.contacts[c].points[0];
    EXPECT_NEAR(p.force, q.force, kClose * force);
    EXPECT_LT((p.point_ground - q.point_ground).norm(), kClose);
    EXPECT_LT((p.point_moving - q.point_moving).norm(), kClose);
    EXPECT_LT((p.normal_ground - q.normal_ground).norm(), kClose);
  }
  for (std::size_t i = 0; i < a.ligaments.size(); ++i)
    EXPECT_NEAR(a.ligaments[i].force, b.ligaments[i].force, kClose * force);
  EXPECT_NEAR(a.conditions[0].multiplier, b.conditions[0].multiplier, 30 * kClose * force);
}

TEST(Agreement, EngineAndReferenceAgreeOnQuarticsAndQuadraticSprings) {
  const BothWays both = solve_both(read_scene(kKnee), 4);
  ASSERT_EQ(both.engine.poses.size(), 19U);
  for (std::size_t i = 0; i < both.engine.poses.size(); ++i) {
    SCOPED_TRACE(i);
    expect_agreement(both.engine.poses[i], both.reference.poses[i]);
  }
}

TEST(Agreement, HoldsForLoadsOfEveryKindAndAMovingFemur) {
  Scene scene = read_scene(kKnee);
  scene.sweep->values = {0, 0.2, 0.4};
  for (const bool follows : {false, true}) {
    LoadDescription force;
    force.name = follows ? "follower" : "dead";
    force.body = scene.moving_body();
    force.vector = {10, 20, 60};
    force.at = {5, -10, 213};
    force.follows_body = follows;
    LoadDescription moment = force;
    moment.moment = true;
    moment.vector = {200, 400, -800};
    scene.loads.push_back(force);
    scene.loads.push_back(moment);
  }
  for (const bool femur_moves : {false, true}) {
    if (femur_moves) {
      scene.bodies[0].fixed = false;
      scene.bodies[1].fixed = true;
      scene.bodies[0].start_translation = -scene.bodies[1].start_translation;
      for (LoadDescription& load : scene.loads) {
        load.body = 0;
        load.vector *= -1;
        load.at = Eigen::Vector3d(3, -8, 5);
      }
    }
    const BothWays both = solve_both(scene, 3);
    for (std::size_t i = 0; i < both.engine.poses.size(); ++i) {
      SCOPED_TRACE(i);
      expect_agreement(both.engine.poses[i], both.reference.poses[i]);
    }
  }
}

TEST(Agreement, TheShippedKneeMovesAsAnIndependentSolutionSays) {
  // Least spring energy under the two gaps as constraints, by another program; as printed.
  struct Row {
    std::size_t pose;
    double adduction, rotation, medial, lateral;
  };
  constexpr Row kRows[] = {{0, -0.84, -0.04, 382, 614},
                           {6, 0.71, -0.36, 324, 177},
                           {12, 1.00, 9.09, 468, 106},
                           {18, -0.60, 17.35, 241, 9}};
  const Scene scene = read_scene(kKnee);
  const SweepResult result = sweep(scene, fit_surfaces(scene));
  for (const Row& row : kRows) {
    const PoseResult& pose = result.poses.at(row.pose);
    EXPECT_NEAR(pose.joint.adduction * 180 / M_PI, row.adduction, 0.006);
    EXPECT_NEAR(pose.joint.internal_rotation * 180 / M_PI, row.rotation, 0.006);
    EXPECT_NEAR(pose.contacts[0].force, row.medial, 0.6);
    EXPECT_NEAR(pose.contacts[1].force, row.lateral, 0.6);
  }
}

TEST(Agreement, QuadraticSpringsEqualTheToeAndItsEnd) {
  const Scene toe = read_scene(kKnee), quadratic = with_quadratic_springs(toe, 0.06);
  for (std::size_t i = 0; i < toe.ligaments.size(); ++i) {
    const double slack = slack_length(toe.ligaments[i].law);
    for (const double strain : {-0.02, 0.0, 0.03, 0.06}) {
      const double length = (1 + strain) * slack;
      EXPECT_NEAR(tension(toe.ligaments[i].law, length).force,
                  tension(quadratic.ligaments[i].law, length).force, 1e-9);
    }
    EXPECT_GT(tension(quadratic.ligaments[i].law, 1.09 * slack).force,
              tension(toe.ligaments[i].law, 1.09 * slack).force);
  }
}

TEST(Agreement, AContactThatPullsIsSaidToPull) {
  // With nothing that presses, the lateral contact of this knee carries 9 N at 90 degrees (an
  // independent solution) and less beyond: Wismans' model goes on into tension.
  Scene scene = read_scene(kKnee);
  scene.sweep->values.clear();
  for (int i = 0; i <= 24; ++i) scene.sweep->values.push_back(i * 5 * M_PI / 180);
  const std::vector<HeightFit> heights = fit_heights(scene, fit_surfaces(scene), 6);
  const SweepResult result = sweep(build_wismans_model(scene, heights), {}, scene.sweep->values);
  const bool pulls = std::any_of(result.poses.begin(), result.poses.end(), [](const auto& pose) {
    return pose.converged() && pose.remark.find("pulls with") != std::string::npos;
  });
  EXPECT_TRUE(pulls);
}

}  // namespace
}  // namespace condyle
