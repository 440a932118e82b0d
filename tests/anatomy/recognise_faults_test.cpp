/// Meshes that are no knee are named in one line.

#include <gtest/gtest.h>

#include <string>

#include "anatomy/knee_variants.h"
#include "condyle/input_error.h"
#include "support/closed_shapes.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::mapped;
using test::part;
using test::phantom;

void expect_refused(const KneeMeshes& meshes, const std::string& words) {
  try {
    const RecognisedKnee knee = recognise_knee(meshes);
    FAIL() << "taken for a knee of " << knee.femur.width << " mm, expected: " << words;
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TriangleMesh shifted(const TriangleMesh& mesh, const Vector3d& d) {
  return mapped(mesh, [&](const Vector3d& p) { return Vector3d(p + d); });
}
TriangleMesh scaled(const TriangleMesh& mesh,
                    double factor,
                    const Vector3d& about = Vector3d::Zero()) {
  return mapped(mesh, [&](const Vector3d& p) { return Vector3d(about + factor * (p - about)); });
}
/// About a point on the y axis, head over heels.
TriangleMesh upside_down(const TriangleMesh& mesh, double y) {
  return mapped(mesh, [&](const Vector3d& p) { return Vector3d(-p.x(), 2 * y - p.y(), p.z()); });
}

const Vector3d kPlateau(0, -22, 0);  // of the phantom

}  // namespace

TEST(RecogniseFaults, EmptyMeshes) {
  expect_refused({}, "the femur has no triangles");
  expect_refused({phantom().femur, {}, {}, {}}, "the tibia has no triangles");
}

TEST(RecogniseFaults, BonesThatAreOthers) {
  const auto [femur, tibia, none, neither] = phantom();
  expect_refused({femur, femur, {}, {}}, "one and the same surface");
  expect_refused({femur, shifted(femur, {0, -120, 0}), {}, {}}, "two femurs");
  expect_refused({femur, upside_down(femur, -22), {}, {}}, "two femurs");
  expect_refused({tibia, shifted(tibia, {0, -95, 0}), {}, {}}, "no two posterior condyles");
}

TEST(RecogniseFaults, BonesThatLieOtherwise) {
  const auto [femur, tibia, none, neither] = phantom();
  expect_refused({femur, upside_down(tibia, -61), {}, {}}, "the tibia is upside down");
  expect_refused({upside_down(femur, 22), tibia, {}, {}}, "do not face the tibia");
  expect_refused({femur, shifted(tibia, {0, 0, 100}), {}, {}}, "do not face the tibia");
  expect_refused({femur, shifted(tibia, {1000, 0, 0}), {}, {}}, "apart");
  const TriangleMesh turned =
      mapped(tibia, [](const Vector3d& p) { return Vector3d(-p.x(), p.y(), -p.z()); });
  expect_refused({femur, turned, {}, {}}, "turned back to front");
  const TriangleMesh other =
      mapped(tibia, [](const Vector3d& p) { return Vector3d(p.x(), p.y(), -p.z()); });
  expect_refused({femur, other, {}, {}}, "of a right knee and the tibia that of a left one");
}

TEST(RecogniseFaults, SizesThatDoNotFit) {
  const auto [femur, tibia, none, neither] = phantom();
  expect_refused({femur, scaled(tibia, 0.7, kPlateau), {}, {}}, "different persons");
  expect_refused({femur, scaled(tibia, 1.4, kPlateau), {}, {}}, "different persons");
  expect_refused({scaled(femur, 1e-3), tibia, {}, {}}, "expected both in one unit");
  expect_refused({femur, scaled(tibia, 0.1), {}, {}}, "expected both in one unit");
  expect_refused({scaled(femur, 1 / 304.8), scaled(tibia, 1 / 304.8), {}, {}}, "--units");
}

TEST(RecogniseFaults, PartsAndOtherThings) {
  const auto [femur, tibia, none, neither] = phantom();
  expect_refused({part(femur, [](const Vector3d& p) { return p.z() < 0; }), tibia, {}, {}},
                 "not both condyles");
  expect_refused({part(femur, [](const Vector3d& p) { return p.z() > 0; }), tibia, {}, {}},
                 "not both condyles");
  const TriangleMesh ball = test::ellipsoid_solid(Vector3d::Constant(38), 2);
  expect_refused({shifted(ball, {0, 18, 0}), tibia, {}, {}}, "not both condyles");
  const TriangleMesh disc = mapped(test::cylinder_solid(38, 60, 2), [](const Vector3d& p) {
    return Vector3d(p.x(), p.z(), -p.y());
  });
  double top = -1e300;
  for (const Vector3d& p : disc.vertices) top = std::max(top, p.y());
  expect_refused({femur, shifted(disc, {0, -22 - top, 0}), {}, {}}, "");
}

// Beyond some 60 degrees the back of the condyles faces the plateau as their end would, and passed for it: the side was
// wrong then, and sure.
TEST(RecogniseFaults, KneesFlexedTooFar) {
  const auto [femur, tibia, none, neither] = phantom();
  for (const double flexion : {75.0, 90.0}) {
    const Eigen::AngleAxisd turn(-flexion * M_PI / 180, Vector3d::UnitZ());
    expect_refused(
        {femur, mapped(tibia, [&](const Vector3d& p) { return Vector3d(turn * p); }), {}, {}},
        "the femur's shaft goes");
  }
}

TEST(RecogniseFaults, CartilageThatLiesElsewhere) {
  const auto [femur, tibia, none, neither] = phantom();
  const TriangleMesh of_femur = part(femur, [](const Vector3d& p) { return p.y() < 0; });
  const TriangleMesh of_tibia = part(tibia, [](const Vector3d& p) { return p.y() > -25; });
  EXPECT_EQ(recognise_knee({femur, tibia, of_femur, of_tibia}).side, Side::kRight);
  expect_refused({femur, tibia, of_tibia, of_femur}, "lies on the other bone");
  expect_refused({femur, tibia, scaled(of_femur, 1e-3), {}}, "expected both in one unit");
  for (const double side : {1.0, -1.0})
    expect_refused({femur, tibia, of_femur,
                    part(of_tibia, [&](const Vector3d& p) { return side * p.z() > 4; })},
                   side > 0 ? "the tibial cartilage covers the lateral side alone"
                            : "the tibial cartilage covers the medial side alone");
}

}  // namespace condyle
