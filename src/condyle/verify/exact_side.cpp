#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/input_error.h"
#include "condyle/results/run_view.h"
#include "condyle/verify/parts.h"
#include "condyle/verify/side.h"

namespace condyle::verification {
namespace {

using Eigen::Matrix3d;
constexpr double kPi = std::numbers::pi;
constexpr double kForEver = std::numeric_limits<double>::infinity();

/// nu by nv cells of a box. A surface has few to begin with; the search divides those that need it.
void add_cells(int chart, Cell box, int nu, int nv, std::vector<Cell>& cells) {
  const double du = (box.u1 - box.u0) / nu, dv = (box.v1 - box.v0) / nv;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      cells.push_back(
          {chart, box.u0 + i * du, box.u0 + (i + 1) * du, box.v0 + j * dv, box.v0 + (j + 1) * dv});
}

/// Σ ((x - c).a_i / r_i)² = 1, a ball too. Six charts, as the faces of a cube: no pole.
class EllipsoidSide final : public SurfaceSide {
 public:
  EllipsoidSide(const Vector3d& center, const Matrix3d& axes, const Vector3d& radii, bool inside)
      : center_(center), axes_(axes), radii_(radii), sign_(inside ? 1 : -1) {}

  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    const int n = parts_of(2 * radii_.maxCoeff() / size, 4, 24);
    std::vector<Cell> cells;
    for (int face = 0; face < 6; ++face) add_cells(face, {face, -1, 1, -1, 1}, n, n, cells);
    return cells;
  }
  [[nodiscard]] double longest_way() const override { return kPi / 2 * radii_.maxCoeff(); }
  [[nodiscard]] ChartPoint at(int chart, double u, double v) const override {
    const int a = chart % 3;
    Vector3d q, q_u = Vector3d::Unit((a + 1) % 3), q_v = Vector3d::Unit((a + 2) % 3);
    q = (chart < 3 ? 1 : -1) * Vector3d::Unit(a) + u * q_u + v * q_v;
    const double length = q.norm();
    const Vector3d d = q / length;
    const auto onto = [&](const Vector3d& x) -> Vector3d { return axes_ * radii_.cwiseProduct(x); };
    return {center_ + onto(d), onto((q_u - d * d.dot(q_u)) / length),
            onto((q_v - d * d.dot(q_v)) / length)};
  }
  [[nodiscard]] double edge(int, double, double) const override { return kForEver; }
  [[nodiscard]] double curvature(int, double, double) const override {
    return radii_.maxCoeff() / (radii_.minCoeff() * radii_.minCoeff());
  }

  /// The point y closest to x has x - y = t y/r² for the greatest root t of Σ (r x/(t + r²))² = 1
  /// [Eberly 2013].
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    Vector3d x = axes_.transpose() * (p - center_);
    for (int i = 0; i < 3; ++i)
      if (std::abs(x[i]) < 1e-13 * radii_[i]) x[i] = std::copysign(1e-13 * radii_[i], x[i]);
    const Vector3d square = radii_.cwiseAbs2();
    double low = -square.minCoeff(), high = radii_.maxCoeff() * x.norm();
    const auto excess = [&](double t) {
      double sum = -1;
      for (int i = 0; i < 3; ++i) {
        const double part = radii_[i] * x[i] / (t + square[i]);
        sum += part * part;
      }
      return sum;
    };
    double t = std::max(0.0, low / 2);
    for (int i = 0; i < 200 && high - low > 1e-16 * square.maxCoeff(); ++i) {
      const double value = excess(t);
      (value > 0 ? low : high) = t;
      double slope = 0;
      for (int k = 0; k < 3; ++k) {
        const double rx = radii_[k] * x[k], d = t + square[k];
        slope -= 2 * rx * rx / (d * d * d);
      }
      const double next = t - value / slope;
      if (next == t) break;
      t = next > low && next < high ? next : (low + high) / 2;
    }
    Vector3d y;
    for (int i = 0; i < 3; ++i) y[i] = square[i] * x[i] / (t + square[i]);
    ClosestPoint closest;
    const Vector3d outward = axes_ * y.cwiseQuotient(square).normalized();
    closest.point = center_ + axes_ * y;
    closest.n = sign_ * outward;
    closest.distance = closest.n.dot(p - closest.point);
    closest.edge = kForEver;
    closest.curvature = curvature(0, 0, 0);
    return closest;
  }

