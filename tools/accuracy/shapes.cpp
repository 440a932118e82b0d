#include "accuracy/shapes.h"

#include <cmath>
#include <memory>
#include <random>

#include "accuracy/phantom_regions.h"
#include "accuracy/phantom_truth.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/exact_surfaces.h"
#include "phantom/mesh_shape.h"
#include "support/mesh_shapes.h"

namespace condyle::accuracy {
namespace {

constexpr double kSide = 24;   // of the sheets [mm]
constexpr double kInside = 8;  // errors are taken where |x|, |y| < this [mm]
constexpr int kCells = 96;     // edges of 0.25 mm
constexpr double kGrid = 0.7;  // of the phantom's meshes [mm]

using Height = std::function<double(double, double)>;

ArticularRegion sheet(const Height& height, double noise) {
  ArticularRegion region;
  region.mesh = test::height_sheet(kSide, kCells, height);
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 1);
  for (Eigen::Vector3d& vertex : region.mesh.vertices)
    vertex += noise * normal(generator) * Eigen::Vector3d::UnitZ();
  region.normals = vertex_normals(region.mesh);
  for (std::size_t i = 0; i < region.mesh.vertices.size(); ++i) {
    region.chart.emplace_back(region.mesh.vertices[i].head<2>());
    region.slope.push_back(region.normals[i].z());
  }
  return region;
}

FitErrors errors_on_sheet(const Surface& exact, const Patch& patch) {
  FitErrors sum;
  int count = 0;
  for (double u = -kInside; u <= kInside; u += 0.37)
    for (double v = -kInside; v <= kInside; v += 0.41, ++count) {
      const SurfacePoint at = patch.evaluate(Patch::place(u, v));
      const SurfacePoint truth = exact.evaluate(exact.closest(at.c, exact.seed(at.c)));
      sum.position += (at.c - truth.c).squaredNorm();
      sum.normal += (at.n - truth.n).squaredNorm();
      sum.curvature += (at.K - truth.K).squaredNorm() / 2;
    }
  return {std::sqrt(sum.position / count), std::sqrt(sum.normal / count) * 180 / M_PI,
          std::sqrt(sum.curvature / count)};
}

Shape of_sheet(const std::string& name,
               const Height& height,
               const std::shared_ptr<const Surface>& exact,
               double noise) {
  return {name, true, sheet(height, 0), sheet(height, noise),
          [exact](const Patch& patch) { return errors_on_sheet(*exact, patch); }};
}

Shape ellipsoid(double noise) {
  const double a = 26, b = 19, c = 24;
  return of_sheet(
      "ellipsoid 26, 19, 24 mm",
      [=](double x, double y) { return c * std::sqrt(1 - x * x / (a * a) - y * y / (b * b)); },
      make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {a, b, c}, true), noise);
}

Shape torus(double noise) {
  const double major = 20, minor = 18;
  return of_sheet(
      "torus 20, 18 mm",
      [=](double x, double y) {
        const double r = major + std::sqrt(minor * minor - y * y);
        return std::sqrt(r * r - x * x);
      },
      make_torus({0, 0, 0}, {0, 1, 0}, major, minor, true), noise);
}

TriangleMesh noisy_bone(phantom::Bone bone, TriangleMesh mesh, double noise) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 1);
  for (Eigen::Vector3d& vertex : mesh.vertices)
    vertex += noise * normal(generator) * phantom::normal(bone, vertex);
  return mesh;
}

std::vector<Shape> of_phantom(double noise) {
  using phantom::Bone;
  const TriangleMesh femur = phantom::mesh_bone(Bone::kFemur, kGrid);
  const TriangleMesh tibia = phantom::mesh_bone(Bone::kTibia, kGrid);
  std::vector<PhantomRegion> exact = phantom_regions(femur, tibia);
  std::vector<PhantomRegion> noisy = phantom_regions(noisy_bone(Bone::kFemur, femur, noise),
                                                     noisy_bone(Bone::kTibia, tibia, noise));
  std::vector<Shape> all;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Bone bone = exact[i].bone;
    all.push_back(
        {exact[i].name, false, std::move(exact[i].region), std::move(noisy[i].region),
         [bone](const Patch& patch) {
           PatchErrors errors;
           errors.add(bone, patch);
           return FitErrors{errors.position.rms(), errors.normal.rms(), errors.curvature.rms()};
         }});
  }
  return all;
}

}  // namespace

std::vector<Shape> shapes(double noise) {
  std::vector<Shape> all;
  all.push_back(ellipsoid(noise));
  all.push_back(torus(noise));
  for (Shape& shape : of_phantom(noise)) all.push_back(std::move(shape));
  return all;
}

}  // namespace condyle::accuracy
