/// The elastic layer: its laws, the wrench of points pressed into a solid against closed forms, its
/// derivatives against differences, and the sums on a real knee's patches against a fixture of
/// another program. Closed forms: ball of radius R pressed by d, k [N/mm³] of both layers in series.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "condyle/contact/layer_side.h"
#include "condyle/surface/exact_surfaces.h"
#include "contact/cartilage.h"
#include "support/layer_fixture.h"
#include "support/numerical_jacobian.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

LayerLaw law_of(PressureLaw pressure, double modulus = 10) {
  const ElasticSurface layer{modulus, 0.45, 3};
  return {layer, layer, pressure};
}

TEST(LayerLaw, TwoUnlikeLayersInSeries) {
  const ElasticSurface on_B{10, 0.45, 3}, on_A{5, 0.4, 2};
  const LayerLaw linear(on_B, on_A, PressureLaw::kLinear);
  EXPECT_NEAR(linear.stiffness(), 3.762827822, 1e-9);
  EXPECT_NEAR(linear.at(0.3).pressure, 1.128848347, 1e-9);
  const LayerLaw logarithmic(on_B, on_A, PressureLaw::kLogarithmic);
  EXPECT_NEAR(logarithmic.at(0.3).pressure, 1.178109155, 1e-9);
  EXPECT_NEAR(logarithmic.at(0.3).energy, 0.1741889471, 1e-10);
  EXPECT_NEAR(logarithmic.at(0.3).stiffness, 4.100011598, 1e-9);
  EXPECT_NEAR(logarithmic.at(1).pressure, 4.388891500, 1e-9);
  EXPECT_NEAR(logarithmic.at(1).energy, 2.080148434, 1e-9);
  EXPECT_NEAR(logarithmic.at(1).stiffness, 5.144658432, 1e-9);
}

TEST(LayerLaw, PressureAndStiffnessAreDerivativesOfTheEnergy) {
  const LayerLaw law({{20, 0.3, 1.5}}, {{4, 0.45, 3}}, PressureLaw::kLogarithmic);
  for (const double d : {1e-7, 1e-3, 0.04, 0.3, 2.0, 4.0, 4.4}) {
    const double h = 1e-5 * d;
    const LayerLaw::Answer above = law.at(d + h), at = law.at(d), below = law.at(d - h);
    EXPECT_NEAR((above.energy - below.energy) / (2 * h) / at.pressure, 1, 1e-7) << d;
    EXPECT_NEAR((above.pressure - below.pressure) / (2 * h) / at.stiffness, 1, 1e-7) << d;
  }
  EXPECT_EQ(law.at(0).pressure, 0);
  EXPECT_EQ(law.at(-1).energy, 0);
  EXPECT_NEAR(law.at(1e-9).pressure / (law.stiffness() * 1e-9), 1, 1e-8);
}

TEST(LayerLaw, ALayerThatCannotChangeItsVolumeIsRefused) {
  EXPECT_NEAR(confined_modulus({1, 0.49, 3}), 17.1, 0.05);
  EXPECT_THROW(LayerLaw({{10, 0.495, 3}}, {}, PressureLaw::kLinear), std::invalid_argument);
  EXPECT_THROW(LayerLaw({{10, 0.45, 0}}, {}, PressureLaw::kLinear), std::invalid_argument);
  EXPECT_THROW(LayerLaw({}, {}, PressureLaw::kLinear), std::invalid_argument);
}

/// Abscissas and weights on (0, 1) of the midpoint rule after t = x³(10 - 15 x + 6 x²), which makes
/// it converge fast for a smooth integrand.
std::vector<std::pair<double, double>> rule(int n) {
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n;
    points.emplace_back(x * x * x * (10 - x * (15 - 6 * x)), 30 * x * x * (1 - x) * (1 - x) / n);
  }
  return points;
}

/// One block of all points.
LayerLattice in_one_block(LayerLattice lattice) {
  LayerBlock block{0, lattice.x.size()};
  for (const Vector3d& x : lattice.x) block.center += x / static_cast<double>(block.count);
  for (const Vector3d& x : lattice.x)
    block.radius = std::max(block.radius, (x - block.center).norm());
  lattice.blocks = {block};
  return lattice;
}

