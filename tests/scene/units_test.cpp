/// One scene written in mm and degrees, in cm, in m, and in radians: the same numbers come out.

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <cmath>

#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

// Every key that has a unit. `mm` is how long 1 mm is in the written unit, `deg` how large 1 degree
// is.
std::string scene_in(const std::string& length, double mm, const std::string& angle, double deg) {
  const auto L = [&](double x) { return fmt::format("{}", x * mm); };
  const auto A = [&](double x) { return fmt::format("{}", x * deg); };
  const auto point = [&](double x, double y, double z) {
    return fmt::format("[{}, {}, {}]", L(x), L(y), L(z));
  };
  std::string text =
      fmt::format("[units]\nlength = \"{}\"\nangle = \"{}\"\nforce = \"N\"\n", length, angle);
  text += "[[body]]\nname = \"femur\"\nfixed = true\nmesh = \"femur.stl\"\nmesh_units = \"m\"\n";
  text += fmt::format(
      "[[body]]\nname = \"tibia\"\nmesh = \"tibia.stl\"\nstart.translation = {}\nstart.rotation = "
      "[{}, {}, {}]\n"
      "mass = 2\ncenter = {}\ninertia = [[{}, 0, 0], [0, {}, 0], [0, 0, {}]]\n",
      point(1, 2, 3), A(4), A(5), A(6), point(4, 5, 6), 7e3 * mm * mm, 8e3 * mm * mm,
      9e3 * mm * mm);
  const std::string axes = "lateral = [0, 0, 1], anterior = [1, 0, 0], proximal = [0, 1, 0]";
  text +=
      fmt::format("[joint]\nside = \"right\"\nfemur = {{ body = \"femur\", origin = {}, {} }}\n",
                  point(1, 1, 1), axes);
  text += fmt::format("tibia = {{ body = \"tibia\", origin = {}, {} }}\n", point(2, 2, 2), axes);
  text += fmt::format(
      "[[surface]]\nname = \"p\"\nbody = \"femur\"\nkind = \"polynomial\"\n"
      "frame = {{ origin = {}, axes = [{}, 0, 0] }}\ncoefficients = [[0, 0, {}], [1, 0, 0.3], [2, "
      "1, {}]]\n",
      point(0, 9, 0), A(30), L(3), 0.02 / (mm * mm));
  text += fmt::format(
      "[[surface]]\nname = \"t\"\nbody = \"tibia\"\nkind = \"torus\"\ncenter = {}\naxis = [0, 3, "
      "4]\nmajor = {}\nminor = {}\n",
      point(1, 0, 0), L(20), L(5));
  text += fmt::format(
      "[[surface]]\nname = \"e\"\nbody = \"tibia\"\nkind = \"ellipsoid\"\ncenter = {}\nsemi_axes = "
      "{}\nsolid = \"outside\"\n",
      point(1, 0, 0), point(20, 30, 40));
  text += fmt::format(
      "[[surface]]\nname = \"m\"\nbody = \"tibia\"\nkind = \"patch\"\n"
      "region = {{ box = [{}, {}] }}\nfit = {{ control_points = [16, 12], smoothing = {} }}\n",
      point(0, 0, 0), point(10, 20, 30), L(2));
  text += fmt::format("[[contact]]\nname = \"c\"\nsurfaces = [\"p\", \"t\"]\nstart = [{}]\n",
                      point(1, 2, 3));
  const std::string ends =
      fmt::format("ends = [{{ body = \"femur\", at = {} }}, {{ body = \"tibia\", at = {} }}]\n",
                  point(0, 30, 0), point(0, -10, 5));
  text += "[[ligament]]\nname = \"toe\"\n" + ends +
          "law = \"toe-linear\"\nstiffness = 1500\nreference_strain = 0.05\n";
  text += "[[ligament]]\nname = \"ref\"\n" + ends +
          fmt::format(
              "law = \"toe-linear\"\nstiffness = 1500\nreference_strain = 0.05\nreference_length = "
              "{}\n",
              L(42));
  text += "[[ligament]]\nname = \"quadratic\"\n" + ends +
          fmt::format("law = \"quadratic\"\nstiffness = {}\nslack_length = {}\n", 15 / (mm * mm),
                      L(30));
  text += "[[ligament]]\nname = \"polynomial\"\n" + ends +
          fmt::format("law = \"polynomial\"\ncoefficients = [10, {}, {}]\ntension_only = true\n",
                      2 / mm, 0.5 / (mm * mm));
  text += "[[ligament]]\nname = \"table\"\n" + ends +
          fmt::format("law = \"table\"\nlengths = [{}, {}]\nforces = [0, 100]\n", L(30), L(40));
  text += fmt::format("[[condition]]\nname = \"f\"\nkind = \"flexion\"\nvalue = {}\n", A(60));
  text +=
      fmt::format("[[condition]]\nname = \"d\"\nkind = \"anterior_drawer\"\nvalue = {}\n", L(6));
  text +=
      fmt::format("[[condition]]\nname = \"i\"\nkind = \"distance\"\n{}value = {}\n", ends, L(33));
  text += fmt::format(
      "[[load]]\nname = \"F\"\nbody = \"tibia\"\nkind = \"force\"\nvector = [1, 2, 3]\nat = {}\n",
      point(7, 8, 9));
  text += fmt::format("[[load]]\nname = \"M\"\nbody = \"tibia\"\nkind = \"moment\"\nvector = {}\n",
                      point(100, 0, 50));
  text += fmt::format("[sweep]\nvary = \"d\"\nfrom = {}\nto = {}\nstep = {}\n", L(0), L(-6), L(-2));
  return text;
}

