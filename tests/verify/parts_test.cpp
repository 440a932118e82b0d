/// The verifier's own laws, splines and coordinates against those of the mechanics: two ways to
/// write the same definitions have to agree.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "condyle/elements/force_law.h"
#include "condyle/elements/kinematic_condition.h"
#include "condyle/math/rotation.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/surface/bspline_basis.h"
#include "condyle/verify/coordinates.h"
#include "condyle/verify/laws.h"
#include "condyle/verify/side.h"
#include "condyle/verify/spline.h"
#include "scene/small_scene.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

std::mt19937 generator(7);
double uniform(double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(generator);
}

TEST(VerifyLaws, AreThoseOfTheElements) {
  const std::vector<ForceLaw> laws = {ToeLinearLaw{1500, 0.06, 30},
                                      QuadraticLaw{3, 28},
                                      PolynomialLaw{{-4000, 120, 0.3}, true},
                                      PolynomialLaw{{-40, 1.5}, false},
                                      make_table_law({25, 27, 30, 31, 36}, {0, 0, 40, 45, 300}),
                                      make_table_law({25, 36}, {0, 300})};
  for (std::size_t i = 0; i < laws.size(); ++i)
    for (double length = 20; length < 42; length += 0.37) {
      const Tension expected = tension(laws[i], length);
      EXPECT_NEAR(verification::force_at(laws[i], length), expected.force,
                  1e-12 * (1 + std::abs(expected.force)))
          << "law " << i << " at " << length;
      // Simpson's rule is exact where the law is a cubic.
      if (i == 3) {
        EXPECT_NEAR(verification::work_between(laws[i], 30, length),
                    expected.energy - tension(laws[i], 30).energy, 1e-9);
      }
    }
}

TEST(VerifySpline, AgreesWithThePatch) {
  for (const auto& [p, q] : {std::pair{3, 3}, {2, 4}, {5, 3}}) {
    PatchData data;
    data.degree = {p, q};
    data.nu = 9;
    data.nv = 8;
    data.knots_u = uniform_knots(data.nu, p, 0, 30);
    data.knots_v = uniform_knots(data.nv, q, -5, 20);
    for (int i = 0; i < data.nu * data.nv; ++i)
      data.control_points.emplace_back(4 * (i / data.nv) + uniform(-1, 1),
                                       4 * (i % data.nv) + uniform(-1, 1), uniform(-1, 1));
    data.mask_nu = 3;
    data.mask_nv = 2;
    for (int i = 0; i < 12; ++i) data.mask.push_back(uniform(-2, 5));
    const Patch patch(data);
    for (int k = 0; k < 200; ++k) {
      const double u = uniform(0, 30), v = uniform(-5, 20);
      const PatchDerivatives expected = patch.derivatives(u, v);
      const verification::SplinePoint at = verification::spline_point(data, u, v);
      EXPECT_LT((at.c - expected.c).norm(), 1e-12);
      EXPECT_LT((at.c_u - expected.c_u).norm() + (at.c_v - expected.c_v).norm(), 1e-12);
      EXPECT_LT((at.c_uu - expected.c_uu).norm() + (at.c_uv - expected.c_uv).norm() +
                    (at.c_vv - expected.c_vv).norm(),
                1e-11);
      EXPECT_NEAR(verification::mask_distance(data, u, v), patch.edge_distance(Patch::place(u, v)),
                  1e-12);
    }
  }
}

RigidTransform random_pose() {
  return {exp_rotation({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}),
          {uniform(-30, 30), uniform(-30, 30), uniform(-30, 30)}};
}

std::string scene_of(bool left, bool femur_moves) {
  std::string text = kSmallScene;
  if (left) {
    text = with(text, "side = \"right\"", "side = \"left\"");
    for (int i = 0; i < 2; ++i)
      text =
          with(text, "lateral = [0, 0, 1], anterior = [1", "lateral = [0, 0, -1],  anterior = [1");
  }
  if (femur_moves) {
    text = with(text, "name = \"femur\"\nfixed = true\n", "name = \"femur\"\n");
    text = with(text, "name = \"tibia\"\nstart.translation = [0, 0, 0]\nstart.rotation = [0, 0, 0]",
                "name = \"tibia\"\nfixed = true");
    text = with(text, "body = \"tibia\"\nkind = \"force\"", "body = \"femur\"\nkind = \"force\"");
  }
  return text;
}

