/// The lowest gap of two surfaces, against exact distances and brute force.

#include "condyle/verify/gap_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "condyle/math/rotation.h"
#include "condyle/surface/bspline_basis.h"

namespace condyle::verification {
namespace {

SurfaceDescription described(SurfaceKind kind) {
  SurfaceDescription surface;
  surface.kind = kind;
  return surface;
}

std::unique_ptr<SurfaceSide> floor_of(double radius) {
  SurfaceDescription plane = described(SurfaceKind::kPlane);
  plane.known_radius = radius;
  return make_exact_side(plane);
}

RigidTransform raised(double z) {
  return {exp_rotation({0.3, -0.2, 0.4}), Vector3d(1.234, -2.345, z)};
}

TEST(GapProbe, FindsHowFarABallIsFromAFloor) {
  SurfaceDescription sphere = described(SurfaceKind::kSphere);
  sphere.radius = 20;
  const auto ball = make_exact_side(sphere), ground = floor_of(30);
  for (const double gap : {0.3, 1e-5, 0.0, -1e-5, -0.02, -4.0}) {
    const RigidTransform X = raised(20 + gap);
    const double from_ball = GapProbe(*ball, *ground).lowest(X).gap,
                 from_floor = GapProbe(*ground, *ball).lowest(X.inverse()).gap;
    // Gaps above zero need not be exact.
    const double tolerance = gap > 0.01 ? 0.01 : 1e-9;
    EXPECT_NEAR(from_ball, gap, tolerance);
    EXPECT_NEAR(from_floor, gap, tolerance);
  }
}

TEST(GapProbe, KnowsWhereASurfaceEnds) {
  SurfaceDescription sphere = described(SurfaceKind::kSphere);
  sphere.radius = 5;
  const auto ball = make_exact_side(sphere), ground = floor_of(10);
  // Its lowest point, 1 mm under the floor, lies 4 mm beyond the rim: on the rim the ball is above.
  const RigidTransform X{Eigen::Matrix3d::Identity(), Vector3d(14, 0, 4)};
  EXPECT_GE(GapProbe(*ball, *ground).lowest(X).gap, 0);
  EXPECT_GE(GapProbe(*ground, *ball).lowest(X.inverse()).gap, 0);
  // 2 mm beyond it the rim is 0.39 mm inside the ball, which is lower beside than on the rim.
  const RigidTransform Y{Eigen::Matrix3d::Identity(), Vector3d(12, 0, 4)};
  EXPECT_NEAR(GapProbe(*ground, *ball).lowest(Y.inverse()).gap, std::sqrt(20.0) - 5, 1e-3);
}

// A cap that is known over 10 mm says nothing of what its bone is like 11 mm below it, unless something pushes in from above.
TEST(GapProbe, TakesABoneForSolidAsDeepAsItsSurfaceIsWide) {
  SurfaceDescription polynomial = described(SurfaceKind::kPolynomial);
  polynomial.terms = {{2, 0, -1. / 60}, {0, 2, -1. / 60}};
  polynomial.known_radius = 10;
  const auto cap = make_exact_side(polynomial), ground = floor_of(3);
  const RigidTransform same{Eigen::Matrix3d::Identity(), Vector3d(0, 0, -11)},
      opposed{exp_rotation({M_PI, 0, 0}), same.p},
      shallow{Eigen::Matrix3d::Identity(), Vector3d(0, 0, -9)};
  const LowestGap behind = GapProbe(*ground, *cap).lowest(same);
  EXPECT_TRUE(behind.behind);
  EXPECT_GE(behind.gap, 0);
  for (const RigidTransform& X : {opposed, shallow}) {
    const LowestGap overlap = GapProbe(*ground, *cap).lowest(X);
    EXPECT_FALSE(overlap.behind);
    EXPECT_NEAR(overlap.gap, X.p.z(), 0.01 * std::abs(X.p.z()));
  }
}

TEST(GapProbe, SeesBallsInSocketsAndToriFromAllSides) {
  SurfaceDescription socket = described(SurfaceKind::kEllipsoid);
  socket.semi_axes = {25, 22, 20};
  socket.solid_inside = false;
  SurfaceDescription ring = described(SurfaceKind::kTorus);
  ring.radius = 10;
  ring.minor_radius = 4;
  const auto outside = make_exact_side(socket), torus = make_exact_side(ring);
  for (const double sink : {0.0, 0.7}) {
    // The tube's outermost circle at (14 cos, 14 sin, 0) pushed along x: 25 - 14 = 11 mm of room.
    const RigidTransform X{Eigen::Matrix3d::Identity(), Vector3d(11 + sink, 0, 0)};
    const LowestGap from_ring = GapProbe(*torus, *outside).lowest(X),
                    from_socket = GapProbe(*outside, *torus).lowest(X.inverse());
    EXPECT_NEAR(from_ring.gap, -sink, 1e-9);
    EXPECT_NEAR(from_socket.gap, -sink, 1e-9);
  }
}

/// Counts how often it is asked for the closest point.
class Counted final : public SurfaceSide {
 public:
  explicit Counted(std::unique_ptr<SurfaceSide> side) : side_(std::move(side)) {}
  [[nodiscard]] std::vector<Cell> cells(double size) const override { return side_->cells(size); }
  [[nodiscard]] double longest_way() const override { return side_->longest_way(); }
  [[nodiscard]] ChartPoint at(int chart, double u, double v) const override {
    return side_->at(chart, u, v);
  }
  [[nodiscard]] double edge(int chart, double u, double v) const override {
    return side_->edge(chart, u, v);
  }
  [[nodiscard]] double curvature(int chart, double u, double v) const override {
    return side_->curvature(chart, u, v);
  }
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    ++asked;
    return side_->closest(p);
  }
  mutable int asked = 0;

