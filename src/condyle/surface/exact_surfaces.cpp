#include "condyle/surface/exact_surfaces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "condyle/input_error.h"
#include "condyle/surface/exact_charts.h"
#include "condyle/surface/exact_surface_tools.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// -κ (I - nn)
Matrix3d umbilic(const Vector3d& n, double kappa) {
  Matrix3d K = (kappa * n) * n.transpose();
  K.diagonal().array() -= kappa;
  return K;
}

class Plane final : public ExactSurface {
 public:
  Plane(const Vector3d& point, const Vector3d& normal, double radius)
      : n_(checked_direction(normal, "plane: normal")),
        point_(point),
        height_(n_.dot(point)),
        radius_(checked_bound(radius, "plane: radius")) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    return {place.numbers, n_, Matrix3d::Zero(), Eigen::Matrix<double, 3, 2>::Zero()};
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint&,
                            const Vector3d& dc) const override {
    return seed(place.numbers + dc);
  }
  [[nodiscard]] Place closest(const Vector3d& p, const Place&) const override { return seed(p); }
  [[nodiscard]] Place seed(const Vector3d& p) const override {
    return {p + (height_ - n_.dot(p)) * n_};
  }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    return std::isinf(radius_) ? radius_ : radius_ - (place.numbers - point_).norm();
  }
  [[nodiscard]] bool bends_evenly() const override { return true; }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    std::vector<Place> places;
    if (std::isinf(radius_)) return places;
    const Vector3d x = n_.unitOrthogonal(), y = n_.cross(x);
    for (const Eigen::Vector2d& at : disc_samples(radius_, spacing))
      places.push_back({point_ + at.x() * x + at.y() * y});
    return places;
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    if (std::isinf(radius_)) return {};
    const Vector3d x = n_.unitOrthogonal(), y = n_.cross(x);
    return {{-radius_, radius_, -radius_, radius_, [=, point = point_](double u, double v) {
               return SurfaceChart::At{point + u * x + v * y, 1};
             }}};
  }
  [[nodiscard]] Extent extent() const override { return {point_, radius_ / std::numbers::sqrt2}; }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<Plane>(*this);
    copy->point_ += d;
    copy->height_ = n_.dot(copy->point_);
    return copy;
  }

 private:
  Vector3d n_, point_;
  double height_, radius_;
};

/// `sign_` is +1 where the solid is inside, so that sign_ times the direction away from the centre
/// points out of it.
class Sphere final : public ExactSurface {
 public:
  Sphere(const Vector3d& center, double radius, bool solid_inside)
      : center_(center),
        radius_(checked_length(radius, "sphere: radius")),
        sign_(solid_inside ? 1 : -1) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    const Vector3d away = unit_or(place.numbers - center_, Vector3d::UnitZ());
    return {place.numbers, sign_ * away, umbilic(away, sign_ / radius_),
            Eigen::Matrix<double, 3, 2>::Zero()};
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Vector3d& dc) const override {
    return on_sphere(place.numbers + dc, sign_ * at.n);
  }
  [[nodiscard]] Place closest(const Vector3d& p, const Place& start) const override {
    return on_sphere(p, unit_or(start.numbers - center_, Vector3d::UnitZ()));
  }
  [[nodiscard]] Place seed(const Vector3d& p) const override {
    return on_sphere(p, Vector3d::UnitZ());
  }
  [[nodiscard]] bool bends_evenly() const override { return true; }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    return ellipsoid_samples(center_, Matrix3d::Identity(), Vector3d::Constant(radius_), spacing);
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    return ellipsoid_charts(center_, Matrix3d::Identity(), Vector3d::Constant(radius_));
  }
  [[nodiscard]] Extent extent() const override { return {center_, radius_}; }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<Sphere>(*this);
    copy->center_ += d;
    return copy;
  }

 private:
  [[nodiscard]] Place on_sphere(const Vector3d& p, const Vector3d& otherwise) const {
    return {center_ + radius_ * unit_or(p - center_, otherwise)};
  }

  Vector3d center_;
  double radius_, sign_;
};

class Cylinder final : public ExactSurface {
 public:
  Cylinder(
      const Vector3d& point, const Vector3d& axis, double radius, bool solid_inside, double length)
      : point_(point),
        axis_(checked_direction(axis, "cylinder: axis")),
        sideways_(axis_.unitOrthogonal()),
        radius_(checked_length(radius, "cylinder: radius")),
        sign_(solid_inside ? 1 : -1),
        length_(checked_bound(length, "cylinder: length")) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    const Vector3d away = unit_or(from_axis(place.numbers), sideways_), round = axis_.cross(away);
    return {place.numbers, sign_ * away, (-sign_ / radius_ * round) * round.transpose(),
            Eigen::Matrix<double, 3, 2>::Zero()};
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Vector3d& dc) const override {
    return on_cylinder(place.numbers + dc, sign_ * at.n);
  }
  [[nodiscard]] Place closest(const Vector3d& p, const Place& start) const override {
    return on_cylinder(p, unit_or(from_axis(start.numbers), sideways_));
  }
  [[nodiscard]] Place seed(const Vector3d& p) const override { return on_cylinder(p, sideways_); }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    return 0.5 * length_ - std::abs(axis_.dot(place.numbers - point_));
  }
  [[nodiscard]] bool bends_evenly() const override { return true; }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    if (std::isinf(length_)) return {};
    return cylinder_samples(point_, axis_, radius_, length_, spacing);
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    if (std::isinf(length_)) return {};
    const double end = std::numbers::pi * radius_;
    const auto at = [*this](double u, double v) {
      const double angle = u / radius_;
      const Vector3d away = std::cos(angle) * sideways_ + std::sin(angle) * axis_.cross(sideways_);
      return SurfaceChart::At{point_ + v * axis_ + radius_ * away, 1};
    };
    return {{-end, end, -length_ / 2, length_ / 2, at}};
  }
  [[nodiscard]] Extent extent() const override {
    return {point_, std::hypot(radius_, length_ / std::sqrt(12))};
  }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<Cylinder>(*this);
    copy->point_ += d;
    return copy;
  }

 private:
  [[nodiscard]] Vector3d from_axis(const Vector3d& p) const {
    const Vector3d x = p - point_;
    return x - axis_.dot(x) * axis_;
  }
  [[nodiscard]] Place on_cylinder(const Vector3d& p, const Vector3d& otherwise) const {
    const Vector3d away = from_axis(p);
    return {(p - away) + radius_ * unit_or(away, otherwise)};
  }

  Vector3d point_, axis_, sideways_;
  double radius_, sign_, length_;
};

