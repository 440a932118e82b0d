/// Wide tables of a robot's tests become the tidy table. The files are made here, in the form that Open
/// Knee(s) and KneeHub publish; no number in them was measured.

#include "condyle/exchange/laxity_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/run_program.h"
#include "calibration/small_calibration.h"
#include "condyle/calibration/measurement_table.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "exchange/jcs_files.h"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

class LaxityTables : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("EI1_kinematics_in_JCS_experiment.csv", kKinematics);
    write("EI1_TibiaKinetics_in_TibiaCS_experiment.csv", kKinetics);
    options_.sd_length = 0.5;
    options_.sd_angle = 1;
  }

  [[nodiscard]] std::vector<fs::path> both() const {
    return {folder_ / "EI1_kinematics_in_JCS_experiment.csv",
            folder_ / "EI1_TibiaKinetics_in_TibiaCS_experiment.csv"};
  }

  [[nodiscard]] std::string message() const {
    try {
      (void)laxity_table(both(), options_);
    } catch (const InputError& error) {
      std::string said = error.what();
      const std::string folder = folder_.string() + "/";
      for (std::size_t at = said.find(folder); at != std::string::npos; at = said.find(folder))
        said.erase(at, folder.size());
      return said;
    }
    return "no error";
  }

  /// As a scene reads it whose loads have these names.
  [[nodiscard]] MeasurementTable read_by_scene(const std::string& table) const {
    std::ofstream(folder_ / "knee.csv") << table;
    Scene scene = parse_scene(kCalibratedScene, folder_ / "knee.toml");
    scene.calibration->loads[1].name = "external";
    scene.calibration->relative.clear();
    return read_measurements(scene);
  }

  /// Of a passive path: what is driven, flexion and valgus.
  [[nodiscard]] LaxityTable passive_table(const std::string& rows) const {
    write("Passive_Flexion_Kinematics_in_JCS.csv",
          "Flexion Angle (deg),Knee JCS Flexion(deg),Knee JCS Valgus(deg)\n" + rows);
    return laxity_table({folder_ / "Passive_Flexion_Kinematics_in_JCS.csv"}, options_);
  }

  LaxityTableOptions options_;
};

// Posterior, medial, superior and valgus grow against our coordinates, internal rotation with them; the
// torque is external, so the foot turns out as it grows.
TEST_F(LaxityTables, MotionsAndLoadsAreReadInTheirOwnSenses) {
  const LaxityTable table = laxity_table(both(), options_);
  const MeasurementTable read = read_by_scene(table.text);
  ASSERT_EQ(read.rows.size(), 15u);
  const double expected[] = {-0.75, -9, -0.75, -3, 2.5};  // of the last row
  for (std::size_t i = 0; i < 5; ++i) {
    const Measurement& row = read.rows[10 + i];
    EXPECT_EQ(row.index, i + 1);
    EXPECT_NEAR(row.value, expected[i] * (i < 2 ? kDegree : 1), 1e-12) << i;
    EXPECT_NEAR(row.sd, i < 2 ? kDegree : 0.5, 1e-12);
    EXPECT_EQ(row.load, 1);
    EXPECT_EQ(row.level, 5000);
    EXPECT_NEAR(row.flexion, 30 * kDegree, 1e-12);
    EXPECT_EQ(row.test, "EI1");
  }
  ASSERT_EQ(table.notes.size(), 2u);
  EXPECT_EQ(table.notes[0],
            "EI1: loads beside external: lateral from 0 to 1 N, distraction from -20 to -20 N");
}

TEST_F(LaxityTables, ANameOfTwoLinesIsRefused) {
  options_.specimen = "two\nlines";
  EXPECT_NE(message().find("expected a name without control characters"), std::string::npos)
      << message();
}

