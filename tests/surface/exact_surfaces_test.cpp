#include "condyle/surface/exact_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "condyle/input_error.h"
#include "support/allocation_count.h"
#include "support/numerical_jacobian.h"
#include "support/random.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Random;

// A point is no place, and a place no point, unless somebody says so.
static_assert(!std::is_convertible_v<Vector3d, Place> && !std::is_convertible_v<Place, Vector3d>);

struct Named {
  std::string name;
  std::unique_ptr<Surface> surface;
  Vector3d center;
  double sign;  ///< +1 where the solid is inside
};

/// One of each kind in general position, with the solid on either side.
std::vector<Named> all_surfaces() {
  Random random(51);
  const Vector3d c = random.vector(20), axis = random.direction();
  const Matrix3d R = random.rotation();
  const std::vector<PolynomialTerm> terms = {{0, 0, 1.5},  {1, 0, 0.1},   {0, 1, -0.2},
                                             {2, 0, 0.01}, {1, 1, 0.004}, {0, 2, -0.02},
                                             {3, 0, 2e-4}, {1, 2, -1e-4}};
  std::vector<Named> all;
  all.push_back({"plane", make_plane(c, 3 * axis), c, 1});
  for (const bool inside : {true, false}) {
    const double sign = inside ? 1 : -1;
    const std::string where = inside ? ", solid inside" : ", solid outside";
    all.push_back({"sphere" + where, make_sphere(c, 22, inside), c, sign});
    all.push_back({"cylinder" + where, make_cylinder(c, 2 * axis, 15, inside), c, sign});
    all.push_back({"ellipsoid" + where, make_ellipsoid(c, R, {20, 35, 27}, inside), c, sign});
    all.push_back({"torus" + where, make_torus(c, axis, 40, 12, inside), c, sign});
    all.push_back({"polynomial" + where, make_polynomial(c, R, terms, inside), c, sign});
  }
  return all;
}

std::vector<Place> some_places(const Named& named, int count) {
  Random random(52);
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const Place place = named.surface->seed(named.center + random.vector(40));
    places.push_back(named.surface->closest(named.center + random.vector(40), place));
  }
  return places;
}

Vector3d tangent(const SurfacePoint& at, const Vector3d& v) { return v - at.n.dot(v) * at.n; }

TEST(ExactSurfaces, NormalIsAUnitVectorAndCurvatureIsSymmetricWithinTheTangentPlane) {
  for (const Named& named : all_surfaces()) {
    for (const Place& place : some_places(named, 20)) {
      const SurfacePoint at = named.surface->evaluate(place);
      EXPECT_EQ(at.c, place.numbers) << named.name;
      EXPECT_NEAR(at.n.norm(), 1, 1e-14) << named.name;
      EXPECT_LT((at.K - at.K.transpose()).norm(), 1e-15) << named.name;
      EXPECT_LT((at.K * at.n).norm(), 1e-15) << named.name;
    }
  }
}

TEST(ExactSurfaces, MovedFollowsTheTangentAndTheNormalTurnsByTheCurvature) {
  Random random(53);
  for (const Named& named : all_surfaces()) {
    const Surface& surface = *named.surface;
    for (const Place& place : some_places(named, 20)) {
      const SurfacePoint at = surface.evaluate(place);
      const Vector3d t = tangent(at, random.direction());
      using Step = Eigen::Matrix<double, 1, 1>;
      const Vector3d dc = test::jacobian_at_zero<3, 1>(
          [&](const Step& s) -> Vector3d { return surface.moved(place, at, s[0] * t).numbers; },
          1e-2);
      const Vector3d dn = test::jacobian_at_zero<3, 1>(
          [&](const Step& s) -> Vector3d {
            return surface.evaluate(surface.moved(place, at, s[0] * t)).n;
          },
          1e-2);
      EXPECT_LT((dc - t).norm(), 1e-9) << named.name;
      EXPECT_LT((dn + at.K * t).norm(), 1e-9) << named.name;
    }
  }
}

