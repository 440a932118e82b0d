/// The scene's text with fitted numbers: read again it is the fitted scene, and nothing else has changed.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "condyle/calibration/calibration_words.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/text_edit.h"
#include "scene/small_scene.h"

namespace condyle::test {
namespace {

// @ stands for a power of ten.
constexpr const char* kLigaments = R"(# before the ligaments
[[ligament]]
name = "strained"
ends = [{ body = "femur", at = [0, 20@, 0] }, { body = "tibia", at = [ -1e0,
   -10.5@, # µ between
   +0.25@] }] # behind
law = "toe-linear"
stiffness = 1_500 # N
reference_strain = 0.02   # as measured

[[ligament]]
name = "slack"
law = "toe-linear"
ends = [
  { at = [3@, 20@, 0], body = "femur" },  # µm
  { at = [3@, -10@, 1@], body = "tibia" },
]
"stiffness" = 2e3
transition_strain = 0.05
slack_length = 31@

[[ligament]]
name = "with length"
law = "quadratic"
stiffness = 12
reference_strain = 0.03
reference_length = 33.0@
[[ligament.ends]]
body = "tibia"
at = [-3@, -10@, 0]
[[ligament.ends]]
body = "femur"
at = [-3@, 20@, 0]
)";

/// The small scene with these ligaments, in other units.
Scene scene_in(const std::string& length, const std::string& angle) {
  std::string text = kSmallScene;
  const std::size_t from = text.find("[[ligament]]"), to = text.find("[[condition]]");
  std::string ligaments = kLigaments;
  for (std::size_t at = 0; (at = ligaments.find('@')) != std::string::npos;)
    ligaments.replace(at, 1, length == "m" ? "e-3" : "");
  text = text.substr(0, from) + ligaments + "\n" + text.substr(to);
  text = with(text, "length = \"mm\"", "length = \"" + length + "\"");
  text = with(text, "angle = \"deg\"", "angle = \"" + angle + "\"");
  if (angle == "rad") text = with(text, "to = 120\nstep = 5", "to = 2\nstep = 0.1");
  return parse_scene(text, "some/knee.toml");
}

FreeParameter moved(ModelParameter number, bool logarithmic = false) {
  FreeParameter parameter;
  parameter.moves = {{number, 1.0}};
  parameter.logarithmic = logarithmic;
  return parameter;
}

CalibrationResult result_of(const std::vector<FreeParameter>& parameters) {
  CalibrationResult result;
  result.table.file = "some/folder/knee.csv";
  result.table.specimen = "k1";
  result.parameters = parameters;
  result.fit.theta.resize(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index j = 0; j < result.fit.theta.size(); ++j)
    result.fit.theta[j] = 0.0123456789 * (1 + 0.3 * static_cast<double>(j));
  return result;
}

Scene expected_of(const Scene& scene, const CalibrationResult& result) {
  return scene_with(scene, result.parameters, {result.fit.theta.begin(), result.fit.theta.end()});
}

double stiffness_of(const ForceLaw& law) {
  const auto* toe = std::get_if<ToeLinearLaw>(&law);
  return toe != nullptr ? toe->stiffness : std::get<QuadraticLaw>(law).stiffness;
}

/// A few roundings, of units and of a strain.
void expect_close(double a, double b) { EXPECT_NEAR(a, b, 2e-15 * std::abs(b)); }

void expect_same_numbers(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.ligaments.size(), b.ligaments.size());
  for (std::size_t i = 0; i < a.ligaments.size(); ++i) {
    const LigamentDescription &p = a.ligaments[i], &q = b.ligaments[i];
    for (std::size_t k = 0; k < 2; ++k)
      for (int c = 0; c < 3; ++c) expect_close(p.ends[k].at[c], q.ends[k].at[c]);
    expect_close(stiffness_of(p.law), stiffness_of(q.law));
    expect_close(slack_length(p.law), slack_length(q.law));
    if (const auto* toe = std::get_if<ToeLinearLaw>(&p.law))
      expect_close(toe->transition_strain, std::get<ToeLinearLaw>(q.law).transition_strain);
    ASSERT_EQ(p.reference_strain.has_value(), q.reference_strain.has_value());
    if (!p.reference_strain) continue;
    EXPECT_NEAR(*p.reference_strain, *q.reference_strain, 1e-14);
  }
  for (std::size_t i = 0; i < a.loads.size(); ++i)
    for (int c = 0; c < 3; ++c) expect_close(a.loads[i].vector[c], b.loads[i].vector[c]);
}

