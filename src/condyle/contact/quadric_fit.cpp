#include "condyle/contact/quadric_fit.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/contact/curvature_tensor.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTurned = 0.5;  // least cosine between the normals of a piece

/// How far a cell rises over the quadric: at its centre, and by slope, curvature and its own rise
/// on the way to its rim.
double rise_over(const SurfacePoint& quadric, const SurfaceCell& cell) {
  if (cell.at.n.dot(quadric.n) < kTurned) return kInfinity;
  const Eigen::Vector3d d = cell.at.c - quadric.c;
  const double along = d.dot(quadric.n), r = cell.radius;
  const Eigen::Vector3d Kt = quadric.K * (d - along * quadric.n), normal = quadric.n - Kt;
  const double slope = off_normal(normal, cell.at.n).norm();
  const Eigen::Matrix3d D = cell.at.K - quadric.K;
  const double bend = std::max(0.0, largest_principal(D));
  return along - 0.5 * d.dot(Kt) + slope * r + 0.5 * bend * r * r + cell.rise;
}

SurfaceCell enclosed(const SurfacePoint& quadric, SurfaceCells cells) {
  SurfaceCell all{quadric};
  for (const SurfaceCell* cell : cells) {
    all.radius = std::max(all.radius, (cell->at.c - quadric.c).norm() + cell->radius);
    if (all.rise < kInfinity) all.rise = std::max(all.rise, rise_over(quadric, *cell));
  }
  return all;
}

}  // namespace

SurfacePoint mean_quadric(const SurfacePoint& about, SurfaceCells cells) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), way = Eigen::Vector3d::Zero();
  double area = 0;
  for (const SurfaceCell* cell : cells) {
    const double w = cell->radius * cell->radius;
    K += w * cell->at.K;
    normal += w * cell->at.n;
    way += w * (cell->at.c - about.c);
    area += w;
  }
  K /= area;
  SurfacePoint mean = about;
  mean.n = (normal + K * way).normalized();
  const Eigen::Vector3d Kn = K * mean.n;
  mean.K = K - mean.n * Kn.transpose() - Kn * mean.n.transpose() +
           mean.n.dot(Kn) * mean.n * mean.n.transpose();
  double height = 0;
  for (const SurfaceCell* cell : cells) {
    const Eigen::Vector3d d = cell->at.c - about.c;
    height += cell->radius * cell->radius * (d.dot(mean.n) - 0.5 * d.dot(mean.K * d));
  }
  mean.c += height / area * mean.n;
  return mean;
}

SurfaceCell fit_quadric(const SurfacePoint& about, SurfaceCells cells) {
  SurfaceCell given = enclosed(about, cells);
  const double least = cells.front()->rise;
  if (given.rise <= least || given.rise == kInfinity) return given;
  SurfaceCell mean = enclosed(mean_quadric(about, cells), cells);
  return mean.rise < given.rise ? mean : given;
}

}  // namespace condyle
