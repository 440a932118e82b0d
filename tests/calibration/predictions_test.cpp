/// Predictions of a table's rows and their derivatives: against sweeps, and against differences of
/// evaluations, on rigid and layered contact, straight and wrapped lines, right and left.

#include "condyle/calibration/predictions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/measured_knee.h"
#include "support/random.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A knee with its table and the numbers that are free.
struct Measured {
  Scene scene = measured_knee();
  MeasurementTable table;
  std::vector<FreeParameter> parameters;

  Measured() { table.file = "knee.csv"; }
  [[nodiscard]] Predictions predictions() const {
    return {scene, fit_surfaces(scene), table, parameters};
  }
  Measurement& add_row(
      MeasuredKind kind, std::size_t index, int load, double level, double flexion) {
    Measurement row;
    row.line = static_cast<int>(table.rows.size()) + 2;
    row.test = "forces";
    row.flexion = flexion * kDegree;
    row.load = load;
    row.level = level;
    row.kind = kind;
    row.index = index;
    return table.rows.emplace_back(row);
  }
};

/// Coordinates, reaction and forces under both kinds of control, told absolutely and relatively.
Measured all_kinds() {
  Measured knee;
  knee.scene.calibration->relative = {"varus", "drawn"};
  add_coordinates("passive", 20 * kDegree, -1, 0, knee.table);
  add_coordinates("anterior", 20 * kDegree, 0, 80, knee.table);
  add_coordinates("varus", 20 * kDegree, 1, -6000, knee.table);
  add_coordinates("drawn", 20 * kDegree, 3, -9, knee.table);
  for (const int load : {0, 3}) {
    const double level = load == 0 ? 80 : -9;
    for (const std::size_t ligament : {0, 1, 3, 5, 8})
      knee.add_row(MeasuredKind::kLigamentForce, ligament, load, level, 20);
    for (const std::size_t contact : {0, 1})
      knee.add_row(MeasuredKind::kContactForce, contact, load, level, 20);
  }
  knee.add_row(MeasuredKind::kReaction, 0, 3, -9, 20);
  for (const std::size_t coordinate : {2, 4})
    knee.add_row(MeasuredKind::kJointCoordinate, coordinate, 0, 80, 20).laxity = true;
  return knee;
}

/// Rows that are compared with each other: of one kind, angles apart from lengths.
int group_of(const Measurement& row) {
  const bool angle = row.kind == MeasuredKind::kJointCoordinate && row.index < 3;
  return angle ? -1 : static_cast<int>(row.kind);
}

double step_of(const FreeParameter& parameter) {
  if (parameter.kind == FreeParameter::Kind::kCurveOffset) return 1e-2;
  if (parameter.kind != FreeParameter::Kind::kNumber) return parameter.component < 3 ? 0.05 : 1e-3;
  switch (parameter.moves[0].first.kind) {
    case ParameterKind::kReferenceStrain:
    case ParameterKind::kTransitionStrain:
      return 1e-4;
    case ParameterKind::kStiffness:
    case ParameterKind::kLoadScale:
      return 1e-3;
    default:
      return 3e-3;  // mm
  }
}

/// Every column by differences of fourth order, relative to the greatest entry of the row's group.
void expect_exact(const Measured& knee, const VectorXd& theta, double h = 1) {
  Predictions predictions = knee.predictions();
  VectorXd y;
  MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(theta, y, &J)) << predictions.failure();
  ASSERT_EQ(J.cols(), static_cast<Eigen::Index>(knee.parameters.size()));
  ASSERT_TRUE(J.allFinite());
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const FreeParameter& parameter = knee.parameters[static_cast<std::size_t>(j)];
    const double step = h * step_of(parameter);
    VectorXd expected = VectorXd::Zero(y.size()), there;
    for (const auto& [steps, weight] :
         {std::pair{1, 8.0}, std::pair{-1, -8.0}, std::pair{2, -1.0}, std::pair{-2, 1.0}}) {
      VectorXd moved = theta;
      moved[j] += steps * step;
      ASSERT_TRUE(predictions.evaluate(moved, there, nullptr)) << predictions.failure();
      expected += weight * there / (12 * step);
    }
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const int group = group_of(knee.table.rows[static_cast<std::size_t>(i)]);
      double greatest = 0, value = 1e-3;
      for (Eigen::Index k = 0; k < y.size(); ++k) {
        if (group_of(knee.table.rows[static_cast<std::size_t>(k)]) != group) continue;
        greatest = std::max(greatest, std::abs(expected[k]));
        value = std::max(value, std::abs(y[k]));
      }
      constexpr double kRoundOff = 1e-11;  // of what Newton leaves
      EXPECT_NEAR(J(i, j), expected[i], 1e-6 * greatest + kRoundOff * value / step)
          << parameter.name << ", row " << i;
    }
  }
}

