/// Every mistake about elastic layers in a scene file gets one line that names file, line, table,
/// key, value and what was expected; what is right is read.

#include "condyle/scene_file/describe.h"
#include "scene/mistake.h"

namespace condyle {
namespace {

using test::Mistake;

const std::string kPair = "surfaces = [\"ball\", \"plateau\"]";
const std::string kRadius = "radius = 20";

/// The small scene with a layer on its ball, and keys of the contact.
std::string layered(const std::string& ball, const std::string& contact) {
  return with(small_scene_with(kRadius, kRadius + "\n" + ball), kPair, kPair + "\n" + contact);
}

TEST(LayerOfAScene, IsReadInItsUnits) {
  std::string text = layered("modulus = 1000\npoisson = 0.4\nlayer = 0.3",
                             "law = \"layer\"\npressure = \"logarithmic\"\ntolerance = 2e-4\n"
                             "lost_force = 0.1");
  text = with(text, "length = \"mm\"", "length = \"cm\"");
  const Scene scene = parse_scene(text, "knee.toml");
  ASSERT_TRUE(scene.contacts[0].layer);
  EXPECT_EQ(scene.contacts[0].layer->pressure, PressureLaw::kLogarithmic);
  EXPECT_EQ(scene.contacts[0].layer->tolerance, 2e-4);
  EXPECT_EQ(scene.contacts[0].layer->beyond, 0.1);
  EXPECT_DOUBLE_EQ(scene.surfaces[0].elastic->modulus, 10);
  EXPECT_DOUBLE_EQ(scene.surfaces[0].elastic->layer, 3);
  const std::string words = describe(scene);
  EXPECT_NE(words.find("ball with plateau, elastic layers, logarithmic"), std::string::npos);
  EXPECT_NE(words.find("E = 10 N/mm^2, nu = 0.4, layer of 3 mm"), std::string::npos);
}

TEST(LayerOfAScene, IsThereOnRequestOnly) {
  const std::string text = small_scene_with(kRadius, kRadius + "\nmodulus = 10\nlayer = 3");
  EXPECT_FALSE(parse_scene(text, "knee.toml").contacts[0].layer);
  EXPECT_FALSE(
      parse_scene(with(text, kPair, kPair + "\nlaw = \"rigid\""), "knee.toml").contacts[0].layer);
}

struct LayerMistake {
  std::string ball, contact, message;
  friend std::ostream& operator<<(std::ostream& stream, const LayerMistake& mistake) {
    return stream << mistake.ball << " | " << mistake.contact;
  }
};

class BadLayer : public testing::TestWithParam<LayerMistake> {};

TEST_P(BadLayer, IsNamedWithItsPlace) {
  EXPECT_EQ(test::message_of(layered(GetParam().ball, GetParam().contact)),
            "some/knee.toml:" + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Layers,
    BadLayer,
    testing::Values(
        LayerMistake{"", "law = \"soft\"",
                     "39: [[contact]] \"medial\": law = \"soft\", expected \"rigid\" or \"layer\""},
        LayerMistake{"", "law = \"layer\"",
                     "39: [[contact]] \"medial\": law = \"layer\", expected modulus and layer of "
                     "surface \"ball\" or \"plateau\": both are rigid"},
        LayerMistake{"modulus = 10", "law = \"layer\"",
                     "27: [[surface]] \"ball\": modulus = 10, expected layer beside it (a "
                     "thickness): contact \"medial\" is one of layers"},
        LayerMistake{"layer = 3", "law = \"layer\"",
                     "27: [[surface]] \"ball\": layer = 3, expected a modulus beside it"},
        LayerMistake{"modulus = 10\nlayer = 0", "law = \"layer\"",
                     "28: [[surface]] \"ball\": layer = 0, expected a thickness (none: elastic "
                     "throughout) > 0"},
        LayerMistake{"modulus = 10\nlayer = 20", "law = \"layer\"",
                     "28: [[surface]] \"ball\": layer = 20, expected a thickness less than 20, the "
                     "smallest radius of the surface"},
        LayerMistake{"modulus = 10\nlayer = 3\npoisson = 0.495", "law = \"layer\"",
                     "29: [[surface]] \"ball\": poisson = 0.495, expected at most 0.49 of a layer "
                     "that is pressed: nearer to 0.5 it moves sideways, which a foundation of "
                     "springs cannot"},
        LayerMistake{"modulus = 10\nlayer = 3\npoisson = -0.1", "law = \"layer\"",
                     "29: [[surface]] \"ball\": poisson = -0.1, expected Poisson's ratio, at least "
                     "0 and less than 0.5"},
        LayerMistake{"modulus = 10\nlayer = 3", "pressure = \"linear\"",
                     "40: [[contact]] \"medial\": pressure = \"linear\", expected law = \"layer\" "
                     "beside it"},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\npressure = \"log\"",
                     "41: [[contact]] \"medial\": pressure = \"log\", expected \"linear\" or "
                     "\"logarithmic\""},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\ntolerance = 0.5",
                     "41: [[contact]] \"medial\": tolerance = 0.5, expected a part of the force, "
                     "above 0 and at most 0.1"},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\nlost_force = 0",
                     "41: [[contact]] \"medial\": lost_force = 0, expected a part of the force, "
                     "above 0 and at most 1"},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\nlost_force = 1.5",
                     "41: [[contact]] \"medial\": lost_force = 1.5, expected a part of the force, "
                     "above 0 and at most 1"},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\nstate = \"closed\"",
                     "41: [[contact]] \"medial\": state = \"closed\", expected \"auto\": layers "
                     "open and close by themselves"},
        LayerMistake{"modulus = 10\nlayer = 3", "law = \"layer\"\ntolerence = 1e-3",
                     "41: [[contact]] \"medial\": unknown key tolerence = 0.001, did you mean "
                     "\"tolerance\"?"}));

}  // namespace
}  // namespace condyle
