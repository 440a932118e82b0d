/// Ellipsoids fitted to bones: exact ones are found again, what is none is refused, and on real knees
/// strings over the ellipsoid are as long as those over the mesh.

#include "condyle/specimen/fit_wraps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_ellipsoid.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/preset_flexion.h"
#include "condyle/specimen/strands_in_bone.h"
#include "scene/fitted_wrap_scene.h"
#include "support/closed_shapes.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using test::ellipsoid_solid;
using test::fitted_wrap_scene;

const RigidTransform kPlace{exp_rotation({0.2, -0.5, 0.3}), {6, 5, -2}};

TriangleMesh placed(TriangleMesh mesh, const RigidTransform& X) {
  for (Vector3d& p : mesh.vertices) p = X * p;
  return mesh;
}

std::string message_of_fit(const TriangleMesh& bone) {
  Scene scene = fitted_wrap_scene();
  try {
    fit_wraps(scene, {TriangleMesh{}, bone});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FitEllipsoid, FindsAnEllipsoidThroughItsPoints) {
  const Vector3d semi_axes(30, 18, 12);
  const TriangleMesh mesh = placed(ellipsoid_solid(semi_axes, 3), kPlace);
  RigidTransform start = kPlace;
  start.R = start.R * exp_rotation({0.2, 0.1, -0.2});
  start.p += Vector3d(3, -2, 1);
  const EllipsoidFit fit = fit_ellipsoid(mesh.vertices, start, 14);
  ASSERT_TRUE(fit.found);
  Vector3d found = fit.semi_axes;
  std::sort(found.begin(), found.end(), std::greater<>());
  // Rounder ones are preferred by as much as 1e-4 of the points' own say.
  EXPECT_NEAR((found - semi_axes).norm(), 0, 0.02);
  EXPECT_NEAR((fit.placement.p - kPlace.p).norm(), 0, 0.01);
  EXPECT_LT(fit.rms, 0.01);
}

TEST(FitWraps, GivesTheShapeOfTheBoneWhereStringsTouch) {
  Scene scene = fitted_wrap_scene();
  ASSERT_TRUE(scene.wraps[0].fit);
  EXPECT_EQ(scene.wraps[0].fit->ligaments, std::vector<int>{0});
  EXPECT_FALSE(has_known_path(scene, scene.ligaments[0]));
  const TriangleMesh bone = placed(ellipsoid_solid({9, 7, 6}, 0.8), kPlace);
  fit_wraps(scene, {TriangleMesh{}, bone});
  const BoneFit& fit = *scene.wraps[0].fit;
  EXPECT_TRUE(fit.done);
  EXPECT_LT(fit.rms, 0.02);
  EXPECT_FALSE(fit.strings.empty());
  // Smoothing over 1.5 mm where radii are 4 mm and more.
  EXPECT_LT(fit.length_max, 0.06);
  // The scene's strain is that along the path.
  const double length = ligament_length(scene, scene.ligaments[0], RigidTransform{});
  EXPECT_GT(length, 30.01);
  EXPECT_DOUBLE_EQ(slack_length(scene.ligaments[0].law), length / 1.1);
  EXPECT_NE(describe_wrap_fits(scene).at(0).find("wrap \"rim\": ellipsoid of semi-axes"),
            std::string::npos);
}

// A wrap of the same shape given by its numbers leads the ligament the same way.
TEST(FitWraps, LeadsAsTheEllipsoidItself) {
  Scene scene = fitted_wrap_scene();
  const Vector3d semi_axes(9, 7, 6);
  fit_wraps(scene, {TriangleMesh{}, placed(ellipsoid_solid(semi_axes, 0.8), kPlace)});
  const double fitted = ligament_length(scene, scene.ligaments[0], RigidTransform{});
  scene.wraps[0].shape = WrapEllipsoid{semi_axes};
  scene.wraps[0].placement = kPlace;
  EXPECT_NEAR(ligament_length(scene, scene.ligaments[0], RigidTransform{}), fitted, 0.01);
}

// Strings and ellipsoid are found to the end: how a file numbers its vertices changes rounding and no more.
TEST(FitWraps, DoNotDependOnTheOrderOfAFile) {
  TriangleMesh bone = placed(ellipsoid_solid({9, 7, 6}, 0.8), kPlace);
  for (std::size_t v = 0; v < bone.vertices.size(); ++v)  // rough as a scan
    bone.vertices[v] *= 1 + 0.01 * std::sin(12.9898 * static_cast<double>(v));
  TriangleMesh backwards = bone;
  std::reverse(backwards.vertices.begin(), backwards.vertices.end());
  std::reverse(backwards.triangles.begin(), backwards.triangles.end());
  const int last = static_cast<int>(bone.vertices.size()) - 1;
  for (auto& t : backwards.triangles)
    for (int& v : t) v = last - v;
  Scene a = fitted_wrap_scene(), b = fitted_wrap_scene();
  fit_wraps(a, {TriangleMesh{}, bone});
  fit_wraps(b, {TriangleMesh{}, backwards});
  EXPECT_EQ(a.wraps[0].fit->vertices, b.wraps[0].fit->vertices);
  EXPECT_LT((std::get<WrapEllipsoid>(a.wraps[0].shape).semi_axes -
             std::get<WrapEllipsoid>(b.wraps[0].shape).semi_axes)
                .norm(),
            1e-5);
  EXPECT_NEAR(ligament_length(a, a.ligaments[0], RigidTransform{}),
              ligament_length(b, b.ligaments[0], RigidTransform{}), 1e-7);
}

TEST(FitWraps, RefusesWhatIsNoEllipsoid) {
  // A bar with edges.
  TriangleMesh bar;
  test::append(bar, test::cylinder_solid(6, 40, 0.7));
  for (Vector3d& p : bar.vertices) {
    const double r = std::max(std::abs(p.x()), std::abs(p.y()));
    if (r > 0) p.head<2>() *= p.head<2>().norm() / r;
  }
  RigidTransform X;
  X.p = {5, 5, 0};
  const std::string message = message_of_fit(placed(bar, X));
  EXPECT_NE(message.find(
                "knee.toml:40: [[wrap]] \"rim\": fit = \"bone\": no ellipsoid is near \"tibia\""),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("expected at most 0.6 mm rms and semi-axes of at most 150 mm: fewer "
                         "ligaments, or a torus or an ellipsoid given by hand"),
            std::string::npos)
      << message;
}

TEST(FitWraps, NamesMeshesThatCannotBeUsed) {
  EXPECT_EQ(
      message_of_fit(test::height_sheet(30, 20, [](double, double) { return 0.0; })),
      "knee.toml:40: [[wrap]] \"rim\": fit = \"bone\": the mesh of \"tibia\" does not enclose a "
      "volume, expected a closed one");
  RigidTransform far;
  far.p = {200, 0, 0};
  EXPECT_EQ(message_of_fit(placed(ellipsoid_solid({9, 7, 6}, 1), far)),
            "knee.toml:40: [[wrap]] \"rim\": fit = \"bone\": no string of its ligaments touches "
            "\"tibia\" "
            "at the start pose or flexed from there, expected a body that is in their way");
}

// Flexion is positive, about the femur's axis, whichever bone is fixed.
TEST(PresetPoses, AreFlexedAsTheJointSays) {
  for (const std::string femur_fixed : {"true", "false"}) {
    std::string text = kSmallScene;
    if (femur_fixed == "false") {
      text = with(text, "name = \"femur\"\nfixed = true", "name = \"femur\"");
      text = with(text, "name = \"tibia\"\n", "name = \"tibia\"\nfixed = true\n");
      text = with(text, "start.translation = [0, 0, 0]\nstart.rotation = [0, 0, 0]\n", "");
      text = with(text, "body = \"tibia\"\nkind = \"force\"", "body = \"femur\"\nkind = \"force\"");
    }
    const Scene scene = parse_scene(text, "knee.toml");
    const std::vector<PresetPose> poses = preset_poses(scene);
    ASSERT_EQ(poses.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
      const JointCoordinates q = joint_coordinates(joint_frames(scene), poses[i].X_BA);
      EXPECT_NEAR(q.flexion, poses[i].flexion, 1e-12);
      EXPECT_NEAR(poses[i].flexion, static_cast<double>(i) * M_PI / 6, 1e-12);
      EXPECT_NEAR(q.adduction, 0, 1e-12);
    }
  }
}

TEST(StrandsInBone, AreNamedWithTheirDepthAndAWrapIsProposed) {
  Scene scene = fitted_wrap_scene();
  scene.wraps.clear();
  scene.ligaments[0].path = {};
  RigidTransform X;
  X.p = {3, 6, 0};
  const TriangleMesh bone = placed(ellipsoid_solid(Vector3d::Constant(5), 0.5), X);
  const std::vector<StrandInBone> strands = strands_in_bone(scene, {TriangleMesh{}, bone});
  ASSERT_EQ(strands.size(), 1U);
  EXPECT_EQ(strands[0].body, 1);
  EXPECT_NEAR(strands[0].depth, 2, 0.05);  // the line passes 3 mm from the middle
  const std::vector<std::string> lines = wrap_warnings(scene, {TriangleMesh{}, bone});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("warning: straight through \"tibia\""), std::string::npos);
  EXPECT_NE(lines[0].find("[[wrap]] body = \"tibia\", kind = \"ellipsoid\", fit = \"bone\""),
            std::string::npos);
  // A patella in the file of its femur is none of the bone.
  TriangleMesh two = bone;
  test::append(two, placed(ellipsoid_solid(Vector3d::Constant(4), 0.5),
                           {Eigen::Matrix3d::Identity(), {60, 0, 0}}));
  const std::vector<StrandInBone> same = strands_in_bone(scene, {TriangleMesh{}, two});
  ASSERT_EQ(same.size(), 1U);
  EXPECT_DOUBLE_EQ(same[0].depth, strands[0].depth);
  // Of an open sheet nothing is said but that.
  const TriangleMesh sheet = test::height_sheet(40, 8, [](double, double) { return 0.; });
  EXPECT_TRUE(strands_in_bone(scene, {TriangleMesh{}, sheet}).empty());
  EXPECT_EQ(wrap_warnings(scene, {TriangleMesh{}, sheet}),
            std::vector<std::string>{
                "ligaments straight through \"tibia\" are not looked for: its mesh is open"});
}

