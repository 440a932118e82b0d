/// Wraps of a scene file and the ligaments that go over them: what is right is read, every mistake gets
/// one line that names file, line, table, key, value and what was expected.

#include <cmath>

#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/describe.h"
#include "scene/mistake.h"

namespace condyle {
namespace {

using test::message_of;

const std::string kLigament = "[[ligament]]\nname = \"aACL\"";
const std::string kLaw = "law = \"toe-linear\"";

/// The small scene with a wrap before its ligament, and keys of the ligament.
std::string wrapped(const std::string& wrap, const std::string& ligament) {
  return with(small_scene_with(kLigament, "[[wrap]]\nname = \"rim\"\n" + wrap + "\n\n" + kLigament),
              kLaw, ligament + "\n" + kLaw);
}

const std::string kWrapSphere =
    "body = \"tibia\"\nkind = \"sphere\"\ncenter = [3, 5, 0]\nradius = 5";

/// From (0, 20) to (0, -10) round a circle about (3, 5) with the radius r: both ends √(15² + 3²) from its
/// middle.
double length_round(double r) {
  const double d = std::hypot(15, 3), straight = std::sqrt(d * d - r * r);
  const double between = 2 * std::atan2(15, 3);  // seen from the middle, on the side of the line
  return 2 * straight + r * (between - 2 * std::acos(r / d));
}

TEST(WrapOfAScene, IsReadInItsUnits) {
  std::string text = wrapped(
      "body = \"tibia\"\nkind = \"ellipsoid\"\ncenter = [3, 5, 0]\naxes = [0, 0, 90]\n"
      "semi_axes = [6, 5, 4]",
      "wraps = [\"rim\"]\nside = [-9, 5, 0]\ninside = \"straight\"\nthickness = 0.2");
  text = with(text, "length = \"mm\"", "length = \"cm\"");
  const Scene scene = parse_scene(text, "knee.toml");
  ASSERT_EQ(scene.wraps.size(), 1U);
  EXPECT_EQ(scene.wraps[0].body, 1);
  EXPECT_NEAR((scene.wraps[0].placement.p - Eigen::Vector3d(30, 50, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((scene.wraps[0].placement.R.col(0) - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
  EXPECT_EQ(std::get<WrapEllipsoid>(scene.wraps[0].shape).semi_axes, Eigen::Vector3d(60, 50, 40));
  const LigamentWraps& path = scene.ligaments[0].path;
  EXPECT_EQ(path.wraps, std::vector<int>{0});
  EXPECT_EQ(path.sides[0], Eigen::Vector3d(-90, 50, 0));
  EXPECT_FALSE(path.anchors_inside);
  EXPECT_DOUBLE_EQ(path.thickness, 2);
  const std::string words = describe(scene);
  EXPECT_NE(words.find("wrap       rim: ellipsoid, semi-axes 60, 50, 40 mm on tibia"),
            std::string::npos);
  EXPECT_NE(words.find("aACL: toe-linear, over rim, 2 mm thick"), std::string::npos);
}

// Half of the thickness goes to the radius; the reference strain is that of the length on the path.
TEST(WrapOfAScene, SetsTheSlackLengthByTheLengthAlongThePath) {
  for (const double thickness : {0.0, 1.0}) {
    const std::string text =
        with(wrapped(kWrapSphere, "wraps = [\"rim\"]\nthickness = " + std::to_string(thickness)),
             "slack_length = 30", "reference_strain = 0.1");
    const Scene scene = parse_scene(text, "knee.toml");
    EXPECT_NEAR(slack_length(scene.ligaments[0].law), length_round(5 + thickness / 2) / 1.1, 1e-10);
  }
}

// Of an end inside a surface of the other body the path is a chord: no length to tell a strain of.
TEST(WrapOfAScene, HasNoReferenceStrainWhereThereIsNoPathAtTheStartPose) {
  const std::string inside = "body = \"tibia\"\nkind = \"sphere\"\ncenter = [1, 18, 0]\nradius = 5",
                    text = wrapped(inside, "wraps = [\"rim\"]");
  EXPECT_EQ(
      message_of(with(text, "slack_length = 30", "reference_strain = 0.1")),
      "some/knee.toml:52: [[ligament]] \"aACL\": reference_strain = 0.1, expected slack_length in "
      "its place: at the start pose an end of it lies inside \"rim\"");
  EXPECT_EQ(parse_scene(text, "knee.toml").ligaments.size(), 1U);
}

TEST(WrapOfAScene, ALigamentOverNoWrapIsStraight) {
  const Scene scene = parse_scene(kSmallScene, "knee.toml");
  EXPECT_EQ(ligament_path(scene, scene.ligaments[0]), nullptr);
  EXPECT_DOUBLE_EQ(ligament_length(scene, scene.ligaments[0], start_pose(scene)), 30);
}

struct WrapMistake {
  std::string wrap, ligament, message;
  friend std::ostream& operator<<(std::ostream& stream, const WrapMistake& mistake) {
    return stream << mistake.wrap << "; " << mistake.ligament;
  }
};

class BadWrap : public testing::TestWithParam<WrapMistake> {};

TEST_P(BadWrap, IsNamed) {
  EXPECT_EQ(message_of(wrapped(GetParam().wrap, GetParam().ligament)),
            "some/knee.toml:" + GetParam().message);
}

const std::string kOn = "wraps = [\"rim\"]";
const WrapMistake kMistakes[] = {
    {"body = \"shank\"\nkind = \"sphere\"\ncenter = [3, 5, 0]\nradius = 5", kOn,
     "41: [[wrap]] \"rim\": body = \"shank\", expected the name of a body: \"femur\" or \"tibia\""},
    {"body = \"tibia\"\nkind = \"cone\"", kOn,
     "42: [[wrap]] \"rim\": kind = \"cone\", expected \"sphere\", \"cylinder\", \"ellipsoid\" or "
     "\"torus\""},
    {"body = \"tibia\"\nkind = \"sphere\"\ncenter = [3, 5, 0]\nradius = 0", kOn,
     "44: [[wrap]] \"rim\": radius = 0, expected a radius > 0"},
    {"body = \"tibia\"\nkind = \"cylinder\"\npoint = [3, 5, 0]\naxis = [0, 0, 1]\nradius = "
     "5\nlength = 4",
     kOn,
     "46: [[wrap]] \"rim\": length = 4, expected no length: a cylinder that ligaments wrap on has "
     "no "
     "ends"},
    {kWrapSphere, "wraps = []",
     "49: [[ligament]] \"aACL\": wraps = [], expected names of wraps [\"...\", ...], from the "
     "first "
     "end to the second"},
    {kWrapSphere, "wraps = [\"rib\"]",
     "49: [[ligament]] \"aACL\": wraps = \"rib\", expected the name of a wrap: \"rim\"; did you "
     "mean \"rim\"?"},
    {kWrapSphere, "wraps = [\"rim\", \"rim\"]",
     "49: [[ligament]] \"aACL\": wraps = \"rim\", expected each wrap once"},
    {kWrapSphere, kOn + "\nside = [[1, 2, 3], [4, 5, 6]]",
     "50: [[ligament]] \"aACL\": side = [[1, 2, 3], [4, 5, 6]], expected a point [x, y, z] on the "
     "side that is passed"},
    {kWrapSphere, kOn + "\nside = [3, 50, 0]",
     "50: [[ligament]] \"aACL\": side = [3, 50, 0], expected points on whose sides of the wraps "
     "there is a shortest path at "
     "the start pose, as there is without"},
    {kWrapSphere, kOn + "\ninside = \"bent\"",
     "50: [[ligament]] \"aACL\": inside = \"bent\", expected \"anchor\" or \"straight\""},
    {kWrapSphere, "thickness = 2",
     "49: [[ligament]] \"aACL\": thickness = 2, expected wraps beside it"},
    {kWrapSphere, kOn + "\nthickness = -1",
     "50: [[ligament]] \"aACL\": thickness = -1, expected a thickness >= 0"},
    {"body = \"tibia\"\nkind = \"torus\"\ncenter = [9, 0, 0]\naxis = [0, 0, 1]\nmajor = 2\nminor = "
     "1.5",
     kOn + "\nthickness = 1",
     "52: [[ligament]] \"aACL\": thickness = 1, expected less than 1, with which wrap \"rim\" has "
     "no hole left"},
    {"body = \"tibia\"\nkind = \"sphere\"\ncenter = [3, -10, 0]\nradius = 7", kOn,
     "48: [[ligament]] \"aACL\": ends = [{ body = \"femur\", at = [0, 20, 0] }, { body = "
     "\"tibia\", at "
     "= [0, -10, 0] }], expected an end outside wrap \"rim\" or close under its surface (it lies 4 "
     "mm "
     "inside)"},
};
INSTANTIATE_TEST_SUITE_P(Scene, BadWrap, testing::ValuesIn(kMistakes));

TEST(WrapOfAScene, NoEndLiesInsideTwo) {
  const std::string text = wrapped(
      "body = \"tibia\"\nkind = \"sphere\"\ncenter = [3, -10, 0]\nradius = 3.5\n\n[[wrap]]\nname = "
      "\"other\"\nbody = \"tibia\"\nkind = \"sphere\"\ncenter = [-4, -10, 0]\nradius = 4.5",
      "wraps = [\"rim\", \"other\"]");
  EXPECT_NE(message_of(text).find("expected an end inside one wrap at most (it lies in \"rim\" and "
                                  "\"other\")"),
            std::string::npos)
      << message_of(text);
}

TEST(WrapOfAScene, ThatNoLigamentUsesIsNamed) {
  EXPECT_EQ(
      message_of(wrapped(kWrapSphere, "")),
      "some/knee.toml:39: [[wrap]] \"rim\": no ligament wraps on it, expected wraps = [..] of a "
      "ligament to name it");
}

}  // namespace
}  // namespace condyle