TEST(ExactSurfaces, NormalPointsOutOfTheSolid) {
  Random random(54);
  for (const Named& named : all_surfaces()) {
    if (named.name == "plane" || named.name.starts_with("polynomial") ||
        named.name.starts_with("torus"))
      continue;
    for (const Place& place : some_places(named, 5)) {
      EXPECT_GT(named.sign * named.surface->evaluate(place).n.dot(place.numbers - named.center), 0)
          << named.name;
    }
  }
  EXPECT_LT(
      (make_plane(Vector3d::Zero(), {0, 0, 2})->evaluate({Vector3d::Zero()}).n - Vector3d::UnitZ())
          .norm(),
      1e-15);
  // Below the height polynomial lies the solid "inside".
  const auto hill = make_polynomial(Vector3d::Zero(), Matrix3d::Identity(), {{2, 0, -0.1}}, true);
  EXPECT_LT((hill->evaluate({Vector3d::Zero()}).n - Vector3d::UnitZ()).norm(), 1e-15);
  // The inner equator of a torus faces the axis.
  const auto ring = make_torus(Vector3d::Zero(), Vector3d::UnitZ(), 40, 10, true);
  EXPECT_LT((ring->evaluate({{30, 0, 0}}).n + Vector3d::UnitX()).norm(), 1e-15);
}