std::vector<int> with_prefixes(const Scene& scene, const std::vector<std::string>& prefixes) {
  std::vector<int> found;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    for (const std::string& prefix : prefixes)
      if (scene.ligaments[i].name.starts_with(prefix)) found.push_back(static_cast<int>(i));
  return found;
}

/// A wrap over the ligaments with these names, fitted.
BoneFit fitted(const fs::path& file, int body, const std::vector<std::string>& prefixes) {
  Scene scene = read_scene(file);
  WrapDescription wrap;
  wrap.name = prefixes[0];
  wrap.body = body;
  wrap.fit = BoneFit{};
  wrap.fit->ligaments = with_prefixes(scene, prefixes);
  for (const int i : wrap.fit->ligaments)
    scene.ligaments[static_cast<std::size_t>(i)].path.wraps = {0};
  scene.wraps = {wrap};
  fit_wraps(scene, std::vector<FittedSurface>{});
  return *scene.wraps[0].fit;
}

TEST(FitWraps, KeepTheLengthsOfStringsOverRealBones) {
  const fs::path folder = fs::path(CONDYLE_SOURCE_DIR) / "../shared/specimens/clouthier2019_ssm";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::vector<fs::path> knees = {folder / "knee.toml"};
  for (const auto& entry : fs::directory_iterator(folder / "population"))
    if (entry.path().extension() == ".toml") knees.push_back(entry.path());
  constexpr int kFemur = 0, kTibia = 1;
  for (const fs::path& knee : knees) {
    const BoneFit superficial = fitted(knee, kTibia, {"MCLs"});
    EXPECT_LT(superficial.length_rms, 0.1) << knee;
    EXPECT_LT(superficial.rms, 0.6) << knee;
    EXPECT_GE(superficial.strings.size(), 20U) << knee;
    const BoneFit medial = fitted(knee, kFemur, {"pCAP1", "pCAP5", "pCAP7"});
    EXPECT_LT(medial.length_rms, 0.15) << knee;
    const BoneFit lateral = fitted(knee, kFemur, {"pCAP2", "pCAP6", "pCAP8"});
    EXPECT_LT(lateral.length_rms, 0.15) << knee;
  }
}

}  // namespace
}  // namespace condyle
