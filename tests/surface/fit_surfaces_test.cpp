#include "condyle/specimen/fit_surfaces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/surface/articular_region.h"
#include "condyle/surface/fit_patch.h"
#include "condyle/surface/patch.h"
#include "phantom/phantom_shape.h"
#include "phantom/split_triangles.h"
#include "scene/small_scene.h"
#include "support/mesh_shapes.h"
#include "support/scratch_folder.h"
#include "surface/fitted_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;
using test::knee;
using test::KneeFiles;
using test::phantom_files;
using test::rim_of;

const fs::path kMeshes = fs::path(CONDYLE_SOURCE_DIR) / "meshes";

std::string complaint(const Scene& scene) {
  try {
    (void)fit_surfaces(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Some exporters leave points of their own in a file.
TEST(FitSurfaces, VerticesOfNoTriangleHaveNoSay) {
  const Scene scene = knee(phantom_files());
  const MeshReader with_stray = [](const MeshFile& file) {
    TriangleMesh mesh = load_mesh(file);
    mesh.vertices.emplace_back(1e18, -1e18, 1e18);
    return mesh;
  };
  const auto plain = fit_surfaces(scene), stray = fit_surfaces(scene, {}, with_stray);
  ASSERT_EQ(plain.size(), stray.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto& a = dynamic_cast<const Patch&>(*plain[i].surface).data().control_points;
    const auto& b = dynamic_cast<const Patch&>(*stray[i].surface).data().control_points;
    ASSERT_TRUE(a == b) << scene.surfaces[i].name;
  }
}

// The mesh carries 0.2 mm of seeded roughness; away from the edge the patch must lie closer than
// that to the exact shape, and its normals much closer than those of the mesh (7 degrees).
TEST(FitSurfaces, FindsTheExactPhantomUnderItsRoughness) {
  const Scene scene = knee(phantom_files());
  const std::vector<FittedSurface> fitted = fit_surfaces(scene);
  ASSERT_EQ(fitted.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const phantom::Bone bone =
        scene.surfaces[i].body == 0 ? phantom::Bone::kFemur : phantom::Bone::kTibia;
    double square = 0, angle_square = 0, count = 0;
    for (const Place& place : fitted[i].surface->samples(1.0)) {
      if (fitted[i].surface->edge_distance(place) < 4) continue;
      const SurfacePoint at = fitted[i].surface->evaluate(place),
                         exact = phantom::surface_point(bone, at.c);
      square += (at.c - exact.c).squaredNorm();
      angle_square += at.n.cross(exact.n).squaredNorm();
      EXPECT_GT(at.n.dot(exact.n), 0.8) << "the normal must leave the bone";
      ++count;
    }
    ASSERT_GT(count, 200) << scene.surfaces[i].name;
    EXPECT_LT(std::sqrt(square / count), 0.14) << scene.surfaces[i].name;
    EXPECT_LT(std::sqrt(angle_square / count) * 180 / M_PI, 3.5) << scene.surfaces[i].name;
    const FitReport& report = *fitted[i].report;
    EXPECT_EQ(report.surface, scene.surfaces[i].name);
    // The roughness of the mesh is 0.2 mm; at the rims, and on the crest of the eminence with its
    // radius of 2.3 mm, a patch this smooth (4 to 5 mm in the middle) leaves more.
    EXPECT_LE(report.rms, 0.27);
    EXPECT_LE(report.rms, report.max);
    EXPECT_GT(report.smoothing_length, 1);
  }
}

// What every version before chose: in sixteen ratios from 1 to 6 mm.
TEST(FitSurfaces, ChooseForPositionsAsTheyDid) {
  Scene scene = knee(phantom_files());
  for (SurfaceDescription& surface : scene.surfaces) surface.patch.smooth_for_position = true;
  const std::vector<FittedSurface> fitted = fit_surfaces(scene);
  const double expected[] = {2.4495, 1.9580, 2.1900, 2.4495};  // [mm]
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(fitted[i].report->smoothing_length, expected[i], 1e-4) << scene.surfaces[i].name;
}

// Each triangle cut into sixteen is the same shape: the same lengths, the same patches, also from
// coordinates rounded to single precision as a binary STL holds them.
TEST(FitSurfaces, DoNotDependOnHowAShapeIsCutIntoTriangles) {
  const Scene scene = knee(phantom_files());
  const std::vector<FittedSurface> plain = fit_surfaces(scene);
  const std::vector<FittedSurface> split = fit_surfaces(scene, {}, [](const MeshFile& file) {
    TriangleMesh mesh = phantom::split_triangles(load_mesh(file.path, file.to_mm), 2);
    for (Vector3d& p : mesh.vertices) p = p.cast<float>().cast<double>();
    return mesh;
  });
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(plain[i].report->smoothing_length, split[i].report->smoothing_length, 1e-3);
    for (const Place& place : plain[i].surface->samples(2)) {
      if (plain[i].surface->edge_distance(place) < 1) continue;
      const Vector3d c = plain[i].surface->evaluate(place).c;
      const Surface& other = *split[i].surface;
      EXPECT_LT((other.evaluate(other.closest(c, place)).c - c).norm(), 0.01);
    }
  }
}

// Condyles must reach from the trochlea to deep flexion, for a sweep from 0 to 120 degrees.
TEST(FitSurfaces, CoversTheContactZonesOfThePhantom) {
  const std::vector<FittedSurface> fitted = fit_surfaces(knee(phantom_files()));
  for (const int i : {0, 2}) {
    const double z = i == 0 ? -23.5 : 23.5;  // middles of the condyles
    for (double degrees = -45; degrees <= 130; degrees += 5) {
      const double angle = degrees * M_PI / 180;
      const Vector3d p(-25 * std::sin(angle), -25 * std::cos(angle), z);
      const Surface& surface = *fitted[i].surface;
      // Two millimetres to the last data; what is known ends before that.
      const double rim = rim_of(fitted[i]);
      EXPECT_GT(surface.edge_distance(surface.closest(p, surface.seed(p))) + rim, 2)
          << "at " << degrees << " degrees";
      EXPECT_GT(surface.edge_distance(surface.closest(p, surface.seed(p))), 0.5);
    }
  }
}

/// The phantom's mesh seen in a mirror: what a left knee gives.
TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vector3d& v : mesh.vertices) v.z() = -v.z();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// What is written into a run and measured from insertions: the mesh of the file, read once.
TEST(FitSurfaces, KeepTheMeshOfTheirBody) {
  const Scene scene = knee(phantom_files());
  const std::vector<FittedSurface> fitted = fit_surfaces(scene);
  for (const int body : {0, 1}) {
    ASSERT_TRUE(fitted[body].bone);
    const TriangleMesh kept = body_mesh(scene, body, fitted),
                       loaded = load_body_mesh(scene.bodies[body]);
    EXPECT_EQ(kept.vertices, loaded.vertices);
    EXPECT_EQ(kept.triangles, loaded.triangles);
  }
}

// Bones without patches are cleaned, too, and what that took is told with their name.
TEST(LoadBodyMesh, TellsWhatWasMended) {
  TriangleMesh bone = test::cube(60);
  test::append(bone, test::cube(1, Vector3d(80, 0, 0)));
  test::append(bone, test::cube(1, Vector3d(90, 0, 0)));
  BodyDescription body;
  body.name = "femur";
  body.mesh = MeshFile{.path = test::fresh_folder("stray pieces") / "femur.off", .named_at = {}};
  test::write_off(body.mesh->path, bone);
  std::vector<std::string> told;
  EXPECT_EQ(load_body_mesh(body, &told).triangles.size(), 12U);
  EXPECT_EQ(told,
            std::vector<std::string>{"body \"femur\": 2 stray pieces (24 triangles) dropped"});
}

// A left knee is charted through its own lateral direction: same regions, mirrored.
TEST(FitSurfaces, TreatsALeftKneeAsTheMirrorOfARightOne) {
  const TriangleMesh right = clean_mesh(load_mesh(kMeshes / "femur.stl", 1)).mesh,
                     left = mirrored(right);
  const BoneFrame right_frame{.lateral = {0, 0, 1}, .anterior = {1, 0, 0}, .proximal = {0, 1, 0}};
  const BoneFrame left_frame{.lateral = {0, 0, -1}, .anterior = {1, 0, 0}, .proximal = {0, 1, 0}};
  const auto region = [](const TriangleMesh& mesh, const BoneFrame& frame) {
    return femoral_region(mesh, fit_condylar_axis(mesh, vertex_normals(mesh), frame),
                          Half::kMedial);
  };
  const ArticularRegion a = region(right, right_frame), b = region(left, left_frame);
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  const Patch p(fit_patch(a).patch), q(fit_patch(b).patch);
  for (const Place& place : p.samples(4)) {
    const SurfacePoint x = p.evaluate(place), y = q.evaluate(place);
    EXPECT_LT((x.c - Vector3d(y.c.x(), y.c.y(), -y.c.z())).norm(), 1e-6);
    EXPECT_LT((x.n - Vector3d(y.n.x(), y.n.y(), -y.n.z())).norm(), 1e-6);
  }
}

// The posterior arcs of the phantom have radii 21.5 and 20.0 about one axis, 20 mm in the coronal
// section.
TEST(FitSurfaces, FindsTheCondylarAxisOfThePhantom) {
  const TriangleMesh mesh = clean_mesh(load_mesh(kMeshes / "femur.stl", 1)).mesh;
  const CondylarAxis axis =
      fit_condylar_axis(mesh, vertex_normals(mesh),
                        {.lateral = {0, 0, 1}, .anterior = {1, 0, 0}, .proximal = {0, 1, 0}});
  EXPECT_NEAR(axis.medial_radius, 21.5, 1.5);
  EXPECT_NEAR(axis.lateral_radius, 20.0, 1.5);
  EXPECT_GT(axis.direction.z(), std::cos(3 * M_PI / 180));
  EXPECT_NEAR(axis.split, 0, 4);  // in the notch
}

TEST(FitSurfaces, FitsABoxInPlaceOfACompartment) {
  Scene scene = knee(phantom_files());
  scene.surfaces.resize(1);
  scene.surfaces[0].body = 1;
  scene.surfaces[0].patch.compartment.reset();
  scene.surfaces[0].patch.region_box = {{{-12, -40, -32}, {12, 0, -14}}};
  scene.joint.reset();
  const std::vector<FittedSurface> fitted = fit_surfaces(scene);
  const SurfacePoint middle = fitted[0].surface->evaluate(fitted[0].surface->seed({0, -22, -22}));
  EXPECT_GT(middle.n.y(), 0.9);
  scene.surfaces[0].patch.region_box = {{{300, 300, 300}, {310, 310, 310}}};
  EXPECT_NE(complaint(scene).find("[[surface]] \"medial condyle\": the region box holds no part"),
            std::string::npos);
}

// The posterior condyle of the phantom alone, moved by a thickness of cartilage.
TEST(FitSurfaces, LimitsACompartmentAndMovesItOutOfTheBone) {
  Scene scene = knee(phantom_files());
  scene.surfaces.resize(1);
  PatchDescription& patch = scene.surfaces[0].patch;
  patch.region_angles = {{20 * M_PI / 180, 120 * M_PI / 180}};
  patch.region_least_cosine = 0.6;
  const FittedSurface bone = fit_surfaces(scene)[0];
  patch.offset = 2.5;
  const FittedSurface cartilage = fit_surfaces(scene)[0];
  for (const Place& place : bone.surface->samples(3)) {
    const SurfacePoint at = bone.surface->evaluate(place);
    EXPECT_NEAR((cartilage.surface->evaluate(place).c - at.c - 2.5 * at.n).norm(), 0, 0.02);
  }
  const Vector3d distal(0, -60, -23), posterior(-60, -20, -23);
  const auto edge = [&](const Vector3d& p) {
    return bone.surface->edge_distance(bone.surface->closest(p, bone.surface->seed(p)));
  };
  EXPECT_LT(edge(distal), 1);
  EXPECT_GT(edge(posterior), 4);
  EXPECT_LT(cartilage.report->area / bone.report->area, 1.01);
  EXPECT_NE(cartilage.report->notes.back().find("moved 2.5 mm out of the bone"), std::string::npos);
}

TEST(FitSurfaces, MakesExactKindsWithoutAMesh) {
  Scene scene;
  scene.bodies.resize(1);
  SurfaceDescription ball;
  ball.body = 0;
  ball.kind = SurfaceKind::kSphere;
  ball.radius = 20;
  scene.surfaces = {ball};
  const std::vector<FittedSurface> fitted = fit_surfaces(scene);
  EXPECT_FALSE(fitted[0].report);
  EXPECT_NEAR(fitted[0].surface->evaluate(fitted[0].surface->seed({0, 0, 30})).c.z(), 20, 1e-9);
}

TEST(FitSurfaces, NamesTheSurfaceThatCannotBeFitted) {
  Scene scene = knee(phantom_files());
  scene.bodies[0].mesh.reset();
  EXPECT_NE(complaint(scene).find("[[surface]] \"medial condyle\": kind = \"patch\" needs a mesh"),
            std::string::npos)
      << complaint(scene);
  scene = knee(phantom_files());
  scene.joint.reset();
  EXPECT_NE(complaint(scene).find("[joint]"), std::string::npos);
  scene = knee(phantom_files());
  scene.surfaces[2].patch.control_points = {60, 60};
  EXPECT_NE(complaint(scene).find("[[surface]] \"lateral condyle\""), std::string::npos)
      << complaint(scene);
  for (const double smoothing : {0.0, 1000.0}) {
    scene = knee(phantom_files());
    scene.surfaces[2].line = 7;
    scene.surfaces[2].patch.smoothing = smoothing;
    const std::string told = complaint(scene);
    EXPECT_NE(told.find("knee.toml:7: [[surface]] \"lateral condyle\""), std::string::npos) << told;
    EXPECT_NE(
        told.find(smoothing > 0 ? "fit.smoothing = 1000, expected" : "fit.smoothing = 0, expected"),
        std::string::npos)
        << told;
  }
  scene = knee(phantom_files());
  scene.surfaces[2].patch.region_angles = {0, 1e-5};
  EXPECT_NE(complaint(scene).find("region.angles = [0, "), std::string::npos) << complaint(scene);
  scene = knee(phantom_files());
  scene.bodies[0].mesh->to_mm = 1000;
  EXPECT_NE(complaint(scene).find("look like mm"), std::string::npos) << complaint(scene);
}

TEST(FitSurfaces, ErrorsOfAMeshBeginWithWhereTheSceneNamesIt) {
  const fs::path file = fs::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml";
  const std::string text = read_scene(file).text;
  const std::string place = file.string() + ":13: [[body]] \"femur\": mesh: ";
  for (const char* mesh : {"../../meshes/tibia.stl", "../../README.md"}) {
    const Scene scene = parse_scene(with(text, "../../meshes/femur.stl", mesh), file);
    const std::string told = complaint(scene);
    EXPECT_EQ(told.find(place), 0) << told;
    EXPECT_NE(told.find(fs::path(mesh).filename().string() + ": ", place.size()), std::string::npos)
        << told;
  }
}

// Which corner a triangle begins with says nothing of its surface, and a tool that turns faces over begins with another one.
TEST(FitSurfaces, DoNotDependOnWhereTrianglesBegin) {
  const Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  const MeshReader rolled = [](const MeshFile& file) {
    TriangleMesh mesh = load_mesh(file.path, file.to_mm);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      std::rotate(mesh.triangles[t].begin(), mesh.triangles[t].begin() + t % 3,
                  mesh.triangles[t].end());
    return mesh;
  };
  const std::vector<FittedSurface> expected = fit_surfaces(scene),
                                   found = fit_surfaces(scene, {}, rolled);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& own = dynamic_cast<const Patch&>(*expected[i].surface).data();
    const auto& other = dynamic_cast<const Patch&>(*found[i].surface).data();
    ASSERT_EQ(other.control_points.size(), own.control_points.size());
    for (std::size_t k = 0; k < own.control_points.size(); ++k)
      ASSERT_LT((other.control_points[k] - own.control_points[k]).norm(), 1e-8) << i;
  }
}

}  // namespace
}  // namespace condyle