TEST(ExactSurfaces, CurvaturesOfClosedFormsAreMet) {
  const auto projector = [](const Vector3d& n) -> Matrix3d {
    return Matrix3d::Identity() - n * n.transpose();
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ(),
                 zero = Vector3d::Zero();
  // A ball of radius r has K = -(I - nn)/r, a socket +(I - nn)/r.
  EXPECT_LT((make_sphere(zero, 20, true)->evaluate({20 * x}).K + projector(x) / 20).norm(), 1e-16);
  EXPECT_LT((make_sphere(zero, 20, false)->evaluate({20 * x}).K - projector(x) / 20).norm(), 1e-16);
  EXPECT_LT(
      (make_cylinder(zero, z, 5, true)->evaluate({{5, 0, 7}}).K + y * y.transpose() / 5).norm(),
      1e-16);
  // Torus 40, 10: 1/10 round the tube everywhere; round the axis 1/50 outside, -1/30 inside, 0 on
  // top.
  const auto torus = make_torus(zero, z, 40, 10, true);
  EXPECT_LT((torus->evaluate({50 * x}).K + z * z.transpose() / 10 + y * y.transpose() / 50).norm(),
            1e-16);
  EXPECT_LT((torus->evaluate({30 * x}).K + z * z.transpose() / 10 - y * y.transpose() / 30).norm(),
            1e-16);
  EXPECT_LT((torus->evaluate({{40, 0, 10}}).K + x * x.transpose() / 10).norm(), 1e-16);
  // Ellipsoid at the end of its semi-axis a: curvatures a/b² and a/c².
  const auto ellipsoid = make_ellipsoid(zero, Matrix3d::Identity(), {20, 30, 25}, true);
  const Matrix3d K = ellipsoid->evaluate({20 * x}).K;
  EXPECT_LT((K + 20. / 900 * y * y.transpose() + 20. / 625 * z * z.transpose()).norm(), 1e-16);
  // A paraboloid x²/(2 r) over the solid is a cup of radius r at its lowest point.
  const auto cup =
      make_polynomial(zero, Matrix3d::Identity(), {{2, 0, 1. / 40}, {0, 2, 1. / 40}}, true);
  EXPECT_LT((cup->evaluate({zero}).K - projector(z) / 20).norm(), 1e-16);
}

/// How far a point is from the surface by the surface's own equation, relative to its size.
double off_surface(const std::string& name, const Vector3d& local) {
  if (name == "sphere") return local.norm() / 22 - 1;
  if (name == "cylinder") return local.head<2>().norm() / 15 - 1;
  if (name == "ellipsoid") return local.cwiseQuotient(Vector3d(20, 35, 27)).norm() - 1;
  if (name == "torus") return (std::hypot(local.head<2>().norm() - 40, local.z()) - 12) / 40;
  return local.z() / 30;
}

TEST(ExactSurfaces, PlacesStayOnTheSurfaceHoweverFarTheyMove) {
  Random random(55);
  const Vector3d zero = Vector3d::Zero(), z = Vector3d::UnitZ();
  const Matrix3d I = Matrix3d::Identity();
  std::vector<std::pair<std::string, std::unique_ptr<Surface>>> surfaces;
  surfaces.emplace_back("plane", make_plane(zero, z));
  surfaces.emplace_back("sphere", make_sphere(zero, 22, true));
  surfaces.emplace_back("cylinder", make_cylinder(zero, z, 15, false));
  surfaces.emplace_back("ellipsoid", make_ellipsoid(zero, I, {20, 35, 27}, true));
  surfaces.emplace_back("torus", make_torus(zero, z, 40, 12, true));
  for (const auto& [name, surface] : surfaces) {
    Place place = surface->seed(random.vector(30));
    for (int i = 0; i < 400; ++i) {
      const SurfacePoint at = surface->evaluate(place);
      // A walk of steps from 1e-3 mm to a metre; every fourth starts anew near the surface.
      const double length = std::pow(10.0, random.between(-3, 3));
      place = surface->moved(place, at, length * tangent(at, random.direction()));
      ASSERT_TRUE(place.numbers.allFinite()) << name;
      EXPECT_LT(std::abs(off_surface(name, place.numbers)),
                1e-13 * (1 + place.numbers.norm() / 100))
          << name;
    }
  }
}

TEST(ExactSurfaces, EverythingIsFiniteWhereAnEquationDegenerates) {
  for (const Named& named : all_surfaces()) {
    const Surface& surface = *named.surface;
    // The centre of a ball, the axis of a cylinder, centre and middle of the tube of a torus.
    for (const Vector3d& p : {named.center, Vector3d(named.center + Vector3d(0, 0, 1e-170))}) {
      const SurfacePoint at = surface.evaluate({p});
      EXPECT_TRUE(at.n.allFinite() && at.K.allFinite()) << named.name;
      EXPECT_NEAR(at.n.norm(), 1, 1e-12) << named.name;
      const Place seed = surface.seed(p);
      EXPECT_TRUE(seed.numbers.allFinite()) << named.name;
      EXPECT_TRUE(surface.closest(p, seed).numbers.allFinite()) << named.name;
      EXPECT_TRUE(surface.closest(p, {p}).numbers.allFinite()) << named.name;
      EXPECT_TRUE(surface.moved(seed, surface.evaluate(seed), named.center - seed.numbers)
                      .numbers.allFinite())
          << named.name;
    }
  }
  const auto torus = make_torus(Vector3d::Zero(), Vector3d::UnitZ(), 40, 10, true);
  EXPECT_TRUE(torus->evaluate({{40, 0, 0}}).K.allFinite());
  EXPECT_TRUE(torus->closest({40, 0, 0}, {{50, 0, 0}}).numbers.isApprox(Vector3d(50, 0, 0)));
}

TEST(ExactSurfaces, ClosestPlaceHasThePointOnItsNormal) {
  Random random(56);
  for (const Named& named : all_surfaces()) {
    const Surface& surface = *named.surface;
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = named.center + random.vector(60);
      const Place place = surface.closest(p, surface.seed(p));
      const SurfacePoint at = surface.evaluate(place);
      EXPECT_LT(tangent(at, p - place.numbers).norm(), 1e-11 * (1 + (p - place.numbers).norm()))
          << named.name;
    }
  }
}

TEST(ExactSurfaces, NoSampleIsCloserThanTheClosestPlace) {
  Random random(57);
  for (const Named& named : all_surfaces()) {
    const std::vector<Place> samples = named.surface->samples(4);
    if (samples.empty()) continue;
    for (int i = 0; i < 50; ++i) {
      const Vector3d p = named.center + 150 * random.direction();  // outside every one of them
      const double distance = (p - named.surface->closest(p, samples.front()).numbers).norm();
      for (const Place& sample : samples)
        EXPECT_GE((p - sample.numbers).norm(), distance - 1e-12) << named.name;
    }
  }
}

