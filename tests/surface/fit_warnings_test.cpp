/// What the report of a fit warns of: meshes that face inwards, folds, regions too thin to trust.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/cracked_mesh.h"
#include "support/mesh_shapes.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;

TriangleMesh phantom_femur() {
  return load_mesh(fs::path(CONDYLE_SOURCE_DIR) / "meshes/femur.stl", 1);
}
TriangleMesh reversed(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

struct FitWarnings : ::testing::Test {
  fs::path folder = test::scratch_folder("fit warnings");
  Scene scene;

  FitWarnings() { fs::create_directories(folder); }
  ~FitWarnings() override { fs::remove_all(folder); }

  /// The notes of the only surface, fitted to this mesh.
  std::vector<std::string> notes_of(const TriangleMesh& mesh, PatchDescription patch) {
    return fit(mesh, std::move(patch)).report->notes;
  }
  FittedSurface fit(const TriangleMesh& mesh, PatchDescription patch) {
    const fs::path file = folder / "mesh.off";
    std::ofstream out(file);
    out.precision(12);
    out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (const Vector3d& v : mesh.vertices) out << v.transpose() << '\n';
    for (const auto& [a, b, c] : mesh.triangles) out << "3 " << a << ' ' << b << ' ' << c << '\n';
    out.close();
    scene.bodies.resize(2);
    scene.bodies[0].name = "femur";
    scene.bodies[0].mesh = MeshFile{file, 1, {}};
    const auto frame = [](int body) {
      return AnatomicalFrame{.body = body,
                             .origin = Vector3d::Zero(),
                             .lateral = {0, 0, 1},
                             .anterior = {1, 0, 0},
                             .proximal = {0, 1, 0}};
    };
    if (patch.compartment)
      scene.joint = JointDescription{.side = Side::kRight, .femur = frame(0), .tibia = frame(1)};
    SurfaceDescription surface;
    surface.name = "patch";
    surface.body = 0;
    surface.kind = SurfaceKind::kPatch;
    surface.patch = std::move(patch);
    scene.surfaces = {surface};
    return fit_surfaces(scene)[0];
  }
};

PatchDescription medial() {
  PatchDescription patch;
  patch.compartment = Compartment::kMedial;
  return patch;
}
PatchDescription within(const Vector3d& a, const Vector3d& b) {
  PatchDescription patch;
  patch.region_box = {{a, b}};
  return patch;
}
bool holds(const std::vector<std::string>& notes, const std::string& words) {
  return std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

// Mirroring the vertices alone turns every triangle of a closed bone inwards: what an export of the
// other side leaves behind.
TEST_F(FitWarnings, NameAMeshThatWasMirrored) {
  TriangleMesh mesh = phantom_femur();
  EXPECT_FALSE(holds(notes_of(mesh, medial()), "mirroring"));
  for (Vector3d& v : mesh.vertices) v.z() = -v.z();
  EXPECT_TRUE(holds(notes_of(mesh, medial()),
                    "triangles faced into the bone, as after mirroring: check the side"));
}

// What lies beyond a crack is linked with the rest again: the patch is the same but for the 0.02 mm.
TEST_F(FitWarnings, NameASeamAndJoinIt) {
  const FittedSurface whole = fit(phantom_femur(), medial());
  EXPECT_FALSE(holds(whole.report->notes, "seam"));
  const FittedSurface joined = fit(test::cracked(phantom_femur(), -24, 0.02), medial());
  EXPECT_TRUE(holds(joined.report->notes, "warning: seam: along "));
  EXPECT_NEAR(joined.report->area, whole.report->area, 0.01 * whole.report->area);
  const auto &patch = *joined.surface, &expected = *whole.surface;
  for (const Place& place : expected.samples(4)) {
    const Vector3d p = expected.evaluate(place).c;
    if (expected.edge_distance(place) < 2) continue;
    const SurfacePoint there = patch.evaluate(patch.closest(p, patch.seed(p)));
    EXPECT_LT((there.c - p).norm(), 0.03);
  }
}

// Bone and cartilage in one file: what touches is the cartilage.
TEST_F(FitWarnings, NameASheetBelowTheOneThatIsFitted) {
  const TriangleMesh bone = phantom_femur();
  const FittedSurface alone = fit(bone, medial());
  EXPECT_EQ(alone.report->sheet_below, 0);
  TriangleMesh cartilage = alone.region;
  const std::vector<Vector3d> normals = vertex_normals(cartilage);
  for (std::size_t i = 0; i < normals.size(); ++i) cartilage.vertices[i] += 2 * normals[i];
  TriangleMesh both = bone;
  test::append(both, cartilage);
  const FittedSurface found = fit(both, medial());
  EXPECT_TRUE(
      holds(found.report->notes, "warning: two sheets: the mesh has another surface 2.0 mm"));
  EXPECT_NEAR(found.report->sheet_below, 2, 0.05);
  for (const Place& place : found.surface->samples(4)) {
    if (found.surface->edge_distance(place) < 2) continue;
    const Vector3d p = found.surface->evaluate(place).c;
    const SurfacePoint there =
        alone.surface->evaluate(alone.surface->closest(p, alone.surface->seed(p)));
    EXPECT_NEAR((there.c - p).norm(), 2, 0.1);
  }
}

TEST_F(FitWarnings, NameAHole) {
  TriangleMesh mesh = phantom_femur();
  const Vector3d distal(0, -21, -23);
  const auto far = [&](const auto& triangle) {
    return (triangle_middle(mesh, triangle) - distal).norm() > 5;
  };
  std::vector<bool> keep;
  for (const auto& triangle : mesh.triangles) keep.push_back(far(triangle));
  const std::size_t all = mesh.triangles.size();
  mesh = sub_mesh(mesh, keep).mesh;
  ASSERT_LT(mesh.triangles.size(), all);
  EXPECT_TRUE(
      holds(notes_of(mesh, medial()), "warning: hole: one in the region left out, the widest "));
}

// Six by four control points cannot follow a condyle; those that are chosen leave 0.2 mm of
// roughness.
TEST_F(FitWarnings, NameAPatchThatMissesItsMesh) {
  EXPECT_FALSE(holds(notes_of(phantom_femur(), medial()), "poor fit"));
  PatchDescription coarse = medial();
  coarse.smoothing = 30;
  const std::vector<std::string> notes = notes_of(phantom_femur(), coarse);
  EXPECT_TRUE(holds(notes, "warning: poor fit: "));
  EXPECT_TRUE(holds(notes, "more control points or less smoothing"));
}

TEST_F(FitWarnings, NameASpike) {
  TriangleMesh mesh = phantom_femur();
  const Vector3d distal(0, -21, -23);
  const auto nearest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                                        [&](const Vector3d& a, const Vector3d& b) {
                                          return (a - distal).norm() < (b - distal).norm();
                                        });
  const Vector3d tip = *nearest - Vector3d(0, 15, 0);
  // All corners of triangles there, as files of triangles have them.
  for (Vector3d& p : mesh.vertices)
    if (&p != &*nearest && (p - *nearest).norm() == 0) p = tip;
  *nearest = tip;
  EXPECT_TRUE(holds(notes_of(mesh, medial()),
                    fmt::format("is there a spike in the mesh at [{:.1f}, {:.1f}, {:.1f}] mm?",
                                tip.x(), tip.y(), tip.z())));
}

// An open sheet has no inside; the condyle tells which way is out.
TEST_F(FitWarnings, SayThatAnOpenSheetWasTurned) {
  const TriangleMesh sheet = fit(phantom_femur(), medial()).region;
  const FittedSurface right = fit(sheet, medial()), turned = fit(reversed(sheet), medial());
  EXPECT_FALSE(holds(right.report->notes, "were turned"));
  EXPECT_TRUE(holds(turned.report->notes, "1 of 1 sheets faced into the bone and were turned"));
  const Vector3d distal(0, -60, -23);
  EXPECT_LT(turned.surface->evaluate(turned.surface->seed(distal)).n.y(), -0.8);
}

// Hills of 45 degrees with ripples of 1.5 mm on them that reach 70 degrees the other way: a patch
// that follows the hills faces away from the ripples' far sides.
TEST_F(FitWarnings, NameAFold) {
  const auto hills = [](double x, double) { return 4.77 * std::sin(2 * M_PI * x / 30); };
  const auto rippled = [&](double x, double y) {
    return hills(x, y) + 0.88 * std::sin(2 * M_PI * x / 1.5);
  };
  PatchDescription patch = within({-20, -20, -20}, {20, 20, 20});
  patch.smoothing = 3;
  EXPECT_FALSE(holds(notes_of(test::height_sheet(24, 80, hills), patch), "fold"));
  EXPECT_TRUE(holds(notes_of(test::height_sheet(24, 160, rippled), patch),
                    "warning: fold: the patch faces away from the mesh at"));
}

// A strip of 7 mm is at most 3.5 mm from its edge, less the rim that smoothing makes uncertain.
TEST_F(FitWarnings, NameAThinRegion) {
  const TriangleMesh mesh =
      test::height_sheet(30, 60, [](double x, double y) { return 0.01 * (x * x + y * y); });
  EXPECT_FALSE(holds(notes_of(mesh, within({-15, -15, -5}, {15, 15, 20})), "thin region"));
  EXPECT_TRUE(holds(notes_of(mesh, within({-15, -3.6, -5}, {15, 3.6, 20})),
                    "warning: thin region: nowhere farther than"));
}

}  // namespace
}  // namespace condyle
