#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/surface/exact_charts.h"
#include "condyle/surface/exact_surface_tools.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kHighestExponent = 30;

/// Height and its derivatives.
struct Height {
  double h, h_x, h_y, h_xx, h_xy, h_yy;
};

/// Value with first and half the second derivative, as Horner's scheme carries them.
struct Horner {
  double value = 0, first = 0, half_second = 0;
  void next(double x, double coefficient) {
    half_second = half_second * x + first;
    first = first * x + value;
    value = value * x + coefficient;
  }
};

class HeightPolynomial final : public ExactSurface {
 public:
  HeightPolynomial(const Vector3d& origin,
                   const Matrix3d& axes,
                   const std::vector<PolynomialTerm>& terms,
                   bool solid_inside,
                   double radius)
      : origin_(origin),
        axes_(checked_axes(axes, "polynomial: axes")),
        sign_(solid_inside ? 1 : -1),
        radius_(checked_bound(radius, "polynomial: radius")) {
    for (const PolynomialTerm& term : terms) {
      check(term);
      rows_ = std::max(rows_, term.i + 1);
      columns_ = std::max(columns_, term.j + 1);
    }
    coefficients_.assign(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), 0.0);
    for (const PolynomialTerm& term : terms) coefficients_[term.i * columns_ + term.j] += term.a;
  }

  /// The gradient of z - h is (-h_x, -h_y, 1) =: w n and K = P [h_xx h_xy; h_xy h_yy] P / w, P = I
  /// - nn.
  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    const Vector3d x = axes_.transpose() * (place.numbers - origin_);
    const Height z = height(x[0], x[1]);
    const Vector3d gradient(-z.h_x, -z.h_y, 1);
    const double w = gradient.norm();
    const Vector3d n = gradient / w;
    Matrix3d hessian = Matrix3d::Zero();
    hessian.topLeftCorner<2, 2>() << z.h_xx, z.h_xy, z.h_xy, z.h_yy;
    const Vector3d m = hessian * n;
    const Vector3d side = m - (n.dot(m) / 2) * n;
    const Matrix3d K = (sign_ / w) * (hessian - n * side.transpose() - side * n.transpose());
    return {place.numbers, axes_ * (sign_ * n), axes_ * K * axes_.transpose(),
            Eigen::Matrix<double, 3, 2>::Zero()};
  }

  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint&,
                            const Vector3d& dc) const override {
    return seed(place.numbers + dc);
  }
  [[nodiscard]] Place closest(const Vector3d& p, const Place& start) const override {
    return closest_by_newton(*this, p, start);
  }
  /// Above or below p. A tangent displacement leaves the surface only by its square, so `moved` may
  /// do the same.
  [[nodiscard]] Place seed(const Vector3d& p) const override {
    Vector3d x = axes_.transpose() * (p - origin_);
    x[2] = height(x[0], x[1]).h;
    return {origin_ + axes_ * x};
  }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    if (std::isinf(radius_)) return radius_;
    return radius_ - (axes_.leftCols<2>().transpose() * (place.numbers - origin_)).norm();
  }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    std::vector<Place> places;
    if (std::isinf(radius_)) return places;
    for (const Eigen::Vector2d& at : disc_samples(radius_, spacing / steepness(spacing)))
      places.push_back({origin_ + axes_ * Vector3d(at.x(), at.y(), height(at.x(), at.y()).h)});
    return places;
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    if (std::isinf(radius_)) return {};
    return {{-radius_, radius_, -radius_, radius_, [*this](double u, double v) {
               const Height z = height(u, v);
               return SurfaceChart::At{origin_ + axes_ * Vector3d(u, v, z.h),
                                       std::hypot(1.0, z.h_x, z.h_y)};
             }}};
  }
  [[nodiscard]] Extent extent() const override {
    return {seed(origin_).numbers, radius_ / std::numbers::sqrt2};
  }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<HeightPolynomial>(*this);
    copy->origin_ += d;
    return copy;
  }

 private:
  /// How much longer than its shadow a way on the surface may be.
  [[nodiscard]] double steepness(double spacing) const {
    constexpr double kMost = 4;
    double steepest = 1;
    for (const Eigen::Vector2d& at : disc_samples(radius_, 2 * spacing)) {
      const Height z = height(at.x(), at.y());
      steepest = std::max(steepest, std::hypot(1.0, z.h_x, z.h_y));
    }
    return std::min(steepest, kMost);
  }

  static void check(const PolynomialTerm& term) {
    const auto fits = [](int exponent) { return exponent >= 0 && exponent <= kHighestExponent; };
    if (fits(term.i) && fits(term.j) && std::isfinite(term.a)) return;
    throw InputError(
        fmt::format("polynomial: term [{}, {}, {}], expected exponents from 0 to {} and a number",
                    term.i, term.j, term.a, kHighestExponent));
  }

  /// Horner in y within Horner in x.
  [[nodiscard]] Height height(double x, double y) const {
    Horner value, slope;  // in x: of h and of h_y
    double h_yy = 0;
    for (int i = rows_; i-- > 0;) {
      Horner row;
      for (int j = columns_; j-- > 0;) row.next(y, coefficients_[i * columns_ + j]);
      value.next(x, row.value);
      slope.next(x, row.first);
      h_yy = h_yy * x + 2 * row.half_second;
    }
    return {value.value, value.first, slope.value, 2 * value.half_second, slope.first, h_yy};
  }

  Vector3d origin_;
  Matrix3d axes_;
  double sign_, radius_;
  int rows_ = 1, columns_ = 1;
  std::vector<double> coefficients_;  ///< of x^i y^j at [i columns_ + j]
};

}  // namespace

std::unique_ptr<Surface> make_polynomial(const Vector3d& origin,
                                         const Matrix3d& axes,
                                         const std::vector<PolynomialTerm>& terms,
                                         bool solid_inside,
                                         double radius) {
  return std::make_unique<HeightPolynomial>(origin, axes, terms, solid_inside, radius);
}

}  // namespace condyle
