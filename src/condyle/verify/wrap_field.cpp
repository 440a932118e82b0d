#include "condyle/verify/wrap_field.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "condyle/verify/parts.h"

namespace condyle::verification {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// f = xᵀDx - 1 with f made a length near the surface by a factor.
Field quadric(const Vector3d& d, double factor, const Vector3d& x) {
  Field field;
  field.f = factor * (x.dot(d.cwiseProduct(x)) - 1);
  field.gradient = 2 * factor * d.cwiseProduct(x);
  field.hessian = (2 * factor * d).asDiagonal();
  return field;
}

/// f = √((√(x² + y²) - R)² + z²) - r.
Field torus(double ring, double tube, const Vector3d& x) {
  const double rho = std::hypot(x.x(), x.y());
  const Vector3d out(x.x() / rho, x.y() / rho, 0), round(-out.y(), out.x(), 0);
  const Vector3d from_ring = (rho - ring) * out + x.z() * Vector3d::UnitZ();
  const double distance = from_ring.norm();
  const Vector3d n = from_ring / distance, along = n.cross(round);
  Field field;
  field.f = distance - tube;
  field.gradient = n;
  field.hessian =
      along * along.transpose() / distance + round * round.transpose() * n.dot(out) / rho;
  return field;
}

}  // namespace

double least_radius(const WrapShape& shape) {
  struct Least {
    double operator()(const WrapSphere& s) const { return s.radius; }
    double operator()(const WrapCylinder& s) const { return s.radius; }
    double operator()(const WrapEllipsoid& s) const {
      const double least = s.semi_axes.minCoeff();
      return least * least / s.semi_axes.maxCoeff();
    }
    double operator()(const WrapTorus& s) const { return std::min(s.tube, s.ring - s.tube); }
  };
  return std::visit(Least{}, shape);
}

Field field_at(const WrapShape& shape, double larger, const Vector3d& x) {
  struct At {
    const Vector3d& x;
    double larger;
    Field operator()(const WrapSphere& s) const {
      const double r = s.radius + larger;
      return quadric(Vector3d::Constant(1 / (r * r)), r / 2, x);
    }
    Field operator()(const WrapCylinder& s) const {
      const double r = s.radius + larger;
      return quadric({1 / (r * r), 1 / (r * r), 0}, r / 2, x);
    }
    Field operator()(const WrapEllipsoid& s) const {
      const Vector3d a = s.semi_axes + Vector3d::Constant(larger);
      return quadric(a.cwiseAbs2().cwiseInverse(), a.minCoeff() / 2, x);
    }
    Field operator()(const WrapTorus& s) const { return torus(s.ring, s.tube + larger, x); }
  };
  return std::visit(At{x, larger}, shape);
}

/// Newton on y + λ ∇f(y) = x, f(y) = 0.
Vector3d closest_on(const WrapShape& shape, double larger, const Vector3d& x) {
  constexpr int kRounds = 50;
  Vector3d y = x;
  double lambda = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Field at = field_at(shape, larger, y);
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    matrix.topLeftCorner<3, 3>() = Matrix3d::Identity() + lambda * at.hessian;
    matrix.topRightCorner<3, 1>() = at.gradient;
    matrix.bottomLeftCorner<1, 3>() = at.gradient.transpose();
    Eigen::Vector4d rest;
    rest << x - y - lambda * at.gradient, -at.f;
    const Eigen::Vector4d step = matrix.partialPivLu().solve(rest);
    y += step.head<3>();
    lambda += step[3];
    if (step.head<3>().norm() < 1e-13 * (1 + y.norm())) break;
  }
  return y;
}

/// x'' = -(tᵀ ∇∇f t) ∇f/|∇f|², by the classical Runge-Kutta method in steps of a hundredth of the
/// least radius.
void follow_geodesic(
    const WrapShape& shape, double larger, double length, Vector3d& x, Vector3d& t) {
  const int steps = parts_of(100 * std::abs(length) / least_radius(shape), 200, 20000);
  const double h = length / steps;
  const auto bend = [&](const Vector3d& at, const Vector3d& along) {
    const Field field = field_at(shape, larger, at);
    return Vector3d(-along.dot(field.hessian * along) / field.gradient.squaredNorm() *
                    field.gradient);
  };
  for (int step = 0; step < steps; ++step) {
    const Vector3d x1 = t, t1 = bend(x, t);
    const Vector3d x2 = t + h / 2 * t1, t2 = bend(x + h / 2 * x1, x2);
    const Vector3d x3 = t + h / 2 * t2, t3 = bend(x + h / 2 * x2, x3);
    const Vector3d x4 = t + h * t3, t4 = bend(x + h * x3, x4);
    x += h / 6 * (x1 + 2 * x2 + 2 * x3 + x4);
    t += h / 6 * (t1 + 2 * t2 + 2 * t3 + t4);
  }
}

}  // namespace condyle::verification
