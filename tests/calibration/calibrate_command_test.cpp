/// The program fits a knee to a table that was made from a knee of known numbers.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/run_program.h"
#include "condyle/calibration/calibration.h"
#include "condyle/calibration/predictions.h"
#include "condyle/results/calibration_journal.h"
#include "condyle/results/line_file.h"
#include "condyle/results/run_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCalibrate = R"(
[calibrate]
measurements = "measured.csv"
starts = 2
samples = 20
[[calibrate.load]]
name = "anterior"
load = "drawer"
[[calibrate.parameter]]
of = ["aACL", "aPCL", "LCL"]
what = "reference_strain"
prior_sd = 0.03
)";

constexpr double kTruth[] = {0.02, -0.015, 0.01};

class CalibrateCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("knee.toml",
          contents(fs::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/drawer.toml") + kCalibrate);
    write("measured.csv", table(std::vector<double>(30, 0)));
    write("measured.csv", table(answers_of_the_truth()));
  }

  /// Two coordinates at three angles and five levels, those at 30 deg unseen.
  static std::string table(const std::vector<double>& values) {
    std::string csv = "test,flexion,load,level,coordinate,value,sd,use\n";
    std::size_t k = 0;
    for (const int flexion : {15, 30, 60})
      for (const int level : {-100, -50, 50, 100, 75})
        for (const char* coordinate : {"anterior_drawer", "internal_rotation"})
          csv += fmt::format("ap{},{},anterior,{},{},{},0.5,{}\n", flexion, flexion, level,
                             coordinate, values[k++], flexion == 30 ? "test" : "fit");
    return csv;
  }

  [[nodiscard]] std::vector<double> answers_of_the_truth() const {
    const Scene scene = read_scene(folder_ / "knee.toml");
    const MeasurementTable rows = read_measurements(scene);
    const std::vector<FreeParameter> parameters = free_parameters(scene, {}, rows);
    Predictions predictions(scene, fit_surfaces(scene), rows, parameters);
    Eigen::VectorXd y;
    EXPECT_TRUE(predictions.evaluate(Eigen::Map<const Eigen::VectorXd>(kTruth, 3), y, nullptr));
    std::vector<double> told;
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
      told.push_back(y[static_cast<Eigen::Index>(i)] / unit_of(rows.rows[i], scene).factor);
    return told;
  }

  [[nodiscard]] bool there(const std::string& name) const { return fs::exists(folder_ / name); }
};

TEST_F(CalibrateCommand, FitsTellsAndWritesAllThatIsAskedFor) {
  const Outcome outcome = run(
      "calibrate knee.toml -o fit.h5 --scene fitted.toml --table t.csv --latex t.tex --posterior "
      "p.csv --suggest");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("of 3 directions are determined"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("wrote fitted.toml"), std::string::npos);
  std::vector<std::string> names = results();
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"fit.h5", "fitted.toml", "measured.csv", "p.csv",
                                             "t.csv", "t.tex"}));  // and no journal
  const condyle::Run fit = read_run(folder_ / "fit.h5");
  ASSERT_NE(fit.calibration(), nullptr);
  const CalibrationResult& result = *fit.calibration();
  EXPECT_TRUE(result.fit.converged);
  EXPECT_EQ(result.samples.rows(), 20);
  EXPECT_FALSE(result.suggested.empty());
  // No noise, and a prior about 0: the fit lies between it and the truth.
  EXPECT_LT(result.fitted.after, 0.2 * result.fitted.before);
  EXPECT_LT(result.unseen.after, 0.5 * result.unseen.before);
  // The fitted scene answers as the fit does: nothing is left to gain where the prior is at its numbers.
  EXPECT_EQ(run("check fitted.toml").code, 0);
  const Scene fitted = read_scene(folder_ / "fitted.toml");
  const Scene expected =
      scene_with(fit.scene, result.parameters, {result.fit.theta.begin(), result.fit.theta.end()});
  for (std::size_t i = 0; i < fitted.ligaments.size(); ++i) {
    const double length = slack_length(expected.ligaments[i].law);
    EXPECT_NEAR(slack_length(fitted.ligaments[i].law), length, 1e-14 * length);
  }
}

TEST_F(CalibrateCommand, SaysItAllAsJson) {
  const Outcome outcome = run("calibrate knee.toml -o fit.h5 --json --samples 0");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part : {"\"command\": \"calibrate\"", "\"name\": \"aACL.reference_strain\"",
                           "\"agreements\"", "\"counts\"", "\"reduced_chi_square\""})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  EXPECT_NE(outcome.out.find("\"sample_sd\": null"), std::string::npos) << "there are no samples";
}