Scene read(const std::string& length, double mm, const std::string& angle, double deg) {
  return parse_scene(scene_in(length, mm, angle, deg), "folder/knee.toml");
}

// Decimal input times a unit: two roundings.
constexpr double kTolerance = 4e-15;

void expect_same(const Scene& a, const Scene& b) {
  const auto near = [](const auto& x, const auto& y) {
    return (x - y).norm() <= kTolerance * (1 + y.norm());
  };
  const auto close = [](double x, double y) {
    return std::abs(x - y) <= kTolerance * (1 + std::abs(y));
  };
  EXPECT_TRUE(near(a.bodies[1].start_translation, b.bodies[1].start_translation));
  EXPECT_TRUE(near(a.bodies[1].start_rotation, b.bodies[1].start_rotation));
  EXPECT_TRUE(near(*a.bodies[1].center, *b.bodies[1].center));
  EXPECT_TRUE(near(*a.bodies[1].inertia, *b.bodies[1].inertia));
  EXPECT_EQ(*a.bodies[1].mass, *b.bodies[1].mass);
  EXPECT_TRUE(near(a.joint->tibia.origin, b.joint->tibia.origin));
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    const SurfaceDescription &s = a.surfaces[i], &t = b.surfaces[i];
    EXPECT_TRUE(near(s.point, t.point)) << s.name;
    EXPECT_TRUE(near(s.axes, t.axes)) << s.name;
    EXPECT_TRUE(near(s.semi_axes, t.semi_axes)) << s.name;
    EXPECT_TRUE(close(s.radius, t.radius) && close(s.minor_radius, t.minor_radius)) << s.name;
    for (std::size_t k = 0; k < s.terms.size(); ++k)
      EXPECT_TRUE(close(s.terms[k].a, t.terms[k].a)) << k;
  }
  EXPECT_TRUE(near((*a.surfaces[3].patch.region_box)[1], (*b.surfaces[3].patch.region_box)[1]));
  EXPECT_TRUE(close(*a.surfaces[3].patch.smoothing, *b.surfaces[3].patch.smoothing));
  EXPECT_TRUE(near(a.contacts[0].start[0], b.contacts[0].start[0]));
  for (std::size_t i = 0; i < a.ligaments.size(); ++i) {
    const Tension s = tension(a.ligaments[i].law, 37.5), t = tension(b.ligaments[i].law, 37.5);
    EXPECT_NEAR(s.force, t.force, 1e-12 * (1 + std::abs(t.force))) << a.ligaments[i].name;
    EXPECT_NEAR(s.slope, t.slope, 1e-12 * (1 + std::abs(t.slope))) << a.ligaments[i].name;
  }
  for (std::size_t i = 0; i < a.conditions.size(); ++i)
    EXPECT_TRUE(close(a.conditions[i].value, b.conditions[i].value));
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    EXPECT_TRUE(near(a.loads[i].vector, b.loads[i].vector));
    EXPECT_TRUE(near(a.loads[i].at, b.loads[i].at));
  }
  ASSERT_EQ(a.sweep->values.size(), b.sweep->values.size());
  for (std::size_t i = 0; i < a.sweep->values.size(); ++i)
    EXPECT_TRUE(close(a.sweep->values[i], b.sweep->values[i]));
}

