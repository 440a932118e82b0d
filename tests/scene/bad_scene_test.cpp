/// Every mistake in a scene file gets one line that names file, line, table, key, value and what
/// was expected.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <vector>

#include "condyle/input_error.h"
#include "condyle/scene/read_scene.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

std::string message_of(const std::string& text) {
  try {
    (void)parse_scene(text, "some/knee.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Mistake {
  std::string from, to;  // what is changed in the small scene
  std::string message;   // the whole message after "some/knee.toml:"
  friend std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.to;
  }
};

class BadScene : public testing::TestWithParam<Mistake> {};

TEST_P(BadScene, IsNamedWithItsPlace) {
  const Mistake& mistake = GetParam();
  EXPECT_EQ(message_of(small_scene_with(mistake.from, mistake.to)),
            "some/knee.toml:" + mistake.message);
}

// Line numbers are those of tests/scene/small_scene.h, where the text begins on line 1.
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
        Mistake{"name = \"tibia\"", "name = \"a/b\"",
                "12: [[body]] \"a/b\": name = \"a/b\", expected a name of at most 100 characters "
                "without \"/\""},
        Mistake{"name = \"tibia\"\n", "",
                "11: [[body]] number 2: name is missing, expected a name"},
        Mistake{"start.translation = [0, 0, 0]", "start.translation = [0, 0]",
                "13: [[body]] \"tibia\": start.translation = [0, 0], expected a point [x, y, z], "
                "three finite numbers"},
        Mistake{"start.rotation = [0, 0, 0]", "start.rotation = [0, nan, 0]",
                "14: [[body]] \"tibia\": start.rotation = [0, nan, 0], "
                "expected a rotation vector [x, y, z], three finite numbers"},
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
    Surfaces,
    BadScene,
    testing::Values(
        Mistake{"body = \"femur\"\nkind", "body = \"patella\"\nkind",
                "23: [[surface]] \"ball\": body = \"patella\", expected the name of a body: "
                "\"femur\" or \"tibia\""},
        Mistake{"kind = \"sphere\"", "kind = \"spere\"",
                "24: [[surface]] \"ball\": kind = \"spere\", expected \"patch\", \"plane\", "
                "\"sphere\", \"cylinder\", "
                "\"ellipsoid\", \"torus\" or \"polynomial\"; did you mean \"sphere\"?"},
        Mistake{"radius = 20", "radius = 0",
                "26: [[surface]] \"ball\": radius = 0, expected a radius > 0"},
        Mistake{
            "radius = 20", "radius = \"20\"",
            "26: [[surface]] \"ball\": radius = \"20\", expected a radius > 0, a finite number"},
        Mistake{"radius = 20", "raduis = 20",
                "26: [[surface]] \"ball\": unknown key raduis = 20, did you mean \"radius\"?"},
        Mistake{"radius = 20", "",
                "21: [[surface]] \"ball\": radius is missing, expected a radius > 0"},
        Mistake{"radius = 20", "radius = 20\nsolid = \"in\"",
                "27: [[surface]] \"ball\": solid = \"in\", expected \"inside\" or \"outside\""},
        Mistake{
            "normal = [0, 1, 0]", "normal = [0, 0, 0]",
            "33: [[surface]] \"plateau\": normal = [0, 0, 0], expected a direction of some length"},
        Mistake{"normal = [0, 1, 0]", "normal = [0, 1, 0]\nsolid = \"outside\"",
                "34: [[surface]] \"plateau\": solid = \"outside\", expected \"inside\": a patch or "
                "a plane has no outside"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
            "kind = \"patch\"\ncompartment = \"medial\"",
            "21: [[surface]] \"ball\": no mesh to fit, expected a mesh here or on body \"femur\""},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"torus\"\ncenter = [0, 20, 0]\naxis = [1, 0, 0]\nmajor = 2\nminor = 3",
                "28: [[surface]] \"ball\": minor = 3, expected a radius less than major"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
            "kind = \"polynomial\"\ncoefficients = [[0, 0, 1], [2, -1, 3]]",
            "25: [[surface]] \"ball\": coefficients = -1, expected a whole number from 0 to 20"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
                "kind = \"ellipsoid\"\ncenter = [0, 20, 0]\nsemi_axes = [1, 2, 3]\naxes = "
                "[[1,0,0],[0,1,0],[0,0,-1]]",
                "27: [[surface]] \"ball\": axes = [[1, 0, 0], [0, 1, 0], [0, 0, -1]], expected a "
                "right-handed triad"}));

