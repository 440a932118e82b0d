#include "condyle/reference/height_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kReach = 30;  // [mm] of a grid where no outline says how far

/// x^n and its first two derivatives.
struct Power {
  double value, first, second;
  Power(double x, int n)
      : value(std::pow(x, n)),
        first(n > 0 ? n * std::pow(x, n - 1) : 0),
        second(n > 1 ? n * (n - 1) * std::pow(x, n - 2) : 0) {}
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

HeightPoint evaluate(const HeightSurface& surface, const Vector2d& at) {
  double h = 0, h_x[2] = {0, 0}, h_xx[2][2] = {{0, 0}, {0, 0}};
  for (const PolynomialTerm& term : surface.terms) {
    const Power X(at.x(), term.i), Y(at.y(), term.j);
    h += term.a * X.value * Y.value;
    h_x[0] += term.a * X.first * Y.value;
    h_x[1] += term.a * X.value * Y.first;
    h_xx[0][0] += term.a * X.second * Y.value;
    h_xx[0][1] += term.a * X.first * Y.first;
    h_xx[1][1] += term.a * X.value * Y.second;
  }
  h_xx[1][0] = h_xx[0][1];
  const double sign = surface.solid_below ? 1 : -1;
  const Vector3d g(-h_x[0], -h_x[1], 1);
  const double w = g.norm();
  HeightPoint point;
  point.c = surface.origin + surface.axes * Vector3d(at.x(), at.y(), h);
  point.n = sign / w * (surface.axes * g);
  for (int k = 0; k < 2; ++k) {
    point.t[k] = surface.axes * Vector3d(k == 0, k == 1, h_x[k]);
    const Vector3d g_k(-h_xx[0][k], -h_xx[1][k], 0);
    point.n_x[k] = sign / w * (surface.axes * (g_k - g * (g.dot(g_k) / (w * w))));
    for (int l = 0; l < 2; ++l) point.c_xx[k][l] = h_xx[k][l] * surface.axes.col(2);
  }
  return point;
}

double distance_to_outline(const HeightSurface& surface, const Vector2d& at) {
  const std::vector<Vector2d>& outline = surface.outline;
  if (outline.size() < 3) return std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  bool within = true;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d edge = outline[(i + 1) % outline.size()] - outline[i], to = at - outline[i];
    const double along = std::clamp(to.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (to - along * edge).norm());
    within = within && cross(edge, to) >= 0;
  }
  return within ? nearest : -nearest;
}

Vector2d coordinates_of(const HeightSurface& surface, const Vector3d& p) {
  return surface.axes.leftCols<2>().transpose() * (p - surface.origin);
}

// Andrew's monotone chain: the lower side, then the upper one.
std::vector<Vector2d> convex_outline(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Vector2d& p : points) {
      while (hull.size() >= base + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::vector<Vector2d> grid_within(const HeightSurface& surface, double spacing) {
  Vector2d low(-kReach, -kReach), high(kReach, kReach);
  if (!surface.outline.empty()) {
    low = high = surface.outline.front();
    for (const Vector2d& corner : surface.outline) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  std::vector<Vector2d> grid;
  for (double x = low.x(); x <= high.x(); x += spacing) {
    for (double y = low.y(); y <= high.y(); y += spacing) {
      const Vector2d at(x, y);
      if (distance_to_outline(surface, at) >= 0) grid.push_back(at);
    }
  }
  return grid;
}

}  // namespace condyle
