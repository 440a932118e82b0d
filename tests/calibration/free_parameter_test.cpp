/// The numbers of a fit: their names, priors and bounds, and the scene that they change.

#include "condyle/calibration/free_parameter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calibration/small_calibration.h"
#include "condyle/calibration/bone_triad.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/drive.h"
#include "condyle/math/rotation.h"
#include "condyle/scene/start_pose.h"

namespace condyle::test {
namespace {

using Eigen::Vector3d;

MeasurementTable table_with(const std::vector<Measurement>& rows) {
  MeasurementTable table;
  table.rows = rows;
  return table;
}

Scene calibrated_scene(const std::string& text = kCalibratedScene) {
  return parse_scene(text, "some/knee.toml");
}

std::vector<FreeParameter> free_of(const Scene& scene) {
  return free_parameters(scene, {}, MeasurementTable());
}

std::vector<std::string> names_of_all(const std::vector<FreeParameter>& parameters) {
  std::vector<std::string> names;
  for (const FreeParameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

/// A square of side 20 mm across x at x = 1, of two triangles that face +x.
TriangleMesh wall() {
  return {{{1, -10, -10}, {1, 10, -10}, {1, 10, 10}, {1, -10, 10}}, {{0, 1, 2}, {0, 2, 3}}};
}

TEST(FreeParameter, StandInTheOrderOfTheSceneNuisanceLast) {
  const std::vector<std::string> expected = {
      "aACL.reference_strain",     "pACL.reference_strain",      "aACL+pACL.stiffness",
      "aACL.insertion.tibia.x",    "aACL.insertion.tibia.y",     "aACL.insertion.tibia.z",
      "femur frame.shift.lateral", "femur frame.shift.anterior", "femur frame.shift.proximal",
      "femur frame.turn.lateral",  "femur frame.turn.anterior",  "femur frame.turn.proximal",
      "tibia frame.shift.lateral", "tibia frame.shift.anterior", "tibia frame.shift.proximal"};
  EXPECT_EQ(names_of_all(free_of(calibrated_scene())), expected);
}

TEST(FreeParameter, BoundsAndStartsAreOfTheNumberItself) {
  const std::vector<FreeParameter> free = free_of(calibrated_scene());
  EXPECT_NEAR(free[0].start, 0, 1e-15);  // 30 mm long at the start pose, slack length 30 mm
  EXPECT_DOUBLE_EQ(free[1].start, 0.05);
  EXPECT_DOUBLE_EQ(free[1].bounds[0], -0.45);
  EXPECT_DOUBLE_EQ(free[1].bounds[1], 0.15);
  EXPECT_TRUE(free[2].logarithmic);
  EXPECT_DOUBLE_EQ(free[2].bounds[1], std::log(5));
  EXPECT_EQ(free[2].start, 0);  // one factor for both
  EXPECT_EQ(free[2].moves.size(), 2u);
  EXPECT_EQ(free[3].prior_sd, 2);
}

TEST(FreeParameter, AnOffsetForEachCurveAndCoordinateThatIsFitted) {
  Measurement drawer, twice, seen, force;
  drawer.test = twice.test = seen.test = force.test = "ap30";
  drawer.index = twice.index = 4;
  seen.index = 1;
  seen.use = MeasuredUse::kTest;
  force.kind = MeasuredKind::kLigamentForce;
  Scene scene = calibrated_scene();
  scene.calibration->femur_frame_sd.reset();
  scene.calibration->tibia_frame_sd.reset();
  const std::vector<FreeParameter> free =
      free_parameters(scene, {}, table_with({drawer, twice, seen, force}));
  ASSERT_EQ(free.size(), 7u);
  EXPECT_EQ(free.back().name, "ap30.anterior_drawer offset");
  EXPECT_EQ(free.back().coordinate, 4u);
  EXPECT_EQ(free.back().prior_sd, 0.5);
  EXPECT_TRUE(free.back().nuisance());
}

TEST(FreeParameter, InsertionsMoveInTheTangentPlaneOfTheirBoneAndAlongItsNormal) {
  const std::vector<FreeParameter> free =
      free_parameters(calibrated_scene(), {TriangleMesh(), wall()}, MeasurementTable());
  EXPECT_EQ(free[5].name, "aACL.insertion.tibia.normal");
  EXPECT_EQ(free[3].prior_sd, 2);
  EXPECT_EQ(free[5].prior_sd, 0.25);
  ASSERT_EQ(free[5].moves.size(), 1u);  // along x
  EXPECT_EQ(free[5].moves[0].first.component, 0);
  EXPECT_DOUBLE_EQ(free[5].moves[0].second, 1);
  EXPECT_EQ(free[5].moves[0].first.body, OfBody::kMoving);
}

TEST(BoneTriad, ANormalIsThatOfTheNearestSideOfAPlate) {
  TriangleMesh plate = wall();
  const TriangleMesh front = wall();
  for (const Vector3d& vertex : front.vertices)
    plate.vertices.emplace_back(vertex - Vector3d(0.5, 0, 0));
  plate.triangles.push_back({4, 6, 5});
  plate.triangles.push_back({4, 7, 6});
  EXPECT_LT((bone_normal(plate, {3, 1, 2}).value() - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((bone_normal(plate, {-3, 1, 2}).value() + Vector3d::UnitX()).norm(), 1e-12);
}

// A ridge: neither side's normal, but the mean of both.
TEST(BoneTriad, ANormalIsTheMeanOfTrianglesNearby) {
  TriangleMesh roof;  // along z, its sides 45 degrees down
  roof.vertices = {{0, 0, -9}, {0, 0, 9}, {9, -9, 0}, {-9, -9, 0}};
  roof.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_LT((bone_normal(roof, {0, 5, 0}).value() - Vector3d::UnitY()).norm(), 1e-12);
}

TEST(BoneTriad, IsOrthonormalAndOfTheHandednessOfItsAxes) {
  const Vector3d n = Vector3d(0.3, -0.8, 0.1).normalized();
  const Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(), triad = triad_about(n, axes);
  EXPECT_LT((triad.transpose() * triad - axes).norm(), 1e-14);
  EXPECT_NEAR(triad.determinant(), 1, 1e-14);
  EXPECT_EQ(triad.col(2), n);
  // The axis most at right angles to n is z.
  EXPECT_NEAR(triad.col(0).dot(Vector3d::UnitZ().cross(n)), 0, 1e-15);
}

// Whichever way the bone lies in its file, and on either side.
TEST(BoneTriad, OfAKneeAndItsMirrorImageElsewhereAreImagesOfEachOther) {
  const Vector3d n = Vector3d(0.3, -0.8, 0.1).normalized();
  Eigen::Matrix3d axes;  // anterior, proximal, lateral
  axes << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const Eigen::Matrix3d turn = exp_rotation(Vector3d(0.4, -1.1, 0.7)),
                        mirror = Vector3d(-1, 1, 1).asDiagonal();
  for (const Eigen::Matrix3d& moved : {turn, Eigen::Matrix3d(turn * mirror)})
    EXPECT_LT((triad_about(moved * n, moved * axes) - moved * triad_about(n, axes)).norm(), 1e-14);
}

TEST(BoneTriad, AMeshWithoutAreaHasNoNormal) {
  EXPECT_FALSE(bone_normal(TriangleMesh(), Vector3d::Zero()).has_value());
  const TriangleMesh flat = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_FALSE(bone_normal(flat, Vector3d::Zero()).has_value());
}

std::string message_of_free(const Scene& scene) {
  try {
    (void)free_of(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FreeParameter, ANumberIsFreeOnce) {
  Scene scene = calibrated_scene();
  CalibrationParameter again = scene.calibration->parameters[0];
  again.what = ParameterKind::kSlackLength;
  again.of = {1};
  scene.calibration->parameters.push_back(again);
  EXPECT_EQ(message_of_free(scene),
            "some/knee.toml: [[calibrate.parameter]] pACL.slack_length is free twice, expected "
            "once");
}

TEST(FreeParameter, ANumberThatALawDoesNotHaveIsRefused) {
  Scene scene = calibrated_scene();
  scene.calibration->parameters[0].of = {2};
  EXPECT_EQ(message_of_free(scene),
            "some/knee.toml: [[calibrate.parameter]] strap.reference_strain: its law has none, "
            "expected toe-linear or quadratic");
}

/// Everything that can be free at once, the slack length of pACL in place of its strain.
Scene scene_with_all_free() {
  std::string text = with(kCalibratedScene, "of = [\"aACL\", \"pACL\"]", "of = [\"aACL\"]");
  text = with(text, "of = [\"aACL\"]\nwhat = \"insertion",
              "of = [\"aACL\", \"pACL\"]\nwhat = \"insertion");
  text += R"(
[[calibrate.parameter]]
of = ["pACL"]
what = "slack_length"
prior_sd = 1
[[calibrate.parameter]]
of = ["aACL"]
what = "transition_strain"
prior_sd = 0.02
[[calibrate.parameter]]
of = ["aACL", "pACL"]
what = "insertion.femur"
prior_sd = 2
together = true
[[calibrate.parameter]]
of = ["weight"]
what = "load"
prior_sd = 0.1
)";
  Scene scene = parse_scene(text, "some/knee.toml");
  scene.contacts.clear();  // no surfaces are needed
  return scene;
}

// The same numbers change in the model, one after the other (change of model_parameter.h), and in the
// described scene at one go.
TEST(SceneWith, IsTheSceneWhoseModelHasTheChangedNumbers) {
  const Scene scene = scene_with_all_free();
  const std::vector<FreeParameter> free = free_of(scene);
  std::vector<double> theta(free.size());
  for (std::size_t j = 0; j < theta.size(); ++j)
    theta[j] = 0.4 * free[j].prior_sd * (j % 2 == 0 ? 1 : -1.5);
  const Model model = build_model(scene, {});
  Parameters parameters = parameters_of(model);
  Drive drive = drive_of(model);
  for (std::size_t j = 0; j < free.size(); ++j)
    for (const auto& [number, factor] : free[j].moves) {
      double by = factor * theta[j];
      if (number.kind == ParameterKind::kStiffness) {
        const ForceLaw& law = parameters.elements[number.index].law;
        const double k = number.index == 0 ? std::get<ToeLinearLaw>(law).stiffness
                                           : std::get<QuadraticLaw>(law).stiffness;
        by = k * (std::exp(theta[j]) - 1);
      }
      if (number.kind == ParameterKind::kLoadScale) by = std::exp(theta[j]) - 1;
      change(number, by, model, parameters, drive);
    }
  const Scene changed = scene_with(scene, free, theta);
  const Model expected = build_model(changed, {});
  for (std::size_t i = 0; i < 2; ++i) {
    const LineElement &a = parameters.elements[i], &b = expected.elements[i];
    // Origins of a model's frames lie where its insertions are: told in the files' frames.
    EXPECT_LT((a.x_C + model.origins.B - b.x_C - expected.origins.B).norm(), 1e-12);
    EXPECT_LT((a.s_D + model.origins.A - b.s_D - expected.origins.A).norm(), 1e-12);
    for (const double stretch : {0.01, 0.2}) {
      const double length = slack_length(b.law) * (1 + stretch);
      EXPECT_NEAR(tension(a.law, length).force, tension(b.law, length).force,
                  1e-10 * tension(b.law, length).force);
    }
  }
  const double scale = drive.scales[0];
  EXPECT_LT((scale * model.loads[0].vector - expected.loads[0].vector).norm(), 1e-12);
  const LigamentDescription& slackened = changed.ligaments[1];
  const double length = distance_between(changed, slackened.ends, start_pose(changed));
  EXPECT_NEAR(slackened.reference_strain.value(), length / slack_length(slackened.law) - 1, 1e-14);
}

TEST(SceneWith, NothingChangesWithoutAChange) {
  const Scene scene = calibrated_scene();
  const std::vector<FreeParameter> free = free_of(scene);
  const Scene same = scene_with(scene, free, std::vector<double>(free.size(), 0));
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    EXPECT_NEAR(slack_length(same.ligaments[i].law), slack_length(scene.ligaments[i].law), 1e-13);
}

}  // namespace
}  // namespace condyle::test