// A patch needs a mesh; its file is looked for by read_scene only.
const std::string kSphere = "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20";
INSTANTIATE_TEST_SUITE_P(
    BoundsAndElasticity,
    BadScene,
    testing::Values(
        Mistake{"normal = [0, 1, 0]", "normal = [0, 1, 0]\nradius = -1",
                "34: [[surface]] \"plateau\": radius = -1, expected a radius of the part that is "
                "known > 0"},
        Mistake{"kind = \"sphere\"\ncenter = [0, 20, 0]",
                "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]\nlength = 0",
                "27: [[surface]] \"ball\": length = 0, expected a length > 0"},
        Mistake{
            "kind = \"sphere\"\ncenter = [0, 20, 0]",
            "kind = \"cylinder\"\npoint = [0, 20, 0]\naxis = [0, 0, 1]",
            "38: [[contact]] \"medial\": surfaces = [\"ball\", \"plateau\"], expected bounds of "
            "\"ball\" or of \"plateau\": radius of a plane or a polynomial, length of a "
            "cylinder"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 0",
                "27: [[surface]] \"ball\": modulus = 0, expected a modulus (force/length^2) > 0"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 5\npoisson = 0.5",
                "28: [[surface]] \"ball\": poisson = 0.5, expected Poisson's ratio, at least 0 and "
                "less than 0.5"},
        Mistake{"radius = 20", "radius = 20\nlayer = 3",
                "27: [[surface]] \"ball\": layer = 3, expected a modulus beside it"},
        Mistake{"radius = 20", "radius = 20\nmodulus = 5\nlayer = 0",
                "28: [[surface]] \"ball\": layer = 0, expected a thickness (none: elastic "
                "throughout) > 0"},
        Mistake{
            "radius = 20\n\n[[surface]]\nname = \"plateau\"",
            "radius = 20\nmodulus = 5\nlayer = 2\n\n[[surface]]\nmodulus = 9\nname = "
            "\"plateau\"",
            "40: [[contact]] \"medial\": surfaces = [\"ball\", \"plateau\"], expected layers on "
            "both or on neither (\"ball\" has a layer, \"plateau\" is elastic throughout)"}));

