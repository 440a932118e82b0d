#include "condyle/contact/contact_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/contact/bending.h"
#include "condyle/contact/contact.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/exact_surfaces.h"
#include "support/random.h"

namespace condyle {
namespace {

ContactPair pair_of(std::unique_ptr<Surface> on_B, std::unique_ptr<Surface> on_A) {
  ContactPair pair;
  pair.name = "pair";
  pair.on_B = std::move(on_B);
  pair.on_A = std::move(on_A);
  return pair;
}

TEST(ContactSearch, FindsTheLowestPointOfABallOverAPlane) {
  const ContactPair pair =
      pair_of(make_plane({0, 0, 0}, {0, 0, 1}), make_sphere({0, 0, 0}, 20, true));
  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  search.find({exp_rotation({0.3, -0.8, 0.2}), {3, -7, 20.05}}, 0.1, minima);
  ASSERT_EQ(minima.size(), 1u);
  EXPECT_TRUE(minima[0].refined);
  EXPECT_NEAR(minima[0].gap, 0.05, 1e-12);
  EXPECT_LT((minima[0].point_B - Eigen::Vector3d(3, -7, 0)).norm(), 1e-9);
}

TEST(ContactSearch, SeesNothingBeyondTheCutoffAndAnOverlapBelowIt) {
  const ContactPair pair =
      pair_of(make_sphere({0, 0, 0}, 20, true), make_sphere({0, 0, 0}, 15, true));
  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  search.find({Eigen::Matrix3d::Identity(), {0, 0, 35.5}}, 0.1, minima);
  EXPECT_TRUE(minima.empty());
  search.find({Eigen::Matrix3d::Identity(), {0, 0, 32}}, 0.1, minima);
  ASSERT_EQ(minima.size(), 1u);
  EXPECT_NEAR(minima[0].gap, -3, 1e-9);
}

// The ellipsoid of a failed pose that touched a socket at one end and stuck far through it: the points of the
// socket within it face away from what they are closest to.
TEST(ContactSearch, ASolidThroughAClosedSocketIsAnOverlap) {
  const ContactPair pair =
      pair_of(make_sphere({0, 0, 0}, 48, false),
              make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {58, 48, 41}, true));
  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  for (const double far : {5.0, 20.0, 60.0}) {
    search.find({exp_rotation({0.3, -0.5, 0.2}), {0.6 * far, -0.3 * far, 0.7 * far}}, 0.1, minima);
    ASSERT_FALSE(minima.empty()) << far;
    EXPECT_LT(minima[0].gap, -1) << far;
  }
}

/// A point of an ellipsoid and its normal.
struct OfEllipsoid {
  Eigen::Vector3d c, n;
  OfEllipsoid(const Eigen::Vector3d& axes, const Eigen::Vector3d& u)
      : c(axes.cwiseProduct(u.normalized())), n(u.normalized().cwiseQuotient(axes).normalized()) {}
};

// Blades, needles and discs, whose curvature changes within the spacing of samples: two convex solids overlap by what
// they are pushed into each other at a point where their normals are opposite.
TEST(ContactSearch, SeesAGrazingOverlapOfAnyTwoEllipsoids) {
  test::Random random(11);
  const auto axes = [&] {
    const Eigen::Vector3d logs(random.between(0, 4.1), random.between(0, 4.1),
                               random.between(0, 4.1));
    return Eigen::Vector3d(logs.array().exp());
  };
  int refined = 0;
  constexpr int kTrials = 400;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Eigen::Vector3d of_A = axes(), of_B = axes();
    const OfEllipsoid a(of_A, random.vector(1)), b(of_B, random.vector(1));
    const ContactPair pair =
        pair_of(make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), of_B, true),
                make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), of_A, true));
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(a.n, -b.n).toRotationMatrix();
    const double depth = std::exp(random.between(-6, -3));
    RigidTransform X{exp_rotation(random.between(-3, 3) * b.n) * turn, {}};
    X.p = b.c - depth * b.n - X.R * a.c;
    ContactSearch search(pair);
    std::vector<GapMinimum> minima;
    search.find(X, 0, minima);
    ASSERT_FALSE(minima.empty()) << trial << ", " << depth;
    EXPECT_LT(minima[0].gap, -depth + 1e-9) << trial;
    refined += minima[0].refined ? 1 : 0;
  }
  EXPECT_GT(refined, 0.9 * kTrials);
}

