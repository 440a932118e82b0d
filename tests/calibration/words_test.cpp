/// A calibration in words: what has to be said is said, with the right numbers and units.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/told_parameter.h"
#include "support/made_up_calibration.h"

namespace condyle::test {
namespace {

std::string told(const CalibrationResult& result) {
  std::string text;
  for (const std::string& line : calibration_lines(made_up_calibration_scene(), result))
    text += line + "\n";
  return text;
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string line_with(const std::string& text, const std::string& part) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (says(line, part)) return line;
  return "";
}

TEST(CalibrationWords, TellStrainsInPerCentFactorsAsSuchAndTurnsInDegrees) {
  CalibrationResult result = made_up_calibration();
  result.parameters.back().units = "rad";
  const std::vector<ToldParameter> all = told_parameters(result);
  EXPECT_EQ(all[0].unit, "%");
  EXPECT_NEAR(all[0].scene, 0.2, 1e-12);
  EXPECT_NEAR(all[0].mean, 2.33, 1e-12);  // 0.2 % and 0.0213
  EXPECT_NEAR(all[0].prior_sd, 3, 1e-12);
  EXPECT_EQ(all[2].unit, "factor");
  EXPECT_EQ(all[2].scene, 1);
  EXPECT_NEAR(all[2].mean, 1.25, 1e-12);
  EXPECT_EQ(all[3].unit, "mm");
  EXPECT_EQ(all[4].unit, "deg");
  EXPECT_NEAR(all[4].mean, -0.2 * 180 / M_PI, 1e-12);
  for (std::size_t j = 0; j < all.size(); ++j)
    EXPECT_NEAR(all[j].shrinkage, all[j].best_sd() / all[j].prior_sd, 1e-12);
}

TEST(CalibrationWords, TakeTheSamplesSdWhereItPartsFromTheDeltaMethods) {
  const CalibrationResult result = made_up_calibration();
  const std::vector<ToldParameter> all = told_parameters(result);
  EXPECT_FALSE(all[0].parts);
  ASSERT_TRUE(all[1].parts);  // made 1.25 times as large
  EXPECT_NEAR(all[1].best_sd(), 1.25 * all[1].sd, 1e-12);
  EXPECT_TRUE(says(line_with(told(result), "part by more than 10 %"), "pPCL.reference_strain"));
}

// Without prior and data no sample leaves the least: that says nothing of how well a number is known.
TEST(CalibrationWords, ANumberOfWhichNothingIsKnownIsToldByTheDeltaMethod) {
  CalibrationResult result = made_up_calibration();
  result.parameters[1].prior_sd = 1e6;
  result.known.sd[1] = 1e6;
  result.sample_sd[1] = 0;
  const ToldParameter told = told_parameters(result)[1];
  EXPECT_FALSE(told.parts);
  EXPECT_NEAR(told.shrinkage, 1, 1e-12);
  result.known.sd[1] = 0.03;  // by the data alone
  result.sample_sd[1] = 0.05;
  EXPECT_TRUE(told_parameters(result)[1].parts);
}

TEST(CalibrationWords, NameTheWeakestDirectionsAndWhatTheyConsistOf) {
  CalibrationResult result = made_up_calibration();
  result.known.singular_values << 20, 5, 1.5, 0.8, 0.1;
  result.known.determined = 3;
  result.known.directions.setIdentity();
  result.known.directions.col(4) << 0, -0.8, 0.1, 0.59, 0;
  const std::vector<std::string> weak = weak_directions(result, 5);
  ASSERT_EQ(weak.size(), 2U);
  EXPECT_EQ(weak[0].substr(0, 3), "0.1");
  EXPECT_TRUE(says(weak[0], "pPCL.reference_strain: 0.80, aMCL.insertion.femur.normal: -0.59"));
  EXPECT_FALSE(says(weak[0], "LCL"));  // its share is below 0.3
  EXPECT_EQ(weak_directions(result, 1).size(), 1U);
  EXPECT_TRUE(says(told(result), "3 of 5 directions are determined"));
}

// Those at a bound stand last, with a singular value of 0: neither the data nor the prior hold them.
TEST(CalibrationWords, NumbersAtABoundAreNoWeakDirections) {
  CalibrationResult result = made_up_calibration();
  result.known.singular_values << 20, 5, 0.8, 0, 0;
  result.known.determined = 2;
  result.known.directions.setIdentity();
  result.at_bound.assign(result.parameters.size(), false);
  result.at_bound[3] = result.at_bound[4] = true;
  const std::vector<std::string> weak = weak_directions(result, 5);
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_EQ(weak[0].substr(0, 3), "0.8");
  EXPECT_TRUE(says(told(result),
                   "2 of 3 directions are determined by the data (singular values 20 ... 0.8"));
}

TEST(CalibrationWords, ChiSquareHasAVerdict) {
  CalibrationResult result = made_up_calibration();
  EXPECT_TRUE(says(told(result), "The model explains the data"));
  result.reduced_chi_square = 4;
  const std::string text = told(result);
  EXPECT_TRUE(says(text, "does not explain the data within their deviations"));
  EXPECT_TRUE(says(text, "2 times as large"));  // root of 4
  result.reduced_chi_square_limit = std::nan("");
  EXPECT_TRUE(says(told(result), "No degree of freedom is left"));
  EXPECT_FALSE(says(told(result), "nan"));
}

TEST(CalibrationWords, SayWhatIsSilentAtABoundLostOrElsewhere) {
  CalibrationResult result = made_up_calibration();
  result.at_bound[3] = true;
  const std::string text = told(result);
  EXPECT_TRUE(says(line_with(text, "At a bound"), "aMCL.insertion.femur.normal"));
  EXPECT_TRUE(says(line_with(text, "Carry nothing"), "oMCL, APL"));
  EXPECT_TRUE(says(text, "2 of 4 starts reached the same least"));
  EXPECT_TRUE(says(line_with(text, "start 3"), "7.5 in place of 6.25"));
  EXPECT_TRUE(says(line_with(text, "start 4"), "did not converge"));
  EXPECT_TRUE(says(text, "unseen: 1 of 3 rows have no pose"));
  EXPECT_TRUE(says(text, "1 of 41 samples were lost"));
  EXPECT_FALSE(says(text, "another equilibrium"));
  EXPECT_FALSE(says(text, "a contact opens"));
  result.fit.one_sided = {1};
  EXPECT_TRUE(says(line_with(told(result), "where a contact opens or closes"), ".csv:"));
  result.cold_difference = 0.7;
  EXPECT_TRUE(says(told(result), "another equilibrium"));
}

TEST(CalibrationWords, ErrorsAreToldBeforeAndAfterInDeviationsMillimetresAndDegrees) {
  const std::string text = told(made_up_calibration()),
                    line = line_with(text, "fitted              ");
  EXPECT_TRUE(says(line, "6.10 -> 0.97"));
  EXPECT_TRUE(says(line, "3.20 -> 0.31"));
  EXPECT_TRUE(says(line, "2.86 -> 0.34"));  // 0.05 and 0.006 rad
  EXPECT_TRUE(says(line, "94.4 %"));
  CalibrationResult result = made_up_calibration();
  result.unseen = {"unseen", 100, 0, 4, 3, 0.6, 1, 1, 1, 1};
  EXPECT_TRUE(says(told(result), "intervals are too narrow"));
  result.unseen = {"unseen"};
  EXPECT_TRUE(says(told(result), "No row is unseen"));
}

TEST(CalibrationTables, CsvIsReadBackAndLatexIsEscaped) {
  CalibrationResult result = made_up_calibration();
  result.at_bound[1] = true;
  const std::string csv = parameter_csv(result);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
  std::istringstream line(line_with(csv, "LCL.stiffness"));
  std::vector<std::string> fields;
  for (std::string field; std::getline(line, field, ',');) fields.push_back(field);
  ASSERT_EQ(fields.size(), 9U);
  EXPECT_EQ(std::stod(fields[4]), std::exp(result.fit.theta[2]));
  EXPECT_EQ(std::stod(fields[5]), result.known.sd[2]);
  const std::string latex = parameter_latex(result);
  EXPECT_TRUE(says(latex, "aACL.reference\\_strain & \\% &"));
  EXPECT_TRUE(says(line_with(latex, "pPCL"), "at its bound"));
  EXPECT_TRUE(says(latex, "\\end{tabular}"));
}

TEST(CalibrationTables, SamplesHaveAColumnForEachNumber) {
  const CalibrationResult result = made_up_calibration();
  std::istringstream csv(samples_csv(result));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "aACL.reference_strain,pPCL.reference_strain,LCL.stiffness,aMCL.insertion.femur.normal,"
            "ap30.anterior_drawer offset");
  for (Eigen::Index i = 0; i < result.samples.rows(); ++i) {
    ASSERT_TRUE(std::getline(csv, line));
    std::istringstream fields(line);
    for (Eigen::Index j = 0; j < result.samples.cols(); ++j) {
      std::string field;
      std::getline(fields, field, ',');
      EXPECT_EQ(std::stod(field), result.samples(i, j));
    }
  }
  EXPECT_FALSE(std::getline(csv, line));
}

/// A name is no command of LaTeX, and no option of the end of the row before it.
TEST(CalibrationWords, NamesAreWordsToLatexAndToSpreadsheets) {
  CalibrationResult result = made_up_calibration();
  result.parameters[0].name = "[3cm] \\input{/etc/passwd} $x$ %_#&^~*";
  EXPECT_TRUE(says(parameter_latex(result),
                   "\n{[}3cm] \\textbackslash{}input\\{/etc/passwd\\} \\$x\\$ "
                   "\\%\\_\\#\\&\\^{}\\~{}{*} & "))
      << parameter_latex(result);
  result.parameters[0].name = "=HYPERLINK(\"http://x\",1)";
  EXPECT_TRUE(says(parameter_csv(result), "\n\"'=HYPERLINK(\"\"http://x\"\",1)\",%,"))
      << parameter_csv(result);
  EXPECT_TRUE(says(samples_csv(result), "\"'=HYPERLINK"));
}

}  // namespace
}  // namespace condyle::test
