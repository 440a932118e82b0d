#include "condyle/surface/bone_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/surface/face_out.h"
#include "condyle/surface/mesh_distance.h"
#include "support/mesh_shapes.h"

namespace condyle {
namespace {

const BoneFrame kRight{.lateral = {0, 0, 1}, .anterior = {1, 0, 0}, .proximal = {0, 1, 0}};

CleanMesh clean_bone(const char* file) {
  return clean_mesh(load_mesh(std::filesystem::path(CONDYLE_SOURCE_DIR) / "meshes" / file, 1));
}
TriangleMesh bone(const char* file) { return clean_bone(file).mesh; }

template <class Check>
std::string complaint(Check check) {
  try {
    check();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BoneCheck, AcceptsTheBonesOfThePhantom) {
  EXPECT_NO_THROW(check_is_no_femur(clean_bone("tibia.stl"), kRight));
  EXPECT_NO_THROW(check_one_knee(bone("tibia.stl"), kRight));
  const TriangleMesh femur = bone("femur.stl");
  EXPECT_NO_THROW(check_is_femur(fit_condylar_axis(femur, vertex_normals(femur), kRight)));
}

// The radii of the phantom's posterior condyles are 21.5 and 20 mm.
TEST(BoneCheck, KnowsAFemurByItsCondyles) {
  const std::string text = complaint([] { check_is_no_femur(clean_bone("femur.stl"), kRight); });
  EXPECT_NE(text.find("looks like a femur, expected a tibia: it has posterior condyles of radius"),
            std::string::npos)
      << text;
}

// The back of a plateau whose shaft is cut off near it has the shape and the size of posterior condyles.
TEST(BoneCheck, TakesNoTibiaCutBelowItsTopForAFemur) {
  for (const double below : {25, 28, 30, 32, 35, 40}) {
    CleanMesh tibia = clean_bone("tibia.stl");
    double top = -1e300;
    for (const Eigen::Vector3d& p : tibia.mesh.vertices) top = std::max(top, p.y());
    std::vector<bool> kept;
    for (const auto& triangle : tibia.mesh.triangles)
      kept.push_back(std::all_of(triangle.begin(), triangle.end(), [&](int v) {
        return tibia.mesh.vertices[static_cast<std::size_t>(v)].y() > top - below;
      }));
    EXPECT_NO_THROW(check_is_no_femur(clean_mesh(sub_mesh(tibia.mesh, kept).mesh), kRight))
        << below;
  }
}

// The sum of what faces up is that of the holes in what is nearly whole.
TEST(BoneCheck, HolesInATibiaTurnNothing) {
  for (const double radius : {4, 9, 14}) {
    const TriangleMesh whole = bone("tibia.stl");
    Eigen::Vector3d eminence = whole.vertices[0];
    for (const Eigen::Vector3d& p : whole.vertices)
      if (p.y() > eminence.y()) eminence = p;
    for (const bool everywhere : {false, true}) {
      std::vector<bool> kept;
      for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const Eigen::Vector3d middle = triangle_middle(whole, whole.triangles[t]);
        kept.push_back(everywhere ? (t * 7919) % 100 >= static_cast<std::size_t>(radius) / 4
                                  : (middle - eminence).norm() > radius);
      }
      CleanMesh tibia = clean_mesh(sub_mesh(whole, kept).mesh);
      EXPECT_EQ(face_out_of_tibia(tibia, kRight), 0) << radius << " " << everywhere;
      for (auto& triangle : tibia.mesh.triangles) std::swap(triangle[1], triangle[2]);
      EXPECT_EQ(face_out_of_tibia(tibia, kRight),
                std::count(tibia.closed.begin(), tibia.closed.end(), false));
    }
  }
}

// Rims of a plateau bend about one axis too, with a radius of an eighth of the bone's width.
TEST(BoneCheck, TellsWiderAndNarrowerBonesApart) {
  for (const double width : {0.88, 0.94, 1.06, 1.12, 1.2}) {
    SCOPED_TRACE(width);
    CleanMesh femur = clean_bone("femur.stl"), tibia = clean_bone("tibia.stl");
    for (CleanMesh* wider : {&femur, &tibia})
      for (Eigen::Vector3d& vertex : wider->mesh.vertices) vertex.z() *= width;
    EXPECT_NO_THROW(check_is_no_femur(tibia, kRight));
    EXPECT_THROW(check_is_no_femur(femur, kRight), InputError);
  }
}

TEST(BoneCheck, FindsNoCondylesOnATibia) {
  const TriangleMesh tibia = bone("tibia.stl");
  const std::string text =
      complaint([&] { check_is_femur(fit_condylar_axis(tibia, vertex_normals(tibia), kRight)); });
  EXPECT_NE(text.find("posterior condyles"), std::string::npos) << text;
}

TEST(BoneCheck, SeesTwoKneesByTheirWidth) {
  TriangleMesh both = bone("femur.stl");
  const TriangleMesh one = both;
  const int first = static_cast<int>(one.vertices.size());
  for (const Eigen::Vector3d& v : one.vertices)
    both.vertices.emplace_back(v + Eigen::Vector3d(0, 0, 200));
  for (const auto& [a, b, c] : one.triangles)
    both.triangles.push_back({a + first, b + first, c + first});
  const std::string text = complaint([&] { check_one_knee(both, kRight); });
  EXPECT_NE(text.find("two knees in one file"), std::string::npos) << text;
}

// Depths of the phantom's plateaus: 49.5 mm medial, 43.5 lateral. Read as a left knee, they change
// places.
TEST(BoneCheck, DeeperPlateauTellsTheSide) {
  const BoneFrame left{.lateral = {0, 0, -1}, .anterior = {1, 0, 0}, .proximal = {0, 1, 0}};
  EXPECT_GT(plateau_depth_ratio(bone("tibia.stl"), kRight), 1.05);
  EXPECT_LT(plateau_depth_ratio(bone("tibia.stl"), left), 0.95);
}

// A ball of 9 mm behind the lateral plateau and below it, as a fibular head is in a CT of both
// bones.
TEST(BoneCheck, FibularHeadDoesNotDeepenThePlateau) {
  TriangleMesh both = bone("tibia.stl");
  const int first = static_cast<int>(both.vertices.size());
  const TriangleMesh head = test::grid_sheet(20, 20, [](double i, double j) {
    const double a = M_PI * i / 20, b = 2 * M_PI * j / 20;
    return Eigen::Vector3d(-26 + 9 * std::sin(a) * std::cos(b), -47 - 9 * std::cos(a),
                           34 + 9 * std::sin(a) * std::sin(b));
  });
  both.vertices.insert(both.vertices.end(), head.vertices.begin(), head.vertices.end());
  for (const auto& [a, b, c] : head.triangles)
    both.triangles.push_back({a + first, b + first, c + first});
  EXPECT_GT(plateau_depth_ratio(both, kRight), 1.05);
}

// A triangle in the plane z = 0: above its inside, beside an edge, beyond a corner.
TEST(MeshDistance, IsThatToTheNearestPartOfATriangle) {
  const TriangleMesh mesh{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  const MeshDistance distance(mesh);
  EXPECT_NEAR(distance({1, 1, 2}), 2, 1e-12);
  EXPECT_NEAR(distance({2, -3, 0}), 3, 1e-12);
  EXPECT_NEAR(distance({-3, -4, 0}), 5, 1e-12);
  EXPECT_TRUE(distance.closest({1, 1, 2}).isApprox(Eigen::Vector3d(1, 1, 0)));
  EXPECT_TRUE(distance.closest({2, -3, 0}).isApprox(Eigen::Vector3d(2, 0, 0)));
}

}  // namespace
}  // namespace condyle