TEST(ExactSurfaces, ClosestFromWithinAnEllipsoidIsAMinimumNearTheStart) {
  Random random(58);
  const auto ellipsoid = make_ellipsoid(Vector3d::Zero(), Matrix3d::Identity(), {20, 35, 27}, true);
  for (int i = 0; i < 200; ++i) {
    const Place start = ellipsoid->seed(random.vector(30));
    const Vector3d p = 0.9 * start.numbers;
    const Place place = ellipsoid->closest(p, start);
    const SurfacePoint at = ellipsoid->evaluate(place);
    EXPECT_LT(tangent(at, p - place.numbers).norm(), 1e-12);
    EXPECT_LE((p - place.numbers).norm(), (p - start.numbers).norm());
    EXPECT_LT((place.numbers - start.numbers).norm(), 6);
  }
}

TEST(ExactSurfaces, ClosestLeavesAMaximumOfTheDistance) {
  // From (0, 0, 10) within, the end of the semi-axis 60 is a maximum of the distance: the closest
  // places lie aside.
  const auto ellipsoid = make_ellipsoid(Vector3d::Zero(), Matrix3d::Identity(), {20, 20, 60}, true);
  const Vector3d p(0, 0, 10);
  EXPECT_LT((p - ellipsoid->closest(p, {{0, 0, 60}}).numbers).norm(), 20);
}

TEST(ExactSurfaces, SamplesLieOnTheSurfaceAboutASpacingApart) {
  for (const Named& named : all_surfaces()) {
    const double spacing = 3;
    const std::vector<Place> samples = named.surface->samples(spacing);
    const bool bounded = named.name.starts_with("sphere") || named.name.starts_with("ellipsoid") ||
                         named.name.starts_with("torus");
    ASSERT_EQ(samples.empty(), !bounded) << named.name;
    for (std::size_t i = 0; i < samples.size(); i += 7) {
      const SurfacePoint at = named.surface->evaluate(samples[i]);
      EXPECT_LT(
          (named.surface->moved(samples[i], at, Vector3d::Zero()).numbers - samples[i].numbers)
              .norm(),
          1e-12);
      double nearest = 1e9;
      for (const Place& other : samples) {
        if (&other != &samples[i])
          nearest = std::min(nearest, (other.numbers - samples[i].numbers).norm());
      }
      EXPECT_LT(nearest, 1.05 * spacing) << named.name;
      EXPECT_GT(nearest, 0.2 * spacing) << named.name;
    }
    for (const Place& place : bounded ? some_places(named, 100) : std::vector<Place>{}) {
      double nearest = 1e9;
      for (const Place& sample : samples)
        nearest = std::min(nearest, (sample.numbers - place.numbers).norm());
      EXPECT_LT(nearest, 0.8 * spacing)
          << named.name;  // half the diagonal of a square of that side is 0.71
    }
  }
}

TEST(ExactSurfaces, BadShapesAreNamed) {
  const Vector3d zero = Vector3d::Zero(), z = Vector3d::UnitZ();
  const Matrix3d I = Matrix3d::Identity();
  EXPECT_THROW((void)make_plane(zero, zero), InputError);
  EXPECT_THROW((void)make_sphere(zero, -1, true), InputError);
  EXPECT_THROW((void)make_sphere(zero, NAN, true), InputError);
  EXPECT_THROW((void)make_cylinder(zero, zero, 1, true), InputError);
  EXPECT_THROW((void)make_ellipsoid(zero, 2 * I, {1, 1, 1}, true), InputError);
  EXPECT_THROW((void)make_ellipsoid(zero, I, {1, 0, 1}, true), InputError);
  EXPECT_THROW((void)make_torus(zero, z, 10, 10, true), InputError);
  EXPECT_THROW((void)make_polynomial(zero, I, {{-1, 0, 1}}, true), InputError);
}

