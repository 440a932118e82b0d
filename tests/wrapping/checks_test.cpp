/// The checks of shared/published/wrapping/checks.json: lengths, arcs, end tangents and Hessians of
/// shortest paths, each found in two independent ways to more digits than are compared.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "condyle/math/rotation.h"
#include "support/string_over.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using nlohmann::json;
using test::StringOver;

const std::filesystem::path kFile = CONDYLE_SOURCE_DIR "/../shared/published/wrapping/checks.json";

Vector3d vector_of(const json& j) {
  return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()};
}
Matrix3d matrix_of(const json& j) {
  Matrix3d m;
  m << vector_of(j[0]).transpose(), vector_of(j[1]).transpose(), vector_of(j[2]).transpose();
  return m;
}

class WrappingChecks : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFile)) GTEST_SKIP() << "no checks at " << kFile;
    std::ifstream stream(kFile);
    all_ = json::parse(stream);
  }
  json all_;
};

void expect_as_published(StringOver& string,
                         const json& check,
                         const Vector3d& X,
                         const Vector3d& Y) {
  EXPECT_NEAR(string.length(X, Y), check.at("length").get<double>(), 1e-9);
  const auto touches = string.touches(X, Y);
  for (std::size_t i = 0; i < check.at("arcs").size(); ++i) {
    EXPECT_TRUE(touches.at(i).touching);
    EXPECT_NEAR(touches.at(i).arc, check.at("arcs")[i].get<double>(), 1e-9);
    if (!check.contains("P")) continue;
    EXPECT_LT((touches.at(i).P - vector_of(check.at("P")[i])).norm(), 1e-9);
    EXPECT_LT((touches.at(i).Q - vector_of(check.at("Q")[i])).norm(), 1e-9);
  }
  const test::StringEnds ends = string.ends(X, Y);
  EXPECT_LT((ends.e_X - vector_of(check.at("t_at_X"))).norm(), 1e-9);
  EXPECT_LT((ends.e_Y - vector_of(check.at("t_at_Y"))).norm(), 1e-9);
  if (check.contains("hessian_YY")) {
    EXPECT_LT((ends.H_XX - matrix_of(check.at("hessian_XX"))).norm(), 1e-9);
    EXPECT_LT((ends.H_YY - matrix_of(check.at("hessian_YY"))).norm(), 1e-9);
  }
  if (check.contains("B")) {
    EXPECT_NEAR(string.finding(X, Y).conjugate * check.at("length").get<double>(),
                check.at("B").get<double>(), 1e-8);
  }
}

TEST_F(WrappingChecks, OneSurfaceWhoseSideIsTheNearest) {
  const auto semi = [](const json& check) {
    return WrapEllipsoid{vector_of(check.at("inputs").at("semi_axes"))};
  };
  const auto expect = [&](const char* name, const WrapShape& shape,
                          const std::optional<Vector3d>& side = {}) {
    SCOPED_TRACE(name);
    const json& check = all_.at(name);
    StringOver string({shape}, {side});
    expect_as_published(string, check, vector_of(check.at("inputs").at("X")),
                        vector_of(check.at("inputs").at("Y")));
  };
  expect("S1_sphere", WrapSphere{20});
  expect("S2_cylinder_helix", WrapCylinder{18});
  expect("S5_torus_over_the_tube", WrapTorus{30, 8});
  expect("S6_torus_through_the_hole", WrapTorus{30, 8}, Vector3d(22, 0, 0));
  expect("S7_ellipsoid_30_18_12", semi(all_.at("S7_ellipsoid_30_18_12")));
  expect("S8_ellipsoid_long_arc", semi(all_.at("S8_ellipsoid_long_arc")), Vector3d(0, 0, 15));
  expect("S9_spheroid_equator", semi(all_.at("S9_spheroid_equator")), Vector3d(0, 25, 0));
  expect("S12_sphere_near_conjugate_0.1", WrapSphere{20}, Vector3d(0, 20, 0));
  expect("S12_sphere_near_conjugate_0.001", WrapSphere{20}, Vector3d(0, 20, 0));
}

TEST_F(WrappingChecks, TwoCylindersInSequence) {
  const json& check = all_.at("S3_two_cylinders_open");
  StringOver string({WrapCylinder{15}, WrapCylinder{12}}, {Vector3d(0, 15, 0), Vector3d(40, 14, 0)},
                    {RigidTransform{}, RigidTransform{Matrix3d::Identity(), {40, 2, 0}}});
  expect_as_published(string, check, vector_of(check.at("inputs").at("X")),
                      vector_of(check.at("inputs").at("Y")));
}

TEST_F(WrappingChecks, EllipsoidThenASkewCylinder) {
  const json& check = all_.at("S14_ellipsoid_then_skew_cylinder");
  const Matrix3d z_to_y = exp_rotation(Vector3d(-M_PI / 2, 0, 0));
  StringOver string({WrapEllipsoid{{30, 18, 12}}, WrapCylinder{9}}, {{}, Vector3d(40, 0, 17)},
                    {RigidTransform{}, RigidTransform{z_to_y, {40, 0, 8}}});
  expect_as_published(string, check, vector_of(check.at("inputs").at("X")),
                      vector_of(check.at("inputs").at("Y")));
}

