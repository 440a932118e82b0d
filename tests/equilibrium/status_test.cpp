/// Every status that is not "converged", reached on purpose, with a reason that names the culprit.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/ball_on_floor.h"
#include "support/hold.h"
#include "support/known_part.h"
#include "support/quadric_knee.h"

namespace condyle {
namespace {

using test::add, test::held;

Model ball_on_floor() {
  Model model = test::ball_on_floor("weight", -10);
  model.start.p = {0, 0, 10.5};
  return model;
}

void add_spring(Model& model,
                const char* name,
                const Eigen::Vector3d& x_C,
                const Eigen::Vector3d& s_D,
                const ForceLaw& law) {
  LineElement& element = model.elements.emplace_back();
  element.x_C = x_C;
  element.s_D = s_D;
  element.law = law;
  model.element_names.emplace_back(name);
}

PoseResult solve(Model model, const EquilibriumOptions& options = {}) {
  EquilibriumSolver solver(std::move(model), options);
  return solver.solve();
}

void expect_reason(const PoseResult& pose, PoseStatus status, const std::string& words) {
  EXPECT_EQ(name(pose.status), std::string(name(status))) << pose.reason;
  EXPECT_NE(pose.reason.find(words), std::string::npos) << pose.reason;
}

TEST(Status, ConditionsThatSayTheSameAreNamed) {
  Model model = ball_on_floor();
  add(model, "x", held(ConditionKind::kTranslation, 0));
  add(model, "other", held(ConditionKind::kTranslation, 1));
  add(model, "x again", held(ConditionKind::kTranslation, 0));
  expect_reason(solve(model), PoseStatus::kSingular,
                "conditions \"x\" and \"x again\" depend on each other");
}

TEST(Status, ConditionsThatContradictEachOtherSaySo) {
  Model model = ball_on_floor();
  add(model, "x", held(ConditionKind::kTranslation, 0, 0));
  add(model, "x again", held(ConditionKind::kTranslation, 0, 2));
  expect_reason(solve(model), PoseStatus::kSingular,
                "conditions \"x\" and \"x again\" depend on each other and cannot all hold");
}

// The floor and the condition both say how high the ball is.
TEST(Status, AConditionThatRepeatsAContactIsNamedWithIt) {
  for (const double height : {9.0, 12.0}) {
    Model model = ball_on_floor();
    model.start.p.z() = height;
    model.pairs[0].mode = ContactMode::kClosed;
    add(model, "height", held(ConditionKind::kTranslation, 2, height));
    expect_reason(solve(model), PoseStatus::kSingular,
                  "condition \"height\" and contact \"floor\" depend on each other");
  }
}

// Two fibres that would have to be longer than their ends are apart.
TEST(Status, FibresThatCannotBothHaveTheirLengthAreNamed) {
  Model model;
  KinematicCondition left = held(ConditionKind::kDistance, 0, 4), right = left;
  left.x_C = {-10, 0, 0};
  right.x_C = {10, 0, 0};
  add(model, "left", left);
  add(model, "right", right);
  model.start.p = {1, 3, 1};
  model.length = 10;
  expect_reason(solve(model), PoseStatus::kSingular, "conditions \"left\" and \"right\"");
}

TEST(Status, SevenConditionsAreNamed) {
  Model model = ball_on_floor();
  for (int k = 0; k < 6; ++k)
    add(model, "one of six",
        held(k < 3 ? ConditionKind::kTranslation : ConditionKind::kRotation, k % 3,
             k == 2 ? 12 : 0));
  add(model, "the seventh", held(ConditionKind::kTranslation, 0));
  expect_reason(solve(model), PoseStatus::kSingular, "\"the seventh\"");
}

// A moment about the vertical turns the ball on the spot: nothing resists.
TEST(Status, ALoadThatNothingCarriesIsNamed) {
  Model model = ball_on_floor();
  model.loads[0].vector = {0, 0, 10};
  model.load_names[0] = "balloon";
  expect_reason(solve(model), PoseStatus::kNoEquilibrium, "\"balloon\"");
}

TEST(Status, ALineElementWithoutLengthIsNamed) {
  Model model;
  model.length = 10;
  for (int k = 0; k < 3; ++k) add(model, "hold", held(ConditionKind::kTranslation, k));
  for (int k = 0; k < 3; ++k) add(model, "turn", held(ConditionKind::kRotation, k));
  add_spring(model, "point", {1, 2, 3}, {1, 2, 3}, QuadraticLaw{10, 5});
  expect_reason(solve(model), PoseStatus::kZeroLength, "\"point\"");
}

TEST(Status, AForceThatOverflowsIsNamed) {
  Model model = ball_on_floor();
  CustomLaw law;
  law.tension = [](double length) {
    const double f = length > 20 ? std::numeric_limits<double>::infinity() : 1.0;
    return Tension{f, 0, f};
  };
  add_spring(model, "bursting", {0, 0, 60}, {0, 0, 0}, law);
  expect_reason(solve(model), PoseStatus::kDiverged, "\"bursting\"");
}

TEST(Status, AnIterationLimitSaysWhatIsStillOff) {
  Model model = test::quadric_knee();
  model.conditions[0].value = 1.5;
  EquilibriumOptions options;
  options.newton.max_iterations = 1;
  options.descent.max_steps = 1;
  expect_reason(solve(model, options), PoseStatus::kIterationLimit, "condition \"flexion\" is");
}

TEST(Status, AContactBeyondTheKnownSurfaceIsNamed) {
  Model model = ball_on_floor();
  model.pairs[0].on_B = std::make_shared<test::KnownPart>(
      model.pairs[0].on_B, [](const Eigen::Vector3d& c) { return -c.x(); });
  add(model, "x", held(ConditionKind::kTranslation, 0, -1));
  add(model, "y", held(ConditionKind::kTranslation, 1));
  for (int k = 0; k < 3; ++k) add(model, "turn", held(ConditionKind::kRotation, k));
  model.start.p.x() = -1;
  EquilibriumSolver solver(std::move(model));
  const PoseResult inside = solver.solve();
  EXPECT_TRUE(inside.converged()) << inside.reason;
  expect_reason(solver.solve(condition_value(0).with(drive_of(solver.model()), 0.5)),
                PoseStatus::kLeftPatch, "\"floor\"");
}

// A ball in a socket that is too small for it, another beyond the edge of a floor: whichever contact comes first, it is no
// equilibrium.
TEST(Status, DoesNotHangOnTheOrderOfContacts) {
  const std::string
      head = R"(
units = { length = "mm", angle = "deg", force = "N" }
body = [{ name = "g", fixed = true }, { name = "m", start = { translation = [0, 0, 0] } }]
surface = [
  { name = "socket", body = "g", kind = "sphere", center = [0, 0, 8], radius = 8, solid = "outside" },
  { name = "ball", body = "m", kind = "sphere", center = [0, 0, 10], radius = 10 },
  { name = "floor", body = "g", kind = "plane", point = [85, 0, 0], normal = [0, 0, 1], radius = 5 },
  { name = "other ball", body = "m", kind = "sphere", center = [100, 0, 10], radius = 10 } ]
condition = [
  { name = "tx", kind = "translation", axis = "x", value = 0 },
  { name = "ty", kind = "translation", axis = "y", value = 0 },
  { name = "rx", kind = "rotation", axis = "x", value = 0 },
  { name = "rz", kind = "rotation", axis = "z", value = 0 } ]
load = [{ name = "push", body = "m", kind = "force", vector = [0, 0, -10], at = [50, 0, 0] }]
sweep = { vary = "push.scale", values = [1] }
)",
      tight =
          R"({ name = "tight", surfaces = ["socket", "ball"], state = "closed", start = [[0, 0, 0]] })",
      off =
          R"({ name = "off", surfaces = ["floor", "other ball"], state = "closed", start = [[100, 0, 0]] })";
  for (const bool turned : {false, true}) {
    const std::string contacts = turned ? off + ", " + tight : tight + ", " + off;
    const Scene scene = parse_scene(head + "contact = [" + contacts + "]", "knee.toml");
    const SweepResult found = sweep(scene, fit_surfaces(scene));
    expect_reason(found.poses[0], PoseStatus::kOverlap, "interpenetrate");
  }
}

// Conditions hold the ball 3 mm deep in the floor, from which it cannot come.
TEST(Status, ABodyHeldInsideTheOtherIsNamed) {
  Model model = ball_on_floor();
  add(model, "height", held(ConditionKind::kTranslation, 2, 7));
  model.start.p.z() = 7;
  expect_reason(
      solve(model), PoseStatus::kOverlap,
      "condition \"height\" and contact \"floor\" depend on each other and cannot all hold");
}

// Two floors in one, held apart by no condition: a ball between two walls that are too near.
TEST(Status, ABallThatDoesNotFitBetweenTwoWallsOverlaps) {
  Model model = ball_on_floor();
  ContactPair roof = model.pairs[0];
  roof.name = "roof";
  roof.on_B = make_plane({0, 0, 18}, {0, 0, -1});
  model.pairs.push_back(roof);
  model.start.p.z() = 9;
  expect_reason(solve(model), PoseStatus::kOverlap,
                "contacts \"floor\" and \"roof\" depend on each other and cannot all hold");
}

}  // namespace
}  // namespace condyle
