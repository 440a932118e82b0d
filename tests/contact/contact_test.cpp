#include "condyle/contact/contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "condyle/contact/settle_places.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/numerical_jacobian.h"

namespace condyle {
namespace {

/// Two ellipsoids near each other; the places solve g = h = 0 after each displacement only up to
/// the gap, so the tests follow the pair of points whose normals are opposite and whose connection
/// is normal.
struct Pair {
  std::unique_ptr<Surface> on_B =
      make_ellipsoid({0, 0, 0}, exp_rotation({0.2, 0.1, -0.3}), {30, 22, 20}, true);
  std::unique_ptr<Surface> on_A =
      make_ellipsoid({1, -2, 3}, exp_rotation({0.5, -0.1, 0.2}), {25, 18, 21}, true);
  ContactPlaces places{on_B->seed({0, 0, 50}), on_A->seed({0, 0, -50})};

  /// Newton on the two places at a fixed pose.
  ContactLinearization settle(const RigidTransform& X) {
    for (int k = 0; k < 60; ++k) {
      const ContactLinearization contact = linearize_contact({*on_B, *on_A}, places, X);
      const Eigen::Vector3d along = contact.gap() * contact.B.n;
      places.on_B = on_B->moved(places.on_B, contact.B, contact.D0());
      places.on_A = on_A->moved(places.on_A, contact.A,
                                X.R.transpose() * (contact.D0() - (contact.g - along)));
    }
    return linearize_contact({*on_B, *on_A}, places, X);
  }
};

/// A pose at which the ellipsoids touch.
RigidTransform touching(Pair& pair) {
  RigidTransform X{exp_rotation({0.3, -0.2, 0.4}), {2, 3, 40}};
  for (int k = 0; k < 60; ++k) {
    const ContactLinearization contact = pair.settle(X);
    X.p -= contact.gap() * contact.B.n;
  }
  return X;
}

TEST(Contact, SlidesAsDifferencesSay) {
  Pair pair;
  const RigidTransform X = touching(pair);
  const ContactLinearization contact = pair.settle(X);
  ASSERT_LT(contact.g.norm(), 1e-10);
  ASSERT_LT(contact.h.norm(), 1e-12);
  EXPECT_GT(contact.relative_curvature[0], 0);
  // Motions that keep the gap closed: along the tangent plane, and turns about the point of
  // contact.
  const auto point_after = [&](const Eigen::Vector3d& da,
                               const Eigen::Vector3d& dpi) -> Eigen::Vector3d {
    return pair.settle(test::displaced(X, da, dpi)).B.c;
  };
  const Eigen::Vector3d t = contact.B.n.unitOrthogonal();
  const double h = 1e-4;
  const Eigen::Vector3d slid =
      (point_after(h * t, Eigen::Vector3d::Zero()) - point_after(-h * t, Eigen::Vector3d::Zero())) /
      (2 * h);
  EXPECT_LT((slid - contact.D1() * t).norm(), 1e-6);
  const Eigen::Vector3d turn(0.3, -0.8, 0.5);
  const Eigen::Vector3d a = -turn.cross(contact.s);
  const Eigen::Vector3d rolled =
      (point_after(h * a, h * turn) - point_after(-h * a, -h * turn)) / (2 * h);
  EXPECT_LT((rolled - (contact.D1() * a + contact.D2() * turn)).norm(), 1e-5);
}

/// The same pair, 7 mm apart.
struct ApartPair : Pair {
  ContactLinearization settle_at(const RigidTransform& X) {
    ContactLinearization at;
    EXPECT_EQ(settle_places({*on_B, *on_A}, X, {20}, places, at), Settled::kThere);
    return at;
  }
};

// In all six directions; plain linearisation is wrong by a part of γ κ, a quarter here.
TEST(Contact, SlidesAcrossAGapAsDifferencesSay) {
  ApartPair pair;
  RigidTransform X = touching(pair);
  X.p += 7 * pair.settle(X).B.n;
  const ContactLinearization at = pair.settle_at(X);
  EXPECT_NEAR(at.gap(), 7, 1e-9);
  EXPECT_EQ(at.across, at.gap());
  const double h = 1e-4;
  for (int k = 0; k < 6; ++k) {
    const Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Unit(k);
    const Eigen::Vector3d da = motion.head<3>(), dpi = motion.tail<3>();
    const auto point_at = [&](double t) -> Eigen::Vector3d {
      return pair.settle_at(test::displaced(X, t * da, t * dpi)).B.c;
    };
    const Eigen::Vector3d slid = (point_at(h) - point_at(-h)) / (2 * h);
    const Eigen::Vector2d slide = at.S1 * da + at.S2 * dpi;
    const Eigen::Vector3d dc = at.T * slide + at.across * (at.K_T * slide);
    EXPECT_LT((slid - dc).norm(), 1e-7 * (1 + slid.norm())) << k;
  }
}

// A ball of radius r on a plane: K + Kr = -1/r twice.
TEST(Contact, RelativeCurvatureOfABallOnAPlane) {
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const auto ball = make_sphere({0, 0, 0}, 20, true);
  const ContactLinearization contact =
      linearize_contact({*plane, *ball}, {Place{{3, 4, 0}}, Place{{0, 0, -20}}},
                        {Eigen::Matrix3d::Identity(), {3, 4, 20}});
  EXPECT_NEAR(contact.relative_curvature[0], 0.05, 1e-15);
  EXPECT_NEAR(contact.relative_curvature[1], 0.05, 1e-15);
  EXPECT_NEAR(contact.gap(), 0, 1e-14);
}

// A ball in a socket of nearly its radius, and a cylinder on a plane: finite, whatever the
// curvature.
TEST(Contact, StaysFiniteWhereTheCurvatureVanishes) {
  const auto socket = make_sphere({0, 0, 0}, 20, false);
  const auto ball = make_sphere({0, 0, 0}, 20, true);
  const ContactLinearization conforming = linearize_contact(
      {*socket, *ball}, {Place{{0, 0, -20}}, Place{{0, 0, -20}}}, RigidTransform());
  EXPECT_TRUE(conforming.D1().allFinite() && conforming.D2().allFinite() &&
              conforming.D0().allFinite());
  EXPECT_NEAR(conforming.relative_curvature[0], 0, 1e-15);
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const auto roll = make_cylinder({0, 0, 0}, {1, 0, 0}, 10, true);
  const ContactLinearization line =
      linearize_contact({*plane, *roll}, {Place{{0, 0, 0}}, Place{{0, 0, -10}}},
                        {Eigen::Matrix3d::Identity(), {0, 0, 10}});
  EXPECT_TRUE(line.D1().allFinite() && line.D2().allFinite());
  EXPECT_NEAR(line.relative_curvature[0], 0, 1e-15);
  EXPECT_NEAR(line.relative_curvature[1], 0.1, 1e-15);
}

// A point at the end of a roller stays there while the roller moves, also along its axis and turned
// a little about the normal: the point of the floor follows.
TEST(Contact, APointAtTheEndOfALineStaysThere) {
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const auto roll = make_cylinder({0, 0, 0}, {1, 0, 0}, 10, true, 30);
  const RigidTransform X{exp_rotation({0, 0, 0.3}), {2, 3, 10}};
  const Eigen::Vector3d end(15, 0, -10);
  ContactPlaces places{Place{X * end}, Place{end}};
  const ContactLinearization contact = linearize_contact({*plane, *roll}, places, X);
  const Eigen::Vector3d da(0.2, -0.1, 0);
  const Eigen::Vector3d dpi = 0.01 * X.R.col(0) + 0.02 * Eigen::Vector3d::UnitZ();  // stays level
  slide_contact({*plane, *roll}, places, contact, X, da, dpi, 100);
  EXPECT_NEAR(places.on_A.numbers.x(), 15, 1e-12);
  const RigidTransform moved = test::displaced(X, da, dpi);
  // Of second order in the turn of 0.02.
  EXPECT_LT((moved * places.on_A.numbers - places.on_B.numbers).norm(), 5e-3);
  // Where the floor ends first, the point of the floor stays and that of the roller follows.
  const Eigen::Vector3d inner(10, 0, -10);
  const auto short_floor = make_plane(X * inner - 8 * X.R.col(0), {0, 0, 1}, 8);
  places = {Place{X * inner}, Place{inner}};
  const ContactLinearization at = linearize_contact({*short_floor, *roll}, places, X);
  slide_contact({*short_floor, *roll}, places, at, X, 0.2 * X.R.col(0), {0, 0, 0}, 100);
  EXPECT_LT((places.on_B.numbers - X * inner).norm(), 1e-12);
  EXPECT_NEAR(places.on_A.numbers.x(), 9.8, 1e-12);
}

TEST(Contact, LeastCurvatureLiesAlongTheLine) {
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const auto roll = make_cylinder({0, 0, 0}, {1, 0, 0}, 10, true);
  const RigidTransform X{exp_rotation({0, 0, 0.3}), {0, 0, 10}};
  const ContactLinearization line =
      linearize_contact({*plane, *roll}, {Place{{0, 0, 0}}, Place{{0, 0, -10}}}, X);
  EXPECT_NEAR(std::abs(direction_of_least_curvature(line, X.R).dot(X.R.col(0))), 1, 1e-14);
}

}  // namespace
}  // namespace condyle