VectorXd some_theta(const Measured& knee, double part, unsigned seed = 3) {
  Random random(seed);
  VectorXd theta(static_cast<Eigen::Index>(knee.parameters.size()));
  for (Eigen::Index j = 0; j < theta.size(); ++j)
    theta[j] = part * knee.parameters[static_cast<std::size_t>(j)].prior_sd * random.between(-1, 1);
  return theta;
}

void free_all_of_ligaments(Measured& knee, const std::vector<std::size_t>& ligaments) {
  for (const std::size_t i : ligaments) {
    const std::string name = knee.scene.ligaments[i].name;
    knee.parameters.push_back(
        free_number(name + ".reference_strain", {ParameterKind::kReferenceStrain, i}, 0.03));
    knee.parameters.push_back(
        free_number(name + ".stiffness", {ParameterKind::kStiffness, i}, 0.3, true));
    knee.parameters.push_back(
        free_number(name + ".transition_strain", {ParameterKind::kTransitionStrain, i}, 0.01));
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving}) {
      // In a tangent plane that is none of the axes, and along its normal.
      const Eigen::Matrix3d axes = exp_rotation({0.4, -0.7, 0.2});
      for (int k = 0; k < 3; ++k) {
        FreeParameter parameter = free_number(name + ".insertion", {}, k < 2 ? 2 : 0.5);
        parameter.moves.clear();
        for (const int c : {0, 1, 2})
          parameter.moves.push_back(
              {{ParameterKind::kInsertion, i, body, c, Held::kReferenceStrain}, axes(c, k)});
        knee.parameters.push_back(parameter);
      }
    }
  }
}

void free_frames(Measured& knee) {
  for (const auto kind : {FreeParameter::Kind::kFemurFrame, FreeParameter::Kind::kTibiaFrame})
    for (int component = 0; component < 6; ++component) {
      FreeParameter parameter;
      parameter.name = "frame " + std::to_string(component);
      parameter.kind = kind;
      parameter.component = component;
      parameter.prior_sd = component < 3 ? 2 : 2 * kDegree;
      knee.parameters.push_back(parameter);
    }
}

TEST(Predictions, ALaxityIsTheDifferenceOfOppositeLevels) {
  Measured knee;
  add_coordinates("there", 30 * kDegree, 0, 100, knee.table);
  add_coordinates("back", 30 * kDegree, 0, -100, knee.table);
  for (std::size_t c = 1; c < 6; ++c)
    knee.add_row(MeasuredKind::kJointCoordinate, c, 0, 100, 30).laxity = true;
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions();
  VectorXd y;
  MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(VectorXd::Zero(12), y, &J)) << predictions.failure();
  EXPECT_LT((y.segment(10, 5) - y.segment(0, 5) + y.segment(5, 5)).norm(), 1e-14);
  EXPECT_LT((J.middleRows(10, 5) - J.middleRows(0, 5) + J.middleRows(5, 5)).norm(), 1e-12);
  EXPECT_GT(y[13], 1);  // [mm]
}

TEST(Predictions, AreTheJointCoordinatesOfASweepAtThoseLoads) {
  Measured knee;
  knee.scene.calibration->relative = {"relative"};
  add_coordinates("anterior", 30 * kDegree, 0, 50, knee.table);
  add_coordinates("anterior", 30 * kDegree, 0, 100, knee.table);
  add_coordinates("relative", 30 * kDegree, 0, 100, knee.table);
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd::Zero(12), y, nullptr)) << predictions.failure();

  // The same knee without what other tests hold.
  Scene scene = knee.scene;
  scene.conditions.resize(1);
  EquilibriumSolver solver(build_model(scene, fit_surfaces(scene)));
  SweepOptions options;
  options.drive = drive_of(solver.model());
  options.drive->scales = {0, 0, 0};
  std::vector<double> flexions, levels;
  for (int i = 0; i <= 6; ++i) flexions.push_back(5 * kDegree * i);
  for (int i = 0; i <= 10; ++i) levels.push_back(0.1 * i);
  (void)sweep(solver, condition_value(0), flexions, options);
  options.drive->values[0] = 30 * kDegree;
  const SweepResult drawer = sweep(solver, load_scale(0), levels, options);
  ASSERT_EQ(drawer.count_converged(), 11);
  EXPECT_GT(drawer.poses.back().joint.anterior_drawer - drawer.poses[0].joint.anterior_drawer, 0.5);
  for (std::size_t c = 1; c < 6; ++c) {
    const auto of = [&](std::size_t pose) {
      return drawer.poses[pose].joint.*kJointCoordinates[c].member;
    };
    const auto row = static_cast<Eigen::Index>(c) - 1;
    EXPECT_NEAR(y[row], of(5), 1e-9);
    EXPECT_NEAR(y[5 + row], of(10), 1e-9);
    EXPECT_NEAR(y[10 + row], of(10) - of(0), 1e-9);
  }
}

