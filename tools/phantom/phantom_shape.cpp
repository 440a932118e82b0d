#include "phantom/phantom_shape.h"

#include <Eigen/LU>

#include "phantom/femur.h"
#include "phantom/tibia.h"

namespace condyle::phantom {

namespace {

template <class T>
T shape_of(Bone bone, const T& x, const T& y, const T& z) {
  return bone == Bone::kFemur ? femur_shape<T>(x, y, z) : tibia_shape<T>(x, y, z);
}

/// Along the gradient down to f = 0.
Eigen::Vector3d drop_onto(Bone bone, Eigen::Vector3d p) {
  for (int i = 0; i < 30; ++i) {
    const ShapeValue s = shape_derivatives(bone, p);
    const Eigen::Vector3d step = -s.f / s.g.squaredNorm() * s.g;
    p += step * std::min(1.0, 3.0 / (step.norm() + 1e-300));
    if (step.norm() < 1e-13) break;
  }
  return p;
}

}  // namespace

double shape(Bone bone, const Eigen::Vector3d& p) {
  return shape_of<double>(bone, p.x(), p.y(), p.z());
}

ShapeValue shape_derivatives(Bone bone, const Eigen::Vector3d& p) {
  const Jet f = shape_of<Jet>(bone, Jet::coordinate(p.x(), 0), Jet::coordinate(p.y(), 1),
                              Jet::coordinate(p.z(), 2));
  return {f.v, f.g, f.h};
}

Eigen::Vector3d project(Bone bone, const Eigen::Vector3d& p) {
  // Newton on c - p + λ ∇f = 0, f = 0; from where the gradient meets it.
  Eigen::Vector3d c = drop_onto(bone, p);
  double lambda = 0;
  for (int i = 0; i < 20; ++i) {
    const ShapeValue s = shape_derivatives(bone, c);
    if (i == 0) lambda = (p - c).dot(s.g) / s.g.squaredNorm();
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() + lambda * s.h;
    A.topRightCorner<3, 1>() = s.g;
    A.bottomLeftCorner<1, 3>() = s.g.transpose();
    Eigen::Vector4d r;
    r << c - p + lambda * s.g, s.f;
    const Eigen::Vector4d step = -A.partialPivLu().solve(r);
    const double size = step.head<3>().norm();
    c += step.head<3>() * std::min(1.0, 1.0 / (size + 1e-300));
    lambda += step[3];
    if (size < 1e-12) break;
  }
  return drop_onto(bone, c);
}

Eigen::Vector3d normal(Bone bone, const Eigen::Vector3d& c) {
  return shape_derivatives(bone, c).g.normalized();
}

Eigen::Matrix3d curvature(Bone bone, const Eigen::Vector3d& c) {
  const ShapeValue s = shape_derivatives(bone, c);
  const Eigen::Vector3d n = s.g.normalized();
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - n * n.transpose();
  return -(P * s.h * P) / s.g.norm();
}

SurfacePoint surface_point(Bone bone, const Eigen::Vector3d& p) {
  SurfacePoint result;
  result.c = project(bone, p);
  result.n = normal(bone, result.c);
  result.K = curvature(bone, result.c);
  result.dual.setZero();
  return result;
}

Box bounds(Bone bone) {
  if (bone == Bone::kFemur) return {{-28, -30, -46}, {48, 74, 46}};
  return {{-30, -114, -46}, {38, -6, 46}};
}

const char* bone_name(Bone bone) { return bone == Bone::kFemur ? "femur" : "tibia"; }

}  // namespace condyle::phantom