TEST_F(LaxityTables, OffsetsAreAddedInTheSensesOfTheirChannels) {
  write("State.cfg", kState);
  options_.offsets = folder_ / "State.cfg";
  const MeasurementTable read = read_by_scene(laxity_table(both(), options_).text);
  EXPECT_NEAR(read.rows[0].flexion, 30.5 * kDegree + 0.1, 2e-6);  // six digits are written
  EXPECT_NEAR(read.rows[0].value, -0.25 * kDegree + 0.2, 1e-6);
  EXPECT_NEAR(read.rows[2].value, -0.5 - 1, 1e-12);
  EXPECT_NEAR(read.rows[3].value, -1 + 2, 1e-12);
  EXPECT_NEAR(read.rows[4].value, 2 - 30, 1e-12);
  write("kinematic_offsets.csv", ",Knee JCS Superior [mm],Knee JCS Flexion [deg]\n0,30,1\n");
  options_.offsets = folder_ / "kinematic_offsets.csv";
  const MeasurementTable same = read_by_scene(laxity_table(both(), options_).text);
  EXPECT_NEAR(same.rows[4].value, 2 - 30, 1e-12);
  EXPECT_NEAR(same.rows[0].flexion, 31.5 * kDegree, 1e-12);
}

TEST_F(LaxityTables, OffsetsThatCannotBeAreNamed) {
  const auto refusal = [&](const std::string& file, const std::string& text) -> std::string {
    write(file, text);
    options_.offsets = folder_ / file;
    try {
      (void)laxity_table(both(), options_);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal("twice.csv", "Knee JCS Medial [mm],Knee JCS Lateral [mm]\n5,7\n")
                .find("twice.csv:1: two columns of the motion of \"Knee JCS Lateral [mm]\""),
            std::string::npos);
  std::string counted = kState;
  const std::size_t at = counted.rfind("\"6 ");
  counted.replace(at, 2, "\"7");
  EXPECT_NE(refusal("State.cfg", counted).find("expected 6, their count, and six numbers"),
            std::string::npos);
}

TEST_F(LaxityTables, AStepThatIsHeldIsItsEndOrItsMean) {
  write("EI1_kinematics_in_JCS_experiment.csv",
        "Applied Load (N),Knee JCS Posterior [mm],Knee JCS Flexion [deg]\n"
        "0,0,30\n99,1,30\n101,3,30\n-50,-1,30\n");
  write("EI1_TibiaKinetics_in_TibiaCS_experiment.csv",
        "Applied Load (N),JCS Load Anterior Drawer [N]\n0,0\n99,99\n101,101\n-50,-50\n");
  options_.held = 5;
  const MeasurementTable ends = read_by_scene(laxity_table(both(), options_).text);
  ASSERT_EQ(ends.rows.size(), 3u);
  EXPECT_EQ(ends.rows[1].level, 101);
  EXPECT_EQ(ends.rows[1].value, -3);
  options_.mean = true;
  const MeasurementTable means = read_by_scene(laxity_table(both(), options_).text);
  EXPECT_EQ(means.rows[1].level, 100);
  EXPECT_EQ(means.rows[1].value, -2);
}

TEST_F(LaxityTables, APassivePathNeedsNoLoads) {
  write("Passive_Flexion_Kinematics_in_JCS.csv",
        "Flexion Angle (deg),Knee JCS Flexion(deg),Knee JCS Valgus(deg)\n0,0.5,1\n5,5.5,2\n");
  const LaxityTable table =
      laxity_table({folder_ / "Passive_Flexion_Kinematics_in_JCS.csv"}, options_);
  const MeasurementTable read = read_by_scene(table.text);
  ASSERT_EQ(read.rows.size(), 2u);
  options_.held = 10;  // of loads, which it has not
  EXPECT_EQ(laxity_table({folder_ / "Passive_Flexion_Kinematics_in_JCS.csv"}, options_).text,
            table.text);
  EXPECT_EQ(read.rows[1].load, -1);
  EXPECT_NEAR(read.rows[1].flexion, 5.5 * M_PI / 180, 1e-12);
}

/// Loaded and unloaded at one flexion: a table of measurements has each row once.
TEST_F(LaxityTables, StepsThatRepeatAFlexionAndALevelAreSkipped) {
  const LaxityTable table = passive_table("0,0.5,1\n5,5.5,2\n0,0.5,1.5\n");
  EXPECT_EQ(read_by_scene(table.text).rows.size(), 2u);
  EXPECT_NE(table.text.find(",-1.5,1,skip\n"), std::string::npos) << table.text;
  EXPECT_EQ(table.notes[0].substr(table.notes[0].find(':')),
            ": 1 steps repeat a flexion and a level: use = skip");
}

// As rounded numbers are written: -0 is the same level as 0 where the table is read.
TEST_F(LaxityTables, MinusZeroIsNoLevelOfItsOwn) {
  const LaxityTable table = passive_table("0,0,1\n5,5.5,2\n0,-0.000,1.5\n");
  EXPECT_EQ(read_by_scene(table.text).rows.size(), 2u);
  EXPECT_NE(table.text.find(",-1.5,1,skip\n"), std::string::npos) << table.text;
}

TEST_F(LaxityTables, WhatIsNotKnownIsNeverGuessed) {
  const std::string kinematics = "EI1_kinematics_in_JCS_experiment.csv";
  const std::string kinetics = "EI1_TibiaKinetics_in_TibiaCS_experiment.csv";
  write(kinematics, with(kKinematics, "Knee JCS Posterior [mm]", "Knee JCS Y [mm]"));
  EXPECT_EQ(message(), kinematics +
                           ":1: unknown column \"Knee JCS Y [mm]\", expected \"Knee JCS \" with "
                           "Medial, Posterior, Superior [mm], Flexion, Valgus, Internal Rotation "
                           "[deg] or their opposites, each once");
  write(kinematics, with(kKinematics, "Knee JCS Posterior [mm]", "Knee JCS Posterior [m]"));
  EXPECT_NE(message().find("unknown column \"Knee JCS Posterior [m]\""), std::string::npos);
  write(kinematics, with(kKinematics, "Applied Load (Nm)", "Time (ms)"));
  EXPECT_EQ(message(), kinematics +
                           ":1: unknown column \"Time (ms)\", expected \"Applied Load "
                           "(N)\", \"Applied Load (Nm)\" or \"Flexion Angle (deg)\"");
  write(kinematics, with(kKinematics, "0.75,-9", "x,-9"));
  EXPECT_EQ(message(), kinematics + ":4: Knee JCS Valgus [deg] = x, expected a finite number");
  write(kinematics, kKinematics);
  write(kinetics, with(kKinetics, "-20,0,0,5", "-20,0,0,4"));
  EXPECT_EQ(message(), kinetics + ": no column is the applied load of " + kinematics +
                           ", expected one of the same numbers");
  write(kinetics, with(kKinetics, "JCS Load Varus Torque [Nm]", "JCS Load My [Nm]"));
  EXPECT_NE(message().find("unknown column \"JCS Load My [Nm]\""), std::string::npos);
  fs::remove(folder_ / kinetics);
  EXPECT_EQ(message(),
            kinetics + ": no such file, expected kinematics or kinetics of a test (CSV)");
}

TEST_F(LaxityTables, AsAUserMakesThem) {
  const Outcome made =
      run("import EI1_kinematics_in_JCS_experiment.csv "
          "EI1_TibiaKinetics_in_TibiaCS_experiment.csv -o table.csv "
          "--sd-length 0.5 --sd-angle 1 --specimen k1");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(
      contents(folder_ / "table.csv").find("\"k1\",\"EI1\",30,external,5,adduction,-0.75,1,fit"),
      std::string::npos);
  expect_bad_input(run("import EI1_kinematics_in_JCS_experiment.csv -o t.csv --sd-length 1"),
                   "--sd-angle is missing or 0, expected a standard deviation > 0");
  expect_bad_input(
      run("import EI1_kinematics_in_JCS_experiment.csv -o t.csv --sd-length 1 --sd-angle 1"),
      "EI1_kinematics_in_JCS_experiment.csv: kinematics alone, expected EI1_kinetics... beside it, "
      "which says what load is applied in which sense");
  expect_bad_input(run("import EI1_kinematics_in_JCS_experiment.csv -o t.csv --side left"),
                   "--side: expected with a model (.osim) only");
  expect_bad_input(run("import a.osim -o knee.toml --held 0"),
                   "--held: expected with tables of tests (.csv) only");
  expect_bad_input(run("import a.csv b.osim -o t.csv"),
                   "a.csv: expected one model (.osim), or tables of tests (.csv) alone");
}

}  // namespace
}  // namespace condyle::test
