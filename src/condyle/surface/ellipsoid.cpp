#include <algorithm>
#include <cmath>

#include "condyle/surface/exact_charts.h"
#include "condyle/surface/exact_surface_tools.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The surface φ(x) = xᵀ M x = 1 about the centre, M = A diag(1/a²) Aᵀ; M x is normal to it.
class Ellipsoid final : public ExactSurface {
 public:
  Ellipsoid(const Vector3d& center,
            const Matrix3d& axes,
            const Vector3d& semi_axes,
            bool solid_inside)
      : center_(center),
        axes_(checked_axes(axes, "ellipsoid: axes")),
        semi_axes_(semi_axes),
        sign_(solid_inside ? 1 : -1) {
    for (const double a : semi_axes) (void)checked_length(a, "ellipsoid: semi-axis");
    M_ = axes_ * semi_axes_.cwiseAbs2().cwiseInverse().asDiagonal() * axes_.transpose();
  }

  /// n = M x/|M x| and, with P = I - nn, K = -P M P/|M x|; all signs turned where the solid is
  /// outside.
  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    const Vector3d gradient = M_ * (place.numbers - center_);
    const double size = std::max(gradient.norm(), 1e-12 / semi_axes_.maxCoeff());
    const Vector3d n = unit_or(gradient, axes_.col(0)), m = M_ * n;
    const double w = sign_ / size;
    const Vector3d side = w * (m - (n.dot(m) / 2) * n);
    SurfacePoint at{place.numbers, sign_ * n, -w * M_, Eigen::Matrix<double, 3, 2>::Zero()};
    at.K.noalias() += n * side.transpose();
    at.K.noalias() += side * n.transpose();
    return at;
  }

  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint&,
                            const Vector3d& dc) const override {
    return scaled(place.numbers + dc, place);
  }

  [[nodiscard]] Place closest(const Vector3d& p, const Place& start) const override {
    const Vector3d x = axes_.transpose() * (p - center_);
    if (x.cwiseQuotient(semi_axes_).squaredNorm() < 1) return closest_by_newton(*this, p, start);
    const Vector3d squares = semi_axes_.cwiseAbs2();
    const double t = multiplier_outside(x);
    return scaled(
        center_ + axes_ * x.cwiseProduct(squares).cwiseQuotient((squares.array() + t).matrix()),
        start);
  }

  [[nodiscard]] Place seed(const Vector3d& p) const override {
    return scaled(p, {center_ + semi_axes_[0] * axes_.col(0)});
  }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    return ellipsoid_samples(center_, axes_, semi_axes_, spacing);
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    return ellipsoid_charts(center_, axes_, semi_axes_);
  }
  [[nodiscard]] Extent extent() const override {
    return {center_, semi_axes_.norm() / std::sqrt(3)};
  }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<Ellipsoid>(*this);
    copy->center_ += d;
    return copy;
  }

 private:
  /// p brought to the surface along the ray from the centre. A tangent displacement leaves φ = 1
  /// only by its square, so this keeps it to first order.
  [[nodiscard]] Place scaled(const Vector3d& p, const Place& otherwise) const {
    const Vector3d x = p - center_;
    const double phi = x.dot(M_ * x);
    if (!(phi > 1e-24)) return otherwise;
    return {center_ + x / std::sqrt(phi)};
  }

  /// The closest point c to x outside has x - c = t M c with t >= 0 and Σ (a x/(t + a²))² = 1:
  /// convex and decreasing, so Newton from a lower bound climbs to the root.
  [[nodiscard]] double multiplier_outside(const Vector3d& x) const {
    const Vector3d squares = semi_axes_.cwiseAbs2(), ax = semi_axes_.cwiseProduct(x);
    double t = std::max(0.0, (ax.cwiseAbs() - squares).maxCoeff());
    t = std::max(t, semi_axes_.minCoeff() * x.norm() - squares.maxCoeff());
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Vector3d denominator = (squares.array() + t).matrix();
      const Vector3d y = ax.cwiseQuotient(denominator);
      const double slope = -2 * y.cwiseAbs2().cwiseQuotient(denominator).sum();
      const double step = (1 - y.squaredNorm()) / slope;
      if (!(step > 1e-16 * denominator.minCoeff())) break;
      t += step;
    }
    return t;
  }

  Vector3d center_;
  Matrix3d axes_;
  Vector3d semi_axes_;
  double sign_;
  Matrix3d M_;
};

}  // namespace

std::unique_ptr<Surface> make_ellipsoid(const Vector3d& center,
                                        const Matrix3d& axes,
                                        const Vector3d& semi_axes,
                                        bool solid_inside) {
  return std::make_unique<Ellipsoid>(center, axes, semi_axes, solid_inside);
}

}  // namespace condyle
