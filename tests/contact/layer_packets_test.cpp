/// Which points of a rough patch are pressed into another: what is left out and what is told from
/// closest points of poses before changes nothing.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <memory>

#include "condyle/contact/layer_contact.h"
#include "condyle/contact/layer_side.h"
#include "condyle/math/rotation.h"
#include "condyle/surface/bspline_basis.h"
#include "condyle/surface/exact_surfaces.h"
#include "condyle/surface/patch.h"
#include "contact/cartilage.h"
#include "support/bumpy_patches.h"

namespace condyle {
namespace {

/// A pair that is pressed by some tenths of a millimetre, and poses about it: of each three the first
/// is half a millimetre on, as in a sweep, the others nearer and nearer, as Newton's are.
struct Pressed {
  ContactPair pair;
  std::vector<RigidTransform> poses;

  explicit Pressed(unsigned seed) {
    test::Random random(seed);
    pair = test::bumpy_pair(random, 0.2);
    RigidTransform X;
    X.p.z() = 0.6;
    const auto move = [&](double length) {
      const auto some = [&] { return length * random.between(-1, 1); };
      X.p += Eigen::Vector3d(some(), some(), 0.3 * some());
      X.R = exp_rotation(0.03 * Eigen::Vector3d(some(), some(), some())) * X.R;
      poses.push_back(X);
    };
    for (int k = 0; k < 8; ++k)
      for (const double length : {0.5, 4e-3, 1e-6}) move(length);
  }
};

/// W of one point of A at depth -φ, its closest point searched from where it is seeded.
double energy_of(const Pressed& of, const LayerLattice& points, const RigidTransform& X) {
  const LayerLaw law(kCartilage, kCartilage, PressureLaw::kLinear);
  const Surface& into = *of.pair.on_B;
  double energy = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const Eigen::Vector3d p = X * points.x[i];
    const SurfacePoint at = into.evaluate(into.closest(p, into.seed(p)));
    if (at.n.dot(X.R * points.n[i]) < kOpposed)
      energy += points.area[i] * law.at(-at.n.dot(p - at.c)).energy;
  }
  return energy;
}

double distance(const Wrench& a, const Wrench& b) {
  return (a.f - b.f).norm() / b.f.norm() + (a.m - b.m).norm() / b.m.norm() +
         (a.F1 - b.F1).norm() / b.F1.norm() + (a.M2 - b.M2).norm() / b.M2.norm();
}

// By what bounds a pose that is not found: much at first, little at a pose nearby, nothing at the same.
TEST(LayerPackets, WhatIsLookedAtIsCounted) {
  const Pressed pressed(1);
  const LayerLattice lattice = layer_lattice(*pressed.pair.on_A, 3);
  const LayerClosestPoints into(*pressed.pair.on_B);
  LayerSide side(lattice, true, into);
  const auto counted = [&](const RigidTransform& X) {
    const long before = side.looked_at();
    EXPECT_GT(side.pressed(X), 10U);
    return side.looked_at() - before;
  };
  EXPECT_EQ(side.looked_at(), 0);
  const long at_first = counted(pressed.poses[1]);
  EXPECT_GT(at_first, 20);
  EXPECT_EQ(counted(pressed.poses[1]), 0);
  const long nearby = counted(pressed.poses[2]);
  EXPECT_GT(nearby, 0);
  EXPECT_LT(nearby, at_first / 2);
}

// What was found at a pose long ago is no help: closest points begin from those of the blocks, which are looked for
// anew, and not each for itself from many millimetres away.
TEST(LayerPackets, APoseFarFromTheLastOneIsLookedAtAsTheFirst) {
  const Pressed pressed(1);
  const LayerLattice lattice = layer_lattice(*pressed.pair.on_A, 6);
  const LayerClosestPoints into(*pressed.pair.on_B);
  const auto counted = [](LayerSide& side, const RigidTransform& X) {
    const long before = side.looked_at();
    (void)side.pressed(X);
    return side.looked_at() - before;
  };
  LayerSide side(lattice, true, into);
  for (int round = 0; round < 2; ++round)
    for (const double x : {0.0, 7.0, -7.0}) {
      RigidTransform X = pressed.poses[1];
      X.p.x() += x;
      LayerSide fresh(lattice, true, into);
      EXPECT_LT(counted(side, X), 1.1 * static_cast<double>(counted(fresh, X)))
          << round << ", " << x;
    }
}

TEST(LayerPackets, NothingDependsOnThePosesBefore) {
  const LayerLaw law(kCartilage, kCartilage, PressureLaw::kLinear);
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Pressed pressed(seed);
    const LayerLattice lattice = layer_lattice(*pressed.pair.on_A, 3);
    const LayerClosestPoints into(*pressed.pair.on_B);
    LayerSide side(lattice, true, into);
    for (const RigidTransform& X : pressed.poses) {
      Wrench rough, exact, anew;
      side.add_to(X, law, 1, LayerCare::kRough, rough);
      side.add_to(X, law, 1, LayerCare::kExact, exact);
      LayerSide fresh(lattice, true, into);
      fresh.add_to(X, law, 1, LayerCare::kExact, anew);
      LayerSums sums;
      side.add_to(X, law, 1, sums);
      ASSERT_GT(sums.points, 20);
      EXPECT_EQ(side.pressed(X), fresh.pressed(X));
      EXPECT_NEAR(sums.energy, energy_of(pressed, lattice, X), 1e-11 * sums.energy);
      // Curvatures are those of places up to 1e-5 mm beside; over radii of millimetres.
      EXPECT_LT((exact.f - anew.f).norm(), 1e-11 * anew.f.norm());
      EXPECT_LT(distance(exact, anew), 1e-4);
      // Third derivatives of φ times (0.02 mm)², of the depth.
      EXPECT_LT((rough.f - anew.f).norm(), 1e-4 * anew.f.norm());
    }
  }
}

