#include "condyle/equilibrium/stability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/motion_name.h"
#include "support/ball_on_floor.h"
#include "support/hold.h"
#include "support/quadric_knee.h"
#include "support/truss.h"

namespace condyle {
namespace {

/// Stability and its remark at a state.
struct Judged {
  Stability stability;
  std::string remark;
};

Judged judge(const Model& model, const EquilibriumState& state) {
  NewtonSystem system(model);
  const Drive drive = drive_of(model);
  system.assemble(state, drive);
  const Linearization at = linearization(system, state, drive);
  Judged judged{stability(at), {}};
  judged.remark = stability_remark(at, judged.stability);
  return judged;
}

EquilibriumState unloaded(const Model& model, const RigidTransform& X = {}) {
  return {X, {}, std::vector<double>(model.conditions.size(), 0.0)};
}

KinematicCondition prescribed(ConditionKind kind, const JointFrames& frames) {
  KinematicCondition condition;
  condition.kind = kind;
  condition.frames = frames;
  return condition;
}

// Pushed down, the truss resists by -dP/dz, which changes its sign at the limit height.
TEST(Stability, OfATrussIsTheSlopeOfItsLoad) {
  using test::Truss;
  Model model = Truss::model();
  for (const double z : {5.0, 3.0, 2.5, 0.5, -4.0}) {
    model.loads[0].scale = Truss::load(z);
    const Judged judged = judge(model, unloaded(model, {Eigen::Matrix3d::Identity(), {0, 0, z}}));
    const double slope = (Truss::load(z + 1e-5) - Truss::load(z - 1e-5)) / 2e-5;
    EXPECT_NEAR(judged.stability.lowest_stiffness, -slope, 1e-6) << z;
    EXPECT_EQ(judged.stability.stable(), std::abs(z) > Truss::limit_height()) << z;
    EXPECT_FALSE(judged.stability.neutral);
    if (!judged.stability.stable()) {
      EXPECT_NE(judged.remark.find("unstable along a translation along (0.00, 0.00, 1.00)"),
                std::string::npos)
          << judged.remark;
    }
  }
}

TEST(Stability, OfSixConditionsLeavesNoMotion) {
  Model model;
  for (int i = 0; i < 6; ++i)
    test::hold(model, i < 3 ? ConditionKind::kTranslation : ConditionKind::kRotation, i % 3);
  const Judged judged = judge(model, unloaded(model));
  EXPECT_EQ(judged.stability.lowest_stiffness, INFINITY);
  EXPECT_TRUE(judged.stability.stable());
  EXPECT_EQ(judged.remark, "");
}

// Slack ligaments resist nothing: what is not prescribed is free, in the words of the joint.
TEST(Stability, NamesTheCoordinatesThatSlackLigamentsLeaveFree) {
  Model model = test::quadric_knee();
  for (LineElement& element : model.elements) element.law = ToeLinearLaw{1000, 0.06, 500};
  model.loads.clear();
  model.load_names.clear();
  model.conditions.clear();
  model.condition_names.clear();
  EXPECT_EQ(judge(model, unloaded(model)).remark, "neutral: nothing resists any motion");
  const auto prescribe = [&model](ConditionKind kind, const char* name) {
    model.conditions.push_back(prescribed(kind, *model.joint));
    model.condition_names.emplace_back(name);
  };
  prescribe(ConditionKind::kFlexion, "flexion");
  prescribe(ConditionKind::kAdduction, "adduction");
  prescribe(ConditionKind::kLateralShift, "shift");
  EXPECT_EQ(judge(model, unloaded(model)).remark,
            "neutral: nothing resists internal rotation, anterior drawer and distraction");
  prescribe(ConditionKind::kAnteriorDrawer, "drawer");
  prescribe(ConditionKind::kDistraction, "distraction");
  EXPECT_EQ(judge(model, unloaded(model)).remark, "neutral: nothing resists internal rotation");
}

// A body on two hinges' worth of conditions turns about the line through them.
TEST(Stability, NamesAnAxisWhereThereIsNoJoint) {
  Model model;
  model.length = 10;
  for (const double z : {-10.0, 10.0}) {
    for (int axis = 0; axis < (z < 0 ? 3 : 2); ++axis) {
      KinematicCondition fibre;  // long fibres to far away hold a point of the body
      fibre.kind = ConditionKind::kDistance;
      fibre.s_D = {3, 4, z};
      fibre.x_C = fibre.s_D + 50 * Eigen::Vector3d::Unit(axis);
      fibre.value = 50;
      model.conditions.push_back(fibre);
      model.condition_names.emplace_back("fibre");
    }
  }
  const std::string remark = judge(model, unloaded(model)).remark;
  const std::string start =
      "neutral: nothing resists a rotation about (0.00, 0.00, 1.00) through (3.00, 4.00, 0.00) mm";
  EXPECT_EQ(remark.substr(0, start.size()), start) << remark;
  // The name does not depend on which way the eigenvector comes out.
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
  for (const int axis : {0, 1, 2, 3, 4, 5}) motion[axis] = axis % 3 == 1 ? -0.5 : 1;
  EXPECT_EQ(name_motions(model, {}, motion), name_motions(model, {}, -motion));
  motion.tail<3>().setZero();
  EXPECT_EQ(name_motions(model, {}, -motion), "a translation along (0.67, -0.33, 0.67)");
}

// A ball on a floor with a weight may roll anywhere and spin.
TEST(Stability, OfABallOnAFloorIsNeutral) {
  const Model model = test::ball_on_floor("weight", -10);
  EquilibriumState state = unloaded(model, {Eigen::Matrix3d::Identity(), {0, 0, 10}});
  state.contacts = {{0, {Place{{0, 0, 0}}, Place{{0, 0, -10}}}, 10}};
  const Judged judged = judge(model, state);
  EXPECT_TRUE(judged.stability.neutral);
  EXPECT_EQ(judged.stability.free.cols(), 5);
  EXPECT_EQ(judged.stability.free.row(2).norm(), 0);  // all but up and down
}

TEST(Stability, SaysThatRedundantConstraintsShareWhatTheyCarry) {
  Model model = test::Truss::model();
  model.conditions.push_back(model.conditions[0]);
  model.condition_names.emplace_back("hold 0 again");
  model.conditions.erase(model.conditions.begin() + 4);
  model.condition_names.erase(model.condition_names.begin() + 4);
  const Judged judged = judge(model, unloaded(model, model.start));
  EXPECT_TRUE(judged.stability.dependent);
  EXPECT_NE(judged.remark.find("conditions \"hold 0\" and \"hold 0 again\" depend on each other"),
            std::string::npos)
      << judged.remark;
}

TEST(Stability, JoinsWords) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b"}), "a and b");
  EXPECT_EQ(joined({"a", "b", "c"}), "a, b and c");
}

}  // namespace
}  // namespace condyle
