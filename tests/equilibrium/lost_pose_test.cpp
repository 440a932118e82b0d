/// A pose that is lost stays alone: what a sweep says at a value does not depend on its step nor on
/// its direction, a pose beyond the edge of a patch is told as one, and surfaces that have passed
/// through each other are no open contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "condyle/equilibrium/carried_pose.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/known_part.h"
#include "support/quadric_knee.h"
#include "support/same_sweep.h"
#include "support/truss.h"

namespace condyle {
namespace {

/// Values in degrees, as a scene gives them.
std::vector<double> values(double from, double to, double step) {
  std::vector<double> all;
  const int n = static_cast<int>(std::lround((to - from) / step));
  for (int k = 0; k <= n; ++k) all.push_back(kDegree * (from + k * step));
  return all;
}

SweepResult run(const Model& model, const std::vector<double>& flexions) {
  EquilibriumSolver solver(model);
  return sweep(solver, condition_value(0), flexions);
}

/// The sweeps that all have to say the same where they meet.
std::vector<SweepResult> every_way(const Model& model) {
  return {run(model, values(0, 120, 5)),  run(model, values(0, 120, 1)),
          run(model, values(120, 0, -5)), run(model, values(120, 0, -1)),
          run(model, values(60, 120, 5)), run(model, values(60, 0, -5))};
}

using ByValue = std::map<long, PoseResult>;
ByValue by_value(const SweepResult& sweep) {
  ByValue poses;
  for (const PoseResult& pose : sweep.poses) poses[std::lround(pose.value / kDegree)] = pose;
  return poses;
}

void expect_near(const PoseResult& a, const PoseResult& b, double tolerance) {
  EXPECT_LT((a.X_BA.p - b.X_BA.p).norm(), tolerance);
  EXPECT_LT((a.X_BA.R - b.X_BA.R).norm(), tolerance);
}

/// The knee of two ellipsoids with names for its surfaces.
Model knee() {
  Model model = test::quadric_knee();
  model.pairs[0].surface_B = "medial condyle";
  model.pairs[1].surface_B = "lateral condyle";
  model.pairs[0].surface_A = "medial plateau";
  model.pairs[1].surface_A = "lateral plateau";
  return model;
}

/// Of the medial contact on the condyle [mm].
double height(const PoseResult& pose) { return pose.contacts[0].points.at(0).point_ground.y(); }

/// Of the medial condyle a band is not known about which the contact rolls between two angles.
Model knee_with_unknown_band(const ByValue& whole, long first, long last) {
  Model model = knee();
  const double a = height(whole.at(first)), b = height(whole.at(last));
  const double middle = 0.5 * (a + b), half = 0.5 * std::abs(a - b);
  model.pairs[0].on_B = std::make_shared<test::KnownPart>(
      model.pairs[0].on_B,
      [=](const Eigen::Vector3d& c) { return std::abs(c.y() - middle) - half; });
  return model;
}

class UnknownBand : public testing::Test {
 protected:
  static constexpr long kFirst = 52, kLast = 68;
  ByValue whole = by_value(run(knee(), values(0, 120, 1)));
  Model model = knee_with_unknown_band(whole, kFirst, kLast);
};

TEST_F(UnknownBand, IsCrossedFromEverySideToTheSamePoses) {
  for (const SweepResult& sweep : every_way(model)) {
    SCOPED_TRACE(testing::Message()
                 << sweep.poses.size() << " poses from " << sweep.poses[0].value / kDegree);
    for (const auto& [degrees, pose] : by_value(sweep)) {
      SCOPED_TRACE(degrees);
      // The contact of great angles comes back to the heights of the band.
      const double a = height(whole.at(kFirst)), b = height(whole.at(kLast));
      const double y = height(whole.at(degrees));
      const bool within = y > std::min(a, b) && y < std::max(a, b);
      if (degrees != kFirst && degrees != kLast) {
        EXPECT_EQ(name(pose.status), std::string(within ? "left patch" : "converged"))
            << pose.reason;
      }
      if (pose.solved()) expect_near(pose, whole.at(degrees), 1e-7);
    }
  }
}

TEST_F(UnknownBand, IsToldWithTheContactTheSurfaceTheSideAndTheDistance) {
  for (const auto& [degrees, pose] : by_value(run(model, values(0, 120, 5)))) {
    if (pose.status != PoseStatus::kLeftPatch) continue;
    for (const char* words :
         {"contact \"medial\"", "mm beyond the ", "\"medial condyle\"", "of the joint's origin"})
      EXPECT_NE(pose.reason.find(words), std::string::npos) << degrees << ": " << pose.reason;
    EXPECT_LT(pose.contacts[0].points[0].edge_distance, 0);
    EXPECT_TRUE(pose.joint_stiffness || pose.lowest_stiffness > 0);  // all of it is there
  }
}

// A ligament whose force is no number over some lengths: there is no equilibrium at all while it has
// such a length, and the sweep goes on behind.
TEST(LostPoses, WithoutAnyEquilibriumStayAlone) {
  const ByValue whole = by_value(run(knee(), values(0, 120, 1)));
  Model model = knee();
  LineElement& bursting = model.elements[4];  // aMCL
  const auto length = [&](long degrees) {
    return line_element_state(bursting, whole.at(degrees).X_BA).length;
  };
  const double least = std::min(length(53), length(67)), most = std::max(length(53), length(67));
  CustomLaw law;
  law.tension = [inner = bursting.law, least, most](double at) {
    Tension tension = condyle::tension(inner, at);
    if (at > least && at < most) tension.force = tension.energy = NAN;
    return tension;
  };
  bursting.law = law;
  for (const SweepResult& sweep : every_way(model)) {
    SCOPED_TRACE(testing::Message()
                 << sweep.poses.size() << " poses from " << sweep.poses[0].value / kDegree);
    for (const auto& [degrees, pose] : by_value(sweep)) {
      SCOPED_TRACE(degrees);
      if (pose.converged()) expect_near(pose, whole.at(degrees), 1e-7);
      // Behind its greatest length the strand comes back to those of the band.
      const bool within = length(degrees) > least && length(degrees) < most;
      if (within && degrees != 53 && degrees != 67) {
        EXPECT_FALSE(pose.converged());
        EXPECT_NE(pose.reason.find("\"aMCL\" has no finite force"), std::string::npos)
            << pose.reason;
      } else if (degrees != 53 && degrees != 67) {
        EXPECT_TRUE(pose.converged()) << pose.reason;
      }
    }
  }
}

// Poses that do not converge wait for the next one that does: all are told once, in order.
TEST_F(UnknownBand, PosesAreToldOnceAndInOrder) {
  EquilibriumSolver solver(model);
  SweepOptions options;
  std::vector<double> told, computed;
  options.on_pose = [&](const PoseResult& pose) { told.push_back(pose.value); };
  options.on_computed = [&](const KnownPose& known) { computed.push_back(known.pose.value); };
  const std::vector<double> flexions = values(0, 120, 5);
  const SweepResult result = sweep(solver, condition_value(0), flexions, options);
  EXPECT_EQ(told, flexions);
  EXPECT_EQ(computed, flexions);
}

// Those that wait are told beforehand, and a sweep that takes them over before they are final is the one that was
// never stopped: it looks for them from the next pose that converges.
TEST_F(UnknownBand, PosesThatWaitAreToldAndTakenOver) {
  const std::vector<double> flexions = values(0, 120, 5);
  std::vector<KnownPose> told;
  SweepOptions options;
  options.on_open = [&](const KnownPose& known) {
    EXPECT_TRUE(known.open);
    EXPECT_FALSE(known.pose.converged());
    told.push_back(known);
  };
  options.on_computed = [&](const KnownPose& known) {
    EXPECT_FALSE(known.open);
    told.push_back(known);
  };
  EquilibriumSolver solver(model);
  const SweepResult unstopped = sweep(solver, condition_value(0), flexions, options);
  ASSERT_GT(told.size(), flexions.size() + 1);
  const auto first_open =
      std::find_if(told.begin(), told.end(), [](const KnownPose& known) { return known.open; });
  for (auto stop = first_open; stop != told.end() && stop->open; ++stop) {
    EquilibriumSolver again(model);
    SweepOptions resumed;
    resumed.known.assign(told.begin(), stop + 1);
    std::vector<double> computed;
    resumed.on_open = [&](const KnownPose& known) { computed.push_back(known.pose.value); };
    resumed.on_computed = resumed.on_open;
    test::expect_same_sweep(unstopped, sweep(again, condition_value(0), flexions, resumed));
    // As final, what was open is told again.
    EXPECT_NE(std::find(computed.begin(), computed.end(), first_open->pose.value), computed.end());
  }
}

// In the range of a snap-through both branches are equilibria, and the sweep says so on the way up
// and on the way down.
TEST(SecondEquilibrium, OfASnapThroughIsToldOnEitherWay) {
  using test::Truss;
  const std::vector<double> up = {-12, -8, -4, 0, 4, 8, 12};
  const std::vector<double> down(up.rbegin(), up.rend());
  for (const std::vector<double>& loads : {up, down}) {
    EquilibriumSolver solver(Truss::model());
    const SweepResult result = sweep(solver, load_scale(0), loads);
    for (const PoseResult& pose : result.poses) {
      SCOPED_TRACE(pose.value);
      ASSERT_TRUE(pose.converged()) << pose.reason;
      const bool two = std::abs(pose.value) < Truss::limit_load();
      const bool told = pose.remark.find("second position of equilibrium") != std::string::npos;
      EXPECT_TRUE(!told || two) << pose.remark;
      EXPECT_TRUE(told || !two);
    }
  }
}

// Past the limit load the truss snaps through: one pose, and only that, is told to lie far from the
// one before it.
TEST(Jumps, ABodyThatMovedFarBetweenTwoPosesIsTold) {
  using test::Truss;
  EquilibriumSolver solver(Truss::model());
  const std::vector<double> loads = {-12, -8, -4, 0, 4, 8, 12};
  const SweepResult result = sweep(solver, load_scale(0), loads);
  int told = 0;
  for (std::size_t k = 1; k < loads.size(); ++k) {
    const PoseResult &before = result.poses[k - 1], &pose = result.poses[k];
    const double moved = (pose.X_BA.p - before.X_BA.p).norm();
    const bool says =
        pose.remark.find("since the pose before it the body moved") != std::string::npos;
    EXPECT_EQ(says, moved > 0.5 * solver.model().length) << loads[k] << ": " << moved << " mm";
    told += says;
  }
  EXPECT_EQ(told, 1);
}

// The tibia far above the femur's condyles: nothing faces, both contacts would be open.
TEST(PassedThrough, AStartOnTheWrongSideIsOverlapAtOnce) {
  Model model = knee();
  const auto within = [](const Eigen::Vector3d& c) { return 25 - std::hypot(c.x() - 23, c.y()); };
  model.pairs[1].on_A = std::make_shared<test::KnownPart>(model.pairs[1].on_A, within);
  EquilibriumSolver right(model);
  EXPECT_TRUE(right.solve().converged());
  model.start.p.z() += 80;
  EquilibriumSolver wrong(model);
  const PoseResult pose = wrong.solve();
  EXPECT_EQ(pose.status, PoseStatus::kOverlap) << pose.reason;
  EXPECT_NE(pose.reason.find("contact \"lateral\": the surfaces have passed through each other"),
            std::string::npos)
      << pose.reason;
  EXPECT_EQ(pose.iterations, 0);
}

TEST(CarriedPose, HasThePrescribedCoordinatesAndKeepsTheOthers) {
  Model model = knee();
  const RigidTransform from{exp_rotation({0.2, -0.1, 0.3}), {1, -2, 3}};
  const JointCoordinates before = joint_coordinates(*model.joint, from);
  const Drive drive = condition_value(0).with(drive_of(model), 1.1);
  const JointCoordinates q = joint_coordinates(*model.joint, carried(model, drive, from));
  EXPECT_NEAR(q.flexion, 1.1, 1e-12);
  EXPECT_NEAR(q.adduction, before.adduction, 1e-12);
  EXPECT_NEAR(q.internal_rotation, before.internal_rotation, 1e-12);
  EXPECT_NEAR(q.lateral_shift, before.lateral_shift, 1e-12);
  EXPECT_NEAR(q.anterior_drawer, before.anterior_drawer, 1e-12);
  EXPECT_NEAR(q.distraction, before.distraction, 1e-12);
}

TEST(CarriedPose, MeetsConditionsWithoutAJoint) {
  Model model;
  model.length = 30;
  KinematicCondition height;
  height.kind = ConditionKind::kTranslation;
  height.axis = Eigen::Vector3d::UnitZ();
  height.value = 7;
  KinematicCondition turn;
  turn.kind = ConditionKind::kRotation;
  turn.cardan_axis = 0;
  turn.value = 0.8;
  model.conditions = {height, turn};
  const RigidTransform X =
      carried(model, drive_of(model), {Eigen::Matrix3d::Identity(), {1, 2, 3}});
  for (const KinematicCondition& condition : model.conditions)
    EXPECT_NEAR(evaluate(condition, condition.value, X).k, 0, 1e-10);
  EXPECT_NEAR(X.p.x(), 1, 1e-10);
  EXPECT_NEAR(X.p.y(), 2, 1e-10);
}

// At 90 degrees the axes of a Cardan angle are parallel: what prescribes it may hold there, but has no direction to carry
// along. The shipped spring asks nothing of it; one that pulls sideways does.
TEST(GimbalLock, AConditionWithoutADirectionCarriesNothing) {
  for (const bool sideways : {false, true}) {
    Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/hard/cardan.toml");
    if (sideways) scene.ligaments[0].ends[0].at.x() = 30;
    const SweepResult swept = sweep(scene, fit_surfaces(scene));
    ASSERT_EQ(swept.poses.size(), 7U);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_TRUE(swept.poses[i].converged()) << i;
    const PoseResult& locked = swept.poses[5];
    EXPECT_NEAR(locked.value, M_PI / 2, 1e-12);
    EXPECT_EQ(locked.status, sideways ? PoseStatus::kSingular : PoseStatus::kConverged);
    if (sideways) {
      EXPECT_NE(locked.reason.find("\"rotation x\": its first and last axes are parallel"),
                std::string::npos)
          << locked.reason;
    }
  }
}

}  // namespace
}  // namespace condyle