TEST(ContactSearch, SurfacesMuchSmallerThanTheSpacingAreSeen) {
  const ContactPair pair =
      pair_of(make_torus({0, 0, 0}, {0, 0, 1}, 14, 6, true), make_sphere({0, 0, 0}, 28, true));
  ContactSearch search(pair, 43);
  std::vector<GapMinimum> minima;
  search.find({Eigen::Matrix3d::Identity(), {47.5, 0, 0}}, 0.1, minima);  // 14 + 6 + 28 = 48
  ASSERT_EQ(minima.size(), 1u);
  EXPECT_NEAR(minima[0].gap, -0.5, 1e-9);
}

// A wavy floor of height 0.5 cos(x) cos(y)-like polynomial bumps: x⁴ - 2x² has two pits at x = ±1
// (scaled by 10 mm), so a large ball over a double ridge touches in two places.
TEST(ContactSearch, FindsTwoPlacesWhereABallTouchesTwoRidges) {
  // z = 2 x²/100 - x⁴/10000: ridges of height 1 at x = ±10.
  const ContactPair pair = pair_of(make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                                                   {{2, 0, 0.02}, {4, 0, -0.0001}}, true),
                                   make_sphere({0, 0, 0}, 60, true));
  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  search.find({Eigen::Matrix3d::Identity(), {0, 0, 60.3}}, 0.5, minima);
  ASSERT_EQ(minima.size(), 2u);
  EXPECT_NEAR(minima[0].gap, minima[1].gap, 1e-9);  // by symmetry
  EXPECT_NEAR(std::abs(minima[0].point_B.x()), std::abs(minima[1].point_B.x()), 1e-9);
  EXPECT_LT(minima[0].point_B.x() * minima[1].point_B.x(), 0);
  // The gap there by a fine scan of the polynomial.
  double lowest = 1e9;
  for (double x = -20; x <= 20; x += 1e-3) {
    const double z = 0.02 * x * x - 0.0001 * x * x * x * x;
    lowest = std::min(lowest, std::hypot(x, 60.3 - z) - 60);
  }
  EXPECT_NEAR(minima[0].gap, lowest, 1e-6);
}

TEST(ContactSearch, FindsTheSameMinimumWarmAndFresh) {
  const ContactPair pair =
      pair_of(make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {30, 22, 20}, true),
              make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {18, 12, 15}, true));
  ContactSearch warm(pair);
  std::vector<GapMinimum> minima, fresh_minima;
  for (int k = 0; k < 20; ++k) {
    const RigidTransform X{exp_rotation({0.1 * k, 0.05 * k, 0}), {2.0 * k - 20, 5, 33 - 0.2 * k}};
    warm.find(X, 5, minima);
    ContactSearch fresh(pair);
    fresh.find(X, 5, fresh_minima);
    ASSERT_EQ(minima.size(), fresh_minima.size()) << k;  // two convex bodies: one minimum at most
    if (minima.empty()) continue;
    EXPECT_EQ(minima.size(), 1u);
    EXPECT_NEAR(minima[0].gap, fresh_minima[0].gap, 1e-9) << k;
  }
}

// A ring and an egg go through the cavity of a hollow ball or egg, and out through its wall: what a search remembers
// of the wall that they came from says nothing of the other one.
TEST(ContactSearch, SeesAnOverlapBeyondTheCentreWarmAndFresh) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d z(0, 0, 1);
  int overlaps = 0;
  for (const bool ring : {true, false})
    for (const bool ball : {true, false}) {
      const ContactPair pair = pair_of(ring ? make_torus({0, 0, 0}, z, 9, 3, true)
                                            : make_ellipsoid({0, 0, 0}, I, {7, 9, 11}, true),
                                       ball ? make_sphere({0, 0, 0}, 23, false)
                                            : make_ellipsoid({0, 0, 0}, I, {18, 27, 30}, false));
      ContactSearch warm(pair);
      std::vector<GapMinimum> minima, fresh_minima;
      for (int k = -30; k <= 60; ++k) {
        const RigidTransform X{exp_rotation({0.01 * k, 0.3, 0}), {0.1 * k, 0.03 * k, 0.7 * k}};
        warm.find(X, 0, minima);
        ContactSearch(pair).find(X, 0, fresh_minima);
        EXPECT_EQ(minima.empty(), fresh_minima.empty()) << ring << ball << k;
        overlaps += minima.empty() ? 0 : 1;
      }
    }
  EXPECT_GT(overlaps, 100);
}

