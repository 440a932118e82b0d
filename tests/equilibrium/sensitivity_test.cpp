/// Derivatives of solved poses: every parameter and every output against poses solved anew, on rigid
/// and layered contacts, straight and wrapped lines, right and left, either body moving.

#include "condyle/equilibrium/sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/model_origins.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/allocation_count.h"
#include "support/layered_pairs.h"
#include "support/led_paths.h"
#include "support/patch_knee.h"
#include "support/quadric_knee.h"
#include "support/sensitivity_check.h"
#include "support/words_of.h"
#include "support/wrapped_scenes.h"

namespace condyle {
namespace {

using test::words_of;

using Eigen::MatrixXd;
using Eigen::Vector3d;
using test::Studied;

constexpr double kDegree = std::numbers::pi / 180;

Studied nominal(Model model) {
  Drive drive = drive_of(model);
  return {std::move(model), std::move(drive)};
}

Studied wismans_type(double flexion) {
  const Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml");
  Studied knee = nominal(build_model(scene, fit_surfaces(scene)));
  knee.drive.values[0] = flexion * kDegree;
  return knee;
}

/// With a ligament of another law, a dead force and a dead moment, at 25 degrees.
Model loaded(Model model) {
  model.elements[7].law = QuadraticLaw{4, slack_length(model.elements[7].law)};
  Load force, moment;
  force.vector = {4, -9, 12};
  force.at = {2, -5, -40};
  moment.moment = true;
  moment.vector = {90, 150, -200};
  model.loads.push_back(force);
  model.loads.push_back(moment);
  model.load_names.insert(model.load_names.end(), {"force", "moment"});
  model.conditions[0].value = 25 * kDegree;
  return model;
}

Studied quadric(bool left = false, bool femur_moves = false) {
  test::QuadricKneeView view;
  view.left = left;
  view.femur_moves = femur_moves;
  return nominal(loaded(test::quadric_knee(view)));
}

Studied hanging_body(double push) {
  Studied body = nominal(build_model(parse_scene(test::kHangingBody, "knee.toml"), {}));
  body.drive.scales[1] = push;
  return body;
}

/// Unlike layers on both surfaces of each pair.
Studied layered(Model model, PressureLaw pressure) {
  Studied knee = nominal(std::move(model));
  knee.layer.pressure = pressure;
  knee.model = test::on_layers(knee.model, 10, knee.layer);
  for (ContactPair& pair : knee.model.pairs) pair.elastic_A = ElasticSurface{6, 0.4, 2};
  return knee;
}

struct Solved {
  explicit Solved(const Studied& knee)
      : solver(std::make_shared<const Model>(knee.model), test::for_differences()),
        pose(solver.solve(knee.drive)),
        sensitivity(solver.model()) {
    EXPECT_TRUE(pose.converged()) << pose.reason;
    EXPECT_TRUE(sensitivity.set(at()));
  }
  [[nodiscard]] Linearization at() const { return solver.linearized_solution(); }
  [[nodiscard]] std::vector<PoseOutput> outputs() const { return test::all_outputs(at(), pose); }