// What holds the drawer does the work on the ligaments: its integral over the drawer is what they store
// more of, and it is positive where it drives the drawer up.
TEST(Predictions, TheReactionIsTheWorkOfWhatIsHeld) {
  Measured knee;
  const std::vector<double> drawn = {-7.6, -7.4, -7.2};
  for (const double level : drawn) {
    knee.add_row(MeasuredKind::kReaction, 0, 3, level, 20);
    for (std::size_t i = 0; i < 12; ++i)
      knee.add_row(MeasuredKind::kLigamentForce, i, 3, level, 20);
  }
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr)) << predictions.failure();
  // Energy by the force of a toe-linear law, which tells the strain.
  const auto energy = [&](Eigen::Index pose) {
    double sum = 0;
    for (std::size_t i = 0; i < 12; ++i) {
      const auto& law = std::get<ToeLinearLaw>(knee.scene.ligaments[i].law);
      const double force = y[13 * pose + 1 + static_cast<Eigen::Index>(i)];
      const double k = law.stiffness, toe = law.transition_strain;
      const double strain =
          force > k * toe / 2 ? force / k + toe / 2 : std::sqrt(2 * toe * force / k);
      sum += tension(law, law.slack_length * (1 + strain)).energy;
    }
    return sum;
  };
  const double work = (drawn[2] - drawn[0]) / 6 * (y[0] + 4 * y[13] + y[26]);
  EXPECT_GT(std::abs(work), 1);
  EXPECT_NEAR(work, energy(2) - energy(0), 1e-3 * std::abs(work));
}

TEST(Predictions, DerivativesByStrainStiffnessAndInsertions) {
  Measured knee = all_kinds();
  free_all_of_ligaments(knee, {0, 1, 3, 8});
  expect_exact(knee, some_theta(knee, 0.3));
}

TEST(Predictions, DerivativesBySlackLengthsAndWhatGoesTogether) {
  Measured knee = all_kinds();
  for (const std::size_t i : {0, 4}) {
    knee.parameters.push_back(free_number("slack", {ParameterKind::kSlackLength, i}, 1));
    // An insertion whose strain is held takes the slack length with it.
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving})
      knee.parameters.push_back(free_number(
          "insertion", {ParameterKind::kInsertion, i, body, 1, Held::kReferenceStrain}, 2));
  }
  FreeParameter together =
      free_number("all stiffnesses", {ParameterKind::kStiffness, 0}, 0.3, true);
  for (std::size_t i = 1; i < 12; ++i)
    together.moves.push_back({{ParameterKind::kStiffness, i}, 1.0});
  knee.parameters.push_back(together);
  knee.parameters.push_back(free_number("anterior", {ParameterKind::kLoadScale, 0}, 0.05, true));
  expect_exact(knee, some_theta(knee, 0.5));
}

TEST(Predictions, DerivativesByFramesAndOffsetsOfCurves) {
  Measured knee = all_kinds();
  knee.parameters = {
      free_number("aACL.reference_strain", {ParameterKind::kReferenceStrain, 0}, 0.03)};
  free_frames(knee);
  FreeParameter offset;
  offset.name = "offset";
  offset.kind = FreeParameter::Kind::kCurveOffset;
  offset.test = "anterior";
  offset.coordinate = 4;
  knee.parameters.push_back(offset);
  for (const double part : {0.0, 5.0}) expect_exact(knee, some_theta(knee, part));
}