// Corners of two edges, where a sample faces the other surface's known part or not by a hair.
TEST(ContactSearch, FindsTheSameAtCornersOfEdgesWarmAndFresh) {
  const ContactPair pair = pair_of(make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                                                   {{2, 0, -0.03}, {0, 2, -0.025}}, true, 12),
                                   make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                                                   {{2, 0, -0.04}, {0, 2, -0.035}}, false, 12));
  const auto cover = std::make_shared<const ContactCover>(pair, 1.2);
  std::vector<GapMinimum> minima, fresh;
  const auto lowest = [&](const RigidTransform& X) {
    ContactSearch(cover).find(X, 0, fresh);
    return fresh.empty() ? 0 : fresh[0].gap;
  };
  ContactSearch warm(cover);
  int at_corners = 0;
  for (int k = 0; k < 8; ++k) {
    const double t = 1.3 * k;
    RigidTransform X{exp_rotation({0.1 * std::sin(t), 0.12 * std::cos(1.3 * t), 0.4 * t}),
                     {8 + std::sin(2 * t), 8 + std::cos(t), 0}};
    double clear = 10, deep = -10;
    for (int halving = 0; halving < 12; ++halving) {
      X.p.z() = 0.5 * (clear + deep);
      (lowest(X) < 0 ? deep : clear) = X.p.z();
    }
    for (const double sunk : {0.002, 0.02}) {
      X.p.z() = deep - sunk;
      if (lowest(X) == 0) continue;
      at_corners += !fresh[0].refined ? 1 : 0;
      for (int from = 0; from < 12; ++from) {
        const Eigen::Vector3d aside(0.15 * std::sin(from), 0.15 * std::cos(from), 0);
        warm.find({X.R, X.p + aside}, 0, minima);
        warm.find(X, 0, minima);
        ASSERT_FALSE(minima.empty()) << k;
        ASSERT_NEAR(minima[0].gap, fresh[0].gap, 1e-8) << k;
      }
    }
  }
  EXPECT_GT(at_corners, 10);
}

// The ball rests on the inner side of the right ridge (z' = 0.1428 at x = 7), so far over that it
// runs into the left one: 60 mm from its centre, but for the way that Pythagoras tells.
TEST(ContactSearch, AKnownContactHidesNoOverlapElsewhere) {
  const ContactPair pair = pair_of(make_polynomial({0, 0, 0}, Eigen::Matrix3d::Identity(),
                                                   {{2, 0, 0.02}, {4, 0, -0.0001}}, true),
                                   make_sphere({0, 0, 0}, 60, true));
  const auto height = [](double x) { return 0.02 * x * x - 0.0001 * x * x * x * x; };
  const double slope = 0.04 * 7 - 0.0004 * 343;
  const Eigen::Vector3d touch(7, 0, height(7)), n = Eigen::Vector3d(-slope, 0, 1).normalized();
  const RigidTransform X{Eigen::Matrix3d::Identity(), touch + 60 * n};
  const ContactPlaces places{pair.on_B->closest(touch, pair.on_B->seed(touch)),
                             pair.on_A->closest(-60 * n, pair.on_A->seed(-60 * n))};
  const ContactLinearization at = linearize_contact(pair, places, X);
  ASSERT_LT(at.g.norm(), 1e-9);
  ASSERT_GT(at.relative_curvature[0], 0);
  double lowest = 1e9;  // by a fine scan of the left ridge
  for (double x = -20; x <= 0; x += 1e-3)
    lowest = std::min(lowest, std::hypot(x - X.p.x(), X.p.z() - height(x)) - 60);
  ASSERT_LT(lowest, -0.2);

  ContactSearch search(pair);
  std::vector<GapMinimum> minima;
  search.find(X, 0, minima, 0.3, {known_contact(at)});
  ASSERT_FALSE(minima.empty());
  EXPECT_NEAR(minima[0].gap, lowest, 1e-6);
}

// Two hills 2.4 mm apart, a saddle of 2 micrometres between them, on a ridge that falls off to the
// sides by ten times as much from one sample to the next: wherever the samples fall (spacing 1.2
// mm), both hills are found where a plane lies half a micrometre too low.
TEST(ContactSearch, FindsBothHillsOfAShallowRidgeWhereverTheSamplesFall) {
  const double d = 1.2, a = 0.002 / std::pow(d, 4);
  const std::vector<PolynomialTerm> hills = {
      {0, 0, -a * std::pow(d, 4)}, {2, 0, 2 * a * d * d}, {4, 0, -a}, {0, 2, -0.02}};
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d axes = exp_rotation({0, 0, 0.37 * k});
    const Eigen::Vector3d origin(0.13 * k, 0.29 * k, 0);
    const ContactPair pair =
        pair_of(make_polynomial(origin, axes, hills, true, 8), make_plane({0, 0, 0}, {0, 0, -1}));
    ContactSearch search(pair);
    std::vector<GapMinimum> minima;
    search.find({Eigen::Matrix3d::Identity(), {0, 0, -5e-4}}, 0, minima);
    ASSERT_EQ(minima.size(), 2u) << k;
    for (const GapMinimum& minimum : minima) {
      EXPECT_TRUE(minimum.refined);
      EXPECT_NEAR(minimum.gap, -5e-4, 1e-12) << k;
      EXPECT_NEAR(std::abs(axes.col(0).dot(minimum.point_B - origin)), d, 1e-6) << k;
    }
  }
}