 private:
  std::unique_ptr<SurfaceSide> side_;
};

std::unique_ptr<SurfaceSide> ball_of(double radius) {
  SurfaceDescription sphere = described(SurfaceKind::kSphere);
  sphere.radius = radius;
  return make_exact_side(sphere);
}

TEST(GapProbe, TellsADeepOverlapThatIsAsDeepEverywhereWithoutDividingAllCells) {
  const Counted outer(ball_of(25));
  const auto inner = ball_of(20);
  EXPECT_NEAR(GapProbe(*inner, outer).lowest({}).gap, -5, 0.05);
  EXPECT_LT(outer.asked, 50000);
}

// Balls in sockets that are larger by a hundred-thousandth to a thousandth: neither curvature says anything of the
// gap between them, which is 2 δ on the far side.
TEST(GapProbe, TellsSurfacesApartThatNearlyConform) {
  constexpr double kRadius = 20;
  for (const double larger : {2e-4, 2e-3, 2e-2})
    for (const double sink : {0.0, 1e-4}) {
      SurfaceDescription socket = described(SurfaceKind::kSphere);
      socket.radius = kRadius + larger;
      socket.solid_inside = false;
      const Counted around(make_exact_side(socket));
      const RigidTransform X{exp_rotation({0.3, -0.2, 0.4}),
                             (larger + sink) * Vector3d(1, 2, -2) / 3};
      EXPECT_NEAR(GapProbe(*ball_of(kRadius), around).lowest(X).gap, -sink, 1e-9) << larger;
      EXPECT_LT(around.asked, 120000) << larger;
    }
}

TEST(GapProbe, LooksAtWhatIsLargeAsAtWhatIsSmall) {
  for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
    const Counted ground(floor_of(30 * scale));
    const RigidTransform X{exp_rotation({0.3, -0.2, 0.4}), scale * Vector3d(1.2, -2.3, 19.5)};
    EXPECT_NEAR(GapProbe(*ball_of(20 * scale), ground).lowest(X).gap, -0.5 * scale, 0.005 * scale);
    EXPECT_LT(ground.asked, 50000) << scale;
  }
}

// Layers overlap, so only what is deeper than they bear is looked for.
TEST(GapProbe, FindsNoMoreThanIsWanted) {
  const Counted ground(floor_of(30));
  const auto ball = ball_of(20);
  const RigidTransform X = raised(18.5);
  const LowestGap lowest = GapProbe(*ball, ground).lowest(X, -2);
  EXPECT_TRUE(lowest.exact);
  EXPECT_GT(lowest.gap, -2);
  const int asked = ground.asked;
  EXPECT_NEAR(GapProbe(*ball, ground).lowest(X).gap, -1.5, 0.015);
  EXPECT_GT(ground.asked - asked, asked);
  EXPECT_NEAR(GapProbe(*ball, ground).lowest(raised(16), -2).gap, -4, 0.04);
}

