/// Wraps of a scene file that are to be fitted to the bone: what is right is read, mistakes are named.

#include "condyle/scene/ligament_path.h"
#include "condyle/scene_file/describe.h"
#include "scene/fitted_wrap_scene.h"
#include "scene/mistake.h"

namespace condyle {
namespace {

using test::fitted_wrap_scene;
using test::fitted_wrap_text;
using test::message_of;

TEST(WrapFittedToTheBone, IsReadWithTheLigamentsThatLeadIt) {
  for (const std::string keys : {"", "ligaments = [\"aACL\"]\n"}) {
    const Scene scene = fitted_wrap_scene(keys);
    ASSERT_TRUE(scene.wraps[0].fit);
    EXPECT_FALSE(scene.wraps[0].fit->done);
    EXPECT_EQ(scene.wraps[0].fit->ligaments, std::vector<int>{0});
    EXPECT_FALSE(has_known_path(scene, scene.ligaments[0]));
    EXPECT_NE(describe(scene).find("wrap       rim: ellipsoid, fitted to the bone on tibia"),
              std::string::npos);
  }
}

TEST(WrapFittedToTheBone, OtherWrapsAndLigamentsAreKnownAtOnce) {
  const Scene scene = parse_scene(kSmallScene, "knee.toml");
  EXPECT_TRUE(has_known_path(scene, scene.ligaments[0]));
}

std::string mistake(const std::string& text) {
  const std::string message = message_of(text), place = "[[wrap]] \"rim\": ";
  const std::size_t at = message.find(place);
  return at == std::string::npos ? message : message.substr(at + place.size());
}

TEST(WrapFittedToTheBone, MistakesAreNamed) {
  EXPECT_EQ(mistake(with(fitted_wrap_text(), "\"bone\"", "\"mesh\"")),
            "fit = \"mesh\", expected \"bone\"");
  EXPECT_EQ(mistake(with(fitted_wrap_text(), "\"ellipsoid\"", "\"sphere\"")),
            "kind = \"sphere\", expected \"ellipsoid\", which can be fitted to a bone");
  EXPECT_EQ(mistake(with(fitted_wrap_text(), "mesh = \"tibia.ply\"\n", "")),
            "fit = \"bone\", expected a mesh of body \"tibia\", which names none");
  EXPECT_EQ(mistake(fitted_wrap_text("semi_axes = [3, 2, 1]\n")),
            "semi_axes = [3, 2, 1], expected none where fit = \"bone\" finds it");
  EXPECT_EQ(mistake(fitted_wrap_text("ligaments = [\"PCL\"]\n")),
            "ligaments = \"PCL\", expected the name of a ligament: \"aACL\"");
  EXPECT_EQ(mistake(fitted_wrap_text("ligaments = []\n")),
            "ligaments = [], expected names of ligaments [\"...\", ...] that wrap on it");
}

TEST(WrapFittedToTheBone, IsNotLedByALigamentThatDoesNotWrapOnIt) {
  const std::string other =
      "[[ligament]]\nname = \"PCL\"\nends = [{ body = \"femur\", at = [5, 20, 0] }, { body = "
      "\"tibia\", at = [5, -10, 0] }]\nlaw = \"quadratic\"\nstiffness = 1\nslack_length = 30\n\n";
  EXPECT_EQ(mistake(with(fitted_wrap_text("ligaments = [\"PCL\"]\n"), "[[condition]]",
                         other + "[[condition]]")),
            "ligaments = \"PCL\", expected names of ligaments [\"...\", ...] that wrap on it");
}

}  // namespace
}  // namespace condyle