  EquilibriumSolver solver;
  PoseResult pose;
  Sensitivity sensitivity;
};

std::vector<double> column_of(const MatrixXd& J, std::size_t j) {
  const Eigen::VectorXd column = J.col(static_cast<Eigen::Index>(j));
  return {column.begin(), column.end()};
}

/// Every column against differences. `h`: a part of the usual steps.
void expect_exact(const Studied& knee,
                  std::size_t each = 1,
                  double tolerance = 1e-6,
                  double h = 1) {
  Solved solved(knee);
  const std::vector<PoseOutput> outputs = solved.outputs();
  const std::vector<ModelParameter> parameters = test::all_parameters(knee, each);
  MatrixXd J;
  solved.sensitivity.derivatives(outputs, parameters, J);
  test::Perturbed perturbed(knee, solved.solver.covers(), solved.solver.solution());
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const std::string name = name_of(parameters[j], knee.model);
    const double step = h * test::step_of(parameters[j], knee);
    std::string failed;
    const std::vector<double> expected =
        test::column_by_differences(perturbed, outputs, parameters[j], step, failed);
    ASSERT_EQ(failed, "") << name;
    const auto [off, where] =
        test::worst_of_column(column_of(J, j), expected, outputs, solved.pose, step);
    EXPECT_LT(off, tolerance) << name << ": " << where;
  }
}

TEST(Sensitivity, OfTheWismansTypeKnee) {
  for (const double flexion : {0.0, 40.0}) expect_exact(wismans_type(flexion), 4);
}

TEST(Sensitivity, OfEllipsoidsInACupAndOnAPlane) { expect_exact(quadric()); }

TEST(Sensitivity, OfALeftKnee) { expect_exact(quadric(true, false), 3); }

TEST(Sensitivity, OfAMovingFemur) {
  expect_exact(quadric(false, true), 3);
  expect_exact(quadric(true, true), 5);
}

TEST(Sensitivity, OfPatches) { expect_exact(nominal(loaded(benchmarks::patch_knee())), 4); }

TEST(Sensitivity, OfWrappedLines) {
  for (const double push : {-1.3, 0.2}) expect_exact(hanging_body(push), 1);
}

TEST(Sensitivity, OfLayers) {
  for (const PressureLaw law : {PressureLaw::kLinear, PressureLaw::kLogarithmic})
    expect_exact(layered(loaded(test::quadric_knee()), law), 8, 1e-6, 1e-2);
}

/// Every column of two matrices by groups of outputs, where round-off in what the model's numbers are
/// `larger` times is none.
void expect_same(const MatrixXd& A,
                 const MatrixXd& B,
                 const Studied& knee,
                 const std::vector<PoseOutput>& outputs,
                 const std::vector<ModelParameter>& parameters,
                 const PoseResult& pose,
                 double larger,
                 double tolerance) {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double step = test::step_of(parameters[j], knee) / (3e-3 * larger);
    const auto [off, where] =
        test::worst_of_column(column_of(A, j), column_of(B, j), outputs, pose, step);
    EXPECT_LT(off, tolerance) << name_of(parameters[j], knee.model) << ": " << where;
  }
}

