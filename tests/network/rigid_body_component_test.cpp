#include "condyle/network/rigid_body_component.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "condyle/math/rotation.h"
#include "condyle/network/linear_graph.h"
#include "network/gravity.h"
#include "support/random.h"

namespace condyle {
namespace {

/// Eight point masses: an asymmetric body.
std::vector<PointMass> some_points() {
  test::Random random(11);
  std::vector<PointMass> points(8);
  for (PointMass& point : points) point = {random.between(1e-4, 1e-3), random.vector(60)};
  return points;
}

Vector6 random_six(test::Random& random, double a, double b) {
  Vector6 x;
  x << random.vector(a), random.vector(b);
  return x;
}

TEST(RigidBodyComponent, MasslessBodyIsSkewAndTakesNoPower) {
  test::Random random(1);
  const std::vector<Eigen::Vector3d> arms = {random.vector(50), random.vector(50),
                                             random.vector(50)};
  const Eigen::MatrixXd H = hybrid_matrix(arms);
  EXPECT_EQ(H, -H.transpose());
  EXPECT_GT(H.norm(), 1);
  Eigen::VectorXd z(24);
  for (int i = 0; i < 24; ++i) z[i] = random.between(-1, 1);
  EXPECT_NEAR(z.dot(H * z), 0, 1e-12);
}

// Newton and Euler for each point mass of the body: Σ m a and Σ r x m a about the reference port.
TEST(RigidBodyComponent, InertiaIsThatOfItsPointsAtAnyReferencePort) {
  test::Random random(2);
  const std::vector<PointMass> points = some_points();
  const MassProperties mass = mass_of_points(points);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Vector3d reference = trial == 0 ? mass.center : random.vector(100);
    const Eigen::Matrix3d R = random.rotation();
    const Vector6 x = random_six(random, 500, 5), rate = random_six(random, 3000, 40);
    const InertiaTerms terms = inertia_terms(mass, reference, R, x, kGravity);
    const Vector6 y = terms.P * rate + terms.Q + terms.u;
    Vector6 expected = Vector6::Zero();
    const Eigen::Vector3d w = x.tail<3>(), alpha = rate.tail<3>();
    for (const PointMass& point : points) {
      const Eigen::Vector3d r = R * (point.position - reference);
      const Eigen::Vector3d f =
          point.mass * (rate.head<3>() + alpha.cross(r) + w.cross(w.cross(r)) - kGravity);
      expected.head<3>() += f;
      expected.tail<3>() += r.cross(f);
    }
    EXPECT_LT((y - expected).norm(), 1e-12 * expected.norm());
  }
}

// At the mass centre: f = m dv/dt - m g, M = J dω/dt + ω x J ω [Tokad 1992, 42-45].
TEST(RigidBodyComponent, InverseOfTheInertiaNeedsNoFactorization) {
  test::Random random(5);
  const MassProperties mass = mass_of_points(some_points());
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Matrix3d R = random.rotation();
    const InertiaTerms terms =
        inertia_terms(mass, random.vector(300), R, Vector6::Zero(), Eigen::Vector3d::Zero());
    const Matrix6 unit = inverse_inertia(mass.mass, mass.inertia.inverse(), R, terms.arm) * terms.P;
    EXPECT_LT((unit - Matrix6::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(RigidBodyComponent, AtTheMassCentreEulersEquationsRemain) {
  test::Random random(3);
  const MassProperties mass = mass_of_points(some_points());
  const Eigen::Matrix3d R = random.rotation(), J = R * mass.inertia * R.transpose();
  const Vector6 x = random_six(random, 500, 5);
  const InertiaTerms terms = inertia_terms(mass, mass.center, R, x, kGravity);
  const Eigen::Vector3d w = x.tail<3>();
  Matrix6 P = Matrix6::Zero();
  P.topLeftCorner<3, 3>() = mass.mass * Eigen::Matrix3d::Identity();
  P.bottomRightCorner<3, 3>() = J;
  Vector6 Q, u;
  Q << Eigen::Vector3d::Zero(), w.cross(J * w);
  u << -mass.mass * kGravity, Eigen::Vector3d::Zero();
  EXPECT_LT((terms.P - P).norm(), 1e-13 * P.norm());
  EXPECT_LT((terms.Q - Q).norm(), 1e-12 * Q.norm());
  EXPECT_LT((terms.u - u).norm(), 1e-13 * u.norm());
}

// (Q - P'/2 x).x = 0 [Tokad 1992, 48], and P' against a difference over 1e-5 s.
TEST(RigidBodyComponent, VelocityTermsDoNoWorkBeyondTheChangeOfInertia) {
  test::Random random(4);
  const MassProperties mass = mass_of_points(some_points());
  const Eigen::Vector3d reference = random.vector(100);
  const Eigen::Matrix3d R = random.rotation();
  const Vector6 x = random_six(random, 500, 5);
  const Eigen::Vector3d w = x.tail<3>();
  const InertiaTerms terms = inertia_terms(mass, reference, R, x, kGravity);
  const Matrix6 rate = inertia_rate(mass, reference, R, w);
  EXPECT_LT(std::abs(x.dot(terms.Q - rate * x / 2)), 1e-12 * x.norm() * terms.Q.norm());
  constexpr double h = 1e-5;
  const auto P_at = [&](double t) -> Matrix6 {
    return inertia_terms(mass, reference, exp_rotation(t * w) * R, x, kGravity).P;
  };
  const Matrix6 difference = (P_at(h) - P_at(-h)) / (2 * h);
  EXPECT_LT((rate - difference).norm(), 1e-8 * rate.norm());  // h² ω² and round-off / h
}

// Star from the ground or from A_0 [Tokad 1992, Fig. 4]: y_0 = Σ through of all edges at A_0. The
// wrenches that the two terminal graphs call y and y' give the same acceleration.
TEST(RigidBodyComponent, EitherTerminalTreeGivesTheSameMotion) {
  test::Random random(5);
  LinearGraph star, from_A0;
  star.vertices = from_A0.vertices = {"ground", "A0", "A1", "A2"};
  star.edges = {{"0", 0, 1}, {"1", 0, 2}, {"2", 0, 3}};
  from_A0.edges = {{"0", 0, 1}, {"1", 1, 2}, {"2", 1, 3}};
  const Eigen::MatrixXd T = tree_transformation(star, from_A0).cast<double>();
  const MassProperties mass = mass_of_points(some_points());
  const Eigen::Matrix3d R = random.rotation();
  const Vector6 x_0 = random_six(random, 500, 5);
  const Eigen::Vector3d arms[3] = {Eigen::Vector3d::Zero(), random.vector(80), random.vector(80)};
  const InertiaTerms terms = inertia_terms(mass, {0, 0, 0}, R, x_0, kGravity);

  EdgeVariables y_new(6, 3), x(6, 3);  // through of the tree from A_0, across of the star
  for (int j = 0; j < 3; ++j) {
    y_new.col(j) = random_six(random, 100, 1000);
    x.col(j) = carrier(arms[j]).transpose() * x_0;
  }
  const EdgeVariables y = y_new * T, x_new = x * T.transpose();
  Vector6 sum = Vector6::Zero();
  for (int j = 0; j < 3; ++j) sum += wrench_at_reference(y.col(j), arms[j]);
  const Vector6 rate = terms.P.inverse() * (sum - terms.Q - terms.u);
  // The other form: y'_0 = W x_0 + u - Σ (K_j - I) y'_j, for edge j has the twist (K_jᵀ - I) x_0.
  Vector6 sum_new = y_new.col(0);
  for (int j = 1; j < 3; ++j) {
    sum_new += (carrier(arms[j]) - Matrix6::Identity()) * y_new.col(j);
    EXPECT_LT((x_new.col(j) - (carrier(arms[j]) - Matrix6::Identity()).transpose() * x_0).norm(),
              1e-10);
  }
  const Vector6 rate_new = terms.P.inverse() * (sum_new - terms.Q - terms.u);
  EXPECT_LT((rate - rate_new).norm(), 1e-12 * rate.norm());
  EXPECT_NEAR(tellegen_sum(x, y).sum, tellegen_sum(x_new, y_new).sum,
              1e-12 * tellegen_sum(x, y).scale);
}

}  // namespace
}  // namespace condyle