/// Each line of the new text that is none of the old one, in order; the first says where it is from.
std::vector<std::string> changed_lines(const Scene& scene, const std::string& text) {
  std::istringstream before(scene.text), after(text);
  std::string a, b;
  std::getline(after, b);
  EXPECT_EQ(b.substr(0, 38), "# Fitted by condyle calibrate to knee.");
  std::vector<std::string> changed;
  while (std::getline(before, a)) {
    EXPECT_TRUE(std::getline(after, b));
    if (a != b) changed.push_back(b);
  }
  EXPECT_FALSE(std::getline(after, b));
  return changed;
}

std::vector<std::pair<const char*, std::vector<FreeParameter>>> kinds() {
  using Kind = ParameterKind;
  const auto insertion = [](std::size_t of, OfBody body, int component, Held held) {
    return moved({Kind::kInsertion, of, body, component, held});
  };
  return {
      {"strain", {moved({Kind::kReferenceStrain, 0})}},
      {"strain of a slack length", {moved({Kind::kReferenceStrain, 1})}},
      {"strain with its length", {moved({Kind::kReferenceStrain, 2})}},
      {"slack length", {moved({Kind::kSlackLength, 1})}},
      {"slack length of a strain", {moved({Kind::kSlackLength, 0})}},
      {"stiffness", {moved({Kind::kStiffness, 0}, true), moved({Kind::kStiffness, 1}, true)}},
      {"stiffness of a quadratic law", {moved({Kind::kStiffness, 2}, true)}},
      {"transition strain", {moved({Kind::kTransitionStrain, 1})}},
      {"insertions",
       {insertion(0, OfBody::kMoving, 1, Held::kReferenceStrain),
        insertion(1, OfBody::kFixed, 2, Held::kSlackLength),
        insertion(2, OfBody::kMoving, 0, Held::kSlackLength),
        insertion(2, OfBody::kFixed, 0, Held::kReferenceStrain)}},
      {"insertion and strain",
       {insertion(0, OfBody::kFixed, 0, Held::kReferenceStrain),
        moved({Kind::kReferenceStrain, 0})}},
      {"insertion with the slack length held",
       {insertion(0, OfBody::kFixed, 1, Held::kSlackLength), moved({Kind::kSlackLength, 0})}},
      {"load", {moved({Kind::kLoadScale, 0}, true)}},
  };
}

TEST(FittedSceneText, ReadAgainIsTheFittedScene) {
  for (const char* length : {"mm", "cm", "m"})
    for (const char* angle : {"deg", "rad"})
      for (const auto& [name, parameters] : kinds()) {
        SCOPED_TRACE(std::string(name) + " in " + length + ", " + angle);
        const Scene scene = scene_in(length, angle);
        const CalibrationResult result = result_of(parameters);
        const std::string text = fitted_scene_text(scene, result);
        expect_same_numbers(parse_scene(text, scene.file), expected_of(scene, result));
      }
}