 private:
  Vector3d center_;
  Matrix3d axes_;
  Vector3d radii_;
  double sign_;
};

/// n.(x - c) = 0
class PlaneSide final : public SurfaceSide {
 public:
  PlaneSide(const Vector3d& point, const Vector3d& normal, double radius)
      : point_(point),
        n_(normal.normalized()),
        x_(n_.unitOrthogonal()),
        y_(n_.cross(x_)),
        radius_(radius) {}
  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    std::vector<Cell> cells;
    if (std::isinf(radius_)) return cells;
    const int n = parts_of(2 * radius_ / size, 4, 48);
    add_cells(0, {0, -radius_, radius_, -radius_, radius_}, n, n, cells);
    return cells;
  }
  [[nodiscard]] double longest_way() const override { return 2 * radius_; }
  [[nodiscard]] ChartPoint at(int, double u, double v) const override {
    return {point_ + u * x_ + v * y_, x_, y_};
  }
  [[nodiscard]] double edge(int, double u, double v) const override {
    return std::isinf(radius_) ? kForEver : radius_ - std::hypot(u, v);
  }
  [[nodiscard]] double curvature(int, double, double) const override { return 0; }
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    const double height = n_.dot(p - point_);
    const Vector3d on = p - height * n_;
    return {height, on, n_, edge(0, (on - point_).dot(x_), (on - point_).dot(y_)), 0};
  }

 private:
  Vector3d point_, n_, x_, y_;
  double radius_;
};

/// |(x - c) - a a.(x - c)| = r
class CylinderSide final : public SurfaceSide {
 public:
  CylinderSide(
      const Vector3d& point, const Vector3d& axis, double radius, bool inside, double length)
      : point_(point),
        a_(axis.normalized()),
        x_(a_.unitOrthogonal()),
        y_(a_.cross(x_)),
        radius_(radius),
        sign_(inside ? 1 : -1),
        length_(length) {}
  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    std::vector<Cell> cells;
    if (std::isinf(length_)) return cells;
    add_cells(0, {0, -kPi, kPi, -length_ / 2, length_ / 2},
              parts_of(2 * kPi * radius_ / size, 12, 96), parts_of(length_ / size, 2, 48), cells);
    return cells;
  }
  [[nodiscard]] double longest_way() const override { return std::max(2 * kPi * radius_, length_); }
  [[nodiscard]] ChartPoint at(int, double u, double v) const override {
    const Vector3d out = std::cos(u) * x_ + std::sin(u) * y_;
    return {point_ + radius_ * out + v * a_, radius_ * a_.cross(out), a_};
  }
  [[nodiscard]] double edge(int, double, double v) const override {
    return length_ / 2 - std::abs(v);
  }
  [[nodiscard]] double curvature(int, double, double) const override { return 1 / radius_; }
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    const Vector3d q = p - point_;
    const double along = a_.dot(q);
    Vector3d out = q - along * a_;
    const double r = out.norm();
    out = r > 0 ? Vector3d(out / r) : x_;
    return {sign_ * (r - radius_), point_ + along * a_ + radius_ * out, sign_ * out,
            edge(0, 0, along), 1 / radius_};
  }

 private:
  Vector3d point_, a_, x_, y_;
  double radius_, sign_, length_;
};