TEST(VerifyCoordinates, AreThoseOfTheJoint) {
  for (const bool left : {false, true})
    for (const bool femur_moves : {false, true}) {
      const Scene scene = parse_scene(scene_of(left, femur_moves), "knee.toml");
      for (int k = 0; k < 20; ++k) {
        const RigidTransform X = random_pose();
        const JointCoordinates q = joint_coordinates(joint_frames(scene), X);
        const std::array<double, 6> own = verification::grood_suntay(scene, X);
        EXPECT_NEAR(own[0], q.flexion, 1e-13);
        EXPECT_NEAR(own[1], q.adduction, 1e-13);
        EXPECT_NEAR(own[2], q.internal_rotation, 1e-13);
        EXPECT_NEAR(own[3], q.lateral_shift, 1e-12);
        EXPECT_NEAR(own[4], q.anterior_drawer, 1e-12);
        EXPECT_NEAR(own[5], q.distraction, 1e-12);
      }
    }
}

TEST(VerifyCoordinates, ChangeAsTheConditionsSay) {
  for (const bool left : {false, true})
    for (const bool femur_moves : {false, true}) {
      const Scene scene = parse_scene(scene_of(left, femur_moves), "knee.toml");
      const int fixed = scene.fixed_body(), moving = scene.moving_body();
      for (int kind = 0; kind <= static_cast<int>(ConditionKind::kDistance); ++kind) {
        ConditionDescription described;
        described.kind = static_cast<ConditionKind>(kind);
        described.axis = Vector3d(1, 2, -1).normalized();
        described.cardan_axis = kind % 3;
        described.ends = {Attachment{fixed, {3, 1, 2}}, Attachment{moving, {-4, 6, 1}}};
        KinematicCondition condition;
        condition.kind = described.kind;
        condition.axis = described.axis;
        condition.cardan_axis = described.cardan_axis;
        condition.frames = joint_frames(scene);
        // A translation is that of the bodies' origins.
        if (described.kind == ConditionKind::kDistance) {
          condition.x_C = described.ends[0].at;
          condition.s_D = described.ends[1].at;
        }
        const RigidTransform X = random_pose();
        const ConditionDerivatives expected = evaluate(condition, 0, X);
        EXPECT_NEAR(verification::coordinate(scene, described, X), expected.coordinate, 1e-12);
        const auto own = verification::gradient(scene, described, X, X.p);
        const double size = expected.alpha.norm() + expected.eta.norm();
        EXPECT_LT((own.head<3>() - expected.alpha).norm(), 1e-13 * size) << "kind " << kind;
        EXPECT_LT((own.tail<3>() - expected.eta).norm(), 1e-13 * size) << "kind " << kind;
      }
    }
}

TEST(VerifyCoordinates, ChangeAsTheConditionsSayBesideAGimbalLock) {
  // Beside 90 degrees of adduction angles change by 1/distance, their direction rounds by as much.
  for (const double beside : {1e-3, 1e-5}) {
    const Scene scene = parse_scene(scene_of(false, false), "knee.toml");
    const RigidTransform X{exp_rotation(Vector3d(0, std::numbers::pi / 2 - beside, 0)),
                           Vector3d(4, -2, 7)};
    for (const ConditionKind kind :
         {ConditionKind::kFlexion, ConditionKind::kAdduction, ConditionKind::kInternalRotation,
          ConditionKind::kAnteriorDrawer}) {
      ConditionDescription described;
      described.kind = kind;
      KinematicCondition condition;
      condition.kind = kind;
      condition.frames = joint_frames(scene);
      const ConditionDerivatives expected = evaluate(condition, 0, X);
      const auto own = verification::gradient(scene, described, X, X.p);
      const double size = expected.alpha.norm() + expected.eta.norm();
      EXPECT_LT((own.tail<3>() - expected.eta).norm(), 1e-14 / beside * size)
          << "kind " << static_cast<int>(kind) << ", " << beside;
    }
  }
}

TEST(VerifyCoordinates, StartWhereTheSceneDoes) {
  for (const bool femur_moves : {false, true}) {
    std::string text = scene_of(true, femur_moves);
    const std::string moving =
        femur_moves ? "[[body]]\nname = \"femur\"\n" : "[[body]]\nname = \"tibia\"\n";
    if (!femur_moves) text = with(text, "start.rotation = [0, 0, 0]", "");
    text = with(text, moving,
                moving + "start.flexion = 30\nstart.adduction = 4\nstart.internal_rotation = -7\n");
    const Scene scene = parse_scene(text, "knee.toml");
    EXPECT_LT((verification::start_of(scene).R - start_pose(scene).R).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace condyle
