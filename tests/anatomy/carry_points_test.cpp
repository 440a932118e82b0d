/// Points carried from one bone to another: to their own places where the other is the same bone
/// elsewhere, smoothly bent, rougher, shorter or open.

#include "condyle/anatomy/carry_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anatomy/carried_errors.h"
#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Place = std::function<Vector3d(const Vector3d&)>;

const Place kStays = [](const Vector3d& p) { return p; };

/// Femur and tibia of the phantom, whose frames are those of its coordinates. Its insertions lie up
/// to 0.4 mm off its rough mesh: what is carried here are the points of the mesh below.
class CarryPoints : public testing::TestWithParam<int> {
 protected:
  static const test::KneeBone& bone() {
    static const auto bones = [] {
      auto both = test::knee_bones(CONDYLE_SOURCE_DIR "/data/phantom/wrapped.toml");
      for (test::KneeBone& b : both) {
        const MeshDistance mesh(b.mesh);
        for (Vector3d& p : b.insertions) p = mesh.closest(p);
      }
      return both;
    }();
    return bones[GetParam()];
  }
  static bool femur() { return GetParam() == 0; }

  static TriangleMesh placed(TriangleMesh mesh, const Place& place) {
    for (Vector3d& p : mesh.vertices) p = place(p);
    return mesh;
  }
  static CarriedPoints carried_to(const TriangleMesh& mesh, const BoneFrame& frame) {
    return carry_points(bone().framed(), {mesh, frame}, bone().insertions);
  }
  static double error(const CarriedPoints& carried, std::size_t i, const Place& place) {
    return (carried.points[i].at - place(bone().insertions[i])).norm();
  }
  /// [mm], of all insertions.
  static double largest_error(const CarriedPoints& carried, const Place& place) {
    double largest = 0;
    for (std::size_t i = 0; i < carried.points.size(); ++i)
      largest = std::max(largest, error(carried, i, place));
    return largest;
  }
  static double largest_change(const CarriedPoints& a, const CarriedPoints& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.points.size(); ++i)
      largest = std::max(largest, (a.points[i].at - b.points[i].at).norm());
    return largest;
  }
};

INSTANTIATE_TEST_SUITE_P(Bones, CarryPoints, testing::Values(0, 1), [](const auto& bone) {
  return std::string(bone.param == 0 ? "Femur" : "Tibia");
});

/// The triangles whose centre and normal are inside.
TriangleMesh part(const TriangleMesh& mesh,
                  const std::function<bool(const Vector3d&, const Vector3d&)>& inside) {
  std::vector<bool> keep;
  for (const auto& [i, j, k] : mesh.triangles)
    keep.push_back(inside((mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]) / 3,
                          triangle_area(mesh, {i, j, k}).normalized()));
  return sub_mesh(mesh, keep).mesh;
}

/// Of other proportions, in any pose, right and left. What is left is what tangent planes of samples
/// 1.5 mm apart and a roughness of 0.2 mm make of it.
TEST_P(CarryPoints, FindTheirPlacesOnTheSameBoneElsewhere) {
  test::Random random(3);
  const Vector3d size(1.08, 0.96, 1.04);
  for (const double side : {1.0, -1.0}) {
    const RigidTransform X = random.pose(300);
    const Place place = [&](const Vector3d& p) {
      return Vector3d(X * size.cwiseProduct(Vector3d(p.x(), p.y(), side * p.z())));
    };
    TriangleMesh mesh = placed(bone().mesh, place);
    if (side < 0)
      for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    const CarriedPoints carried =
        carried_to(mesh, {X.p, side * X.R.col(2), X.R.col(0), X.R.col(1)});
    EXPECT_LT(largest_error(carried, place), 0.1);
    EXPECT_LT((carried.size - size).cwiseAbs().maxCoeff(), 0.001);
    EXPECT_GT(carried.covered, 0.95);
    for (const CarriedPoint& point : carried.points) EXPECT_LT(point.moved, 0.2);
  }
}

/// By 3 degrees and 4 mm, on bones of any size.
TEST_P(CarryPoints, HardlyFeelHowFramesScatter) {
  test::Random random(4);
  for (const double size : {0.75, 1.0, 1.35}) {
    const Place place = [&](const Vector3d& p) { return Vector3d(size * p); };
    const BoneFrame frame = test::disturbed(bone().frame, 3 * M_PI / 180, 4, random);
    EXPECT_LT(largest_error(carried_to(placed(bone().mesh, place), frame), place), 0.1);
  }
}