/// (|x - a a.x| - R)² + (a.x)² = r² about the centre
class TorusSide final : public SurfaceSide {
 public:
  TorusSide(const Vector3d& center, const Vector3d& axis, double major, double minor, bool inside)
      : center_(center),
        a_(axis.normalized()),
        x_(a_.unitOrthogonal()),
        y_(a_.cross(x_)),
        major_(major),
        minor_(minor),
        sign_(inside ? 1 : -1) {}
  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    std::vector<Cell> cells;
    add_cells(0, {0, -kPi, kPi, -kPi, kPi}, parts_of(2 * kPi * (major_ + minor_) / size, 12, 96),
              parts_of(2 * kPi * minor_ / size, 12, 48), cells);
    return cells;
  }
  [[nodiscard]] double longest_way() const override { return 2 * kPi * (major_ + minor_); }
  [[nodiscard]] ChartPoint at(int, double u, double v) const override {
    const Vector3d out = std::cos(u) * x_ + std::sin(u) * y_, round = a_.cross(out);
    const double r = major_ + minor_ * std::cos(v);
    return {center_ + r * out + minor_ * std::sin(v) * a_, r * round,
            minor_ * (std::cos(v) * a_ - std::sin(v) * out)};
  }
  [[nodiscard]] double edge(int, double, double) const override { return kForEver; }
  [[nodiscard]] double curvature(int, double, double) const override {
    return 1 / std::min(minor_, major_ - minor_);
  }
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    const Vector3d q = p - center_;
    Vector3d out = q - a_.dot(q) * a_;
    out = out.norm() > 0 ? Vector3d(out.normalized()) : x_;
    Vector3d away = q - major_ * out;
    const double r = away.norm();
    away = r > 0 ? Vector3d(away / r) : out;
    return {sign_ * (r - minor_), center_ + major_ * out + minor_ * away, sign_ * away, kForEver,
            curvature(0, 0, 0)};
  }

 private:
  Vector3d center_, a_, x_, y_;
  double major_, minor_, sign_;
};

/// z = Σ a xⁱ yʲ in a frame of its own
class HeightSide final : public SurfaceSide {
 public:
  HeightSide(const Vector3d& origin,
             const Matrix3d& axes,
             std::vector<PolynomialTerm> terms,
             bool below,
             double radius)
      : origin_(origin),
        axes_(axes),
        terms_(std::move(terms)),
        sign_(below ? 1 : -1),
        radius_(radius) {}
  [[nodiscard]] std::vector<Cell> cells(double size) const override {
    std::vector<Cell> cells;
    if (std::isinf(radius_)) return cells;
    const int n = parts_of(2 * radius_ / size, 8, 64);
    add_cells(0, {0, -radius_, radius_, -radius_, radius_}, n, n, cells);
    return cells;
  }
  [[nodiscard]] double longest_way() const override { return 2 * radius_; }
  [[nodiscard]] double solid_depth() const override { return radius_; }
  [[nodiscard]] ChartPoint at(int, double u, double v) const override {
    const Height h = height(u, v);
    return {origin_ + axes_ * Vector3d(u, v, h.z), axes_ * Vector3d(1, 0, h.x),
            axes_ * Vector3d(0, 1, h.y)};
  }
  [[nodiscard]] double edge(int, double u, double v) const override {
    return std::isinf(radius_) ? kForEver : radius_ - std::hypot(u, v);
  }
  [[nodiscard]] double curvature(int, double u, double v) const override {
    const Height h = height(u, v);
    return 2 * (std::abs(h.xx) + 2 * std::abs(h.xy) + std::abs(h.yy));
  }
  /// Newton on the squared distance from the point below, kept a descent.
  [[nodiscard]] ClosestPoint closest(const Vector3d& p) const override {
    const Vector3d q = axes_.transpose() * (p - origin_);
    double x = q.x(), y = q.y();
    const auto square = [&](double a, double b) {
      const double z = height(a, b).z - q.z();
      return (a - q.x()) * (a - q.x()) + (b - q.y()) * (b - q.y()) + z * z;
    };
    double best = square(x, y);
    for (int i = 0; i < 60; ++i) {
      const Height h = height(x, y);
      const double over = h.z - q.z(), gx = x - q.x() + over * h.x, gy = y - q.y() + over * h.y;
      double a = 1 + h.x * h.x + over * h.xx, b = h.x * h.y + over * h.xy,
             c = 1 + h.y * h.y + over * h.yy;
      if (!(a > 0.05 && a * c - b * b > 0.05)) a = 1 + h.x * h.x, c = 1 + h.y * h.y, b = h.x * h.y;
      const double det = a * c - b * b;
      double dx = -(c * gx - b * gy) / det, dy = -(a * gy - b * gx) / det;
      int half = 0;
      while (half < 40 && !(square(x + dx, y + dy) <= best)) dx /= 2, dy /= 2, ++half;
      if (half == 40) break;
      x += dx, y += dy, best = square(x, y);
      if (std::hypot(dx, dy) < 1e-13) break;
    }
    const Height h = height(x, y);
    ClosestPoint closest;
    closest.point = origin_ + axes_ * Vector3d(x, y, h.z);
    closest.n = sign_ * (axes_ * Vector3d(-h.x, -h.y, 1).normalized());
    closest.distance = closest.n.dot(p - closest.point);
    closest.edge = edge(0, x, y);
    closest.curvature = curvature(0, x, y);
    return closest;
  }

