#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/study.h"
#include "mesh/mesh_measures.h"
#include "mesh/mesh_shapes.h"
#include "surface/exact_surfaces.h"
#include "surface/fit_patch.h"

namespace condyle::accuracy {
namespace {

constexpr double kSide = 24;   // of the sheet [mm]
constexpr double kInside = 8;  // errors are taken where |x|, |y| < this [mm]
constexpr int kCells = 96;     // edges of 0.25 mm

/// A part of a closed surface as a height over the plane, and the surface itself.
struct Shape {
  std::string name;
  std::function<double(double, double)> height;
  std::unique_ptr<Surface> exact;
};

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  const double a = 26, b = 19, c = 24;
  all.push_back(
      {"ellipsoid 26, 19, 24 mm",
       [=](double x, double y) { return c * std::sqrt(1 - x * x / (a * a) - y * y / (b * b)); },
       make_ellipsoid({0, 0, 0}, Eigen::Matrix3d::Identity(), {a, b, c}, true)});
  const double major = 20, minor = 18;
  all.push_back({"torus 20, 18 mm",
                 [=](double x, double y) {
                   const double r = major + std::sqrt(minor * minor - y * y);
                   return std::sqrt(r * r - x * x);
                 },
                 make_torus({0, 0, 0}, {0, 1, 0}, major, minor, true)});
  return all;
}

ArticularRegion region_of(const Shape& shape, double noise) {
  ArticularRegion region;
  region.mesh = testing::height_sheet(kSide, kCells, shape.height);
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

/// Root mean squares over the inside.
struct Errors {
  double position = 0;   ///< [mm]
  double normal = 0;     ///< [degrees]
  double curvature = 0;  ///< of the tensor, per root of two principal values [1/mm]
};

Errors errors_of(const Shape& shape, const Patch& patch) {
  Errors sum;
  int count = 0;
  for (double u = -kInside; u <= kInside; u += 0.37)
    for (double v = -kInside; v <= kInside; v += 0.41, ++count) {
      const SurfacePoint at = patch.evaluate({u, v, 0});
      const SurfacePoint truth =
          shape.exact->evaluate(shape.exact->closest(at.c, shape.exact->seed(at.c)));
      sum.position += (at.c - truth.c).squaredNorm();
      sum.normal += (at.n - truth.n).squaredNorm();
      sum.curvature += (at.K - truth.K).squaredNorm() / 2;
    }
  return {std::sqrt(sum.position / count), std::sqrt(sum.normal / count) * 180 / M_PI,
          std::sqrt(sum.curvature / count)};
}

std::string order(double coarse, double fine, double ratio) {
  return coarse > 0 ? fmt::format(" ({:.1f})", std::log(coarse / fine) / std::log(ratio)) : "";
}

/// Without noise and almost without smoothing: what splines can do.
void add_orders(const Shape& shape, int degree, fmt::ostream& csv, std::string& page) {
  const ArticularRegion region = region_of(shape, 0);
  Errors last;
  int last_cells = 0;
  for (const int cells : {5, 10, 20}) {
    FitOptions options;
    options.control_points = {{cells + degree, cells + degree}};
    options.smoothing_length = 0.05;
    options.degree = degree;
    options.rounds = 10;
    options.settled = 1e-9;
    PatchFit fit;
    const double time = least_microseconds(1, [&] { fit = fit_patch(region, options); }) / 1000;
    const Errors errors = errors_of(shape, Patch(fit.patch));
    const double ratio = last_cells > 0 ? static_cast<double>(cells) / last_cells : 1;
    csv.print("\"{}\",0,{},{},{:.3e},{:.3e},{:.3e},{:.0f}\n", shape.name, degree, cells + degree,
              errors.position, errors.normal, errors.curvature, time);
    page += fmt::format("| {} | {} | {} | {:.1e}{} | {:.1e}{} | {:.1e}{} | {:.0f} ms |\n",
                        shape.name, degree, cells + degree, errors.position,
                        order(last.position, errors.position, ratio), errors.normal,
                        order(last.normal, errors.normal, ratio), errors.curvature,
                        order(last.curvature, errors.curvature, ratio), time);
    last = errors;
    last_cells = cells;
  }
}

/// With noise: the smoothing that is chosen beside the best one that knows the truth.
void add_noise(const Shape& shape, fmt::ostream& csv, std::string& page) {
  const ArticularRegion region = region_of(shape, 0.1);
  const PatchFit chosen = fit_patch(region);
  const Errors automatic = errors_of(shape, Patch(chosen.patch));
  Errors best{1e300, 0, 0};
  double best_length = 0;
  for (const double length : {1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0}) {
    FitOptions options;
    options.smoothing_length = length;
    const Errors errors = errors_of(shape, Patch(fit_patch(region, options).patch));
    if (errors.position >= best.position) continue;
    best = errors;
    best_length = length;
  }
  csv.print("\"{}\",0.1,3,,{:.3e},{:.3e},{:.3e},\n", shape.name, automatic.position,
            automatic.normal, automatic.curvature);
  page += fmt::format(
      "| {} | {:.1f}, chosen | {:.4f} mm | {:.2f}° | {:.5f} |\n| | {:.1f}, best | {:.4f} mm | "
      "{:.2f}° "
      "| {:.5f} |\n",
      shape.name, chosen.smoothing_length, automatic.position, automatic.normal,
      automatic.curvature, best_length, best.position, best.normal, best.curvature);
}

}  // namespace

std::string study_surfaces(const std::filesystem::path& folder) {
  fmt::ostream csv = fmt::output_file((folder / "surfaces.csv").string());
  csv.print("shape,noise_mm,degree,control_points,position_mm,normal_deg,curvature_per_mm,ms\n");
  std::string page =
      "### Surfaces\n\nSheets of 24 mm with 9,409 vertices, errors (root mean square) in the "
      "middle "
      "16 mm against the exact surface. Without noise, in brackets the order observed from the row "
      "above:\n\n| shape | degree | control points each way | position [mm] | normal [°] | "
      "curvature "
      "[1/mm] | fit |\n|---|---|---|---|---|---|---|\n";
  const std::vector<Shape> all = shapes();
  for (const Shape& shape : all)
    for (const int degree : {3, 5}) add_orders(shape, degree, csv, page);
  page +=
      "\nWith 0.1 mm of noise at every vertex, the smoothing length [mm] that the program chooses "
      "and "
      "the best of seven, knowing the truth:\n\n| shape | smoothing | position | normal | "
      "curvature "
      "[1/mm] |\n|---|---|---|---|---|\n";
  for (const Shape& shape : all) add_noise(shape, csv, page);
  return page + "\n";
}

}  // namespace condyle::accuracy
