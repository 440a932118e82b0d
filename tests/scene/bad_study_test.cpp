#include <ostream>

#include "scene/mistake.h"
#include "scene/study_on_disk.h"

namespace condyle {
namespace {

struct StudyMistake {
  std::string from, to;  ///< what is changed in the small study
  std::string message;   ///< the whole message after "study.toml:"
  friend std::ostream& operator<<(std::ostream& stream, const StudyMistake& mistake) {
    return stream << mistake.to;
  }
};

class BadStudyTest : public test::StudyOnDisk, public testing::WithParamInterface<StudyMistake> {};

TEST_P(BadStudyTest, IsNamed) {
  const StudyMistake& mistake = GetParam();
  EXPECT_EQ(message_of(mistake.from, mistake.to), "study.toml:" + mistake.message);
}

const char* const kDesigns =
    "\"monte-carlo\", \"latin-hypercube\", \"sobol\", \"saltelli\" or \"grid\", or the path of a "
    "table (CSV)";

INSTANTIATE_TEST_SUITE_P(
    Keys,
    BadStudyTest,
    testing::Values(
        StudyMistake{"seed = 7", "sead = 7", "5: unknown key sead = 7, did you mean \"seed\"?"},
        StudyMistake{"samples = 1024", "sample = 1024",
                     "4: unknown key sample = 1024, did you mean \"samples\"?"},
        StudyMistake{"samples = 1024", "", "1: samples is missing, expected a whole number >= 1"},
        StudyMistake{"samples = 1024", "samples = 0",
                     "4: samples = 0, expected a whole number >= 1"},
        StudyMistake{"samples = 1024", "samples = 10.5",
                     "4: samples = 10.5, expected a whole number >= 1"},
        StudyMistake{"samples = 1024", "samples = 1e17",
                     "4: samples = 1e+17, expected a whole number >= 1 and <= 2^53"},
        StudyMistake{"seed = 7", "seed = -1", "5: seed = -1, expected a whole number >= 0"},
        StudyMistake{"samples = 1024", "samples = 1024\nlevels = 3",
                     "5: levels = 3, expected design = \"grid\" beside it"},
        StudyMistake{"samples = 1024", "samples = 1024\ntable = \"values\"",
                     "5: table = \"values\", expected the path of a table as design beside it"},
        StudyMistake{"design = \"sobol\"", "design = \"grid\"",
                     "4: samples = 1024, expected levels in its place: a grid has levels^d points"},
        StudyMistake{"design = \"sobol\"\nsamples = 1024", "design = \"grid\"\nlevels = 1",
                     "4: levels = 1, expected a whole number from 2 to 1000000"},
        StudyMistake{"design = \"sobol\"", "design = \"sobel\"",
                     "3: design = \"sobel\", expected " + std::string(kDesigns) +
                         "; did you mean \"sobol\"?"},
        StudyMistake{"design = \"sobol\"", "design = \"none.csv\"",
                     "3: design = \"none.csv\", expected " + std::string(kDesigns) +
                         " (there is no file none.csv)"},
        StudyMistake{"design = \"sobol\"", "design = \"/dev/zero\"",
                     "3: design = \"/dev/zero\", expected " + std::string(kDesigns) +
                         " (no table is /dev/zero)"},
        StudyMistake{"seed = 7", "precision = \"float16\"",
                     "5: precision = \"float16\", expected \"float64\" or \"float32\"; did you "
                     "mean \"float64\"?"},
        StudyMistake{"\"aACL.force\"]", "\"joint\"]",
                     "6: outputs = \"joint\", expected each word once"},
        StudyMistake{"[\"joint\", \"aACL.force\"]", "\"joint\"",
                     "6: outputs = \"joint\", expected words [\"joint\", \"contact.force\", "
                     "\"aACL.force\", ...]"}));

INSTANTIATE_TEST_SUITE_P(
    Specimens,
    BadStudyTest,
    testing::Values(
        StudyMistake{"[\"knee.toml\"]", "[]",
                     "2: specimens = [], expected the path of a scene, a list of them, or a folder "
                     "of scenes"},
        StudyMistake{"[\"knee.toml\"]", "\"none.toml\"",
                     "2: specimens = \"none.toml\", expected the path of a scene or of a folder of "
                     "scenes (there is no none.toml)"},
        StudyMistake{"[\"knee.toml\"]", "\"knees\"",
                     "2: specimens = \"knees\", expected a folder of scenes (there is no *.toml "
                     "with bodies in knees)"},
        StudyMistake{"[\"knee.toml\"]", "[\"knee.toml\", \"./knee.toml\"]",
                     "2: specimens = \"./knee.toml\", expected each scene once: ./knee.toml"}));

INSTANTIATE_TEST_SUITE_P(
    Varied,
    BadStudyTest,
    testing::Values(
        StudyMistake{"what = \"stiffness\"", "what = \"stifness\"",
                     "9: [[vary]] number 1: what = \"stifness\", expected \"reference_strain\", "
                     "\"slack_length\", \"stiffness\", \"transition_strain\", "
                     "\"insertion.femur\", \"insertion.tibia\", \"load\" or \"roughness\"; did you "
                     "mean \"stiffness\"?"},
        StudyMistake{"of = \"*\"", "of = \"PCL*\"",
                     "10: [[vary]] number 1: of = \"PCL*\", expected the beginning of a name of a "
                     "ligament whose law is toe-linear or quadratic"},
        StudyMistake{"sd = 0.1", "prior_sd = 0.1",
                     "8: [[vary]] number 1: sd is missing, expected a standard deviation (or range "
                     "in its place) > 0"},
        StudyMistake{"sd = 0.1", "sd = 0",
                     "11: [[vary]] number 1: sd = 0, expected a standard deviation (or range in "
                     "its place) > 0"},
        StudyMistake{"sd = 0.1", "sd = 0.1\nnormal_sd = 1",
                     "12: [[vary]] number 1: normal_sd = 1, expected what = \"insertion.BODY\" "
                     "beside it"},
        StudyMistake{"sd = 0.1", "sd = 0.1\nbounds = [1.1, 2]",
                     "12: [[vary]] number 1: bounds = [1.1, 2], expected bounds of a factor on the "
                     "scene's value, about 1"},
        StudyMistake{"sd = 0.1", "range = [0, 2]",
                     "11: [[vary]] number 1: range = [0, 2], expected factors on the scene's "
                     "value, > 0"},
        StudyMistake{"range = [-1, 1]", "range = [1, 1]",
                     "16: [[vary]] number 2: range = [1, 1], expected two numbers [lower, upper], "
                     "the lower one first"},
        StudyMistake{"range = [-1, 1]", "range = [-30, 1]",
                     "16: [[vary]] number 2: range = [-30, 1], expected changes to numbers > 0: "
                     "the scene's own is 30 of \"aACL\""},
        StudyMistake{"range = [-1, 1]", "range = [-1, 1]\nsd = 1",
                     "16: [[vary]] number 2: range = [-1, 1], expected either range, or sd with "
                     "bounds"},
        StudyMistake{"what = \"stiffness\"", "what = \"slack_length\"",
                     "15: [[vary]] number 2: of = \"aACL\", expected numbers that are free once: "
                     "that of \"aACL\" is since line 10"}));

class StudyOfSeveralTest : public test::StudyOnDisk {
 protected:
  [[nodiscard]] std::string message_with(const std::string& other) const {
    write("other.toml", other);
    return message_of("\"knee.toml\"", "\"knee.toml\", \"other.toml\"");
  }
};

TEST_F(StudyOfSeveralTest, ExpectsNumbersInEach) {
  EXPECT_EQ(message_with(with(kSmallScene, "name = \"aACL\"", "name = \"aPCL\"")),
            "study.toml:15: [[vary]] number 2: of = \"aACL\", expected the name of a ligament: "
            "\"aPCL\"; did you mean \"aPCL\"?, in other.toml");
  const std::string more =
      "[[ligament]]\nname = \"aPCL\"\nends = [{ body = \"femur\", at = [0, 20, 0] }, "
      "{ body = \"tibia\", at = [0, -10, 0] }]\nlaw = \"toe-linear\"\nstiffness = 900\n"
      "slack_length = 30\n\n[[condition]]";
  EXPECT_EQ(message_with(with(kSmallScene, "[[condition]]", more)),
            "study.toml:2: specimens = [\"knee.toml\", \"other.toml\"], expected scenes in which "
            "the same vary: number 1 that varies is of others in other.toml than in knee.toml");
}

TEST_F(StudyOfSeveralTest, ExpectsTheSameSweep) {
  const std::string start =
      "study.toml:2: specimens = \"other.toml\", expected scenes with a [sweep] in steps over the "
      "same values: other.toml ";
  EXPECT_EQ(message_with(with(kSmallScene, "step = 5", "step = 10")),
            start + "has a [sweep] that visits other poses than that of knee.toml");
  EXPECT_EQ(message_with(with(kSmallScene, "kind = \"flexion\"", "kind = \"internal_rotation\"")),
            start + "has a [sweep] that visits other poses than that of knee.toml");
  EXPECT_EQ(message_with(with(kSmallScene, "step = 5", "step = 5\npath = \"arc length\"")),
            start + "has a [sweep] with path = \"arc length\"");
  EXPECT_EQ(message_with(kSmallScene.substr(0, kSmallScene.find("[sweep]"))),
            start + "has no [sweep]");
}

// In a scene in cm a range of a length is ten times as wide.
TEST_F(StudyOfSeveralTest, ExpectsOneUnitOfLengthForARange) {
  const std::string cm = with(kSmallScene, "length = \"mm\"", "length = \"cm\"");
  EXPECT_EQ(
      message_with(cm),
      "study.toml:16: [[vary]] number 2: range = [-1, 1], expected one that is the same in all "
      "scenes, which have one unit of length: -1 to 1 mm in knee.toml are -10 to 10 mm in "
      "other.toml");
}

TEST_F(StudyOfSeveralTest, ExpectsNamesOfTheirOwn) {
  write("knees/knee.toml", kSmallScene);
  EXPECT_EQ(message_of("\"knee.toml\"", "\"knee.toml\", \"knees/knee.toml\""),
            "study.toml:2: specimens = \"knees/knee.toml\", expected scenes whose files have "
            "different names: knee.toml and knees/knee.toml");
}

using StudyFileTest = test::StudyOnDisk;

TEST_F(StudyFileTest, NeedsSomethingThatVaries) {
  const std::string none = test::kSmallStudy.substr(0, test::kSmallStudy.find("\n[[vary]]"));
  EXPECT_EQ(message_of(none), "study.toml:1: [[vary]] is missing, expected one or more");
  write("points.csv", "x\n0\n");
  EXPECT_EQ(message_of(with(none, "\"sobol\"", "\"points.csv\"")),
            "study.toml:1: [[vary]] is missing, expected one or more, or a first scene with "
            "[calibrate] whose numbers the table holds");
}

// What follows the head of a table belongs to it.
TEST_F(StudyFileTest, KeysOfTheFileBelowATableAreNamed) {
  const std::string above = with(test::kSmallStudy, "design = \"sobol\"\n", "");
  EXPECT_NE(message_of(above + "design = \"sobol\"\n")
                .find("design = \"sobol\" belongs to the table above it, expected before the first "
                      "table of the file"),
            std::string::npos)
      << message_of(above + "design = \"sobol\"\n");
}

TEST_F(StudyFileTest, GridThatNoOneCanCountIsRefused) {
  std::string study = with(test::kSmallStudy, "design = \"sobol\"", "design = \"grid\"");
  study = with(study, "samples = 1024", "levels = 1000000");
  const std::string insertions = "[[vary]]\nwhat = \"insertion.tibia\"\nof = \"*\"\nsd = 1\n";
  EXPECT_EQ(message_of(study), "no error");
  EXPECT_EQ(message_of(study + insertions),
            "study.toml:4: levels = 1000000, expected a grid of at most 2^53 points: 1000000^5 = "
            "1e+30 are more");
}

TEST_F(StudyFileTest, SceneIsNoStudy) {
  EXPECT_EQ(message_of(kSmallScene),
            "study.toml:1: is a scene, expected a study, which names scenes as its specimens");
  EXPECT_THROW((void)read_study(folder_ / "none.toml"), InputError);
}

TEST_F(StudyFileTest, StudyIsNoScene) {
  EXPECT_EQ(test::message_of(test::kSmallStudy),
            "some/knee.toml:1: is a study, expected a scene; condyle study sweeps the scenes that "
            "it names");
}

}  // namespace
}  // namespace condyle
