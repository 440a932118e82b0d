#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/verify/nearest_point.h"
#include "condyle/verify/parts.h"
#include "condyle/verify/side.h"
#include "condyle/verify/spline.h"

namespace condyle::verification {
namespace {

/// Of a grid, one way, and one for each knot: a damaged patch may be of any size.
constexpr int kMostLines = 200;
constexpr double kGrid = 1;         ///< between the points where a closest is looked for first [mm]
constexpr double kMargin = 1.5;     ///< of those points beyond what is known [mm]
constexpr double kCurvature = 1.5;  ///< what is measured at points of a cell, for all of it

/// The values that divide the knot spans of [a, b] into steps no longer than `step`.
std::vector<double> divided(const std::vector<double>& knots, double a, double b, double step) {
  const double least = (b - a) / kMostLines;
  std::vector<double> values = {a};
  for (const double knot : knots) {
    const double from = values.back(), to = std::min(knot, b);
    if (to <= from) continue;
    const int parts = parts_of((to - from) / std::max(step, least), 1, kMostLines);
    for (int i = 1; i <= parts; ++i) values.push_back(from + (to - from) * i / parts);
  }
  return values;
}

/// √(κ₁² + κ₂²) from the two fundamental forms.
double total_curvature(const SplinePoint& at) {
  const double E = at.c_u.squaredNorm(), F = at.c_u.dot(at.c_v), G = at.c_v.squaredNorm();
  const double area2 = std::max(E * G - F * F, 1e-300);
  const Vector3d n = at.c_u.cross(at.c_v) / std::sqrt(area2);
  const double L = n.dot(at.c_uu), M = n.dot(at.c_uv), N = n.dot(at.c_vv);
  const double twice_mean = (E * N - 2 * F * M + G * L) / area2, gauss = (L * N - M * M) / area2;
  return std::sqrt(std::max(0.0, twice_mean * twice_mean - 2 * gauss));
}

class SplineSide final : public SurfaceSide {
 public:
  explicit SplineSide(const PatchData& patch) : patch_(patch), box_(spline_box(patch)) {
    const SplinePoint middle =
        spline_point(patch_, (box_.u0 + box_.u1) / 2, (box_.v0 + box_.v1) / 2);
    per_mm_ = {1 / middle.c_u.norm(), 1 / middle.c_v.norm()};
    lay_grid();
    const Vector3d center = std::accumulate(points_.begin(), points_.end(), Vector3d(0, 0, 0)) /
                            static_cast<double>(points_.size());
    for (const Vector3d& p : points_) half_width_ = std::max(half_width_, (p - center).norm());
    tree_ = std::make_unique<NearestPoint>(points_);
  }

  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    const std::vector<double> u = divided(patch_.knots_u, box_.u0, box_.u1, size * per_mm_[0]),
                              v = divided(patch_.knots_v, box_.v0, box_.v1, size * per_mm_[1]);
    std::vector<Cell> cells;
    for (std::size_t i = 1; i < u.size(); ++i)
      for (std::size_t j = 1; j < v.size(); ++j) {
        const double middle = edge(0, (u[i - 1] + u[i]) / 2, (v[j - 1] + v[j]) / 2);
        if (middle > -2 * size) cells.push_back({0, u[i - 1], u[i], v[j - 1], v[j]});
      }
    return cells;
  }

  [[nodiscard]] double longest_way() const override { return 0; }
  [[nodiscard]] double solid_depth() const override { return half_width_; }
  [[nodiscard]] ChartPoint at(int, double u, double v) const override {
    const SplinePoint at = spline_point(patch_, u, v);
    return {at.c, at.c_u, at.c_v};
  }

  [[nodiscard]] double edge(int, double u, double v) const override {
    const double outside = std::max(std::max(box_.u0 - u, u - box_.u1) / per_mm_[0],
                                    std::max(box_.v0 - v, v - box_.v1) / per_mm_[1]);
    if (outside > 0) return -outside;
    return mask_distance(patch_, u, v);
  }

  [[nodiscard]] double curvature(int, double u, double v) const override {
    return kCurvature * total_curvature(spline_point(patch_, u, v));
  }

  [[nodiscard]] bool is_clear(const Vector3d& p, double r) const override {
    const std::size_t i = tree_->of(p);
    const Vector3d way = p - points_[i];
    const double distance = way.norm() - reach_;
    return distance > r && distance > reach_ && way.dot(normals_[i]) > 0;
  }

  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    const std::size_t start = tree_->of(p);
    return closest_from(p, places_[start], curvatures_[start]);
  }
  [[nodiscard]] ClosestPoint closest_near(const Vector3d& p,
                                          const ClosestPoint& start) const override {
    return closest_from(p, start.place, start.curvature);
  }