/// How far a dense sampling of an ellipsoid rises over quadrics that are said to hold it.
class CoverOfAnEllipsoid : public testing::Test {
 protected:
  CoverOfAnEllipsoid() {
    for (const Place& place : surface->samples(0.3)) dense.push_back(surface->evaluate(place).c);
  }
  [[nodiscard]] bool is_in_cell(const Eigen::Vector3d& c, int sample) const {
    return (c - cover.sample(sample).c).norm() < cover.cell_radius(sample);
  }
  /// Over the quadric of a cluster, within the cells of its samples [mm].
  [[nodiscard]] double rise_over(const SurfaceCover::Cluster& cluster,
                                 const SurfacePoint& at) const {
    double rise = 0;
    for (const Eigen::Vector3d& c : dense) {
      bool within = false;
      for (int k = cluster.first; k < cluster.last && !within; ++k)
        within = is_in_cell(c, cover.in_order(k));
      const Eigen::Vector3d d = c - at.c;
      if (within) rise = std::max(rise, at.n.dot(d) - 0.5 * d.dot(at.K * d));
    }
    return rise;
  }
  const std::unique_ptr<const Surface> surface =
      make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {19, 26, 24}, true);
  const SurfaceCover cover{*surface, 1.2};
  ClusterQuadrics quadrics{cover};
  std::vector<Eigen::Vector3d> dense;
};

// A quarter of the spacing at which it was measured: between the samples too.
TEST_F(CoverOfAnEllipsoid, NoPointRisesAboveWhatItsClustersAllow) {
  int told = 0;
  for (int k = 0; k < static_cast<int>(cover.clusters().size()); k += 7) {
    const SurfaceCell& cell = quadrics.of(k).cell;
    if (!std::isfinite(cell.rise)) continue;
    ++told;
    EXPECT_LE(rise_over(cover.cluster(k), cell.at), cell.rise)
        << "cluster " << k << ", " << cell.radius << " mm";
  }
  EXPECT_GT(told, 50);
}

// Quadrics about as curved as the ellipsoid, a little turned, tilted and shifted: what is said to lie
// below one, does.
TEST_F(CoverOfAnEllipsoid, EveryPointOfACellLiesOnTheSideThatItIsSaidToLieOn) {
  int told = 0;
  std::vector<int> doubtful;
  for (int k = 0; k < 12; ++k) {
    const SurfacePoint& about = cover.sample(k * cover.size() / 12);
    SurfacePoint upper = about;
    upper.n = -(exp_rotation({0.02 * k, 0.1, -0.01 * k}) * about.n);
    upper.K = Eigen::Matrix3d::Zero();
    upper.c += (0.1 * k - 0.3) * about.n;
    const DividingQuadric quadric = divide(about, upper, about.c);
    cover.columns().not_on(CellColumns::Side::kBelow, quadric, doubtful);
    EXPECT_LT(doubtful.size(), static_cast<std::size_t>(cover.size()));
    for (int i = 0; i < cover.size(); i += 5) {
      if (std::binary_search(doubtful.begin(), doubtful.end(), i)) continue;
      for (const Eigen::Vector3d& c : dense) {
        if (!is_in_cell(c, i)) continue;
        ++told;
        const Eigen::Vector3d d = c - quadric.o;
        EXPECT_LT((quadric.n - quadric.b).dot(d) - 0.5 * d.dot(quadric.M * d), 0) << c.transpose();
      }
    }
  }
  EXPECT_GT(told, 1000);
}

TEST_F(CoverOfAnEllipsoid, NoPointRisesAboveWhatItsShellsAllow) {
  int told = 0;
  for (int k = 0; k < cover.size(); k += 31)
    for (const double radius : {4.0, 8.0, 12.0}) {
      const SurfacePoint& at = cover.sample(k);
      const double allowance = quadrics.rise(at, 0, 0, radius).over_quadric;
      if (!std::isfinite(allowance)) continue;
      ++told;
      for (const Eigen::Vector3d& c : dense) {
        const Eigen::Vector3d d = c - at.c;
        if (d.norm() > radius) continue;
        const Eigen::Vector3d t = d - at.n.dot(d) * at.n;
        EXPECT_LE(at.n.dot(d) - 0.5 * t.dot(at.K * t), 0.5 * allowance * t.squaredNorm() + 1e-9)
            << at.c.transpose() << " by " << d.transpose();
      }
    }
  EXPECT_GT(told, 300);
}

}  // namespace
}  // namespace condyle