// A long roller lies on a floor, and a sheet as an ellipsoid stands on it: no bound tells that all of a line, or of a sheet's broad
// sides, is free. That not all was looked at is no overlap.
TEST(GapProbe, SaysWhereItGaveUp) {
  SurfaceDescription roller = described(SurfaceKind::kCylinder);
  roller.direction = Vector3d::UnitX();
  roller.radius = 5;
  roller.length = 1000;
  SurfaceDescription ellipsoid = described(SurfaceKind::kEllipsoid);
  ellipsoid.semi_axes = {100, 0.1, 100};
  ellipsoid.axes.setIdentity();
  const auto ground = floor_of(800);
  const RigidTransform lying{Eigen::Matrix3d::Identity(), Vector3d(0, 0, 5)},
      standing{exp_rotation({M_PI / 2, 0, 0}), Vector3d(0, 0, 0.1)};
  for (const auto& [surface, X] : {std::pair{roller, lying}, std::pair{ellipsoid, standing}}) {
    const LowestGap lowest = GapProbe(*make_exact_side(surface), *ground).lowest(X);
    EXPECT_FALSE(lowest.exact);
    EXPECT_LT(std::abs(lowest.gap), 1e-6);
  }
}

TEST(GapProbe, SaysThatNumbersAreTooGreat) {
  const auto ball = ball_of(1e99), ground = floor_of(30);
  const RigidTransform far{Eigen::Matrix3d::Identity(), Vector3d(0, 0, 1e300)};
  EXPECT_TRUE(std::isnan(GapProbe(*ground, *ball).lowest(far).gap));
}

/// A sheet over [0, 30]² with a random field of height on it, 3 mm from control point to control
/// point.
PatchData bumpy(double rms, unsigned seed) {
  PatchData data;
  data.nu = data.nv = 13;
  data.knots_u = data.knots_v = uniform_knots(13, 3, 0, 30);
  std::mt19937 random(seed);
  std::normal_distribution<double> height;
  for (int i = 0; i < data.nu; ++i)
    for (int j = 0; j < data.nv; ++j)
      data.control_points.emplace_back(3 * i - 3, 3 * j - 3, rms * height(random));
  return data;
}

TEST(GapProbe, MissesNothingThatBruteForceFinds) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const PatchData data = bumpy(0.05 * seed, seed);
    const Patch patch(data);
    SurfaceDescription sphere = described(SurfaceKind::kSphere);
    sphere.radius = 300;
    sphere.point = {15, 15, 300};
    const auto sheet = make_spline_side(data), ball = make_exact_side(sphere);
    double highest = -1e9;  // of a sheet under a ball: how far it comes towards its centre
    for (double u = 0; u <= 30; u += 0.05)
      for (double v = 0; v <= 30; v += 0.05)
        highest = std::max(highest, 300 - (patch.derivatives(u, v).c - sphere.point).norm());
    // Sink the ball until 0.01 mm of the highest bump is inside.
    const RigidTransform X{Eigen::Matrix3d::Identity(), Vector3d(0, 0, -highest + 0.01)};
    const double from_sheet = GapProbe(*sheet, *ball).lowest(X).gap,
                 from_ball = GapProbe(*ball, *sheet).lowest(X.inverse()).gap;
    EXPECT_LT(from_sheet, -0.01 + 2e-4) << "seed " << seed;
    EXPECT_GT(from_sheet, -0.03) << "seed " << seed;
    EXPECT_NEAR(from_ball, from_sheet, 1e-3) << "seed " << seed;
  }
}

TEST(GapProbe, LooksOnlyAtWhatIsKnown) {
  PatchData data = bumpy(0, 1);
  data.mask_nu = data.mask_nv = 30;  // known for u < 15
  for (int i = 0; i <= 30; ++i)
    for (int j = 0; j <= 30; ++j) data.mask.push_back(15 - i);
  SurfaceDescription sphere = described(SurfaceKind::kSphere);
  sphere.radius = 20;
  const auto sheet = make_spline_side(data), ball = make_exact_side(sphere);
  const auto lowest = [&](double x) {
    const RigidTransform X{Eigen::Matrix3d::Identity(), Vector3d(x, 15, 19.5)};
    return std::min(GapProbe(*sheet, *ball).lowest(X.inverse()).gap,
                    GapProbe(*ball, *sheet).lowest(X).gap);
  };
  EXPECT_NEAR(lowest(10), -0.5, 1e-9);
  EXPECT_GE(lowest(25), 0);  // 10 mm beyond: the ball has risen over the sheet by then
}

}  // namespace
}  // namespace condyle::verification
