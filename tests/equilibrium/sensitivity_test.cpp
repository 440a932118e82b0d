/// Derivatives of solved poses: every parameter and every output against poses solved anew, on rigid
/// and layered contacts, straight and wrapped lines, right and left, either body moving.

#include "condyle/equilibrium/sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/equilibrium/model_origins.h"
#include "condyle/math/rotation.h"
#include "support/allocation_count.h"
#include "support/patch_knee.h"
#include "support/studied_knees.h"

namespace condyle {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using test::expect_exact;
using test::expect_same;
using test::hanging_body;
using test::layered;
using test::loaded;
using test::nominal;
using test::quadric;
using test::Solved;
using test::Studied;
using test::wismans_type;

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
    // Curvatures where a layer is pressed are those of a place up to 1e-5 mm beside (layer_packets.cpp).
    expect_same(J_there, J, knee, outputs, parameters, here.pose, 10, on_layers ? 1e-5 : 1e-7);
  }
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