/// A surface of revolution about z. `profile`: radius, height and length of its derivative at t.
template <typename Profile, typename Normal>
LayerLattice revolve(double end, const Profile& profile, const Normal& normal) {
  constexpr int kAround = 12;
  LayerLattice lattice;
  for (const auto& [t, weight] : rule(400)) {
    const Vector3d at = profile(end * t);
    for (int j = 0; j < kAround; ++j) {
      const double phi = 2 * M_PI * j / kAround;
      lattice.x.emplace_back(at.x() * std::cos(phi), at.x() * std::sin(phi), at.y());
      lattice.n.push_back(normal(lattice.x.back()));
      lattice.area.push_back(weight * end * at.z() * 2 * M_PI * at.x() / kAround);
    }
  }
  return in_one_block(lattice);
}

/// The cap of a sphere about the origin from its lowest point up to an angle; of a ball or a cup.
LayerLattice cap(double R, double angle, bool ball = true) {
  return revolve(
      angle, [R](double t) { return Vector3d(R * std::sin(t), -R * std::cos(t), R); },
      [ball](const Vector3d& x) { return Vector3d((ball ? 1 : -1) * x.normalized()); });
}

LayerLattice disc(double radius) {
  return revolve(
      radius, [](double r) { return Vector3d(r, 0, 1); },
      [](const Vector3d&) { return Vector3d(0, 0, 1); });
}

struct Pushed {
  Wrench wrench;
  LayerSums sums;
};

Pushed push(const LayerLattice& points,
            bool of_A,
            const Surface& into,
            const RigidTransform& X,
            const LayerLaw& law,
            double share) {
  Pushed out;
  const LayerClosestPoints closest(into);
  LayerSide side(points, of_A, closest);
  side.add_to(X, law, share, LayerCare::kExact, out.wrench);
  side.add_to(X, law, share, out.sums);
  LayerSums again;
  side.add_to(X, law, share, again);
  EXPECT_NEAR(again.energy, out.sums.energy, 1e-12 * out.sums.energy);
  EXPECT_EQ(again.points, out.sums.points);
  return out;
}

Pushed push_A(const LayerLattice& of_A,
              const Surface& on_B,
              const RigidTransform& X,
              const LayerLaw& law,
              double share = 1) {
  return push(of_A, true, on_B, X, law, share);
}

Pushed push_B(const LayerLattice& of_B,
              const Surface& on_A,
              const RigidTransform& X,
              const LayerLaw& law,
              double share = 1) {
  return push(of_B, false, on_A, X, law, share);
}

RigidTransform at_height(double z) { return {Matrix3d::Identity(), {0, 0, z}}; }

TEST(LayerContact, BallOnAPlane) {
  const double R = 30, d = 0.5;
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const auto ball = make_sphere({0, 0, 0}, R, true);
  const LayerLaw law = law_of(PressureLaw::kLinear);
  const Pushed by_ball = push_A(cap(R, std::acos(1 - d / R)), *plane, at_height(R - d), law);
  EXPECT_NEAR(by_ball.sums.energy, 24.82580402, 1e-7);
  EXPECT_NEAR(by_ball.wrench.f.z(), 148.9548241, 1e-6);
  EXPECT_NEAR(by_ball.sums.area, 94.24777961, 1e-7);
  EXPECT_NEAR(by_ball.wrench.m.norm(), 0, 1e-9);
  const Pushed by_plane = push_B(disc(std::sqrt(2 * R * d - d * d)), *ball, at_height(R - d), law);
  EXPECT_NEAR(by_plane.sums.energy, 24.51548147, 1e-7);
  EXPECT_NEAR(by_plane.wrench.f.z(), 146.4722437, 1e-6);
  EXPECT_NEAR(by_plane.sums.area, 93.46238144, 1e-7);
  EXPECT_NEAR(-(by_ball.wrench.F1(2, 2) + by_plane.wrench.F1(2, 2)) / 2, 588.3715552, 1e-5);
}