/// The same knee of the other side.
Scene mirrored(Scene scene) {
  const auto mirror = [](Eigen::Vector3d& v) { v.x() = -v.x(); };
  scene.joint->side = Side::kLeft;
  mirror(scene.joint->femur.lateral);
  mirror(scene.joint->tibia.lateral);
  mirror(scene.joint->femur.origin);
  mirror(scene.joint->tibia.origin);
  for (BodyDescription& body : scene.bodies) mirror(body.start_translation);
  for (SurfaceDescription& surface : scene.surfaces) {
    mirror(surface.point);
    mirror(surface.direction);
  }
  for (LigamentDescription& ligament : scene.ligaments)
    for (Attachment& end : ligament.ends) mirror(end.at);
  for (LoadDescription& load : scene.loads) {
    mirror(load.at);
    // Forces are mirrored, moments are the other way about.
    if (load.moment)
      load.vector = Eigen::Vector3d(load.vector.x(), -load.vector.y(), -load.vector.z());
    else
      mirror(load.vector);
  }
  return scene;
}

TEST(Predictions, OfALeftKneeAreThoseOfTheRightOne) {
  Measured right = all_kinds(), left = all_kinds();
  left.scene = mirrored(left.scene);
  for (Measured* knee : {&right, &left}) {
    knee->parameters = free_strains(knee->scene);
    free_frames(*knee);
  }
  expect_exact(left, some_theta(left, 0.5));
  Predictions of_right = right.predictions(), of_left = left.predictions();
  VectorXd y, y_left;
  MatrixXd J, J_left;
  VectorXd theta = some_theta(right, 0.5);
  theta.tail(12).setZero();
  ASSERT_TRUE(of_right.evaluate(theta, y, &J)) << of_right.failure();
  ASSERT_TRUE(of_left.evaluate(theta, y_left, &J_left)) << of_left.failure();
  EXPECT_LT((y - y_left).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_LT((J.leftCols(12) - J_left.leftCols(12)).norm(), 1e-8 * J.norm());
}

TEST(Predictions, OnLayersOfCartilage) {
  Measured knee = all_kinds();
  for (SurfaceDescription& surface : knee.scene.surfaces)
    surface.elastic = ElasticSurface{10, 0.45, 3};
  for (ContactDescription& contact : knee.scene.contacts) contact.layer = LayerOptions{};
  free_all_of_ligaments(knee, {1, 8});
  expect_exact(knee, some_theta(knee, 0.3), 0.1);
}

TEST(Predictions, WithALigamentThatWraps) {
  Measured knee = all_kinds();
  WrapDescription ball;
  ball.name = "ball";
  ball.body = 0;
  ball.shape = WrapSphere{9};
  ball.placement.p = {22, -8, 60};
  knee.scene.wraps.push_back(ball);
  LigamentDescription strand;
  strand.name = "strand";
  strand.ends = {Attachment{0, {30, 20, 65}}, Attachment{1, {23.7, -53, 227.1}}};
  strand.law = ToeLinearLaw{600, 0.06, 82};
  strand.path.wraps = {0};
  knee.scene.ligaments.push_back(strand);
  free_all_of_ligaments(knee, {8, 12});
  // A strand that is slack would show nothing.
  knee.add_row(MeasuredKind::kLigamentForce, 12, -1, 0, 20);
  Predictions predictions = knee.predictions();
  VectorXd y;
  const VectorXd theta = some_theta(knee, 0.3);
  ASSERT_TRUE(predictions.evaluate(theta, y, nullptr)) << predictions.failure();
  EXPECT_GT(y[y.size() - 1], 1);
  expect_exact(knee, theta);
}

TEST(Predictions, WithoutAPoseAreNoneAndLeaveEverythingAsItWas) {
  Measured knee = all_kinds();
  knee.parameters = free_strains(knee.scene);
  Predictions predictions = knee.predictions(), other = knee.predictions();
  const VectorXd theta = some_theta(knee, 1);
  VectorXd y, y_other;
  ASSERT_TRUE(predictions.evaluate(theta, y, nullptr));
  ASSERT_TRUE(other.evaluate(theta, y_other, nullptr));
  // No ligament ever pulls: nothing carries the loads.
  EXPECT_FALSE(predictions.evaluate(VectorXd::Constant(12, -0.9), y, nullptr));
  EXPECT_NE(predictions.failure().find("knee.csv:"), std::string::npos) << predictions.failure();
  // A strain that no line has.
  EXPECT_FALSE(predictions.evaluate(VectorXd::Constant(12, -5), y, nullptr));
  EXPECT_EQ(predictions.failure(), "the slack length of \"APL\" is not positive");
  const VectorXd next = some_theta(knee, 1, 4);
  ASSERT_TRUE(predictions.evaluate(next, y, nullptr));
  ASSERT_TRUE(other.evaluate(next, y_other, nullptr));
  EXPECT_LT((y - y_other).lpNorm<Eigen::Infinity>(), 1e-10);
}

TEST(Predictions, DoNotDependOnTheOrderOfEvaluationsAndStartAgainToTheLastBit) {
  Measured knee = all_kinds();
  knee.parameters = free_strains(knee.scene);
  const VectorXd a = some_theta(knee, 2, 1), b = some_theta(knee, 2, 2);
  Predictions predictions = knee.predictions();
  VectorXd first, again, unused;
  MatrixXd J_first, J_again;
  ASSERT_TRUE(predictions.evaluate(a, first, &J_first)) << predictions.failure();
  ASSERT_TRUE(predictions.evaluate(b, unused, nullptr)) << predictions.failure();
  ASSERT_TRUE(predictions.evaluate(a, again, &J_again));
  EXPECT_LT((first - again).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_LT((J_first - J_again).norm(), 1e-9 * J_first.norm());
  predictions.reset();
  ASSERT_TRUE(predictions.evaluate(a, again, &J_again));
  EXPECT_TRUE(first == again);
  EXPECT_TRUE(J_first == J_again);
  Predictions copy(knee.predictions());
  ASSERT_TRUE(copy.evaluate(a, again, &J_again));
  EXPECT_TRUE(first == again);
  EXPECT_LT(predictions.difference_of_cold_path(a), 1e-7);
}

TEST(Predictions, ARowThatIsFittedNeedsAPoseAndATestIsLostWithoutOne) {
  Measured knee;
  add_coordinates("passive", 20 * kDegree, -1, 0, knee.table);
  knee.add_row(MeasuredKind::kReaction, 0, 3, 500, 20).use = MeasuredUse::kTest;
  knee.table.rows.back().line = 88;
  Predictions predictions = knee.predictions();
  VectorXd y;
  MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, &J));
  EXPECT_TRUE(y.head(5).allFinite());
  EXPECT_TRUE(std::isnan(y[5]));
  knee.table.rows.back().use = MeasuredUse::kFit;
  try {
    (void)knee.predictions();
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("knee.csv:88"), std::string::npos) << error.what();
  }
}