TEST(ExactSurfaces, EvaluatingAndMovingAllocateNothing) {
  for (const Named& named : all_surfaces()) {
    const Place place = named.surface->seed(named.center + Vector3d(30, 40, 50));
    double sum = 0;
    const test::AllocationCount count;
    const SurfacePoint at = named.surface->evaluate(place);
    sum += named.surface->moved(place, at, at.n.unitOrthogonal()).numbers.norm();
    sum += named.surface->closest(Vector3d(1, 2, 3), place).numbers.norm();
    EXPECT_EQ(count.since_start(), 0) << named.name;
    EXPECT_TRUE(std::isfinite(sum)) << named.name;
  }
}

/// Bounded surfaces: how far their farthest sample lies from the edge, and how near any two
/// neighbours.
struct BoundedCase {
  const char* name;
  std::unique_ptr<Surface> surface;
  Vector3d within, on_edge, beyond;  // with the distances 2, 0 and -1
};

std::vector<BoundedCase> bounded_surfaces() {
  const Matrix3d I = Matrix3d::Identity();
  const Vector3d z = Vector3d::UnitZ();
  std::vector<BoundedCase> all;
  all.push_back({"plane", make_plane({1, 2, 3}, z, 10), {9, 2, 3}, {1, 12, 3}, {-10, 2, 3}});
  all.push_back(
      {"cylinder", make_cylinder({1, 2, 3}, z, 5, true, 20), {6, 2, 11}, {1, 7, -7}, {1, 7, 14}});
  all.push_back({"polynomial",
                 make_polynomial(Vector3d::Zero(), I, {{2, 0, 0.05}}, true, 10),
                 {8, 0, 3.2},
                 {0, 10, 0},
                 {0, -11, 0}});
  return all;
}

TEST(ExactSurfaces, KnowTheirBounds) {
  for (const BoundedCase& c : bounded_surfaces()) {
    EXPECT_NEAR(c.surface->edge_distance({c.within}), 2, 1e-14) << c.name;
    EXPECT_NEAR(c.surface->edge_distance({c.on_edge}), 0, 1e-14) << c.name;
    EXPECT_NEAR(c.surface->edge_distance({c.beyond}), -1, 1e-14) << c.name;
  }
  EXPECT_EQ(make_cylinder({0, 0, 0}, {0, 0, 1}, 5, true)->edge_distance({{5, 0, 1e6}}), kUnbounded);
  EXPECT_EQ(make_plane({0, 0, 0}, {0, 0, 1})->edge_distance({{5, 1e6, 0}}), kUnbounded);
}

// Every place within the bounds has a sample within the spacing, some samples lie on the edge
// itself, and none beyond.
TEST(ExactSurfaces, AreSampledUpToTheirBounds) {
  constexpr double kSpacing = 1.5;
  for (const BoundedCase& c : bounded_surfaces()) {
    const std::vector<Place> samples = c.surface->samples(kSpacing);
    double nearest_edge = 1e9, nearest = 1e9;
    for (const Place& place : samples) {
      EXPECT_GT(c.surface->edge_distance(place), -1e-12) << c.name;
      nearest_edge = std::min(nearest_edge, std::abs(c.surface->edge_distance(place)));
      nearest = std::min(nearest, (place.numbers - c.within).norm());
      EXPECT_LT((c.surface->seed(place.numbers).numbers - place.numbers).norm(), 1e-12) << c.name;
    }
    EXPECT_LT(nearest_edge, 1e-12) << c.name;
    EXPECT_LT(nearest, kSpacing) << c.name;
  }
  EXPECT_TRUE(make_plane({0, 0, 0}, {0, 0, 1})->samples(1).empty());
}

TEST(ExactSurfaces, RefuseBoundsThatBoundNothing) {
  EXPECT_THROW((void)make_plane(Vector3d::Zero(), Vector3d::UnitZ(), 0), InputError);
  EXPECT_THROW((void)make_cylinder(Vector3d::Zero(), Vector3d::UnitZ(), 1, true, -2), InputError);
  EXPECT_THROW((void)make_polynomial(Vector3d::Zero(), Matrix3d::Identity(), {{1, 0, 1}}, true,
                                     std::nan("")),
               InputError);
}

}  // namespace
}  // namespace condyle
