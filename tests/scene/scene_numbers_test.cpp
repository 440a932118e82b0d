/// Numbers of the knee by their names, as [sweep] sensitivities has them.

#include "condyle/scene_file/read_scene_numbers.h"

#include "scene/mistake.h"

namespace condyle {
namespace {

using test::Mistake;

std::string asking(const std::string& names) {
  return small_scene_with("step = 5", "step = 5\nsensitivities = [" + names + "]");
}

std::vector<SceneNumber> numbers(const std::string& names) {
  return parse_scene(asking(names), "knee.toml").sweep->sensitivities;
}

TEST(SceneNumbers, AreThoseOfLigamentsLoadsConditionsAndSurfaces) {
  const std::vector<SceneNumber> found = numbers(
      R"("aACL.insertion.tibia", "weight.scale", "weight.point", "bend.value", "plateau.shift")");
  ASSERT_EQ(found.size(), 5U);
  EXPECT_EQ(found[0].kind, ParameterKind::kInsertion);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_EQ(found[0].body, 1);
  EXPECT_EQ(found[1].kind, ParameterKind::kLoadScale);
  EXPECT_EQ(found[2].kind, ParameterKind::kLoadPoint);
  EXPECT_EQ(found[3].kind, ParameterKind::kConditionValue);
  EXPECT_EQ(found[4].kind, ParameterKind::kSurfaceShift);
  EXPECT_EQ(found[4].index, 1);
  EXPECT_EQ(found[4].name, "plateau.shift");
}

// Of two ligaments, the second of a law that has no stiffness.
TEST(SceneNumbers, AStarIsEveryLigamentThatHasTheNumber) {
  const std::string second = R"([[ligament]]
name = "strap"
ends = [{ body = "femur", at = [0, 20, 5] }, { body = "tibia", at = [0, -10, 5] }]
law = "polynomial"
coefficients = [1, 2]

[[condition]])";
  const std::string text =
      with(asking(R"("*.stiffness", "*.insertion.femur")"), "[[condition]]", second);
  const std::vector<SceneNumber> found = parse_scene(text, "knee.toml").sweep->sensitivities;
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].name, "aACL.stiffness");
  EXPECT_EQ(found[1].name, "aACL.insertion.femur");
  EXPECT_EQ(found[2].name, "strap.insertion.femur");
  EXPECT_EQ(test::message_of(with(text, "\"*.stiffness\"", "\"strap.stiffness\"")),
            "some/knee.toml:68: [sweep]: sensitivities = \"strap.stiffness\", expected one of a "
            "ligament whose law is toe-linear or quadratic");
}

class BadNumber : public test::MistakeTest {};

TEST_P(BadNumber, IsNamedWithItsPlace) { expect_named(); }

Mistake asked(const std::string& names, const std::string& said) {
  return {"step = 5", "step = 5\nsensitivities = " + names, "62: [sweep]: sensitivities = " + said};
}

const std::string kSome = "names of numbers [\"aACL.reference_strain\", ...]";

INSTANTIATE_TEST_SUITE_P(
    Sweep,
    BadNumber,
    testing::Values(
        asked("true", "true, expected " + kSome),
        asked("[]", "[], expected " + kSome),
        asked(R"(["aACL.stiffnes"])",
              R"("aACL.stiffnes", expected NAME.NUMBER: "aACL.reference_strain", )"
              R"("aACL.slack_length", "aACL.stiffness", "aACL.transition_strain", )"
              R"("aACL.insertion.femur", "aACL.insertion.tibia", "weight.scale", "weight.vector", )"
              R"("weight.point", "bend.value", "ball.shift", "ball.modulus" or one of 2 more; did )"
              R"(you mean "aACL.stiffness"?)"),
        asked(R"(["*.stifness"])",
              R"("*.stifness", expected a number of ligaments: "*.reference_strain", )"
              R"("*.slack_length", "*.stiffness", "*.transition_strain", "*.insertion.femur" or )"
              R"("*.insertion.tibia"; did you mean "*.stiffness"?)"),
        asked(R"(["ball.modulus"])",
              R"("ball.modulus", expected one of a surface with a layer in a [[contact]] that has )"
              "a law"),
        asked(R"(["aACL.stiffness", "*.stiffness"])",
              R"("*.stiffness", expected each number once ("aACL.stiffness" is there))")));

TEST(SceneNumbers, AMomentHasNoPoint) {
  const std::string text =
      with(asking("\"weight.point\""), "kind = \"force\"", "kind = \"moment\"");
  EXPECT_EQ(
      test::message_of(text),
      "some/knee.toml:62: [sweep]: sensitivities = \"weight.point\", expected one of a force: "
      "a moment has no point");
}

}  // namespace
}  // namespace condyle