TEST_F(CalibrateCommand, AnInterruptKeepsTheBestSoFarAndResumeGoesOn) {
  const Outcome stopped = run("calibrate knee.toml -o fit.h5 --samples 1000000 --quiet",
                              "timeout --foreground --preserve-status -s INT 3 ");
  EXPECT_EQ(stopped.code, 2);
  EXPECT_EQ(stopped.err,
            "condyle: stopped: fit.h5 holds the best so far, --resume goes on from it\n");
  ASSERT_TRUE(there("fit.h5.journal"));
  const condyle::Run half = read_run(folder_ / "fit.h5");
  ASSERT_NE(half.calibration(), nullptr);
  EXPECT_TRUE(half.calibration()->stopped);

  const Outcome resumed = run("calibrate knee.toml -o fit.h5 --samples 5 --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("going on from the best numbers of"), std::string::npos);
  EXPECT_FALSE(there("fit.h5.journal"));
  EXPECT_FALSE(read_run(folder_ / "fit.h5").calibration()->stopped);
}

TEST_F(CalibrateCommand, ResumesWithTheSameSceneAndTableOnly) {
  const std::string scene = contents(folder_ / "knee.toml");
  (void)run("calibrate knee.toml -o fit.h5 --samples 1000000 --quiet",
            "timeout --foreground --preserve-status -s INT 3 ");
  const std::string resume = "calibrate knee.toml -o fit.h5 --resume --quiet";
  write("knee.toml", scene + "# another\n");
  expect_bad_input(
      run(resume),
      "fit.h5.journal: belongs to another text of the scene, expected that of knee.toml");
  write("knee.toml", scene);
  write("measured.csv", contents(folder_ / "measured.csv") + "# another\n");
  expect_bad_input(run(resume),
                   "fit.h5.journal: belongs to another table, expected that of measured.csv");
}

TEST_F(CalibrateCommand, RefusesBadInputInOneLineAndWritesNothing) {
  const std::vector<std::string> before = results();
  expect_bad_input(run("calibrate knee.toml -o measured.csv"),
                   "measured.csv: expected a name that ends in .h5");
  expect_bad_input(run("calibrate knee.toml -o fit.h5 --scene knee.toml"),
                   "knee.toml: is read by this command, expected another file to write");
  expect_bad_input(run("calibrate knee.toml -o fit.h5 --table ./fit.h5"),
                   "./fit.h5: is to be written twice, expected a file for each");
  expect_bad_input(run("calibrate knee.toml -o fit.h5 --scene other.h5"),
                   "other.h5: expected a name that ends in .toml");
  expect_bad_input(run("calibrate knee.toml -o fit.h5 --posterior FEMUR.STL"),
                   "FEMUR.STL: expected a name that ends in .csv");
  write("fit.h5.journal", "my diary\n");
  expect_bad_input(run("calibrate knee.toml -o fit.h5"),
                   "fit.h5.journal: is no journal of a calibration, expected this name to be free "
                   "for one");
  fs::remove(folder_ / "fit.h5.journal");
  expect_bad_input(run("calibrate knee.toml -o fit.h5 --posterior p.csv --samples 0"),
                   "--posterior p.csv: there are no samples to write, expected samples > 0 in "
                   "[calibrate] or by --samples");
  write("plain.toml", kScene);
  expect_bad_input(run("calibrate plain.toml -o fit.h5"),
                   "plain.toml: [calibrate] is missing, expected the table of measurements");
  fs::remove(folder_ / "plain.toml");
  write("measured.csv",
        "test,flexion,load,level,coordinate,value,sd,use\nap,15,pull,1,adduction,1,1,fit\n");
  const Outcome outcome = run("calibrate knee.toml -o fit.h5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_NE(outcome.err.find("measured.csv:2: load = "), std::string::npos) << outcome.err;
  EXPECT_EQ(results(), before);
}

TEST_F(CalibrateCommand, OthersSayThatACalibrationHoldsNoPoses) {
  ASSERT_EQ(run("calibrate knee.toml -o fit.h5 --samples 0 --quiet").code, 0);
  expect_bad_input(run("export fit.h5 -o knee.glb"),
                   "fit.h5: holds no poses (a calibration stores none), expected the result of "
                   "condyle sweep or simulate");
  const Outcome verified = run("verify fit.h5");
  EXPECT_EQ(verified.code, 1);
  EXPECT_NE(verified.err.find("holds no poses (a calibration stores none)"), std::string::npos);
  expect_bad_input(run("sweep knee.toml -o fit.h5 --resume --quiet"),
                   "fit.h5: is no sweep, expected the result of condyle sweep");
}

// A ball on a plane, and nothing that holds it there: its rows have no derivatives.
TEST_F(CalibrateCommand, APoseThatIsNeutralIsNamedBeforeTheWork) {
  std::string text = with(kSmallScene, "slack_length = 30", "slack_length = 60");
  text = text.substr(0, text.find("[[load]]"));
  write("neutral.toml", text +
                            "[calibrate]\nmeasurements = \"neutral.csv\"\n[[calibrate.parameter]]\n"
                            "of = \"*\"\nwhat = \"stiffness\"\nprior_sd = 0.3\n");
  write("neutral.csv",
        "test,flexion,load,level,coordinate,value,sd,use\na,0,none,0,anterior_drawer,1,0.2,fit\n");
  const Outcome outcome = run("calibrate neutral.toml -o fit.h5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("neutral.csv:2"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("no derivatives"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(at("fit.h5")));
  EXPECT_FALSE(fs::exists(at("fit.h5.journal")));
}

// One that went on may begin with worse numbers than those that it took over.
TEST_F(CalibrateCommand, AJournalGivesTheNumbersOfTheLeastCost) {
  const Scene scene = read_scene(folder_ / "knee.toml");
  const CalibrationIdentity identity = calibration_identity(scene, fit_surfaces(scene));
  const fs::path path = folder_ / "some.journal";
  LineFile file(path);
  CalibrationJournal journal(file, identity, 0);
  journal.append(Eigen::Vector2d(1, 2), 3);
  journal.append(Eigen::Vector2d(0.1, 0.25), 2);
  journal.append(Eigen::Vector2d(7, 8), 2.5);
  const CalibrationContents read = read_calibration_journal(path, identity, scene);
  ASSERT_TRUE(read.best);
  EXPECT_EQ(*read.best, Eigen::VectorXd(Eigen::Vector2d(0.1, 0.25)));
  EXPECT_EQ(read.whole_bytes, fs::file_size(path));
}

}  // namespace
}  // namespace condyle::test