TEST(LayerContact, BallInASocketIsHeldSideways) {
  const double R = 30, Rs = 32, d = 0.5, e = Rs - R + d;
  const auto socket = make_sphere({0, 0, 0}, Rs, false);
  const auto ball = make_sphere({0, 0, 0}, R, true);
  const LayerLaw law = law_of(PressureLaw::kLinear);
  const double of_ball = std::acos((Rs * Rs - e * e - R * R) / (2 * e * R));
  const double of_socket = std::acos((Rs * Rs + e * e - R * R) / (2 * e * Rs));
  const Pushed a = push_A(cap(R, of_ball), *socket, at_height(-e), law, 0.5);
  const Pushed b = push_B(cap(Rs, of_socket, false), *ball, at_height(-e), law, 0.5);
  EXPECT_NEAR(2 * a.sums.energy, 2 * 321.4941620 / 2, 1e-5);
  EXPECT_NEAR(2 * b.sums.energy, 2 * 313.7981628 / 2, 1e-5);
  EXPECT_NEAR(2 * a.wrench.f.z(), 1807.815048, 1e-5);
  EXPECT_NEAR(2 * b.wrench.f.z(), 1749.325454, 1e-5);
  EXPECT_NEAR(-(a.wrench.F1(0, 0) + b.wrench.F1(0, 0)), 711.4281005, 1e-4);
}

TEST(LayerContact, TwoBallsAndTheLogarithmicLaw) {
  const LayerLaw law = law_of(PressureLaw::kLinear);
  const double D = 50 - 0.5;
  const auto angle = [D](double on, double other) {
    return std::acos((on * on + D * D - other * other) / (2 * on * D));
  };
  EXPECT_NEAR(push_A(cap(30, angle(30, 20)), *make_sphere({0, 0, 0}, 20, true), at_height(D), law)
                  .wrench.f.z(),
              58.87801259, 1e-6);
  EXPECT_NEAR(push_A(cap(20, angle(20, 30)), *make_sphere({0, 0, 0}, 30, true), at_height(D), law)
                  .wrench.f.z(),
              59.38081048, 1e-6);
  const auto plane = make_plane({0, 0, 0}, {0, 0, 1});
  const std::map<double, double> forces = {
      {0.5, 153.2739889}, {1.5, 1468.794715}, {3, 6581.837915}};
  for (const auto& [d, force] : forces)
    EXPECT_NEAR(push_A(cap(30, std::acos(1 - d / 30)), *plane, at_height(30 - d),
                       law_of(PressureLaw::kLogarithmic))
                    .wrench.f.z(),
                force, 1e-6 * force / 100);
}

void expect_derivatives(const std::function<Wrench(const RigidTransform&)>& wrench,
                        const RigidTransform& X) {
  const auto force = [&](const RigidTransform& at) { return wrench(at).f; };
  const auto moment = [&](const RigidTransform& at) { return wrench(at).m; };
  const auto close = [](const Matrix3d& found, const Matrix3d& expected) {
    EXPECT_LT((found - expected).norm() / expected.norm(), 1e-8);
  };
  const Wrench w = wrench(X);
  close(w.F1, test::jacobian_of_translation(force, X));
  close(w.F2, test::jacobian_of_rotation(force, X));
  close(w.M1, test::jacobian_of_translation(moment, X));
  close(w.M2, test::jacobian_of_rotation(moment, X));
  EXPECT_LT((w.F2 - w.M1.transpose()).norm() / w.F2.norm(), 1e-13);
}