// Errors of what is prescribed: against poses at other flexions and levels.
TEST(Predictions, VarianceOfFlexionAndLevel) {
  Measured knee;
  knee.scene.calibration->flexion_sd = 1 * kDegree;
  knee.scene.calibration->level_sd = 0.02;
  knee.scene.calibration->relative = {"varus"};
  constexpr double h = 1e-3, kLevel = 80;
  // Rows 0 to 4, then at other flexions, then at other levels.
  for (const double flexion : {20 * kDegree, 20 * kDegree - h, 20 * kDegree + h})
    add_coordinates("varus", flexion, 0, kLevel, knee.table);
  for (const double level : {kLevel * (1 - h), kLevel * (1 + h)})
    add_coordinates("varus", 20 * kDegree, 0, level, knee.table);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr));
  const VectorXd variance = predictions.input_variance(VectorXd());
  for (Eigen::Index i = 0; i < 5; ++i) {
    const double by_flexion = (y[10 + i] - y[5 + i]) / (2 * h) * kDegree;
    const double by_level = (y[20 + i] - y[15 + i]) / (2 * h) * 0.02;
    const double expected = by_flexion * by_flexion + by_level * by_level;
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(variance[i], expected, 1e-4 * expected);
  }
}

TEST(Predictions, TellTheGreatestForceOfEachLigament) {
  Measured knee;
  for (const double level : {-100.0, 100.0})
    for (std::size_t i = 0; i < 12; ++i)
      knee.add_row(MeasuredKind::kLigamentForce, i, 0, level, 20);
  Predictions predictions = knee.predictions();
  VectorXd y;
  ASSERT_TRUE(predictions.evaluate(VectorXd(), y, nullptr));
  const std::vector<double> greatest = predictions.largest_ligament_forces();
  ASSERT_EQ(greatest.size(), 12U);
  for (Eigen::Index i = 0; i < 12; ++i)
    EXPECT_EQ(greatest[static_cast<std::size_t>(i)], std::max(y[i], y[12 + i]));
  EXPECT_GT(*std::max_element(greatest.begin(), greatest.end()), 20);
}

}  // namespace
}  // namespace condyle::test