class Torus final : public ExactSurface {
 public:
  Torus(const Vector3d& center, const Vector3d& axis, double major, double minor, bool solid_inside)
      : center_(center),
        axis_(checked_direction(axis, "torus: axis")),
        sideways_(axis_.unitOrthogonal()),
        major_(checked_length(major, "torus: major radius")),
        minor_(checked_length(minor, "torus: minor radius")),
        sign_(solid_inside ? 1 : -1) {
    if (minor_ < major_) return;
    throw InputError(fmt::format("torus: minor radius = {}, expected less than the major radius {}",
                                 minor, major));
  }

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    const Vector3d radial = radial_at(place.numbers, sideways_);
    const Vector3d away = unit_or(place.numbers - center_ - major_ * radial, radial),
                   round = axis_.cross(radial);
    // Curvature 1/minor round the tube, cos/(major + minor cos) round the axis, cos = away.radial.
    const double cosine = away.dot(radial);
    const double difference = 1 / minor_ - cosine / (major_ + minor_ * cosine);
    Matrix3d K = umbilic(away, sign_ / minor_);
    K += (sign_ * difference * round) * round.transpose();
    return {place.numbers, sign_ * away, K, Eigen::Matrix<double, 3, 2>::Zero()};
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Vector3d& dc) const override {
    return on_torus(place.numbers + dc, radial_at(place.numbers, sideways_), sign_ * at.n);
  }
  [[nodiscard]] Place closest(const Vector3d& p, const Place& start) const override {
    const Vector3d radial = radial_at(start.numbers, sideways_);
    return on_torus(p, radial, unit_or(start.numbers - center_ - major_ * radial, radial));
  }
  [[nodiscard]] Place seed(const Vector3d& p) const override {
    return on_torus(p, sideways_, sideways_);
  }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    return torus_samples(center_, axis_, major_, minor_, spacing);
  }
  [[nodiscard]] std::vector<SurfaceChart> charts() const override {
    const double round = major_ + minor_, pi = std::numbers::pi;
    const auto at = [*this, round](double u, double v) {
      const double angle = u / round, tilt = v / minor_;
      const Vector3d radial =
          std::cos(angle) * sideways_ + std::sin(angle) * axis_.cross(sideways_);
      const double from_axis = major_ + minor_ * std::cos(tilt);
      return SurfaceChart::At{center_ + from_axis * radial + minor_ * std::sin(tilt) * axis_,
                              from_axis / round};
    };
    return {{-pi * round, pi * round, -pi * minor_, pi * minor_, at}};
  }
  [[nodiscard]] Extent extent() const override { return {center_, std::hypot(major_, minor_)}; }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Vector3d& d) const override {
    auto copy = std::make_unique<Torus>(*this);
    copy->center_ += d;
    return copy;
  }

 private:
  [[nodiscard]] Vector3d radial_at(const Vector3d& p, const Vector3d& otherwise) const {
    const Vector3d x = p - center_;
    return unit_or(x - axis_.dot(x) * axis_, otherwise);
  }
  [[nodiscard]] Place on_torus(const Vector3d& p,
                               const Vector3d& radial_otherwise,
                               const Vector3d& away_otherwise) const {
    const Vector3d ring = center_ + major_ * radial_at(p, radial_otherwise);
    return {ring + minor_ * unit_or(p - ring, away_otherwise)};
  }

  Vector3d center_, axis_, sideways_;
  double major_, minor_, sign_;
};

}  // namespace

std::unique_ptr<Surface> make_plane(const Vector3d& point, const Vector3d& normal, double radius) {
  return std::make_unique<Plane>(point, normal, radius);
}

std::unique_ptr<Surface> make_sphere(const Vector3d& center, double radius, bool solid_inside) {
  return std::make_unique<Sphere>(center, radius, solid_inside);
}

std::unique_ptr<Surface> make_cylinder(
    const Vector3d& point, const Vector3d& axis, double radius, bool solid_inside, double length) {
  return std::make_unique<Cylinder>(point, axis, radius, solid_inside, length);
}

std::unique_ptr<Surface> make_torus(
    const Vector3d& center, const Vector3d& axis, double major, double minor, bool solid_inside) {
  return std::make_unique<Torus>(center, axis, major, minor, solid_inside);
}

}  // namespace condyle