TEST(FittedSceneText, KeepsAllElseAsItStands) {
  const Scene scene = scene_in("mm", "deg");
  const auto lines = [&](const std::vector<FreeParameter>& parameters) {
    return changed_lines(scene, fitted_scene_text(scene, result_of(parameters)));
  };
  const auto strain = lines({moved({ParameterKind::kReferenceStrain, 0})});
  ASSERT_EQ(strain.size(), 1U);
  EXPECT_EQ(strain[0].substr(0, 29), "reference_strain = 0.03234567");
  EXPECT_EQ(strain[0].substr(strain[0].find("   #")), "   # as measured");
  const auto ends =
      lines({moved({ParameterKind::kInsertion, 0, OfBody::kMoving, 1, Held::kReferenceStrain})});
  ASSERT_EQ(ends.size(), 3U);  // the three numbers stand on three lines
  EXPECT_EQ(ends[1].substr(ends[1].find(',')), ", # µ between");
  EXPECT_EQ(ends[2], "   0.25] }] # behind");
  EXPECT_TRUE(lines({}).empty());
}

// A run that was stopped among its samples has fitted numbers all the same.
TEST(FittedSceneText, SaysWhetherItsNumbersAreAtALeast) {
  const Scene scene = scene_in("mm", "deg");
  CalibrationResult result = result_of({moved({ParameterKind::kReferenceStrain, 0})});
  result.stopped = true;
  const auto says_stopped = [&] {
    return fitted_scene_text(scene, result).find("; stopped before the least") != std::string::npos;
  };
  EXPECT_TRUE(says_stopped());
  result.fit.converged = true;
  EXPECT_FALSE(says_stopped());
}

TEST(FittedSceneText, AStrainKeepsItsMeaningWhereInsertionsMove) {
  const Scene scene = scene_in("mm", "deg");
  const CalibrationResult result =
      result_of({moved({ParameterKind::kInsertion, 0, OfBody::kFixed, 1, Held::kReferenceStrain})});
  const std::string text = fitted_scene_text(scene, result);
  EXPECT_NE(text.find("reference_strain = 0.02   # as measured"), std::string::npos);
}

TEST(FittedSceneText, RefusesANumberThatNoPlaceOfTheTextSays) {
  const Scene scene = scene_in("mm", "deg");
  try {
    (void)fitted_scene_text(scene, result_of({moved({ParameterKind::kTransitionStrain, 0})}));
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("some/knee.toml:"), std::string::npos) << what;
    EXPECT_NE(what.find("\"strained\": transition_strain"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

TEST(FittedSceneText, PathsAreToldFromItsOwnFolder) {
  namespace fs = std::filesystem;
  const fs::path knee = fs::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml";
  const Scene scene = read_scene(knee);
  const fs::path there = fs::path(testing::TempDir()) / "knee.fitted.toml";
  const Scene moved_scene = parse_scene(fitted_scene_text(scene, {}, there), there);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    EXPECT_TRUE(fs::equivalent(moved_scene.bodies[b].mesh->path, scene.bodies[b].mesh->path));
  EXPECT_EQ(fitted_scene_text(scene, {}, knee.parent_path() / "other.toml").find('\n') + 1 +
                scene.text.size(),
            fitted_scene_text(scene, {}).size());
}

TEST(FittedSceneText, AByteOrderMarkStaysNoPartOfIt) {
  Scene scene = scene_in("mm", "deg");
  scene.text = "\xEF\xBB\xBF" + scene.text;
  const std::string text = fitted_scene_text(scene, {});
  EXPECT_EQ(text.find("\xEF\xBB\xBF"), std::string::npos);
  EXPECT_NO_THROW((void)parse_scene(text, "fitted.toml"));
}

TEST(TextEdit, NumbersAreReadBackToTheLastBit) {
  for (const double unit : {1.0, 10.0, 1000.0, M_PI / 180})
    for (int k = 1; k < 2000; ++k) {
      const double factor = std::sin(k) * std::pow(10.0, k % 7 - 3);
      EXPECT_EQ(unit * std::stod(number_text(unit * factor, unit)), unit * factor);
    }
  EXPECT_EQ(number_text(3, 1), "3.0");  // a number with a fraction stays one
}

}  // namespace
}  // namespace condyle::test
