#include "condyle/surface/condylar_axis.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kFirstAngle = 0.35, kLastAngle = 1.92;  // of posterior arcs, 0 distal [rad]

/// A vertex in anatomical components (x anterior, y proximal, z lateral) with its normal and its
/// area.
struct Sample {
  Vector3d p, n;
  double area;
};

/// Axis through (x0, y0, 0) + z (tx, ty, 1), in anatomical components; one radius on either side of
/// `split`.
struct Cylinders {
  double x0 = 0, y0 = 0, tx = 0, ty = 0;
  double radius[2] = {0, 0};
  double split = 0;

  [[nodiscard]] Vector3d direction() const { return Vector3d(tx, ty, 1).normalized(); }
  [[nodiscard]] Vector3d from_axis(const Vector3d& p) const {
    const Vector3d d = direction(), q = p - Vector3d(x0, y0, 0);
    return q - d * d.dot(q);
  }
  [[nodiscard]] int side(const Vector3d& p) const { return p.z() < split ? 0 : 1; }
};

double angle_of(double x, double y) { return std::atan2(-x, -y); }  // 0 distal, + posterior

std::vector<Sample> samples_of(const TriangleMesh& mesh,
                               const std::vector<Vector3d>& normals,
                               const BoneFrame& frame) {
  const std::vector<double> areas = vertex_areas(mesh);
  std::vector<Sample> samples;
  samples.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    samples.push_back({frame.components(mesh.vertices[i] - frame.origin),
                       frame.components(normals[i]), areas[i]});
  return samples;
}

/// Posterior-distal faces of the lower end: mostly condyles, with some of the notch and the
/// epicondyles.
std::vector<Sample> posterior_candidates(const std::vector<Sample>& all) {
  Eigen::AlignedBox3d box;
  for (const Sample& s : all) box.extend(s.p);
  const double top = box.min().y() + 0.55 * box.sizes().z();
  double back = box.max().x();
  for (const Sample& s : all)
    if (s.p.y() < top) back = std::min(back, s.p.x());
  std::vector<Sample> kept;
  for (const Sample& s : all) {
    const double angle = angle_of(s.n.x(), s.n.y());
    if (s.p.y() < top && s.p.x() < back + 0.4 * box.sizes().z() && std::abs(s.n.z()) < 0.4 &&
        angle > 0.4 && angle < 1.9)
      kept.push_back(s);
  }
  return kept;
}

/// A point of a cylinder lies one radius along its normal from the axis: p = a(z) + R n, linear in
/// the unknowns. Least squares, reweighted so that what is no condyle loses its say.
Cylinders first_estimate(const std::vector<Sample>& samples) {
  constexpr double kScale = 1.5;  // [mm]
  using Vector5 = Eigen::Matrix<double, 5, 1>;
  Vector5 x = Vector5::Zero();
  for (int iteration = 0; iteration < 25; ++iteration) {
    Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
    Vector5 b = Vector5::Zero();
    for (const Sample& s : samples) {
      Eigen::Matrix<double, 2, 5> row;
      row << 1, 0, s.p.z(), 0, s.n.x(), 0, 1, 0, s.p.z(), s.n.y();
      const Eigen::Vector2d p = s.p.head<2>(), r = p - row * x;
      const double weight =
          iteration == 0 ? s.area : s.area / (1 + r.squaredNorm() / (kScale * kScale));
      A += weight * row.transpose() * row;
      b += weight * row.transpose() * p;
    }
    x = A.ldlt().solve(b);
  }
  return {.x0 = x[0], .y0 = x[1], .tx = x[2], .ty = x[3], .radius = {x[4], x[4]}, .split = 0};
}

/// Posterior arcs near the cylinders, normals radial.
std::vector<Sample> condyle_samples(const std::vector<Sample>& all,
                                    const Cylinders& c,
                                    double band) {
  std::vector<Sample> kept;
  for (const Sample& s : all) {
    const Vector3d q = c.from_axis(s.p);
    const double r = q.norm(), angle = angle_of(q.x(), q.y());
    if (std::abs(r - c.radius[c.side(s.p)]) < band && s.n.dot(q) > 0.7 * r && angle > kFirstAngle &&
        angle < kLastAngle)
      kept.push_back(s);
  }
  return kept;
}

/// One Gauss-Newton step on Σ area · soft-L1(distance from the cylinder).
void refine(Cylinders& c, const std::vector<Sample>& samples) {
  constexpr double kScale = 0.5;  // [mm]
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> H = 1e-9 * Eigen::Matrix<double, 6, 6>::Identity();
  Vector6 g = Vector6::Zero();
  for (const Sample& s : samples) {
    const Vector3d q = c.from_axis(s.p);
    const Vector3d e = q.normalized();
    const double r = q.norm() - c.radius[c.side(s.p)];
    Vector6 row;
    row << -e.x(), -e.y(), -e.x() * s.p.z(), -e.y() * s.p.z(), c.side(s.p) == 0 ? -1 : 0,
        c.side(s.p) == 0 ? 0 : -1;
    const double weight = s.area / std::sqrt(1 + r * r / (kScale * kScale));
    H += weight * row * row.transpose();
    g += weight * r * row;
  }
  const Vector6 step = H.ldlt().solve(g);
  c.x0 -= step[0];
  c.y0 -= step[1];
  c.tx -= step[2];
  c.ty -= step[3];
  c.radius[0] -= step[4];
  c.radius[1] -= step[5];
}