const std::string kPatch = "kind = \"patch\"\nmesh = \"a.stl\"\ncompartment = \"medial\"";
INSTANTIATE_TEST_SUITE_P(
    Patches,
    BadScene,
    testing::Values(
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\nregion = { box = [[0, 0, 0], [1, 1, 1]], "
                "angles = [0, 90] }",
                "26: [[surface]] \"ball\": region.angles = [0, 90], expected a compartment beside "
                "it"},
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\noffset = -1\nregion = { box = [[0, 0, 0], "
                "[1, 1, 1]] }",
                "26: [[surface]] \"ball\": offset = -1, expected a thickness >= 0"},
        Mistake{kSphere,
                "kind = \"patch\"\nmesh = \"a.stl\"\nregion = { box = [[0, 0, 0], [1, 0, 1]] }",
                "26: [[surface]] \"ball\": region.box = [[0, 0, 0], [1, 0, 1]], expected two "
                "opposite corners "
                "[[x, y, z], [x, y, z]] of a box that encloses some volume"},
        Mistake{kSphere, kPatch + "\nfit = { control_points = [3, 12] }",
                "27: [[surface]] \"ball\": fit.control_points = 3, expected a whole number from 4 "
                "to 500"},
        Mistake{kSphere, kPatch + "\nfit = { smoothing = \"none\" }",
                "27: [[surface]] \"ball\": fit.smoothing = \"none\", expected \"auto\" or a "
                "smoothing length >= 0"},
        Mistake{kSphere, kPatch + "\nmesh_units = \"km\"",
                "27: [[surface]] \"ball\": mesh_units = \"km\", expected \"mm\", \"cm\" or \"m\"; "
                "did you mean \"mm\"?"},
        Mistake{kSphere, "kind = \"patch\"\nmesh = \"a.stl\"",
                "21: [[surface]] \"ball\": compartment is missing, expected \"medial\" or "
                "\"lateral\""}));

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

INSTANTIATE_TEST_SUITE_P(
    Ligaments,
    BadScene,
    testing::Values(
        Mistake{"slack_length = 30", "slack_length = -2",
                "44: [[ligament]] \"aACL\": slack_length = -2, "
                "expected a length (or reference_strain in its place) > 0"},
        Mistake{
            "stiffness = 1500", "stifness = 1500",
            "43: [[ligament]] \"aACL\": unknown key stifness = 1500, did you mean \"stiffness\"?"},
        Mistake{"law = \"toe-linear\"", "law = \"linear\"",
                "42: [[ligament]] \"aACL\": law = \"linear\", expected \"toe-linear\", "
                "\"quadratic\", \"polynomial\" or "
                "\"table\""},
        Mistake{"slack_length = 30", "slack_length = 30\ntransition_strain = 0",
                "45: [[ligament]] \"aACL\": transition_strain = 0, expected a strain > 0"},
        Mistake{"slack_length = 30", "slack_length = 30\nreference_strain = 0.02",
                "44: [[ligament]] \"aACL\": slack_length = 30, "
                "expected either slack_length or reference_strain, not both"},
        Mistake{"slack_length = 30", "reference_strain = -1",
                "44: [[ligament]] \"aACL\": reference_strain = -1, expected a strain > -1"},
        Mistake{"at = [0, -10, 0]", "at = [0, 20, 0]",
                "41: [[ligament]] \"aACL\": ends = [{ body = \"femur\", at = [0, 20, 0] }, { body "
                "= \"tibia\", "
                "at = [0, 20, 0] }], expected ends that lie apart at the start pose (their "
                "distance is 0)"},
        Mistake{"ends = [{ body = \"femur\"", "ends = [{ body = \"tibia\"",
                "41: [[ligament]] \"aACL\": ends = [{ body = \"tibia\", at = [0, 20, 0] }, { body "
                "= \"tibia\", "
                "at = [0, -10, 0] }], expected two ends on two different bodies"},
        Mistake{"{ body = \"tibia\", at = [0, -10, 0] }]",
                "{ body = \"tibia\", att = [0, -10, 0] }]",
                "41: [[ligament]] \"aACL\": unknown key ends[1].att = [0, -10, 0], did you mean "
                "\"at\"?"},
        Mistake{"law = \"toe-linear\"\nstiffness = 1500\nslack_length = 30",
                "law = \"table\"\nlengths = [1, 2, 2]\nforces = [0, 1, 2]",
                "43: [[ligament]] \"aACL\": lengths = [1, 2, 2], expected lengths that increase "
                "strictly"},
        Mistake{"law = \"toe-linear\"\nstiffness = 1500\nslack_length = 30",
                "law = \"table\"\nlengths = [1, 2]\nforces = [0]",
                "44: [[ligament]] \"aACL\": forces = [0], expected as many forces as lengths (2)"},
        Mistake{"law = \"toe-linear\"\nstiffness = 1500\nslack_length = 30",
                "law = \"polynomial\"\ncoefficients = [1, inf]",
                "43: [[ligament]] \"aACL\": coefficients = inf, expected numbers [c0, c1, c2, "
                "...], a finite number"}));

INSTANTIATE_TEST_SUITE_P(
    SuspiciousUnits,
    BadScene,
    testing::Values(
        // 30 m between the ends: the scene is in mm.
        Mistake{
            "length = \"mm\"", "length = \"m\"",
            "39: [[ligament]] \"aACL\": the ends lie 30000 mm apart at the start pose, expected "
            "between 0.5 and "
            "2000 mm; suspect the units: [units] length = \"m\", but the coordinates look like mm"},
        // 0.03 mm between the ends: the scene is in m.
        Mistake{"at = [0, 20, 0] }, { body = \"tibia\", at = [0, -10, 0] }]\nlaw = "
                "\"toe-linear\"\nstiffness = 1500\nslack_length = 30",
                "at = [0, 0.02, 0] }, { body = \"tibia\", at = [0, -0.01, 0] }]\nlaw = "
                "\"toe-linear\"\nstiffness = 1500\nslack_length = 0.03",
                "39: [[ligament]] \"aACL\": no ligament is longer than 0.03 mm at the start pose, "
                "expected between 0.5 "
                "and 2000 mm; suspect the units: [units] length = \"mm\", but the coordinates look "
                "like m"},
        Mistake{"slack_length = 30", "slack_length = 0.03",
                "44: [[ligament]] \"aACL\": slack_length = 0.03, expected a length like that at "
                "the start pose, 30 "
                "(suspect the units)"}));

INSTANTIATE_TEST_SUITE_P(
    Motion,
    BadScene,
    testing::Values(
        Mistake{"value = 0", "value = inf",
                "49: [[condition]] \"bend\": value = inf, expected an angle, a finite number"},
        Mistake{"kind = \"flexion\"", "kind = \"rotation\"\naxis = \"w\"",
                "49: [[condition]] \"bend\": axis = \"w\", expected \"x\", \"y\" or \"z\""},
        Mistake{"kind = \"flexion\"", "kind = \"translation\"",
                "46: [[condition]] \"bend\": axis is missing, expected a direction [x, y, z] in "
                "the ground frame"},
        Mistake{"kind = \"flexion\"", "kind = \"distance\"",
                "49: [[condition]] \"bend\": value = 0, expected a length > 0"},
        Mistake{"body = \"tibia\"\nkind = \"force\"", "body = \"femur\"\nkind = \"force\"",
                "53: [[load]] \"weight\": body = \"femur\", expected a moving body"},
        Mistake{"kind = \"force\"", "kind = \"moment\"\nat = [0, 0, 0]",
                "55: [[load]] \"weight\": at = [0, 0, 0], expected no point of application: a "
                "moment has none"},
        Mistake{"vector = [0, 100, 0]", "vector = [0, 100, 0]\nfollows = \"femur\"",
                "56: [[load]] \"weight\": follows = \"femur\", expected \"ground\" or \"body\""}));

INSTANTIATE_TEST_SUITE_P(
    Sweep,
    BadScene,
    testing::Values(
        Mistake{"vary = \"bend\"", "vary = \"bent\"",
                "58: [sweep]: vary = \"bent\", expected the name of a condition, or NAME.scale of "
                "a load: \"bend\" or "
                "\"weight.scale\"; did you mean \"bend\"?"},
        Mistake{"step = 5", "step = -5",
                "57: [sweep]: step = -5, expected a step > 0 to get from 0 to 120"},
        Mistake{"step = 5", "step = 0",
                "57: [sweep]: step = 0, expected a step > 0 to get from 0 to 120"},
        Mistake{"step = 5", "step = 1e-6",
                "57: [sweep]: step = 1e-06, expected at most 1000000 values from 0 to 120"},
        Mistake{"step = 5", "values = [1]",
                "59: [sweep]: from = 0, expected either values or from, to and step, not both"},
        Mistake{"from = 0\nto = 120\nstep = 5", "values = []",
                "59: [sweep]: values = [], expected values [v1, v2, ...]"},
        Mistake{"step = 5", "step = 5\npath = \"arc lenght\"",
                "62: [sweep]: path = \"arc lenght\", expected \"steps\" or \"arc length\"; did you "
                "mean \"arc length\"?"},
        Mistake{"step = 5", "setp = 5",
                "61: [sweep]: unknown key setp = 5, did you mean \"step\"?"}));

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

TEST(BadSceneFile, NamingAMeshThatDoesNotExistSaysWhereItLooked) {
  const std::filesystem::path file =
      test::scratch_folder("condyle_no_mesh").replace_extension("toml");
  std::ofstream(file) << small_scene_with("fixed = true", "fixed = true\nmesh = \"no.stl\"");
  const std::string mesh = (file.parent_path() / "no.stl").string();
  EXPECT_EQ(message_of_file(file),
            file.string() +
                ":10: [[body]] \"femur\": mesh = \"no.stl\", expected a mesh file "
                "(there is no file " +
                mesh + ")");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace condyle