 private:
  /// Newton on the squared distance.
  [[nodiscard]] ClosestPoint closest_from(const Vector3d& p,
                                          const Eigen::Vector2d& place,
                                          double bound) const {
    double u = place.x(), v = place.y();
    SplinePoint at = spline_point(patch_, u, v);
    double square = (p - at.c).squaredNorm();
    for (int i = 0; i < 30; ++i) {
      const Vector3d r = p - at.c;
      const double gu = r.dot(at.c_u), gv = r.dot(at.c_v);
      const double E = at.c_u.squaredNorm(), G = at.c_v.squaredNorm();
      double a = E - r.dot(at.c_uu), b = at.c_u.dot(at.c_v) - r.dot(at.c_uv),
             c = G - r.dot(at.c_vv);
      // Where the distance has no minimum to go to: the steps of a flat surface, which descend.
      if (!(a > 0.05 * E && a * c - b * b > 0.05 * E * G)) a = E, c = G, b = 0;
      const double det = a * c - b * b;
      double du = (c * gu - b * gv) / det, dv = (a * gv - b * gu) / det;
      bool moved = false;
      for (int half = 0; half < 25 && !moved; ++half, du /= 2, dv /= 2) {
        const double x = std::clamp(u + du, box_.u0, box_.u1),
                     y = std::clamp(v + dv, box_.v0, box_.v1);
        const SplinePoint next = spline_point(patch_, x, y);
        const double next_square = (p - next.c).squaredNorm();
        if (!(next_square <= square * (1 + 1e-15))) continue;
        moved = true;
        const double step = std::max(std::abs(x - u) / per_mm_[0], std::abs(y - v) / per_mm_[1]);
        u = x, v = y, at = next, square = next_square;
        if (step < 1e-11) i = 30;
      }
      if (!moved) break;
    }
    return closest_at(p, {u, v}, at, bound);
  }

  void lay_grid() {
    const std::vector<double> u = divided(patch_.knots_u, box_.u0, box_.u1, kGrid * per_mm_[0]),
                              v = divided(patch_.knots_v, box_.v0, box_.v1, kGrid * per_mm_[1]);
    std::vector<double> curvatures(u.size() * v.size());
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < u.size(); ++i)
      for (std::size_t j = 0; j < v.size(); ++j) {
        const SplinePoint at = spline_point(patch_, u[i], v[j]);
        curvatures[i * v.size() + j] = total_curvature(at);
        if (mask_distance(patch_, u[i], v[j]) < -kMargin) continue;
        index.push_back(i * v.size() + j);
        places_.emplace_back(u[i], v[j]);
        points_.push_back(at.c);
        normals_.push_back(at.c_u.cross(at.c_v).normalized() * patch_.orientation);
        if (i > 0 && j > 0)
          reach_ =
              std::max(reach_, 0.6 * (at.c - spline_point(patch_, u[i - 1], v[j - 1]).c).norm());
      }
    if (points_.empty()) {
      const SplinePoint at = spline_point(patch_, box_.u0, box_.v0);
      places_.emplace_back(box_.u0, box_.v0);
      points_.push_back(at.c);
      normals_.push_back(at.c_u.cross(at.c_v).normalized() * patch_.orientation);
      index.push_back(0);
    }
    for (const std::size_t k : index) {
      const std::size_t i = k / v.size(), j = k % v.size();
      double most = 0;
      for (std::size_t a = i == 0 ? 0 : i - 1; a <= std::min(i + 1, u.size() - 1); ++a)
        for (std::size_t b = j == 0 ? 0 : j - 1; b <= std::min(j + 1, v.size() - 1); ++b)
          most = std::max(most, curvatures[a * v.size() + b]);
      curvatures_.push_back(kCurvature * most);
    }
  }

  /// A closest that the box cut off is no closest: the way to it is not along the normal.
  [[nodiscard]] ClosestPoint closest_at(const Vector3d& p,
                                        const Eigen::Vector2d& place,
                                        const SplinePoint& at,
                                        double bound) const {
    ClosestPoint closest;
    closest.point = at.c;
    closest.n = at.c_u.cross(at.c_v).normalized() * patch_.orientation;
    closest.distance = closest.n.dot(p - at.c);
    closest.edge = edge(0, place.x(), place.y());
    closest.place = place;
    closest.curvature = bound;
    const double aside = ((p - at.c) - closest.distance * closest.n).norm();
    if (aside > 1e-6 + 1e-6 * std::abs(closest.distance)) {
      closest.edge = std::min(closest.edge, -aside);
      const double length = (p - at.c).norm();
      closest.distance = closest.distance < 0 ? -length : length;
    }
    return closest;
  }

  PatchData patch_;
  SplineBox box_;
  std::array<double, 2> per_mm_;  ///< parameter per mm, in the middle
  std::vector<Eigen::Vector2d> places_;
  std::vector<Vector3d> points_, normals_;
  std::vector<double> curvatures_;
  double half_width_ = 0;  ///< how far the known part reaches from its middle [mm]
  double reach_ = 0;       ///< no point of the known part is farther from a point of the grid [mm]
  std::unique_ptr<NearestPoint> tree_;
};

}  // namespace

std::unique_ptr<SurfaceSide> make_spline_side(const PatchData& patch) {
  return std::make_unique<SplineSide>(patch);
}

}  // namespace condyle::verification
