#include "condyle/anatomy/posterior_cylinder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/math/decompositions.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kFirst = 0.35, kLast = 1.92;  // of the arcs, 0 distal, + posterior [rad]
constexpr double kDistanceScale = 1;           // beyond it a sample loses its say [mm]

/// Directions at right angles to the axis.
struct Cylinder {
  Vector3d point, along, distal, posterior;
  double radius;
};

struct Sample {
  Vector3d p;
  double weight;
};

/// 1 within the limits, falling to 0 over `over` beyond them.
double fade(double x, double low, double high, double over) {
  const double beyond = std::max(low - x, x - high) / over;
  return std::clamp(1 - beyond, 0.0, 1.0);
}

std::vector<Sample> samples_near(const TriangleMesh& mesh,
                                 const std::vector<Vector3d>& normals,
                                 const std::vector<double>& areas,
                                 const Cylinder& c,
                                 double band) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Vector3d q = mesh.vertices[i] - c.point, across = q - c.along * c.along.dot(q);
    const double r = across.norm();
    const double angle = std::atan2(c.posterior.dot(across), c.distal.dot(across));
    const double weight = areas[i] * fade(r - c.radius, -band, band, 0.5 * band) *
                          fade(angle, kFirst, kLast, 0.1) *
                          fade(normals[i].dot(across) / std::max(r, 1e-9), 0.8, 2, 0.2);
    if (weight > 0) samples.push_back({mesh.vertices[i], weight});
  }
  return samples;
}

void step(Cylinder& c, const std::vector<Sample>& samples) {
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> H = 1e-9 * Eigen::Matrix<double, 5, 5>::Identity();
  Vector5 g = Vector5::Zero();
  for (const Sample& s : samples) {
    const Vector3d q = s.p - c.point;
    const double z = c.along.dot(q);
    const Vector3d across = q - c.along * z, e = across.normalized();
    const double r = across.norm() - c.radius;
    Vector5 row;
    row << -e.dot(c.distal), -e.dot(c.posterior), -z * e.dot(c.distal), -z * e.dot(c.posterior), -1;
    const double weight = s.weight / std::sqrt(1 + r * r / (kDistanceScale * kDistanceScale));
    H += weight * row * row.transpose();
    g += weight * r * row;
  }
  const Vector5 x = -symmetric_solution(H, g);
  c.point += c.distal * x[0] + c.posterior * x[1];
  c.along = (c.along + c.distal * x[2] + c.posterior * x[3]).normalized();
  c.distal = (c.distal - c.along * c.along.dot(c.distal)).normalized();
  c.posterior -= c.along * c.along.dot(c.posterior);
  c.posterior = (c.posterior - c.distal * c.distal.dot(c.posterior)).normalized();
  c.radius += x[4];
}

}  // namespace

PosteriorCylinder fit_posterior_cylinder(const TriangleMesh& mesh,
                                         const std::vector<Vector3d>& normals,
                                         const CondylarAxis& start) {
  const std::vector<double> areas = vertex_areas(mesh);
  Cylinder c{start.point + start.split * start.direction, start.direction, start.distal,
             start.posterior, (start.medial_radius + start.lateral_radius) / 2};
  std::vector<Sample> samples;
  for (int iteration = 0; iteration < 30; ++iteration) {
    samples = samples_near(mesh, normals, areas, c, iteration < 6 ? 4 : 3);
    if (samples.size() < 40) throw InputError("no posterior condyles found");
    step(c, samples);
  }
  double weight[2] = {1e-300, 1e-300}, sum[2] = {0, 0}, squares = 0;
  for (const Sample& s : samples) {
    const Vector3d q = s.p - c.point;
    const double z = c.along.dot(q), r = (q - c.along * z).norm() - c.radius;
    const int half = z > 0;
    weight[half] += s.weight;
    sum[half] += s.weight * z;
    squares += s.weight * r * r;
  }
  const double low = sum[0] / weight[0], high = sum[1] / weight[1];
  return {.middle = c.point + c.along * (low + high) / 2,
          .direction = c.along,
          .radius = c.radius,
          .rms = std::sqrt(squares / (weight[0] + weight[1]))};
}

}  // namespace condyle