TEST(Units, CentimetresGiveTheSameScene) {
  expect_same(read("cm", 0.1, "deg", 1), read("mm", 1, "deg", 1));
}
TEST(Units, MetresGiveTheSameScene) {
  expect_same(read("m", 1e-3, "deg", 1), read("mm", 1, "deg", 1));
}
TEST(Units, RadiansGiveTheSameScene) {
  expect_same(read("mm", 1, "rad", kDegree), read("mm", 1, "deg", 1));
}

// By hand from scene_in: what comes out of millimetres and degrees.
TEST(Units, InsideAreMillimetreNewtonRadianTonne) {
  const Scene scene = read("m", 1e-3, "deg", 1);
  EXPECT_TRUE(scene.bodies[1].start_translation.isApprox(Eigen::Vector3d(1, 2, 3), kTolerance));
  EXPECT_NEAR(scene.bodies[1].start_rotation.x(), 4 * kDegree, kTolerance);
  EXPECT_DOUBLE_EQ(*scene.bodies[1].mass, 2e-3);
  EXPECT_NEAR((*scene.bodies[1].inertia)(0, 0), 7, 1e-13);  // 7e3 kg mm² = 7 tonne mm²
  EXPECT_DOUBLE_EQ(scene.bodies[0].mesh->to_mm, 1000);
  EXPECT_DOUBLE_EQ(scene.bodies[1].mesh->to_mm, 1000);  // the scene's unit where none is named
  EXPECT_EQ(scene.bodies[0].mesh->path, std::filesystem::path("folder/femur.stl"));
  EXPECT_NEAR(scene.surfaces[0].terms[0].a, 3, kTolerance * 3);
  EXPECT_NEAR(scene.surfaces[0].terms[1].a, 0.3, kTolerance);
  EXPECT_NEAR(scene.surfaces[0].terms[2].a, 0.02, kTolerance);
  EXPECT_TRUE(scene.surfaces[0].axes.isApprox(
      Eigen::AngleAxisd(30 * kDegree, Eigen::Vector3d::UnitX()).toRotationMatrix(), 1e-14));
  EXPECT_TRUE(scene.surfaces[1].direction.isApprox(Eigen::Vector3d(0, 0.6, 0.8), 1e-15));
  EXPECT_NEAR(scene.loads[1].vector.x(), 100, 1e-12);  // 0.1 N m
  EXPECT_NEAR(scene.conditions[0].value, M_PI / 3, 1e-15);
  EXPECT_NEAR(slack_length(scene.ligaments[1].law), 42 / 1.05, 1e-13);
  EXPECT_NEAR(std::get<QuadraticLaw>(scene.ligaments[2].law).stiffness, 15, 1e-12);
  ASSERT_EQ(scene.sweep->values.size(), 4U);
  EXPECT_NEAR(scene.sweep->values[3], -6, 1e-14);
}

TEST(Units, DensityIsTonnePerCubicMillimetreInside) {
  const std::string text = R"(
[units]
length = "m"
angle = "deg"
force = "N"
[[body]]
name = "ground"
fixed = true
[[body]]
name = "bone"
density = 1900
)";
  // Bone of 1900 kg/m³ weighs 1.9e-9 tonne/mm³.
  EXPECT_NEAR(*parse_scene(text, "x.toml").bodies[1].density, 1.9e-9, 1e-23);
}

}  // namespace
}  // namespace condyle
