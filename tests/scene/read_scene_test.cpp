#include "condyle/scene_file/read_scene.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/describe.h"
#include "scene/small_scene.h"

namespace condyle {
namespace {

Scene small() { return parse_scene(kSmallScene, "some/knee.toml"); }

TEST(ReadScene, RefersByIndex) {
  const Scene scene = small();
  EXPECT_EQ(scene.title, "ball and socket");
  EXPECT_EQ(scene.fixed_body(), 0);
  EXPECT_EQ(scene.moving_body(), 1);
  EXPECT_EQ(scene.contacts[0].surfaces, (std::array<int, 2>{0, 1}));
  EXPECT_EQ(scene.ligaments[0].ends[1].body, 1);
  EXPECT_FALSE(scene.sweep->varies_load);
  EXPECT_EQ(scene.sweep->index, 0);
  EXPECT_EQ(scene.sweep->values.size(), 25U);
}

TEST(ReadScene, KeepsTheWholeText) { EXPECT_EQ(small().text, kSmallScene); }

TEST(ReadScene, TakesItsTitleFromTheFileWhereItHasNone) {
  EXPECT_EQ(
      parse_scene(small_scene_with("title = \"ball and socket\"", ""), "some/knee.toml").title,
      "knee");
}

TEST(ReadScene, VariesTheScaleOfALoad) {
  const Scene scene =
      parse_scene(small_scene_with("vary = \"bend\"", "vary = \"weight.scale\""), "knee.toml");
  EXPECT_TRUE(scene.sweep->varies_load);
  EXPECT_EQ(scene.sweep->index, 0);
  EXPECT_DOUBLE_EQ(scene.sweep->values.back(), 120);  // a factor has no unit
}

TEST(ReadScene, TakesTheSlackLengthFromTheStrainAtTheStartPose) {
  // The ends lie 30 mm apart; the start pose moves the tibia 3 mm away, so l0 = 33/1.1.
  const std::string strained = small_scene_with("slack_length = 30", "reference_strain = 0.1");
  const Scene scene = parse_scene(
      with(strained, "translation = [0, 0, 0]", "translation = [0, -3, 0]"), "knee.toml");
  EXPECT_DOUBLE_EQ(slack_length(scene.ligaments[0].law), 30);
  EXPECT_DOUBLE_EQ(*scene.ligaments[0].reference_strain, 0.1);
}

// Scenes in cm: a modulus of 500 N/cm² is 5 N/mm².
TEST(ReadScene, ReadsBoundsAndElasticity) {
  std::string text = small_scene_with("length = \"mm\"", "length = \"cm\"");
  text = with(text, "normal = [0, 1, 0]",
              "normal = [0, 1, 0]\nradius = 3\nmodulus = 500\nlayer = 0.2");
  text = with(text, "kind = \"sphere\"\ncenter = [0, 20, 0]",
              "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]\nlength = 4");
  const Scene scene = parse_scene(text, "knee.toml");
  EXPECT_DOUBLE_EQ(scene.surfaces[0].length, 40);
  EXPECT_FALSE(scene.surfaces[0].elastic);
  EXPECT_DOUBLE_EQ(scene.surfaces[1].known_radius, 30);
  ASSERT_TRUE(scene.surfaces[1].elastic);
  EXPECT_DOUBLE_EQ(scene.surfaces[1].elastic->modulus, 5);
  EXPECT_DOUBLE_EQ(scene.surfaces[1].elastic->poisson, 0.45);
  EXPECT_DOUBLE_EQ(scene.surfaces[1].elastic->layer, 2);
}

// An open contact is never looked for, so both its surfaces may go on for ever.
TEST(ReadScene, AnOpenContactNeedsNoBounds) {
  std::string text = with(kSmallScene, "kind = \"sphere\"\ncenter = [0, 20, 0]",
                          "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]");
  text = with(text, "surfaces = [\"ball\", \"plateau\"]",
              "surfaces = [\"ball\", \"plateau\"]\nstate = \"open\"");
  EXPECT_EQ(parse_scene(text, "knee.toml").contacts[0].state, ContactState::kOpen);
}

TEST(ReadScene, StartsFromJointAngles) {
  const Scene scene = parse_scene(
      small_scene_with("start.rotation = [0, 0, 0]", "start.flexion = 90"), "knee.toml");
  // Flexion of a right knee with lateral = z, anterior = x, proximal = y: the shank swings
  // backwards, so that its proximal axis points anteriorly.
  EXPECT_NEAR(start_pose(scene).R.col(1).x(), 1, 1e-15);
  EXPECT_NEAR(start_pose(scene).R.col(2).z(), 1, 1e-15);
}

TEST(ReadScene, WantsALeftHandedTriadOfALeftKnee) {
  std::string text = small_scene_with("side = \"right\"", "side = \"left\"");
  text = with(text, "lateral = [0, 0, 1]", "lateral = [0, 0, -1]");
  text = with(text, "lateral = [0, 0, 1]", "lateral = [0, 0, -1]");
  const Scene scene = parse_scene(text, "knee.toml");
  EXPECT_EQ(scene.joint->side, Side::kLeft);
  EXPECT_TRUE(scene.joint->femur.lateral.isApprox(Eigen::Vector3d(0, 0, -1), 1e-15));
}

TEST(ReadScene, MakesRoundedAxesExact) {
  const Scene scene =
      parse_scene(small_scene_with("anterior = [1, 0, 0], proximal = [0, 1, 0]",
                                   "anterior = [0.8, 0.6, 0], proximal = [-0.5999, 0.8001, 0]"),
                  "knee.toml");
  const AnatomicalFrame& frame = scene.joint->femur;
  EXPECT_NEAR(frame.anterior.dot(frame.proximal), 0, 1e-15);
  EXPECT_NEAR(frame.proximal.norm(), 1, 1e-15);
}

TEST(ReadScene, AcceptsTheKeysOfTheContractOnAPatch) {
  const std::string sphere = "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20";
  const std::string patch =
      "kind = \"patch\"\nsolid = \"inside\"\ncompartment = \"medial\"\nmesh = "
      "\"cartilage.stl\"\nmesh_units = \"m\"\n"
      "fit = { control_points = \"auto\", smoothing = \"auto\" }";
  const Scene scene = parse_scene(small_scene_with(sphere, patch), "knee.toml");
  const PatchDescription& description = scene.surfaces[0].patch;
  EXPECT_EQ(description.compartment, Compartment::kMedial);
  EXPECT_FALSE(description.control_points.has_value());
  EXPECT_FALSE(description.smoothing.has_value());
  EXPECT_FALSE(description.smooth_for_position);
  EXPECT_DOUBLE_EQ(description.mesh->to_mm, 1000);
  const std::string position =
      "kind = \"patch\"\ncompartment = \"medial\"\nmesh = "
      "\"cartilage.stl\"\nfit = { smoothing = \"position\" }";
  EXPECT_TRUE(parse_scene(small_scene_with(sphere, position), "knee.toml")
                  .surfaces[0]
                  .patch.smooth_for_position);
}

TEST(Describe, SaysWhatTheSceneHolds) {
  const std::string text = describe(small());
  EXPECT_NE(text.find("ball: sphere on femur"), std::string::npos) << text;
  EXPECT_NE(text.find("aACL: toe-linear, 30 mm at the start pose, slack length 30 mm"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("bend from 0 to 120 deg, 25 poses"), std::string::npos) << text;
}

// The specimens are not part of this project: the tests run where the folder stands beside it.
class SpecimenScene : public testing::TestWithParam<const char*> {};

TEST_P(SpecimenScene, IsRead) {
  const std::filesystem::path file = std::filesystem::path(CONDYLE_SOURCE_DIR) / ".." / "shared" /
                                     "specimens" / GetParam() / "knee.toml";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no specimen at " << file;
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.surfaces.size(), 4U);
  EXPECT_GE(scene.ligaments.size(), 50U);
  EXPECT_EQ(scene.sweep->values.size(), 19U);  // 0 to 90 by 5
  for (const LigamentDescription& ligament : scene.ligaments) {
    const double stretch =
        distance_between(scene, ligament.ends, start_pose(scene)) / slack_length(ligament.law);
    EXPECT_GT(stretch, 0.7) << ligament.name;
    EXPECT_LT(stretch, 1.3) << ligament.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SpecimenScene, testing::Values("lenhart2015", "clouthier2019_ssm"));

}  // namespace
}  // namespace condyle