// Every point stays pressed, so that the differences meet no kink.
TEST(LayerContact, HasExactDerivativesWithPointsOnEitherBody) {
  const auto torus = make_torus({0, 0, 0}, Vector3d(0.2, 1, 0.1).normalized(), 40, 12, true);
  const SurfacePoint top = torus->evaluate(torus->seed({20, 0, 35}));
  const RigidTransform X{exp_rotation({0.1, -0.2, 0.3}), top.c - 2 * top.n};
  const auto points_facing = [&](const Vector3d& normal) {
    const Vector3d e = normal.unitOrthogonal(), f = normal.cross(e);
    LayerLattice points;
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        points.x.push_back((i - 2) * e + (j - 2) * f + 0.02 * i * j * normal);
        points.n.push_back(normal);
        points.area.push_back(0.3 + 0.1 * i);
      }
    return in_one_block(points);
  };
  const LayerLattice of_A = points_facing(-(X.R.transpose() * top.n)),
                     of_B = points_facing(-(X.R.transpose() * top.n));
  for (const PressureLaw pressure : {PressureLaw::kLinear, PressureLaw::kLogarithmic}) {
    const LayerLaw law = law_of(pressure);
    expect_derivatives(
        [&](const RigidTransform& at) { return push_A(of_A, *torus, at, law).wrench; }, X);
    expect_derivatives(
        [&](const RigidTransform& at) { return push_B(of_B, *torus, at, law).wrench; },
        X.inverse());
    EXPECT_EQ(push_A(of_A, *torus, X, law).sums.points, 25);
  }
}

/// The poses of the fixture: t and R of its rows.
std::vector<RigidTransform> fixture_poses() {
  std::vector<RigidTransform> poses;
  std::ifstream file(test::kLayer / "jam_fixture.csv");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("run,", 0) == 0) continue;
    std::stringstream cells(line);
    std::vector<double> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::atof(cell.c_str()));
    RigidTransform X;
    X.p = {row[5], row[6], row[7]};
    X.R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&row[8]);
    poses.push_back(X);
  }
  return poses;
}

TEST(LayerContact, AgreesWithAnotherProgramOnTheLenhartPatches) {
  if (!std::filesystem::exists(test::kLayer))
    GTEST_SKIP() << "no published fixture beside the project";
  const nlohmann::json fixture =
      nlohmann::json::parse(std::ifstream(test::kLayer / "patch_fixture.json"));
  const std::vector<RigidTransform> poses = fixture_poses();
  const LayerLaw law(kCartilage, kCartilage, PressureLaw::kLinear);
  int cases = 0;
  for (const nlohmann::json& row : fixture["cases"]) {
    const RigidTransform& X = poses.at(row["jam_row"]);
    const std::string where = row["compartment"], on = row["points_on"];
    const Patch condyle = test::layer_patch(where + " condyle"),
                plateau = test::layer_patch(where + " plateau");
    const int m = row["cells_per_knot_span"];
    const double share = on == "plateau+condyle" ? 0.5 : 1;
    Wrench w;
    double energy = 0, beyond = 0;
    const auto add = [&](const Pushed& pushed) {
      w.f += pushed.wrench.f, w.m += pushed.wrench.m;
      w.F1 += pushed.wrench.F1, w.F2 += pushed.wrench.F2;
      w.M1 += pushed.wrench.M1, w.M2 += pushed.wrench.M2;
      energy += pushed.sums.energy;
      beyond += pushed.sums.beyond;
    };
    if (on != "condyle") add(push_A(layer_lattice(plateau, m, false, 0), condyle, X, law, share));
    if (on != "plateau") add(push_B(layer_lattice(condyle, m, false, 0), plateau, X, law, share));
    // The other program leaves out what faces the unknown part of a patch.
    if (beyond > 0) continue;
    EXPECT_NEAR(energy, row["U_Nmm"].get<double>(), 1e-9 * energy);
    Eigen::Matrix<double, 6, 6> J, expected;
    J << w.F1, w.F2, w.M1, w.M2;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(w.f[i], row["F_on_tibia_N"][i].get<double>(), 1e-9 * w.f.norm());
      EXPECT_NEAR(w.m[i], row["M_about_tibial_origin_Nmm"][i].get<double>(), 1e-9 * w.m.norm());
    }
    for (int i = 0; i < 36; ++i)
      expected(i / 6, i % 6) = row["J_force_moment_by_da_dpi"][i / 6][i % 6].get<double>();
    EXPECT_LT((J - expected).norm() / expected.norm(), 1e-10);
    ++cases;
  }
  EXPECT_GE(cases, 12) << "of 24";
}

}  // namespace
}  // namespace condyle
