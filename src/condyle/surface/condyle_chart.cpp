#include "condyle/surface/condyle_chart.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDepth = 1.3;  // of the line below the crest, in half-widths of the condyle

}  // namespace

AboutAxis about_axis(const CondylarAxis& axis, const Vector3d& p) {
  const Vector3d q = p - axis.point;
  const double along = axis.direction.dot(q);
  const Vector3d r = q - axis.direction * along;
  return {.angle = std::atan2(r.dot(axis.posterior), r.dot(axis.distal)),
          .radius = r.norm(),
          .along = along - axis.split,
          .radial = r.stableNormalized()};
}

CondyleChart::CondyleChart(const TriangleMesh& mesh,
                           const std::vector<bool>& crest,
                           const CondylarAxis& axis,
                           double unit_radius)
    : axis_(axis), unit_radius_(unit_radius) {
  const SubMesh part = sub_mesh(mesh, crest);
  const std::vector<double> areas = vertex_areas(part.mesh);
  std::vector<AboutAxis> points;
  double low = 10, high = -10;
  for (const Vector3d& p : part.mesh.vertices) {
    points.push_back(about_axis(axis, p));
    low = std::min(low, points.back().angle);
    high = std::max(high, points.back().angle);
  }
  if (points.size() < 30) throw InputError("no articular area found");
  middle_ = (low + high) / 2;
  half_ = std::max((high - low) / 2, 0.1);

  // Area-weighted least squares; the least share of the unit matrix keeps gaps of a coarse mesh
  // from mattering.
  Eigen::Matrix<double, kTerms, kTerms> A = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Eigen::Matrix<double, kTerms, 2> b = Eigen::Matrix<double, kTerms, 2>::Zero();
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Terms t = powers(points[i].angle);
    A += areas[i] * t * t.transpose();
    b += areas[i] * t * Vector2d(points[i].along, points[i].radius).transpose();
    area += areas[i];
  }
  A += 1e-6 * area * Eigen::Matrix<double, kTerms, kTerms>::Identity();
  const Eigen::Matrix<double, kTerms, 2> x = A.ldlt().solve(b);
  along_ = x.col(0);
  double square = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = points[i].along - along_.dot(powers(points[i].angle));
    square += areas[i] * off * off;
  }
  // Evenly spread over the width, points lie half_width / √3 rms from the middle.
  tube_ = kDepth * std::sqrt(3 * square / area);
  radius_ = x.col(1);
  radius_[0] -= tube_;
}

CondyleChart::Terms CondyleChart::powers(double angle) const {
  // Legendre polynomials: well conditioned, and their first few follow any condyle.
  const double t = std::clamp((angle - middle_) / half_, -1.0, 1.0), s = t * t;
  Terms terms;
  terms << 1, t, (3 * s - 1) / 2, t * (5 * s - 3) / 2, (s * (35 * s - 30) + 3) / 8;
  return terms;
}

Vector2d CondyleChart::from_line(const AboutAxis& q) const {
  const Terms t = powers(q.angle);
  return {q.along - along_.dot(t), q.radius - radius_.dot(t)};
}

Vector2d CondyleChart::at(const Vector3d& p) const {
  const AboutAxis q = about_axis(axis_, p);
  const Vector2d d = from_line(q);
  return {unit_radius_ * q.angle, tube_ * std::atan2(d.x(), d.y())};
}

Vector3d CondyleChart::direction(const Vector3d& p) const {
  const AboutAxis q = about_axis(axis_, p);
  const Vector2d d = from_line(q).stableNormalized();
  return axis_.direction * d.x() + q.radial * d.y();
}

}  // namespace condyle
