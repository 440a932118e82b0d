#include "condyle/scene_file/read_study.h"

#include "scene/study_on_disk.h"

namespace condyle {
namespace {

using test::kSmallStudy;

class ReadStudyTest : public test::StudyOnDisk {};

TEST_F(ReadStudyTest, ReadsWhatIsThere) {
  const ReadStudy read = this->read(kSmallStudy);
  const StudyDescription& study = read.study;
  EXPECT_EQ(study.title, "a small study");
  EXPECT_EQ(study.text, kSmallStudy);
  EXPECT_EQ(study.file, folder_ / "study.toml");
  EXPECT_EQ(study.specimens, std::vector{folder_ / "knee.toml"});
  EXPECT_EQ(study.design, DesignKind::kSobol);
  EXPECT_EQ(study.samples, 1024);
  EXPECT_EQ(study.seed, 7u);
  EXPECT_EQ(study.outputs, (std::vector<std::string>{"joint", "aACL.force"}));
  EXPECT_EQ(study.outputs_line, 6);
  EXPECT_FALSE(study.single_precision);
  EXPECT_FALSE(study.roughness);
  ASSERT_EQ(read.scenes.size(), 1u);
  EXPECT_EQ(read.scenes[0].title, "ball and socket");
  ASSERT_EQ(read.varied.size(), 1u);
  ASSERT_EQ(read.varied[0].size(), 2u);
  EXPECT_EQ(read.varied[0][0].number.what, ParameterKind::kStiffness);
  EXPECT_EQ(read.varied[0][0].number.prior_sd, 0.1);
  EXPECT_FALSE(read.varied[0][0].range);
  EXPECT_EQ(read.varied[0][1].range, (std::array<double, 2>{-1, 1}));
}

TEST_F(ReadStudyTest, LengthsAreInUnitsOfEachScene) {
  std::string other = with(kSmallScene, "length = \"mm\"", "length = \"cm\"");
  other = with(other, "slack_length = 30", "slack_length = 3");
  write("other.toml", other);
  const ReadStudy read =
      this->read(with(with(kSmallStudy, "\"knee.toml\"", "\"knee.toml\", \"other.toml\""),
                      "range = [-1, 1]", "sd = 1"));
  EXPECT_EQ(read.varied.at(0).at(1).number.prior_sd, 1);
  EXPECT_EQ(read.varied.at(1).at(1).number.prior_sd, 10);
  EXPECT_EQ(read.varied.at(1).at(0).number.prior_sd, 0.1) << "of ln k, in no unit";
}

TEST_F(ReadStudyTest, FolderMeansItsScenesByName) {
  write("knees/b.toml", kSmallScene);
  write("knees/a.toml", kSmallScene);
  write("knees/other.toml", "title = \"no scene\"\n");
  write("knees/notes.txt", "no scene either");
  const ReadStudy read =
      this->read(with(kSmallStudy, "specimens = [\"knee.toml\"]", "specimens = \"knees\""));
  EXPECT_EQ(read.study.specimens,
            (std::vector{folder_ / "knees/a.toml", folder_ / "knees/b.toml"}));
  EXPECT_EQ(read.scenes.size(), 2u);
  EXPECT_EQ(read.varied.size(), 2u);
}

TEST_F(ReadStudyTest, IndicesAreThoseOfEachScene) {
  const std::string pcl =
      "[[ligament]]\nname = \"aPCL\"\nends = [{ body = \"femur\", at = [0, 20, 0] }, "
      "{ body = \"tibia\", at = [0, -10, 0] }]\nlaw = \"toe-linear\"\nstiffness = 900\n"
      "slack_length = 30\n\n[[ligament]]\nname = \"aACL\"";
  write("other.toml", with(kSmallScene, "[[ligament]]\nname = \"aACL\"", pcl));
  std::string study = with(kSmallStudy, "\"knee.toml\"", "\"knee.toml\", \"other.toml\"");
  study = with(study, "of = \"*\"", "of = \"aACL\"");
  const ReadStudy read = this->read(study);
  EXPECT_EQ(read.varied.at(0).at(0).number.of, std::vector{0});
  EXPECT_EQ(read.varied.at(1).at(0).number.of, std::vector{1});
}

TEST_F(ReadStudyTest, GridHasLevelsInPlaceOfSamples) {
  std::string study = with(kSmallStudy, "design = \"sobol\"", "design = \"grid\"");
  study = with(study, "samples = 1024", "levels = 5");
  EXPECT_EQ(this->read(study).study.levels, 5);
  EXPECT_EQ(this->read(study).study.design, DesignKind::kGrid);
}

TEST_F(ReadStudyTest, TableNeedsNoSpread) {
  write("points.csv", "aACL.stiffness,aACL.slack_length\n0,0\n");
  std::string study = with(kSmallStudy, "design = \"sobol\"", "design = \"points.csv\"");
  study = with(study, "samples = 1024", "table = \"values\"");
  study = with(study, "sd = 0.1\n", "");
  const ReadStudy read = this->read(study);
  EXPECT_EQ(read.study.design, DesignKind::kTable);
  EXPECT_EQ(read.study.table, folder_ / "points.csv");
  EXPECT_TRUE(read.study.table_holds_values);
  EXPECT_EQ(read.study.samples, 0) << "all its rows";
}

TEST_F(ReadStudyTest, TableOfAPosteriorVariesWhatTheSceneFits) {
  const std::string calibrate =
      "\n[calibrate]\nmeasurements = \"none.csv\"\n[[calibrate.parameter]]\nof = \"*\"\n"
      "what = \"stiffness\"\nprior_sd = 0.2\n";
  write("knee.toml", kSmallScene + calibrate);
  write("other.toml", kSmallScene);
  write("posterior.csv", "aACL.stiffness\n0.1\n");
  const ReadStudy read = this->read(
      "specimens = [\"knee.toml\", \"other.toml\"]\ndesign = \"posterior.csv\"\n"
      "precision = \"float32\"\n");
  EXPECT_EQ(read.study.title, "study");
  EXPECT_TRUE(read.study.single_precision);
  ASSERT_EQ(read.varied.size(), 2u);
  for (const std::vector<VariedNumber>& numbers : read.varied) {
    ASSERT_EQ(numbers.size(), 1u);
    EXPECT_EQ(numbers[0].number.what, ParameterKind::kStiffness);
    EXPECT_EQ(numbers[0].number.prior_sd, 0.2);
  }
}

TEST_F(ReadStudyTest, RoughnessIsInTheFirstScenesUnit) {
  const std::string study =
      kSmallStudy + "[[vary]]\nwhat = \"roughness\"\nrms = 0.02\ncorrelation = 0.15\n";
  EXPECT_EQ(message_of(study),
            "study.toml:18: [[vary]] number 3: what = \"roughness\", expected scenes with surfaces "
            "that are fitted to a mesh: knee.toml has none");
  std::string scene = with(kSmallScene, "length = \"mm\"", "length = \"cm\"");
  scene = with(scene, "kind = \"sphere\"\ncenter = [0, 20, 0]\nradius = 20",
               "kind = \"patch\"\nmesh = \"ball.stl\"\nregion = { box = [[0, 0, 0], [1, 1, 1]] }");
  scene = with(scene, "slack_length = 30", "slack_length = 3");
  write("ball.stl", "");
  write("knee.toml", scene);
  const ReadStudy read = this->read(study);
  ASSERT_TRUE(read.study.roughness);
  EXPECT_DOUBLE_EQ(read.study.roughness->rms, 0.2);
  EXPECT_DOUBLE_EQ(read.study.roughness->correlation, 1.5);
  EXPECT_EQ(read.varied.at(0).size(), 2u);
}

}  // namespace
}  // namespace condyle