TEST(LayerPackets, AfterAResetNoBitDoes) {
  const LayerLaw law(kCartilage, kCartilage, PressureLaw::kLinear);
  const Pressed pressed(3);
  const LayerLattice lattice = layer_lattice(*pressed.pair.on_A, 2);
  const LayerClosestPoints into(*pressed.pair.on_B);
  LayerSide side(lattice, true, into);
  Wrench first, again;
  side.add_to(pressed.poses[0], law, 1, LayerCare::kRough, first);
  for (const RigidTransform& X : pressed.poses) {
    Wrench wrench;
    side.add_to(X, law, 1, LayerCare::kExact, wrench);
  }
  side.reset();
  side.add_to(pressed.poses[0], law, 1, LayerCare::kRough, again);
  EXPECT_EQ(first.f, again.f);
  EXPECT_EQ(first.M2, again.M2);
}

// Told from the points around them, they carry what a lattice of them does, but at the edge of the
// contact: there they lie beside cells that are not pressed.
TEST(LayerPackets, CornersCarryAsALatticeOfThem) {
  for (const PressureLaw pressure : {PressureLaw::kLinear, PressureLaw::kLogarithmic}) {
    const LayerLaw law(kCartilage, kCartilage, pressure);
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const Pressed pressed(seed);
      const Surface& surface = *pressed.pair.on_A;
      const LayerLattice lattice = layer_lattice(surface, 3),
                         shifted = layer_lattice(surface, 3, true);
      const LayerCorners corners = layer_corners(surface, 3, lattice);
      const LayerClosestPoints into(*pressed.pair.on_B);
      LayerSide side(lattice, true, into), of_corners(shifted, true, into);
      for (const RigidTransform& X : pressed.poses) {
        const CornerForce told = side.at_corners(X, law, corners);
        LayerSums sums;
        of_corners.add_to(X, law, 1, sums);
        EXPECT_NEAR(told.force, sums.force, 1e-3 * sums.force);
        EXPECT_LT((told.along_n - sums.on_A).norm(), 1e-3 * sums.force);
        const CornerForce again = side.at_corners(X, law, corners);
        EXPECT_EQ(told.along_n, again.along_n);
      }
    }
  }
}

/// Is the lattice refined at that pose, of layers `factor` times as stiff?
bool is_refined(Pressed pressed, double tolerance, double factor, double deeper) {
  pressed.pair.elastic_B = pressed.pair.elastic_A = kCartilage;
  LayerOptions options;
  options.tolerance = tolerance;
  const auto law = layer_contact(options)(pressed.pair);
  RigidTransform X = pressed.poses[1];
  X.p.z() += deeper;
  law->soften(factor);
  law->prepare(X);
  const bool refined = !law->accepts(X);
  ContactResult result;
  (void)law->describe(X, result);
  EXPECT_TRUE(result.layer.has_value());
  if (deeper > 0 && result.layer) {
    EXPECT_GT(result.layer->deepest, 3);
  }
  return refined;
}

// Layers that are softer on the way to an equilibrium, and those pressed deeper than they bear (half of 6 mm), had up to
// thirty times as many points, and seconds went by.
TEST(LayerPackets, LatticesAreRefinedForEquilibriaAlone) {
  int refined = 0;
  for (const double tolerance : {1e-3, 5e-4, 3e-4, 2e-4, 1e-4})
    for (unsigned seed = 1; seed <= 6; ++seed) {
      refined += is_refined(Pressed(seed), tolerance, 1, 0) ? 1 : 0;
      EXPECT_FALSE(is_refined(Pressed(seed), tolerance, 0.25, 0)) << tolerance;
      EXPECT_FALSE(is_refined(Pressed(seed), tolerance, 1, 6)) << tolerance;
    }
  EXPECT_GT(refined, 0);
}