TEST_F(WrappingChecks, AnchoredOnTheEllipsoid) {
  const json& check = all_.at("S15_anchored_ellipsoid");
  const Vector3d P0 = vector_of(check.at("inputs").at("P0")),
                 Y = vector_of(check.at("inputs").at("Y"));
  const WrapEllipsoid ellipsoid{{30, 18, 12}};
  const Vector3d inside = P0 - 1.5 * P0.cwiseQuotient(ellipsoid.semi_axes.cwiseAbs2()).normalized();
  StringOver string({ellipsoid});
  EXPECT_NEAR(string.length(inside, Y), check.at("length").get<double>(), 1e-9);
  const auto touches = string.touches(inside, Y);
  EXPECT_NEAR(touches[0].arc, check.at("arc").get<double>(), 1e-9);
  EXPECT_LT((touches[0].P - P0).norm(), 1e-9);
  EXPECT_LT((touches[0].Q - vector_of(check.at("Q"))).norm(), 1e-9);
  EXPECT_LT((string.ends(inside, Y).e_Y - vector_of(check.at("t_at_Y"))).norm(), 1e-9);
  EXPECT_NEAR(string.finding(inside, Y).conjugate * check.at("length").get<double>(),
              check.at("B").get<double>(), 1e-8);
}

// Past the conjugate point the string along the equator is stationary but not the shortest.
TEST_F(WrappingChecks, PastTheConjugatePointAPathOffTheEquatorIsFound) {
  const json& check = all_.at("S9b_spheroid_equator_past_conjugate");
  const Vector3d X = vector_of(check.at("inputs").at("X")),
                 Y = vector_of(check.at("inputs").at("Y"));
  for (const std::optional<Vector3d>& side :
       {std::optional<Vector3d>{}, std::optional<Vector3d>{Vector3d(0, 25, 0)}}) {
    StringOver string({WrapEllipsoid{vector_of(check.at("inputs").at("semi_axes"))}}, {side});
    const double L = string.length(X, Y);
    EXPECT_LT(L, check.at("length").get<double>() - 0.1);
    EXPECT_GT(L, (Y - X).norm());
    EXPECT_EQ(string.finding(X, Y).outcome, WrappedPath::Outcome::kFound);
    EXPECT_GT(string.finding(X, Y).conjugate, 0);
    EXPECT_GT(std::abs(string.touches(X, Y)[0].P.z()), 1);
  }
}

Wrench wrench_of(const StringOver& string, const json& check) {
  const RigidTransform X{exp_rotation(vector_of(check.at("inputs").at("rotation_vector"))),
                         vector_of(check.at("inputs").at("a"))};
  const LineElement element{vector_of(check.at("inputs").at("x_C")),
                            vector_of(check.at("inputs").at("s_D")), ToeLinearLaw{2000, 0.06, 52},
                            string.path()};
  Wrench wrench;
  const LineElementState state = add_line_element(element, X, wrench);
  EXPECT_NEAR(state.length, check.at("length").get<double>(), 1e-9);
  EXPECT_NEAR(state.force, check.at("force").get<double>(), 1e-7);
  return wrench;
}

// Printed to 10 digits; s_D is rounded to 11.
void expect_wrench(const Wrench& wrench, const json& check) {
  EXPECT_LT((wrench.f - vector_of(check.at("wrench_F"))).norm(), 1e-7);
  EXPECT_LT((wrench.m - vector_of(check.at("wrench_M"))).norm(), 1e-6);
  EXPECT_LT((wrench.F1 - matrix_of(check.at("F1"))).norm(), 1e-7);
  EXPECT_LT((wrench.F2 - matrix_of(check.at("F2"))).norm(), 1e-6);
  EXPECT_LT((wrench.M1 - matrix_of(check.at("M1"))).norm(), 1e-6);
  EXPECT_LT((wrench.M2 - matrix_of(check.at("M2"))).norm(), 1e-5);
}

TEST_F(WrappingChecks, WrenchesOfAnEllipsoidOnEitherBody) {
  const json& on_A = all_.at("S13a_wrench_ellipsoid_on_A");
  const Matrix3d R = exp_rotation(vector_of(on_A.at("inputs").at("rotation_vector")));
  const Vector3d a = vector_of(on_A.at("inputs").at("a"));
  const StringOver on_moving({WrapEllipsoid{{30, 18, 12}}}, {{}},
                             {RigidTransform{R.transpose(), -(R.transpose() * a)}}, {true});
  expect_wrench(wrench_of(on_moving, on_A), on_A);
  const StringOver on_fixed({WrapEllipsoid{{30, 18, 12}}});
  const json& on_B = all_.at("S13b_wrench_ellipsoid_on_B");
  expect_wrench(wrench_of(on_fixed, on_B), on_B);
}

}  // namespace
}  // namespace condyle