 private:
  struct Height {
    double z = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  };
  [[nodiscard]] Height height(double x, double y) const {
    Height h;
    const auto power = [](double base, int k) {
      double product = k < 0 ? 0 : 1;
      for (; k > 0; --k) product *= base;
      return product;
    };
    for (const PolynomialTerm& term : terms_) {
      const int i = term.i, j = term.j;
      const double xi = power(x, i), yj = power(y, j), dx = i * power(x, i - 1),
                   dy = j * power(y, j - 1);
      h.z += term.a * xi * yj;
      h.x += term.a * dx * yj;
      h.y += term.a * xi * dy;
      h.xx += term.a * i * (i - 1) * power(x, i - 2) * yj;
      h.xy += term.a * dx * dy;
      h.yy += term.a * xi * j * (j - 1) * power(y, j - 2);
    }
    return h;
  }

  Vector3d origin_;
  Matrix3d axes_;
  std::vector<PolynomialTerm> terms_;
  double sign_, radius_;
};

}  // namespace

std::unique_ptr<SurfaceSide> make_exact_side(const SurfaceDescription& s) {
  switch (s.kind) {
    case SurfaceKind::kPlane:
      return std::make_unique<PlaneSide>(s.point, s.direction, s.known_radius);
    case SurfaceKind::kSphere:
      return std::make_unique<EllipsoidSide>(s.point, Matrix3d::Identity(),
                                             Vector3d::Constant(s.radius), s.solid_inside);
    case SurfaceKind::kCylinder:
      return std::make_unique<CylinderSide>(s.point, s.direction, s.radius, s.solid_inside,
                                            s.length);
    case SurfaceKind::kEllipsoid:
      return std::make_unique<EllipsoidSide>(s.point, s.axes, s.semi_axes, s.solid_inside);
    case SurfaceKind::kTorus:
      return std::make_unique<TorusSide>(s.point, s.direction, s.radius, s.minor_radius,
                                         s.solid_inside);
    case SurfaceKind::kPolynomial:
      return std::make_unique<HeightSide>(s.point, s.axes, s.terms, s.solid_inside, s.known_radius);
    case SurfaceKind::kPatch:
      break;
  }
  throw InputError("surface \"" + s.name + "\": its patch is missing, expected one in /patches");
}

std::vector<std::unique_ptr<SurfaceSide>> make_sides(const Run& run) {
  std::vector<std::unique_ptr<SurfaceSide>> sides;
  for (const SurfaceDescription& surface : run.scene.surfaces) {
    const RunPatch* patch = patch_of(run, surface.name);
    sides.push_back(patch != nullptr && surface.kind == SurfaceKind::kPatch
                        ? make_spline_side(patch->data)
                        : make_exact_side(surface));
  }
  return sides;
}

}  // namespace condyle::verification
