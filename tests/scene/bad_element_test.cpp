/// Every mistake in a scene file gets one line that names file, line, table, key, value and what
/// was expected: ligaments, conditions, loads, sweeps.

#include "scene/mistake.h"

namespace condyle {
namespace {

using test::Mistake;

class BadElement : public test::MistakeTest {};

TEST_P(BadElement, IsNamedWithItsPlace) { expect_named(); }

INSTANTIATE_TEST_SUITE_P(
    Ligaments,
    BadElement,
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
    BadElement,
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
                "(suspect the units)"},
        Mistake{"law = \"toe-linear\"\nstiffness = 1500\nslack_length = 30",
                "law = \"table\"\nlengths = [0.026, 0.03]\nforces = [0, 200]",
                "43: [[ligament]] \"aACL\": lengths = [0.026, 0.03], expected lengths like that at "
                "the start pose, 30 (suspect the units)"},
        Mistake{"to = 120", "to = 380",
                "57: [sweep]: values beyond one turn, expected angles of at most that (suspect "
                "[units] angle)"},
        Mistake{"value = 0", "value = 3600",
                "49: [[condition]] \"bend\": value = 3600, expected an angle of at most one turn "
                "(suspect [units] angle)"}));

INSTANTIATE_TEST_SUITE_P(
    Motion,
    BadElement,
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
    BadElement,
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
        Mistake{"from = 0\nto = 120\nstep = 5", "values = [0, 5, 0]\npath = \"arc length\"",
                "57: [sweep]: values that turn back, expected such as go one way with path = \"arc "
                "length\": it goes "
                "from the first to the last"},
        Mistake{"step = 5", "step = 5\n[simulate]\ntime = 1\nhold = [\"bend\", \"bend\"]",
                "64: [simulate]: hold = \"bend\", expected each condition once"},
        Mistake{"step = 5", "step = 5\n[simulate]\ntime = 1\ntolerance = 1e-30",
                "64: [simulate]: tolerance = 1e-30, expected a tolerance from 1e-13 to 1e-3"},
        Mistake{"step = 5", "step = 5\n[simulate]\ntime = 1e-9\nrate = 1e13",
                "64: [simulate]: rate = 10000000000000, expected at most 1e9 frames per second"},
        Mistake{"step = 5", "setp = 5",
                "61: [sweep]: unknown key setp = 5, did you mean \"step\"?"}));

TEST(BadSweep, ANameThatTwoHaveIsNamed) {
  const std::string text = with(small_scene_with("name = \"bend\"", "name = \"weight.scale\""),
                                "vary = \"bend\"", "vary = \"weight.scale\"");
  EXPECT_EQ(test::message_of(text),
            "some/knee.toml:58: [sweep]: vary = \"weight.scale\", expected another name: a "
            "condition and the scale of a load are both called that");
}

}  // namespace
}  // namespace condyle
