/// [calibrate] of a scene: what is read, and what is refused in which words.

#include <gtest/gtest.h>

#include <ostream>

#include "calibration/small_calibration.h"
#include "condyle/math/degree.h"
#include "scene/mistake.h"

namespace condyle::test {
namespace {

CalibrationDescription calibration_of(const std::string& text) {
  return parse_scene(text, "some/knee.toml").calibration.value();
}

TEST(ReadCalibration, AllIsReadInTheUnitsUsedInside) {
  const CalibrationDescription read = calibration_of(kCalibratedScene);
  EXPECT_EQ(read.measurements, std::filesystem::path("some/knee.csv"));
  EXPECT_EQ(read.flexion, 0);
  EXPECT_EQ(read.moment_to_nmm, 1000);
  EXPECT_EQ(read.relative, std::vector<std::string>{"ap30"});
  EXPECT_EQ(read.huber, 3);
  EXPECT_EQ(read.curve_sd.value()[0], 0.5);
  EXPECT_DOUBLE_EQ(read.curve_sd.value()[1], kDegree);
  EXPECT_DOUBLE_EQ(read.femur_frame_sd.value()[1], 2 * kDegree);
  EXPECT_EQ(read.tibia_frame_sd.value()[1], 0);
  EXPECT_DOUBLE_EQ(read.flexion_sd, kDegree);
  EXPECT_EQ(read.level_sd, 0.02);
  EXPECT_EQ(read.starts, 4);
  EXPECT_EQ(read.seed, 7u);
  EXPECT_EQ(read.samples, 50);
}

TEST(ReadCalibration, LoadsAreThoseOfTheSceneOrConditionsThatHold) {
  const CalibrationDescription read = calibration_of(kCalibratedScene);
  ASSERT_EQ(read.loads.size(), 3u);
  EXPECT_FALSE(read.loads[0].displacement_control);
  EXPECT_EQ(read.loads[1].index, 2);  // weight, drawer, twist
  EXPECT_TRUE(read.loads[2].displacement_control);
  EXPECT_EQ(read.loads[2].index, 1);
}

TEST(ReadCalibration, TheSizeOfALoadThatTestsSetIsNoFreeNumber) {
  const std::string fitted = calibrated_scene_with(
      "of = [\"aACL\", \"pACL\"]\nwhat = \"reference_strain\"\nprior_sd = 0.03\nbounds = [-0.4, "
      "0.2]",
      "of = \"drawer\"\nwhat = \"load\"\nprior_sd = 0.03");
  EXPECT_NE(message_of(fitted).find("fits the size of load \"drawer\", which [[calibrate.load]] "
                                    "\"anterior\" takes from the table"),
            std::string::npos)
      << message_of(fitted);
}

TEST(ReadCalibration, AStarMeansAllWhoseLawHasTheNumber) {
  const CalibrationDescription read = calibration_of(kCalibratedScene);
  ASSERT_EQ(read.parameters.size(), 3u);
  EXPECT_EQ(read.parameters[1].of, (std::vector<int>{0, 1}));  // the strap's law has no stiffness
  EXPECT_TRUE(read.parameters[1].together);
  EXPECT_EQ(read.parameters[2].body, 1);
  EXPECT_EQ(read.parameters[2].normal_sd, 0.25);
}

TEST(ReadCalibration, APrefixMeansABundle) {
  const CalibrationDescription read =
      calibration_of(calibrated_scene_with("of = [\"aACL\", \"pACL\"]", "of = [\"a*\"]"));
  EXPECT_EQ(read.parameters[0].of, std::vector<int>{0});
}

TEST(ReadCalibration, LengthsAreScaledWithTheDeclaredUnit) {
  std::string text =
      calibrated_scene_with("what = \"reference_strain\"", "what = \"slack_length\"");
  text = with(text, "bounds = [-0.4, 0.2]", "bounds = [1, 90]");
  text = with(text, "length = \"mm\"", "length = \"cm\"");
  text = with(text, "moment = \"N m\"\n", "");
  const CalibrationDescription read = calibration_of(text);
  EXPECT_DOUBLE_EQ(read.parameters[0].prior_sd, 0.3);
  EXPECT_DOUBLE_EQ(read.parameters[0].bounds.value()[1], 900);
  EXPECT_DOUBLE_EQ(read.parameters[2].normal_sd.value(), 2.5);
  EXPECT_EQ(read.moment_to_nmm, 10);  // N times the length unit
}

TEST(ReadCalibration, ASceneWithoutItHasNone) {
  EXPECT_FALSE(parse_scene(kSmallScene, "some/knee.toml").calibration.has_value());
}

struct Refused {
  std::string from, to;  ///< what is changed in the scene
  std::string at;        ///< text of the line that is named
  std::string message;   ///< after file and line
  friend std::ostream& operator<<(std::ostream& stream, const Refused& refused) {
    return stream << refused.to;
  }
};

class BadCalibration : public testing::TestWithParam<Refused> {};

TEST_P(BadCalibration, IsNamedWithItsLine) {
  const Refused& refused = GetParam();
  const std::string text = calibrated_scene_with(refused.from, refused.to);
  EXPECT_EQ(message_of(text),
            "some/knee.toml:" + std::to_string(line_of(text, refused.at)) + ": " + refused.message);
}

const Refused kMistakes[] = {
    {"measurements = \"knee.csv\"", "measurement = \"knee.csv\"", "measurement =",
     "[calibrate]: unknown key measurement = \"knee.csv\", did you mean \"measurements\"?"},
    {"moment = \"N m\"", "moment = \"Nm\"", "moment =",
     "[calibrate]: moment = \"Nm\", expected \"N m\", \"N cm\" or \"N mm\"; did you mean \"N m\"?"},
    {"relative = [\"ap30\"]", "relative = \"ap30\"", "relative =",
     "[calibrate]: relative = \"ap30\", expected names of curves of the table [\"ap30\", ...]"},
    {"huber = 3", "huber = 0",
     "huber =", "[calibrate]: huber = 0, expected a number of standard deviations > 0"},
    {"huber = 3", "huber = 1e-300",
     "huber =", "[calibrate]: huber = 1e-300, expected a number of standard deviations >= 0.001"},
    {"flexion_sd = 1\n", "flexion_sd = 1e99\n",
     "flexion_sd =", "[calibrate]: flexion_sd = 1e+99, expected an angle of at most half a turn"},
    {"curve_sd = [0.5, 1]", "curve_sd = [0.5]", "curve_sd =",
     "[calibrate]: curve_sd = [0.5], expected two standard deviations [length, angle] >= 0, one of "
     "them > 0"},
    {"femur = [2, 2], tibia", "femurs = [2, 2], tibia",
     "frame_sd =", "[calibrate]: unknown key frame_sd.femurs = [2, 2], did you mean \"femur\"?"},
    {"level_sd = 0.02", "level_sd = 2",
     "level_sd =", "[calibrate]: level_sd = 2, expected a part of the level below 1, 0.02 for 2 %"},
    {"starts = 4", "starts = 0",
     "starts =", "[calibrate]: starts = 0, expected a whole number from 1 to 1000000"},
    {"samples = 50", "samples = 1.5",
     "samples =", "[calibrate]: samples = 1.5, expected a whole number from 0 to 1000000"},
    {"load = \"drawer\"", "load = \"drawr\"", "load = \"drawr\"",
     "[[calibrate.load]] \"anterior\": load = \"drawr\", expected the name of a load: \"weight\", "
     "\"drawer\" or \"twist\"; did you mean \"drawer\"?"},
    {"load = \"drawer\"", "load = \"drawer\"\ncondition = \"held drawer\"",
     "[[calibrate.load]]\nname = \"anterior\"",
     "[[calibrate.load]] \"anterior\": has load and condition, expected one of them"},
    {"load = \"drawer\"\n", "", "[[calibrate.load]]\nname = \"anterior\"",
     "[[calibrate.load]] \"anterior\": has neither load nor condition, expected one"},
    {"condition = \"held drawer\"", "condition = \"bend\"", "condition = \"bend\"",
     "[[calibrate.load]] \"robot\": condition = \"bend\", expected a condition other than that of "
     "flexion, which every test prescribes"},
    {"name = \"internal\"", "name = \"none\"", "name = \"none\"",
     "[[calibrate.load]] \"none\": name = \"none\", expected another name: none is the unloaded "
     "knee"},
    {"vector = [1, 0, 0]", "vector = [0, 0, 0]", "load = \"drawer\"",
     "[[calibrate.load]] \"anterior\": load = \"drawer\", expected a load whose vector is not 0: "
     "the level acts along it"},
    {"kind = \"flexion\"", "kind = \"adduction\"", "[calibrate]",
     "[calibrate]: needs a [[condition]] of kind \"flexion\" that a test prescribes"},
    {"of = [\"aACL\", \"pACL\"]", "of = [\"aACL\", \"pALC\"]", "of = [\"aACL\", \"pALC\"]",
     "[[calibrate.parameter]] number 1: of = \"pALC\", expected the name of a ligament: \"aACL\", "
     "\"pACL\" or \"strap\"; did you mean \"pACL\"?"},
    {"of = [\"aACL\", \"pACL\"]", "of = [\"aACL\", \"a*\"]", "of = [\"aACL\", \"a*\"]",
     "[[calibrate.parameter]] number 1: of = \"a*\", expected numbers that are free once: that of "
     "\"aACL\" is since line 119"},
    {"of = [\"aACL\", \"pACL\"]", "of = [\"strap\"]", "of = [\"strap\"]",
     "[[calibrate.parameter]] number 1: of = \"strap\", expected a ligament whose law is "
     "toe-linear or quadratic"},
    {"of = [\"aACL\", \"pACL\"]", "of = [\"MCL*\"]", "of = [\"MCL*\"]",
     "[[calibrate.parameter]] number 1: of = \"MCL*\", expected the beginning of a name of a "
     "ligament whose law is toe-linear or quadratic"},
    {"what = \"insertion.tibia\"", "what = \"insertion.tibea\"", "what = \"insertion.tibea\"",
     "[[calibrate.parameter]] number 3: what = \"insertion.tibea\", expected \"reference_strain\", "
     "\"slack_length\", \"stiffness\", \"transition_strain\", \"insertion.femur\", "
     "\"insertion.tibia\" or \"load\"; did you mean \"insertion.tibia\"?"},
    {"what = \"insertion.tibia\"", "what = \"slack_length\"", "of = [\"aACL\"]\nwhat = \"slack",
     "[[calibrate.parameter]] number 3: of = \"aACL\", expected numbers that are free once: that "
     "of \"aACL\" is since line 119"},
    {"prior_sd = 0.03\n", "", "[[calibrate.parameter]]",
     "[[calibrate.parameter]] number 1: prior_sd is missing, expected a standard deviation of the "
     "prior > 0"},
    {"prior_sd = 0.03\n", "prior_sd = 0\n", "prior_sd = 0\n",
     "[[calibrate.parameter]] number 1: prior_sd = 0, expected a standard deviation of the prior "
     "> 0"},
    {"prior_sd = 0.03\n", "prior_sd = 1e10\n", "prior_sd = 1e10\n",
     "[[calibrate.parameter]] number 1: prior_sd = 10000000000, expected a standard deviation of "
     "the "
     "prior "
     "from 1e-09 to 1e+09"},
    {"prior_sd = 0.3\n", "prior_sd = 1e-300\n", "prior_sd = 1e-300\n",
     "[[calibrate.parameter]] number 2: prior_sd = 1e-300, expected a standard deviation of the "
     "prior from 1e-09 to 1e+09"},
    {"prior_sd = 0.3\n", "prior_sd = 0.3\nnormal_sd = 1\n", "normal_sd = 1\n",
     "[[calibrate.parameter]] number 2: normal_sd = 1, expected what = \"insertion.BODY\" beside "
     "it"},
    {"bounds = [-0.4, 0.2]", "bounds = [0.2, -0.4]", "bounds = [0.2",
     "[[calibrate.parameter]] number 1: bounds = [0.2, -0.4], expected two numbers [lower, upper], "
     "the lower one first"},
    {"bounds = [-0.4, 0.2]", "bounds = [-1.5, 0.2]", "bounds = [-1.5",
     "[[calibrate.parameter]] number 1: bounds = [-1.5, 0.2], expected strains > -1"},
    {"bounds = [-0.4, 0.2]", "bounds = [-0.4, 0.02]", "bounds = [-0.4",
     "[[calibrate.parameter]] number 1: bounds = [-0.4, 0.02], expected bounds about the scene's "
     "own value, 0.05 of \"pACL\""},
    {"bounds = [0.2, 5]", "bounds = [100, 5000]", "bounds = [100",
     "[[calibrate.parameter]] number 2: bounds = [100, 5000], expected bounds of a factor on the "
     "scene's value, about 1"},
};

INSTANTIATE_TEST_SUITE_P(Each, BadCalibration, testing::ValuesIn(kMistakes));

TEST(ReadCalibration, NothingFreeIsRefused) {
  const std::string text = kCalibratedScene.substr(0, kCalibratedScene.find("[[calibrate.param"));
  EXPECT_EQ(message_of(text), "some/knee.toml:" + std::to_string(line_of(text, "[calibrate]")) +
                                  ": [calibrate]: has no [[calibrate.parameter]], expected one or "
                                  "more numbers to fit");
}

}  // namespace
}  // namespace condyle::test