/// By 2 to 3 mm over waves of 180 mm. How a smooth surface slides along itself is known by the bending
/// of the field alone: a fraction of a mm is left of it.
TEST_P(CarryPoints, FollowASmoothBend) {
  constexpr double k = 2 * M_PI / 180;
  const Place place = [](const Vector3d& p) {
    return Vector3d(p + Vector3d(2 * std::sin(k * p.y() + 0.4), 1.5 * std::cos(k * p.z()),
                                 2 * std::sin(k * p.x() + k * p.y())));
  };
  const CarriedPoints carried = carried_to(placed(bone().mesh, place), bone().frame);
  double squares = 0;
  for (std::size_t i = 0; i < carried.points.size(); ++i)
    squares += std::pow(error(carried, i, place), 2);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(carried.points.size())), 0.6);
  EXPECT_LT(largest_error(carried, place), 1);
  EXPECT_LT(carried.rms, 0.3);
}

/// Each triangle cut in four, every vertex 0.2 mm off at random along each axis.
TEST_P(CarryPoints, AskLittleOfTheMesh) {
  test::Random random(5);
  TriangleMesh finer;
  for (const auto& [i, j, k] : bone().mesh.triangles) {
    const auto& v = bone().mesh.vertices;
    const int n = static_cast<int>(finer.vertices.size());
    for (const Vector3d& p : {v[i], v[j], v[k], Vector3d((v[i] + v[j]) / 2),
                              Vector3d((v[j] + v[k]) / 2), Vector3d((v[k] + v[i]) / 2)})
      finer.vertices.push_back(p);
    for (const auto& [a, b, c] : {std::array{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
      finer.triangles.push_back({n + a, n + b, n + c});
  }
  finer = clean_mesh(finer).mesh;
  for (Vector3d& p : finer.vertices) p += random.vector(0.2 * std::sqrt(3));
  EXPECT_LT(largest_change(carried_to(bone().mesh, bone().frame), carried_to(finer, bone().frame)),
            0.5);
}

/// Near the joint nothing changes; what lay beyond the cut is where it would be, and less sure.
TEST_P(CarryPoints, DoNotFeelWhereAShaftIsCut) {
  constexpr double kCut = 55;
  const TriangleMesh cut =
      part(bone().mesh, [](const Vector3d& p, const Vector3d&) { return std::abs(p.y()) < kCut; });
  const CarriedPoints whole = carried_to(bone().mesh, bone().frame);
  const CarriedPoints shorter = carried_to(cut, bone().frame);
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const bool beyond = std::abs(bone().insertions[i].y()) > kCut;
    EXPECT_LT((whole.points[i].at - shorter.points[i].at).norm(), beyond ? 0.5 : 0.05);
    if (beyond) {
      EXPECT_GT(shorter.points[i].uncertainty, 2 * whole.points[i].uncertainty);
    }
  }
}

/// The articular end alone, 5 % larger, turned inside out.
TEST_P(CarryPoints, GoBeyondAnOpenSheet) {
  TriangleMesh sheet = part(bone().mesh, [](const Vector3d& p, const Vector3d& n) {
    return femur() ? n.y() < 0.6 && p.y() < 18 && std::abs(p.z()) < 34
                   : p.y() > -36 && n.y() > -0.2;
  });
  for (auto& t : sheet.triangles) std::swap(t[1], t[2]);
  const Place place = [](const Vector3d& p) { return Vector3d(1.05 * p); };
  const CarriedPoints carried = carried_to(placed(sheet, place), bone().frame);
  EXPECT_LT(largest_error(carried, place), 0.75);
  const MeshDistance distance(sheet);
  for (std::size_t i = 0; i < carried.points.size(); ++i)
    if (distance(bone().insertions[i]) > 5) {
      EXPECT_GT(carried.points[i].uncertainty, 2);
    }
}

/// Some muscle's origin goes by size alone. More of the shaft is looked at for it, as far as the mesh
/// goes: what is inserted near its end feels that a little.
TEST_P(CarryPoints, BearAPointFarFromTheJoint) {
  std::vector<Vector3d> points = bone().insertions;
  points.emplace_back(-40, femur() ? 380 : -330, 50);
  const CarriedPoints carried = carry_points(bone().framed(), bone().framed(), points);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((carried.points[i].at - points[i]).norm(), i + 1 < points.size() ? 0.5 : 2);
  EXPECT_GT(carried.points.back().uncertainty, 20);
}

TEST_P(CarryPoints, AreTheSameEveryTime) {
  const CarriedPoints one = carried_to(bone().mesh, bone().frame),
                      two = carried_to(bone().mesh, bone().frame);
  for (std::size_t i = 0; i < one.points.size(); ++i) EXPECT_EQ(one.points[i].at, two.points[i].at);
}

TEST_P(CarryPoints, RefuseABoneThatIsElsewhere) {
  BoneFrame frame = bone().frame;
  frame.origin.y() += 1000;
  EXPECT_THROW((void)carried_to(bone().mesh, frame), InputError);
}

}  // namespace
}  // namespace condyle
