/// What a study keeps, and how its numbers come from points.

#include "condyle/study/study_plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "condyle/calibration/csv_file.h"
#include "condyle/calibration/csv_text.h"
#include "condyle/elements/force_law.h"
#include "condyle/elements/law_rates.h"
#include "condyle/input_error.h"
#include "study/small_study.h"
#include "support/scratch_folder.h"

namespace condyle::test {
namespace {

const Scene& wismans() {
  static const Scene scene = small_study("wismans-type/knee.toml", 1).scenes[0];
  return scene;
}

std::vector<std::string> names_of(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const StudyOutput& output : study_outputs(wismans(), words, "study.toml"))
    names.push_back(output.name);
  return names;
}

std::string refusal(const std::vector<std::string>& words) {
  try {
    (void)study_outputs(wismans(), words, "study.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(StudyOutputs, WithoutWordsAreCoordinatesAndForces) {
  const std::vector<std::string> names = names_of({});
  ASSERT_EQ(names.size(), 5 + 2 + wismans().ligaments.size());
  EXPECT_EQ(names[0], "adduction");  // flexion is swept
  EXPECT_EQ(names[5], "medial.force");
  EXPECT_EQ(names[7], "aACL.force");
}

TEST(StudyOutputs, AreWithoutWhatAConditionPrescribesThoughItIsNotSwept) {
  Scene scene = wismans();
  scene.sweep->varies_load = true;  // flexion stays as its condition says
  const std::vector<StudyOutput> joint = study_outputs(scene, {"joint"}, "study.toml");
  ASSERT_EQ(joint.size(), 5U);
  EXPECT_EQ(joint[0].name, "adduction");
}

TEST(StudyOutputs, StandOnceInTheOrderAskedFor) {
  const std::vector<std::string> expected = {
      "aACL.strain", "flexion",           "medial.point.x", "medial.point.y",  "medial.point.z",
      "adduction",   "internal_rotation", "lateral_shift",  "anterior_drawer", "distraction"};
  EXPECT_EQ(names_of({"aACL.strain", "joint.flexion", "medial.point", "joint", "aACL.strain"}),
            expected);
}

TEST(StudyOutputs, AnUnknownWordIsNamed) {
  for (const char* word : {"aACK.force", "aACL.length2", "joint.drawer", "contact",
                           "contacts.force", "medial.strain", ""}) {
    SCOPED_TRACE(word);
    const std::string message = refusal({"joint", word});
    EXPECT_EQ(message.find("study.toml: outputs: \"" + std::string(word) + "\", expected"), 0u)
        << message;
    EXPECT_NE(message.find("aACL"), std::string::npos);
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

// "contact.force" is that of all contacts; what is called so has to have another name where it has a force as well.
TEST(StudyOutputs, AWordThatIsAlsoANameIsRefusedWhereItMayMeanBoth) {
  Scene scene = wismans();
  scene.ligaments[0].name = "contact";
  scene.ligaments[1].name = "joint";
  scene.contacts[0].name = "ligament";
  const auto refused = [&scene](const std::string& word) {
    try {
      (void)study_outputs(scene, {word}, "study.toml:6");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string where = " in " + scene.file.string();
  EXPECT_EQ(refused("contact.force"),
            "study.toml:6: outputs: \"contact.force\" is that of all contacts and of a ligament of "
            "that name" +
                where + ", expected another name of the ligament");
  EXPECT_EQ(refused("ligament.force"),
            "study.toml:6: outputs: \"ligament.force\" is that of all ligaments and of a contact "
            "of that name" +
                where + ", expected another name of the contact");
  for (const char* word : {"joint", "joint.flexion", "contact.point", "ligament.strain"})
    EXPECT_EQ(refused(word), "") << word;
  EXPECT_NO_THROW((void)study_outputs(scene, {}, "study.toml"));
}

TEST(StudyPlan, ARangeIsUniformAndOfAFactorItsLogarithm) {
  ReadStudy study = small_study("wismans-type/knee.toml", 3, true);
  study.varied[0][0].range = {-0.01, 0.03};
  study.varied[0][1].range = {0.5, 2};
  const StudyPlan plan = study_plan(study);
  const std::size_t strains = study.scenes[0].ligaments.size();
  EXPECT_EQ(plan.parameters[0].spread.kind, Spread::Kind::kUniform);
  EXPECT_DOUBLE_EQ(plan.parameters[0].spread.bounds[1], 0.03);
  EXPECT_TRUE(plan.parameters[strains].logarithmic);
  EXPECT_DOUBLE_EQ(plan.parameters[strains].spread.bounds[0], std::log(0.5));
  EXPECT_EQ(plan.samples(), 3u);
  std::vector<double> theta;
  for (std::uint64_t k = 0; k < plan.samples(); ++k) {
    plan.theta(k, theta);
    ASSERT_EQ(theta.size(), plan.parameters.size());
    EXPECT_GT(theta[0], -0.01);
    EXPECT_LT(theta[0], 0.03);
  }
}

TEST(StudyPlan, ANumberTwiceIsRefusedByName) {
  ReadStudy study = small_study("wismans-type/knee.toml", 3);
  study.varied[0].push_back(study.varied[0][0]);
  try {
    (void)study_plan(study);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("small.toml: [[vary]] in "), 0u) << message;
    EXPECT_NE(message.find("aACL.reference_strain is free twice"), std::string::npos) << message;
  }
}

TEST(StudyPlan, ALoadThatIsNotThereIsRefusedByName) {
  ReadStudy study = small_study("wismans-type/drawer.toml", 3);
  VariedNumber& load = study.varied[0].emplace_back();
  load.number.what = ParameterKind::kLoadScale;
  load.number.of = {0};
  load.number.prior_sd = 0.1;
  EXPECT_EQ(study_plan(study).parameters.size(), 13u);
  study.scenes[0].loads[0].scale = 0;
  EXPECT_NO_THROW((void)study_plan(study)) << "the sweep is over its size";
  study.scenes[0].sweep->varies_load = false;
  try {
    (void)study_plan(study);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(" has scale = 0 in "), std::string::npos)
        << error.what();
  }
}

TEST(StudyPlan, OutputsAreFoundInEachKneeByTheirNames) {
  ReadStudy study = small_study("wismans-type/knee.toml", 2);
  study.scenes.push_back(study.scenes[0]);
  study.varied.push_back(study.varied[0]);
  std::swap(study.scenes[1].contacts[0], study.scenes[1].contacts[1]);
  study.study.outputs = {"medial.force"};
  const StudyPlan plan = study_plan(study);
  ASSERT_EQ(plan.samples(), 4u);
  EXPECT_EQ(plan.knees[0].outputs[0].output.index, 0u);
  EXPECT_EQ(plan.knees[1].outputs[0].output.index, 1u);
  study.scenes[1].contacts[1].name = "inner";
  study.study.outputs.clear();
  EXPECT_THROW((void)study_plan(study), InputError);
}

// Bounds are of the number itself: what change they allow depends on where a knee has it.
TEST(StudyPlan, EachKneeIsCutAtBoundsOfItsOwn) {
  ReadStudy study = small_study("wismans-type/knee.toml", 50);
  study.scenes.push_back(study.scenes[0]);
  study.varied.push_back(study.varied[0]);
  StudyPlan plan = study_plan(study);
  plan.knees[1].parameters[0].bounds = {-0.001, 0.001};
  std::array<double, 2> farthest{};
  std::vector<double> theta;
  for (std::uint64_t k = 0; k < plan.samples(); ++k) {
    plan.theta(k, theta);
    double& far = farthest[plan.knee_of(k)];
    far = std::max(far, std::abs(theta[0]));
  }
  EXPECT_GT(farthest[0], 0.01);
  EXPECT_LE(farthest[1], 0.001);
}

// Read in the units of each scene it would be another one.
TEST(StudyPlan, ASpreadIsOneOfAllKnees) {
  ReadStudy study = small_study("wismans-type/knee.toml", 50);
  study.scenes.push_back(study.scenes[0]);
  study.varied.push_back(study.varied[0]);
  study.varied[1][0].number.prior_sd *= 10;
  try {
    (void)study_plan(study);
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected one for all knees"), std::string::npos)
        << error.what();
  }
}

class StudyTable : public testing::Test {
 protected:
  StudyPlan plan_of(const std::string& text, bool values = false) {
    const std::filesystem::path file = folder_ / "points.csv";
    std::ofstream(file) << text;
    ReadStudy study = small_study("wismans-type/knee.toml", 0);
    study.study.design = DesignKind::kTable;
    study.study.table = file;
    study.study.table_holds_values = values;
    VariedNumber two = study.varied[0][0];
    two.number.of = {0, 1};
    study.varied[0] = {two};
    first_ = study.scenes[0].ligaments[0].name + ".reference_strain";
    return study_plan(study);
  }
  std::string refusal(const std::string& text) {
    try {
      (void)plan_of(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }

  /// With values of the first ligament in `values_`.
  [[nodiscard]] ReadStudy study_of_values(
      const std::string& scene = "wismans-type/knee.toml") const {
    ReadStudy study = small_study(scene, 0);
    study.study.design = DesignKind::kTable;
    study.study.table = values_;
    study.study.table_holds_values = true;
    study.varied[0] = {study.varied[0][0]};
    study.varied[0][0].number.of = {0};
    return study;
  }

  const std::filesystem::path folder_ = fresh_folder("study table"),
                              values_ = folder_ / "values.csv";
  std::string first_;
};

TEST_F(StudyTable, HoldsChangesByTheNamesOfItsColumns) {
  const StudyPlan plan = plan_of(
      "pACL.reference_strain,aACL.reference_strain,femur "
      "frame.turn.lateral\n0.01,0.02,7\n0,-0.5,7\n");
  ASSERT_EQ(plan.samples(), 2u);
  std::vector<double> theta;
  plan.theta(0, theta);
  EXPECT_EQ(theta, (std::vector<double>{0.02, 0.01}));
}

// As tables are written for spreadsheets: an apostrophe before what they would take for a formula.
TEST_F(StudyTable, AnApostropheBeforeAFormulaIsNoneOfTheName) {
  const StudyPlan plan =
      plan_of("\"'-1\",pACL.reference_strain,\"aACL.reference_strain\"\n0,0.01,0.02\n");
  EXPECT_EQ(plan.samples(), 1u);
  // What is written comes back, also where a spreadsheet has taken the quotes off.
  for (const char* name : {"-1", "=a", "'kept", "''", "a'b", "plain"}) {
    const std::string cell = csv_text(name);
    const std::string bare = cell[0] == '"' ? cell.substr(1, cell.size() - 2) : cell;
    std::ofstream(folder_ / "cells.csv") << cell << ',' << bare << '\n';
    const CsvFile back = read_csv(folder_ / "cells.csv", "a table");
    EXPECT_EQ(back.header.fields, (std::vector<std::string>{name, name}));
  }
}

TEST_F(StudyTable, MayHoldTheNumbersThemselves) {
  const StudyPlan plan = plan_of("pACL.reference_strain,aACL.reference_strain\n0.01,0.02\n", true);
  std::vector<double> theta;
  plan.theta(0, theta);
  EXPECT_DOUBLE_EQ(theta[0], 0.02 - plan.knees[0].parameters[0].start);
}

// A strain that the scene tells at a length of its own, and not at the start pose.
TEST_F(StudyTable, AStrainIsToldAtTheLengthOfTheScene) {
  ReadStudy study = study_of_values();
  LigamentDescription& ligament = study.scenes[0].ligaments[0];
  const double own = 1.1 * slack_length(ligament.law);
  ligament.reference_length = own;
  set_slack_length(ligament.law, own / (1 + 0.0335));
  std::ofstream(values_) << ligament.name << ".reference_strain\n0.0335\n0.05\n";
  const StudyPlan plan = study_plan(study);
  std::vector<double> theta;
  plan.theta(0, theta);
  EXPECT_NEAR(theta[0], 0, 1e-14);
  plan.theta(1, theta);
  const double start_length = slack_length(ligament.law) * (1 + plan.knees[0].parameters[0].start);
  EXPECT_NEAR(theta[0], start_length * (0.05 - 0.0335) / own, 1e-14);
}

// In a scene in cm the table is in cm too; several numbers with one change in common have no value.
TEST_F(StudyTable, ItsNumbersAreInTheUnitsOfTheScene) {
  ReadStudy study = study_of_values();
  study.scenes[0].length_to_mm = 10;
  study.varied[0][0].number.what = ParameterKind::kSlackLength;
  const LigamentDescription& ligament = study.scenes[0].ligaments[0];
  const double slack = slack_length(ligament.law);
  std::ofstream(values_) << fmt::format("{}.slack_length\n{:.17g}\n", ligament.name, slack / 10);
  std::vector<double> theta;
  study_plan(study).theta(0, theta);
  EXPECT_NEAR(theta[0], 0, 1e-12 * slack);

  study.varied[0][0].number.what = ParameterKind::kStiffness;
  study.scenes[0].force_to_n = 2;
  const double stiffness = 5;  // a force per area
  study.scenes[0].ligaments[0].law = QuadraticLaw{.stiffness = stiffness, .slack_length = slack};
  std::ofstream(values_) << fmt::format("{}.stiffness\n{:.17g}\n", ligament.name,
                                        stiffness * 100 / 2);
  study_plan(study).theta(0, theta);
  EXPECT_NEAR(theta[0], 0, 1e-12);

  study.varied[0][0].number.what = ParameterKind::kSlackLength;
  study.varied[0][0].number.of = {0, 1};
  study.varied[0][0].number.together = true;
  const std::string both = ligament.name + "+" + study.scenes[0].ligaments[1].name;
  std::ofstream(values_) << both << ".slack_length\n" << slack / 10 << "\n";
  try {
    (void)study_plan(study);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("values.csv:1: " + both +
                        ".slack_length, a change that several numbers have in "
                        "common, expected a table of \"changes\""),
              std::string::npos)
        << error.what();
  }
}

// What is swept has its values from the sweep.
TEST_F(StudyTable, ALoadThatIsSweptHasNoValueOfItsOwn) {
  ReadStudy study = study_of_values("wismans-type/drawer.toml");
  study.varied[0][0].number.what = ParameterKind::kLoadScale;
  study.scenes[0].loads[0].scale = 0;
  std::ofstream(values_) << study.scenes[0].loads[0].name << ".scale\n1\n";
  try {
    (void)study_plan(study);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("values.csv:1: " + study.scenes[0].loads[0].name +
                        ".scale, a load that is swept and has no value of its own, expected a "
                        "table of \"changes\""),
              std::string::npos)
        << error.what();
  }
}

TEST_F(StudyTable, WhatIsMissingIsNamed) {
  EXPECT_NE(refusal("aACL.reference_strain,pACL.reference_strain,aACL.reference_strain\n1,2,3\n")
                .find(":1: two columns \"aACL.reference_strain\", expected one"),
            std::string::npos);
  EXPECT_NE(refusal("aACL.reference_strain\n0.1\n").find("no column \"pACL.reference_strain\""),
            std::string::npos);
  EXPECT_NE(refusal("aACL.reference_strain,pACL.reference_strain\n0.1,x\n")
                .find("points.csv:2: pACL.reference_strain = x, expected a number"),
            std::string::npos);
  EXPECT_NE(refusal("aACL.reference_strain,pACL.reference_strain\n").find("no rows"),
            std::string::npos);
}

}  // namespace
}  // namespace condyle::test
