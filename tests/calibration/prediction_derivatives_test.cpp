/// Derivatives of predictions against differences of evaluations: on rigid and layered contact, straight
/// and wrapped lines, right and left.

#include <gtest/gtest.h>

#include "calibration/measured_predictions.h"

namespace condyle::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
  const VectorXd theta = some_theta(right, 0.5);  // of the frames as well
  ASSERT_TRUE(of_right.evaluate(theta, y, &J)) << of_right.failure();
  ASSERT_TRUE(of_left.evaluate(theta, y_left, &J_left)) << of_left.failure();
  EXPECT_LT((y - y_left).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_LT((J - J_left).norm(), 1e-8 * J.norm());
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

}  // namespace
}  // namespace condyle::test