/// Of a ball of 20 mm that is 0.3 mm deep in a socket's wall or a ball [N].
double force_of_ball_on(std::shared_ptr<const Surface> floor) {
  ContactPair pair;
  pair.on_B = std::move(floor);
  pair.on_A = make_sphere(Eigen::Vector3d(0, 0, 20), 20, true);
  pair.elastic_B = pair.elastic_A = kCartilage;
  const auto law = layer_contact({.pressure = PressureLaw::kLinear, .tolerance = 2e-4})(pair);
  RigidTransform X;
  X.p.z() = -0.3;
  law->prepare(X);
  while (!law->accepts(X)) continue;  // finer each time
  ContactResult result;
  (void)law->describe(X, result);
  return result.force;
}

// A floor that curves with a radius of 5 m is flat but for a part of 20/5000, and has no points of its own: those of the
// ball tell. A lattice over all of it would have cells of a decimetre, or a hundred million points.
TEST(LayerLattices, OfASurfaceFarLargerThanTheOtherAreLeftOut) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double flat = force_of_ball_on(make_plane(Eigen::Vector3d::Zero(), up));
  EXPECT_GT(flat, 10);
  for (const double radius : {500.0, 5e3, 1e6}) {
    EXPECT_NEAR(force_of_ball_on(make_sphere(-radius * up, radius, true)) / flat, 1,
                1.1 * 20 / radius);
    EXPECT_NEAR(force_of_ball_on(make_sphere(radius * up, radius, false)) / flat, 1,
                1.1 * 20 / radius);
    EXPECT_FALSE(has_fine_lattice(*make_sphere(up, radius, true)));
  }
  EXPECT_TRUE(has_fine_lattice(*make_sphere(up, 100, true)));
  // Two of them touch over areas as large as they are.
  EXPECT_FALSE(layer_lattice(*make_sphere(up, 1e4, true), 8).x.empty());
}

/// 44 x 30 mm of z = x²/2Rx + y²/2Ry, upright or upside down; so many control points give the same surface.
std::shared_ptr<Patch> dome(double Rx, double Ry, int nu, int nv, int up) {
  PatchData data;
  data.degree = {3, 3};
  data.nu = nu, data.nv = nv;
  data.knots_u = uniform_knots(nu, 3, -22, 22);
  data.knots_v = uniform_knots(nv, 3, -15, 15);
  const auto knot = [](const std::vector<double>& t, int i) {
    return &t[static_cast<std::size_t>(i)];
  };
  const auto value = [&](const double* t) { return (t[1] + t[2] + t[3]) / 3; };
  const auto square = [&](const double* t) {
    return (t[1] * t[2] + t[1] * t[3] + t[2] * t[3]) / 3;
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double *u = knot(data.knots_u, i), *v = knot(data.knots_v, j);
      data.control_points.emplace_back(value(u), value(v),
                                       up * (square(u) / (2 * Rx) + square(v) / (2 * Ry)));
    }
  data.orientation = -up;
  return std::make_shared<Patch>(data);
}

double force_of_domes(int nu, int nv, double x) {
  ContactPair pair;
  pair.on_B = dome(400, 400, nu, nv, -1);
  pair.on_A = dome(20, 15, nu, nv, 1);
  pair.elastic_B = pair.elastic_A = kCartilage;
  const auto law = layer_contact({.pressure = PressureLaw::kLinear, .tolerance = 1e-3})(pair);
  const RigidTransform X{Eigen::Matrix3d::Identity(), {x, 0, -0.2}};
  law->prepare(X);
  while (!law->accepts(X)) continue;
  ContactResult result;
  (void)law->describe(X, result);
  return result.force;
}

// Between points of spans of 7 mm, as a fit with few control points has them, all of a contact may lie.
TEST(LayerLattices, AreFineEnoughWhereTheSpansOfAPatchAreWide) {
  for (double x = -6; x <= 6; x += 0.5) {
    const double fine = force_of_domes(24, 17, x);
    EXPECT_GT(fine, 5);
    for (const auto& [nu, nv] : {std::pair{9, 7}, std::pair{7, 5}, std::pair{5, 4}})
      EXPECT_NEAR(force_of_domes(nu, nv, x) / fine, 1, 4e-3) << nu << " x " << nv << ", " << x;
  }
}

}  // namespace
}  // namespace condyle