double rms_distance(const Cylinders& c, const std::vector<Sample>& samples) {
  double sum = 0, area = 0;
  for (const Sample& s : samples) {
    const double r = c.from_axis(s.p).norm() - c.radius[c.side(s.p)];
    sum += s.area * r * r;
    area += s.area;
  }
  return std::sqrt(sum / std::max(area, 1e-12));
}

/// Share of 18 steps of 5 degrees, on either side, in which samples lie.
double covered(const Cylinders& c, const std::vector<Sample>& samples) {
  constexpr int kSteps = 18;
  std::array<std::array<bool, kSteps>, 2> filled{};
  for (const Sample& s : samples) {
    const Vector3d q = c.from_axis(s.p);
    const double at = (angle_of(q.x(), q.y()) - kFirstAngle) / (kLastAngle - kFirstAngle);
    filled[c.side(s.p)][std::clamp(static_cast<int>(at * kSteps), 0, kSteps - 1)] = true;
  }
  int count = 0;
  for (const auto& side : filled)
    count += static_cast<int>(std::count(side.begin(), side.end(), true));
  return count / (2.0 * kSteps);
}

void check(const Cylinders& c, const std::vector<Sample>& samples) {
  if (samples.size() < 40)
    throw InputError(fmt::format(
        "no posterior condyles found, {} vertices look like some, expected at least 40: expected a "
        "femur, in the frame of [joint]",
        samples.size()));
  for (const double r : c.radius)
    if (!(r > 8 && r < 45))
      throw InputError(
          fmt::format("posterior condyles of radius {:.3g} mm, expected 8 to 45 mm", r));
  const double tilt = std::atan(std::hypot(c.tx, c.ty)) * 180 / M_PI;
  if (tilt > 30)
    throw InputError(fmt::format(
        "the condylar axis lies {:.0f} degrees off the lateral direction of [joint]", tilt));
}

CondylarAxis in_body_frame(const Cylinders& c, const BoneFrame& frame) {
  const auto vector = [&frame](const Vector3d& v) -> Vector3d {
    return frame.anterior * v.x() + frame.proximal * v.y() + frame.lateral * v.z();
  };
  CondylarAxis axis;
  const Vector3d d = c.direction();
  const Vector3d middle(c.x0, c.y0, 0);
  const Vector3d distal = (-Vector3d::UnitY() + d * d.y()).normalized();
  const Vector3d backward = -Vector3d::UnitX() + d * d.x();
  axis.point = frame.origin + vector(middle);
  axis.direction = vector(d);
  axis.distal = vector(distal);
  axis.posterior = vector((backward - distal * distal.dot(backward)).normalized());
  axis.medial_radius = c.radius[0];
  axis.lateral_radius = c.radius[1];
  axis.split = c.split / d.z();
  return axis;
}

}  // namespace

Gap widest_gap(std::vector<double> positions) {
  std::sort(positions.begin(), positions.end());
  Gap gap;
  if (positions.size() < 2) return gap;
  const double low = positions.front(), extent = positions.back() - low;
  gap.center = low + extent / 2;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    const double center = (positions[i] + positions[i - 1]) / 2,
                 width = positions[i] - positions[i - 1];
    if (width > gap.width && std::abs(center - low - extent / 2) < extent / 4)
      gap = {center, width};
  }
  return gap;
}

CondylarAxis fit_condylar_axis(const TriangleMesh& mesh,
                               const std::vector<Vector3d>& normals,
                               const BoneFrame& frame) {
  const std::vector<Sample> all = samples_of(mesh, normals, frame);
  Cylinders c = first_estimate(posterior_candidates(all));
  std::vector<Sample> samples;
  for (int iteration = 0; iteration < 12; ++iteration) {
    samples = condyle_samples(all, c, iteration < 4 ? 4 : 2.5);
    check(c, samples);
    std::vector<double> z;
    for (const Sample& s : samples)
      if (angle_of(c.from_axis(s.p).x(), c.from_axis(s.p).y()) > 0.9) z.push_back(s.p.z());
    c.split = widest_gap(std::move(z)).center;
    refine(c, samples);
  }
  check(c, samples);
  CondylarAxis axis = in_body_frame(c, frame);
  axis.rms = rms_distance(c, samples);
  axis.coverage = covered(c, samples);
  return axis;
}

}  // namespace condyle
