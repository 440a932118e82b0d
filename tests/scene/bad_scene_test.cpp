/// Every mistake in a scene file gets one line that names file, line, table, key, value and what
/// was expected: the text as such, units, bodies, the joint, contacts.

#include <filesystem>
#include <fstream>

#include "scene/mistake.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using test::message_of;
using test::Mistake;

class BadScene : public test::MistakeTest {};

TEST_P(BadScene, IsNamedWithItsPlace) { expect_named(); }

INSTANTIATE_TEST_SUITE_P(
    Units,
    BadScene,
    testing::Values(Mistake{"length = \"mm\"", "length = \"inch\"",
                            "3: [units]: length = \"inch\", expected \"mm\", \"cm\" or \"m\""},
                    Mistake{"force = \"N\"", "force = 1", "5: [units]: force = 1, expected \"N\""},
                    Mistake{"angle = \"deg\"\n", "",
                            "2: [units]: angle is missing, expected \"deg\" or \"rad\""},
                    Mistake{"force = \"N\"", "force = \"N\"\nmass = \"kg\"",
                            "6: [units]: unknown key mass = \"kg\", expected one of \"angle\", "
                            "\"force\" or \"length\""},
                    Mistake{"[units]", "[unit]",
                            "2: unknown key unit = { length = \"mm\", angle = \"deg\", force = "
                            "\"N\" }, did you mean \"units\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Bodies,
    BadScene,
    testing::Values(
        Mistake{
            "fixed = true", "",
            "11: [[body]] \"tibia\": a second moving body, expected one fixed and one moving body "
            "(is fixed = true missing?)"},
        Mistake{"fixed = true", "fixed = 1",
                "9: [[body]] \"femur\": fixed = 1, expected true or false"},
        Mistake{"name = \"tibia\"", "name = \"tibia\"\nfixed = true",
                "13: [[body]] \"tibia\": fixed = true, expected one fixed body (\"femur\" is fixed "
                "already)"},
        Mistake{"name = \"tibia\"", "name = \"femur\"",
                "12: [[body]] \"femur\": name = \"femur\", expected a name that is not used twice"},
        Mistake{"name = \"tibia\"", "name = \"..\"",
                "12: [[body]] \"..\": name = \"..\", expected a name without \"/\", other than "
                "\".\" and "
                "\"..\": groups of results have it"},
        Mistake{"name = \"tibia\"", "name = \"a\\tb\"",
                "12: [[body]] \"a?b\": name = \"a?b\", expected a name without control characters"},
        Mistake{"name = \"tibia\"", "name = \"a/b\"",
                "12: [[body]] \"a/b\": name = \"a/b\", expected a name without \"/\", other "
                "than \".\" and \"..\": groups of results have it"},
        Mistake{"name = \"tibia\"\n", "",
                "11: [[body]] number 2: name is missing, expected a name"},
        Mistake{"start.translation = [0, 0, 0]", "start.translation = [0, 0]",
                "13: [[body]] \"tibia\": start.translation = [0, 0], expected a point [x, y, z], "
                "three finite numbers"},
        Mistake{"start.rotation = [0, 0, 0]", "start.rotation = [0, nan, 0]",
                "14: [[body]] \"tibia\": start.rotation = [0, nan, 0], "
                "expected a rotation vector [x, y, z], three finite numbers"},
        Mistake{
            "start.rotation = [0, 0, 0]", "start.rotation = [0, 0, 360.1]",
            "14: [[body]] \"tibia\": start.rotation = [0, 0, 360.1], expected a rotation vector of "
            "at most one turn (suspect [units] angle)"},
        Mistake{"start.rotation = [0, 0, 0]", "start.rotaton = [0, 0, 0]",
                "14: [[body]] \"tibia\": unknown key start.rotaton = [0, 0, 0], did you mean "
                "\"rotation\"?"},
        Mistake{"start.rotation", "start.flexion = 3\nstart.rotation",
                "15: [[body]] \"tibia\": start.rotation = [0, 0, 0], "
                "expected either a rotation vector or joint angles, not both"},
        Mistake{"start.rotation = [0, 0, 0]", "density = -1",
                "14: [[body]] \"tibia\": density = -1, expected a density > 0"},
        Mistake{"start.rotation = [0, 0, 0]", "mass = 1",
                "11: [[body]] \"tibia\": center is missing, expected the mass centre [x, y, z]"},
        Mistake{"start.rotation = [0, 0, 0]",
                "mass = 1\ncenter = [0,0,0]\ninertia = [[1,0,0],[0,1,0],[0,0,-1]]",
                "16: [[body]] \"tibia\": inertia = [[1, 0, 0], [0, 1, 0], [0, 0, -1]], "
                "expected a symmetric positive definite matrix"},
        Mistake{"start.rotation = [0, 0, 0]",
                "mass = 1\ncenter = [0,0,0]\ninertia = [[1,0,0],[0,1,0],[0,0,3]]",
                "16: [[body]] \"tibia\": inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 3]], "
                "expected no principal moment above the sum of the two others: no body has one"},
        Mistake{
            "[joint]", "[[body]]\nname = \"fibula\"\n[joint]",
            "16: [[body]] \"fibula\": a second moving body, expected one fixed and one moving body "
            "(is fixed = true missing?)"}));

INSTANTIATE_TEST_SUITE_P(
    ContactTwice,
    BadScene,
    testing::Values(Mistake{
        "surfaces = [\"ball\", \"plateau\"]\n",
        "surfaces = [\"ball\", \"plateau\"]\n\n[[contact]]\nname = \"again\"\n"
        "surfaces = [\"plateau\", \"ball\"]\n",
        "41: [[contact]] \"again\": surfaces = [\"plateau\", \"ball\"], expected two surfaces "
        "that are not yet in contact \"medial\": a contact finds all its points by itself"}));

INSTANTIATE_TEST_SUITE_P(
    Joint,
    BadScene,
    testing::Values(
        Mistake{"side = \"right\"", "side = \"links\"",
                "17: [joint]: side = \"links\", expected \"right\" or \"left\""},
        Mistake{"side = \"right\"", "side = \"left\"",
                "18: [joint]: femur = { body = \"femur\", origin = [0, 0, 0], lateral = [0, 0, 1], "
                "anterior = [1, 0, 0],..., "
                "expected a left-handed triad (lateral, anterior, proximal) for side = \"left\""},
        Mistake{"lateral = [0, 0, 1], anterior = [1, 0, 0]",
                "lateral = [0, 0, 2], anterior = [1, 0, 0]",
                "18: [joint]: femur.lateral = [0, 0, 2], expected a unit vector (its length is 2)"},
        Mistake{"lateral = [0, 0, 1], anterior = [1, 0, 0]",
                "lateral = [0, 0, 1], anterior = [0, 0.6, 0.8]",
                "18: [joint]: femur.anterior = [0, 0.6, 0.8], expected a vector at right angles to "
                "lateral"},
        Mistake{"tibia = { body = \"tibia\"", "tibia = { body = \"femur\"",
                "16: [joint]: femur and tibia name the same body \"femur\", expected two bodies"},
        Mistake{"tibia = { body = \"tibia\"", "tibia = { body = \"tibla\"",
                "19: [joint]: tibia.body = \"tibla\", expected the name of a body: \"femur\" or "
                "\"tibia\"; "
                "did you mean \"tibia\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Contacts,
    BadScene,
    testing::Values(
        Mistake{
            "surfaces = [\"ball\", \"plateau\"]", "surfaces = [\"ball\", \"platau\"]",
            "37: [[contact]] \"medial\": surfaces = \"platau\", expected the name of a surface: "
            "\"ball\" or \"plateau\"; did you mean \"plateau\"?"},
        Mistake{"surfaces = [\"ball\", \"plateau\"]", "surfaces = [\"ball\", \"ball\"]",
                "37: [[contact]] \"medial\": surfaces = [\"ball\", \"ball\"], expected surfaces of "
                "two bodies "
                "(both belong to \"femur\")"},
        Mistake{
            "surfaces = [\"ball\", \"plateau\"]", "surfaces = \"ball\"",
            "37: [[contact]] \"medial\": surfaces = \"ball\", expected the names of two surfaces"},
        Mistake{"surfaces = [\"ball\", \"plateau\"]",
                "surfaces = [\"ball\", \"plateau\"]\nstate = \"shut\"",
                "38: [[contact]] \"medial\": state = \"shut\", expected \"auto\", \"closed\" or "
                "\"open\""},
        Mistake{"surfaces = [\"ball\", \"plateau\"]",
                "surfaces = [\"ball\", \"plateau\"]\nstart = [1, 2, 3]",
                "38: [[contact]] \"medial\": start = 1, expected points [[x, y, z], ...] in the "
                "ground frame, each "
                "[x, y, z], three finite numbers"},
        Mistake{"[[contact]]", "[contact]", "35: contact, expected tables headed [[contact]]"}));

TEST(BadSceneText, WithASyntaxErrorNamesTheLine) {
  const std::string message = message_of("title = \"a\"\nthis is not TOML\n");
  EXPECT_EQ(message.rfind("some/knee.toml:2: not valid TOML: ", 0), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(BadSceneText, ThatIsEmptyAsksForUnits) {
  EXPECT_EQ(
      message_of(""),
      "some/knee.toml:1: units is missing, expected a table [units] with length, angle and force");
}

TEST(BadSceneText, NeedsOneFixedAndOneMovingBody) {
  const std::string units = kSmallScene.substr(0, kSmallScene.find("[[body]]"));
  EXPECT_EQ(message_of(units + "[[body]]\nname = \"a\""),
            "some/knee.toml:1: no fixed body, expected one [[body]] with fixed = true");
  EXPECT_EQ(message_of(units + "[[body]]\nname = \"a\"\nfixed = true"),
            "some/knee.toml:1: no moving body, expected a [[body]] without fixed = true");
}

TEST(BadSceneText, WithoutAJointHasNoFlexion) {
  const std::string before = kSmallScene.substr(0, kSmallScene.find("[joint]"));
  const std::string after = kSmallScene.substr(kSmallScene.find("[[surface]]"));
  EXPECT_EQ(message_of(before + after),
            "some/knee.toml:43: [[condition]] \"bend\": kind = \"flexion\", "
            "expected a [joint] that says where the anatomical frames are");
}

std::string message_of_file(const std::filesystem::path& file) {
  try {
    (void)read_scene(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BadSceneFile, ThatDoesNotExistIsNamed) {
  EXPECT_EQ(message_of_file("nowhere/knee.toml"),
            "nowhere/knee.toml: no such file, expected a scene (TOML)");
}

TEST(BadSceneFile, ThatIsAFolderIsNamed) {
  const std::string folder = testing::TempDir();
  EXPECT_EQ(message_of_file(folder), folder + ": is a folder, expected a scene (TOML)");
}

// Letters of three bytes each.
TEST(BadSceneFile, NamesHaveAHundredCharactersHoweverManyBytesTheseTake) {
  const auto named = [](int letters) {
    std::string name;
    for (int i = 0; i < letters; ++i) name += "\u819d";
    return small_scene_with("name = \"aACL\"", "name = \"" + name + "\"");
  };
  EXPECT_EQ(parse_scene(named(100), "knee.toml").ligaments[0].name.size(), 300U);
  try {
    (void)parse_scene(named(101), "knee.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected at most 100 characters, here are 101"),
              std::string::npos)
        << error.what();
  }
}

TEST(BadSceneFile, NamingAMeshThatDoesNotExistSaysWhereItLooked) {
  const std::filesystem::path file =
      test::scratch_folder("condyle_no_mesh").replace_extension("toml");
  std::ofstream(file) << small_scene_with("fixed = true", "fixed = true\nmesh = \"no.stl\"");
  const std::string mesh = (file.parent_path() / "no.stl").string();
  EXPECT_EQ(message_of_file(file),
            file.string() +
                ":10: [[body]] \"femur\": mesh = \"no.stl\", expected a mesh file "
                "(there is no file " +
                mesh + "; paths start at the scene's folder)");
  std::filesystem::remove(file);
}

// Dots of numbers in words are none of a key.
TEST(KeyDepth, IsThatOfKeysAndNotOfComments) {
  std::string words, parts = "a";
  for (int i = 0; i < 300; ++i) words += "1.5 mm ", parts += ".a";
  for (const std::string& line :
       {"# " + words, "title = \"" + words + "\"", "title = '''\n" + words + "'''",
        "title = \"\"\"\n\\\"" + words + "\"\"\""})
    EXPECT_NO_THROW(
        (void)parse_scene(small_scene_with("title = \"ball and socket\"", line), "knee.toml"))
        << line.substr(0, 20);
  for (const std::string& line :
       {parts + " = 1", "\"a\" . " + parts + " = 1 # it's", "x = { " + parts + " = 1 }",
        "x = [ '''b'''', { " + parts + " = 1 } ]"})
    EXPECT_NE(test::message_of(small_scene_with("title = \"ball and socket\"", line))
                  .find("1: not valid TOML: a key of more than 256 parts"),
              std::string::npos);
}

}  // namespace
}  // namespace condyle