TEST(Sensitivity, ForwardAndAdjointAgree) {
  const auto compare = [](const Studied& knee) {
    Solved solved(knee);
    const std::vector<PoseOutput> outputs = solved.outputs();
    const std::vector<ModelParameter> parameters = test::all_parameters(knee);
    MatrixXd forward, adjoint;
    solved.sensitivity.derivatives(outputs, parameters, forward, Sensitivity::Way::kForward);
    solved.sensitivity.derivatives(outputs, parameters, adjoint, Sensitivity::Way::kAdjoint);
    EXPECT_LT((forward - adjoint).norm(), 1e-10 * forward.norm());
    for (Eigen::Index j = 0; j < forward.cols(); ++j)
      EXPECT_LE((forward.col(j) - adjoint.col(j)).norm(), 1e-10 * forward.col(j).norm())
          << name_of(parameters[static_cast<std::size_t>(j)], knee.model);
    for (const std::size_t j : {std::size_t(0), parameters.size() / 2, parameters.size() - 1})
      for (std::size_t i = 0; i < outputs.size(); ++i)
        EXPECT_NEAR(solved.sensitivity.derivative(outputs[i], parameters[j]),
                    forward(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                    1e-12 * forward.col(static_cast<Eigen::Index>(j)).norm());
  };
  compare(quadric());
  compare(quadric(true, true));
  compare(wismans_type(30));
  compare(hanging_body(-1.3));
  compare(layered(loaded(test::quadric_knee()), PressureLaw::kLogarithmic));
}

// The state itself: pose in the model's frames, contact forces and multipliers.
TEST(Sensitivity, StateRatesAreThoseOfNewtonsUnknowns) {
  const Studied knee = wismans_type(30);
  Solved solved(knee);
  const auto tautest = std::max_element(
      solved.pose.ligaments.begin(), solved.pose.ligaments.end(),
      [](const LigamentResult& a, const LigamentResult& b) { return a.force < b.force; });
  const ModelParameter strain{ParameterKind::kReferenceStrain,
                              static_cast<std::size_t>(tautest - solved.pose.ligaments.begin())};
  const StateRate rate = solved.sensitivity.state_rate(strain);
  const EquilibriumState at = solved.solver.solution();
  constexpr double h = 1e-5;
  std::array<EquilibriumState, 2> moved;
  for (const std::size_t side : {0, 1}) {
    Parameters parameters = parameters_of(knee.model);
    Drive drive = knee.drive;
    change(strain, side == 0 ? -h : h, knee.model, parameters, drive);
    solved.solver.set_parameters(parameters);
    solved.solver.set_state(at, knee.drive);
    ASSERT_TRUE(solved.solver.solve(drive).converged());
    moved[side] = solved.solver.solution();
  }
  const auto close = [](double found, double a, double b) {
    EXPECT_NEAR(found, (b - a) / (2 * h), 1e-5 * std::abs(found));
  };
  const Vector3d da = (moved[1].X.p - moved[0].X.p) / (2 * h);
  const Vector3d dpi = log_rotation(moved[1].X.R * moved[0].X.R.transpose()) / (2 * h);
  EXPECT_GT(da.norm(), 0.1);  // mm
  EXPECT_LT((rate.da - da).norm(), 1e-5 * da.norm());
  EXPECT_LT((rate.dpi - dpi).norm(), 1e-5 * dpi.norm());
  ASSERT_EQ(at.contacts.size(), 2U);
  for (const std::size_t k : {0, 1})
    close(rate.p[k], moved[0].contacts[k].p, moved[1].contacts[k].p);
  close(rate.sigma[0], moved[0].sigma[0], moved[1].sigma[0]);
}

// What is told is in the files' frames: the same wherever the model has the origins of its own, here
// up to a metre away, where arms and moments are other ones.
TEST(Sensitivity, DoesNotDependOnTheOriginsOfTheFrames) {
  for (const bool on_layers : {false, true}) {
    const Studied knee =
        on_layers ? layered(loaded(test::quadric_knee()), PressureLaw::kLinear) : quadric();
    Studied moved = knee;
    move_origins({{700, -400, 580}, {-300, 810, 500}}, moved.model);
    if (on_layers)
      for (ContactPair& pair : moved.model.pairs)
        pair.law = layer_contact(moved.layer, moved.model.origins.B);
    Solved here(knee), there(moved);
    const std::vector<PoseOutput> outputs = here.outputs();
    const std::vector<ModelParameter> parameters = test::all_parameters(knee);
    MatrixXd J, J_there;
    here.sensitivity.derivatives(outputs, parameters, J);
    there.sensitivity.derivatives(outputs, parameters, J_there);
    // Curvatures where a layer is pressed are those of a place up to 1e-5 mm beside (layer_side.cpp).
    expect_same(J_there, J, knee, outputs, parameters, here.pose, 10, on_layers ? 1e-5 : 1e-7);
  }
}

// A knee whose lateral contact is about to open under a moment that lifts it: with the contact's force
// at zero the derivatives of either side are those with the contact and without.
TEST(Sensitivity, IsOneSidedWhereAContactOpens) {
  Studied knee = nominal(test::quadric_knee());
  Load moment;
  moment.moment = true;
  moment.vector = {0, 1000, 0};
  knee.model.loads.push_back(moment);
  knee.model.load_names.emplace_back("moment");
  knee.drive = drive_of(knee.model);
  const ModelParameter scale{ParameterKind::kLoadScale, 1};
  const PoseOutput force{OutputKind::kContactForce, 1}, adduction{OutputKind::kJointCoordinate, 1};
  for (ContactPair& pair : knee.model.pairs) pair.mode = ContactMode::kClosed;
  Solved closed(knee);
  // Newton for the scale at which the force vanishes.
  for (int i = 0; i < 8; ++i) {
    const double slope = closed.sensitivity.derivative(force, scale);
    knee.drive.scales[1] -= value_of(force, closed.pose) / slope;
    closed.pose = closed.solver.solve(knee.drive);
    ASSERT_TRUE(closed.pose.converged()) << closed.pose.reason;
    ASSERT_TRUE(closed.sensitivity.set(closed.at()));
  }
  EXPECT_LT(std::abs(value_of(force, closed.pose)), 1e-9);
  EXPECT_TRUE(one_sided_contacts(closed.at(), closed.pose).empty());  // held closed: it may pull
  Studied open = knee, free = knee;
  open.model.start = free.model.start = closed.solver.solution().X;
  open.model.pairs[1].mode = ContactMode::kOpen;
  for (ContactPair& pair : free.model.pairs) pair.mode = ContactMode::kAuto;
  Solved without(open), either(free);
  const std::vector<OneSidedContact> flagged = one_sided_contacts(either.at(), either.pose);
  ASSERT_EQ(flagged.size(), 1U);
  EXPECT_EQ(flagged[0].pair, 1U);
  const double with_it = closed.sensitivity.derivative(adduction, scale),
               without_it = without.sensitivity.derivative(adduction, scale);
  EXPECT_GT(std::abs(with_it - without_it), 0.1 * std::abs(without_it));
  const double h = 1e-4, sign = closed.sensitivity.derivative(force, scale) > 0 ? 1 : -1;
  const double here = value_of(adduction, either.pose);
  const auto slope_to = [&](double by) {
    Drive drive = knee.drive;
    drive.scales[1] += by;
    const PoseResult pose = either.solver.solve(drive);
    EXPECT_TRUE(pose.converged()) << pose.reason;
    EXPECT_EQ(pose.contacts[1].closed, by * sign > 0);
    return (value_of(adduction, pose) - here) / by;
  };
  EXPECT_NEAR(slope_to(sign * h), with_it, 1e-3 * std::abs(with_it));
  EXPECT_NEAR(slope_to(-sign * h), without_it, 1e-3 * std::abs(without_it));
}

// A ligament at its slack length: force and slope are continuous, so the derivatives are too.
TEST(Sensitivity, IsContinuousWhereALigamentGoesSlack) {
  Studied knee = quadric();
  Solved before(knee);
  auto& law = std::get<ToeLinearLaw>(knee.model.elements[0].law);
  const double length = before.pose.ligaments[0].length;
  const auto derivative_with = [&](double slack) {
    law.slack_length = slack;
    Solved solved(knee);
    return solved.sensitivity.derivative({OutputKind::kJointCoordinate, 4},
                                         {ParameterKind::kLoadScale, 0});
  };
  // From slack to a hair of strain; the length itself changes with that.
  law.slack_length = 2 * length;
  const double free = Solved(knee).pose.ligaments[0].length;
  const double taut = derivative_with(free * (1 - 1e-7)),
               slack = derivative_with(free * (1 + 1e-7));
  EXPECT_NEAR(taut, slack, 1e-4 * std::abs(slack));
}

TEST(Sensitivity, WhatIsNotKnownIsRefusedByName) {
  Studied knee = quadric(false, true);
  knee.model.elements[0].law = PolynomialLaw{{-600, 20}, true};
  knee.model.elements[4].path = std::make_shared<test::PegPath>(
      Vector3d(0.5 * (knee.model.elements[4].x_C + knee.model.elements[4].s_D)));
  knee.model.pairs[1].mode = ContactMode::kOpen;
  Solved solved(knee);
  const PoseOutput flexion{};
  const auto refused = [&](const ModelParameter& parameter) {
    return words_of([&] { (void)solved.sensitivity.derivative(flexion, parameter); });
  };
  EXPECT_EQ(refused({ParameterKind::kReferenceStrain, 0}),
            "reference strain of \"aACL\": its law has none, expected toe-linear or quadratic");
  EXPECT_EQ(refused({ParameterKind::kTransitionStrain, 7}),
            "transition strain of \"capsule\": its law has none, expected toe-linear");
  EXPECT_EQ(refused({ParameterKind::kInsertion, 4, OfBody::kMoving, 1}),
            "insertion of \"aMCL\" on the moving body, y: how its path follows that end is not "
            "known");
  EXPECT_EQ(refused({ParameterKind::kLoadVector, 0, OfBody::kFixed, 2}),
            "vector of \"compression\", z: the load computes itself");
  EXPECT_EQ(refused({ParameterKind::kLoadPoint, 2}),
            "point of \"moment\", x: a moment has no point");
  EXPECT_EQ(refused({ParameterKind::kSlackLength, 8}),
            "slack length of number 8: the model has 8 line elements");
  EXPECT_EQ(refused({ParameterKind::kInsertion, 1, OfBody::kFixed, 3}),
            "insertion of \"pACL\" on the fixed body, ?: its component is 3, expected 0, 1 or 2");
  EXPECT_EQ(refused({ParameterKind::kLayerModulus, 0, OfBody::kBoth}),
            "modulus of both layers of \"medial\": its surfaces are rigid");
  EXPECT_EQ(words_of([&] {
              (void)solved.sensitivity.derivative({OutputKind::kContactResultant, 1},
                                                  {ParameterKind::kStiffness, 1});
            }),
            "contact \"lateral\": it has no such closed point");
  EXPECT_EQ(words_of([&] {
              (void)solved.sensitivity.derivative({OutputKind::kLayerForce, 0},
                                                  {ParameterKind::kStiffness, 1});
            }),
            "contact \"medial\": it is no layer that is pressed");
  // An open contact carries nothing, and goes on so.
  EXPECT_EQ(
      solved.sensitivity.derivative({OutputKind::kContactForce, 1}, {ParameterKind::kStiffness, 1}),
      0);
}

// Prescribed twice, a motion has no multipliers of its own.
TEST(Sensitivity, SaysNothingWhereTheMatrixIsSingular) {
  Studied knee = quadric();
  Solved solved(knee);
  knee.model.conditions.push_back(knee.model.conditions[0]);
  knee.model.condition_names.emplace_back("again");
  knee.drive = drive_of(knee.model);
  EquilibriumState state = solved.solver.solution();
  state.sigma.push_back(0);
  NewtonSystem system(knee.model);
  ASSERT_TRUE(system.assemble(state, knee.drive));
  Sensitivity sensitivity(knee.model);
  EXPECT_FALSE(sensitivity.set(linearization(system, state, knee.drive)));
  EXPECT_THROW((void)sensitivity.derivative({}, {}), std::logic_error);
}

TEST(Sensitivity, AllocatesNothingAfterItsFirstUse) {
  for (const Studied& knee : {quadric(), hanging_body(0.2),
                              layered(loaded(test::quadric_knee()), PressureLaw::kLogarithmic)}) {
    Solved solved(knee);
    const std::vector<PoseOutput> outputs = solved.outputs();
    const std::vector<ModelParameter> parameters = test::all_parameters(knee);
    MatrixXd J;
    solved.sensitivity.derivatives(outputs, parameters, J);
    const MatrixXd first = J;
    const test::AllocationCount count;
    EXPECT_TRUE(solved.sensitivity.set(solved.at()));
    solved.sensitivity.derivatives(outputs, parameters, J, Sensitivity::Way::kForward);
    solved.sensitivity.derivatives(outputs, parameters, J, Sensitivity::Way::kAdjoint);
    (void)solved.sensitivity.state_rate(parameters[0]);
    EXPECT_EQ(count.since_start(), 0);
    EXPECT_LT((J - first).norm(), 1e-10 * first.norm());
  }
}

}  // namespace
}  // namespace condyle
