#include "phantom/phantom_shape.h"

#include <Eigen/LU>

#include "phantom/femur.h"
#include "phantom/tibia.h"

namespace condyle::phantom {

namespace {

using Knee = PhantomParameters;

template <class T>
T shape_of(Bone bone, const Knee& knee, const T& x, const T& y, const T& z) {
  return bone == Bone::kFemur ? femur_shape<T>(knee.femur, x, y, z)
                              : tibia_shape<T>(knee.tibia, x, y, z);
}

const Size& size_of(Bone bone, const Knee& knee) {
  return bone == Bone::kFemur ? knee.femur.size : knee.tibia.size;
}
/// S: dp/dq.
Eigen::Array3d factors(Bone bone, const Knee& knee) {
  const Size& size = size_of(bone, knee);
  return {size.depth, size.depth, size.width};
}
Eigen::Array3d shift(Bone bone, const Knee& knee) {
  return {0, bone == Bone::kFemur ? 0.0 : knee.tibia.rise, 0};
}

/// Along the gradient down to f = 0.
Eigen::Vector3d drop_onto(Bone bone, Eigen::Vector3d p, const Knee& knee) {
  for (int i = 0; i < 30; ++i) {
    const ShapeValue s = shape_derivatives(bone, p, knee);
    const Eigen::Vector3d step = -s.f / s.g.squaredNorm() * s.g;
    p += step * std::min(1.0, 3.0 / (step.norm() + 1e-300));
    if (step.norm() < 1e-13) break;
  }
  return p;
}

}  // namespace

Eigen::Vector3d sized(Bone bone, const Eigen::Vector3d& q, const Knee& knee) {
  return factors(bone, knee) * q.array() + shift(bone, knee);
}
Eigen::Vector3d unsized(Bone bone, const Eigen::Vector3d& p, const Knee& knee) {
  return (p.array() - shift(bone, knee)) / factors(bone, knee);
}

double shape(Bone bone, const Eigen::Vector3d& p, const Knee& knee) {
  const Eigen::Vector3d q = unsized(bone, p, knee);
  return size_of(bone, knee).depth * shape_of<double>(bone, knee, q.x(), q.y(), q.z());
}

ShapeValue shape_derivatives(Bone bone, const Eigen::Vector3d& p, const Knee& knee) {
  const Eigen::Vector3d q = unsized(bone, p, knee);
  const Jet f = shape_of<Jet>(bone, knee, Jet::coordinate(q.x(), 0), Jet::coordinate(q.y(), 1),
                              Jet::coordinate(q.z(), 2));
  const double depth = size_of(bone, knee).depth;
  const Eigen::Vector3d by = factors(bone, knee).inverse();
  return {depth * f.v, depth * by.cwiseProduct(f.g),
          depth * (by.asDiagonal() * f.h * by.asDiagonal()).eval()};
}

Eigen::Vector3d project(Bone bone, const Eigen::Vector3d& p, const Knee& knee) {
  // Newton on c - p + λ ∇f = 0, f = 0; from where the gradient meets it.
  Eigen::Vector3d c = drop_onto(bone, p, knee);
  double lambda = 0;
  for (int i = 0; i < 20; ++i) {
    const ShapeValue s = shape_derivatives(bone, c, knee);
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
  return drop_onto(bone, c, knee);
}

Eigen::Vector3d normal(Bone bone, const Eigen::Vector3d& c, const Knee& knee) {
  return shape_derivatives(bone, c, knee).g.normalized();
}

Eigen::Matrix3d curvature(Bone bone, const Eigen::Vector3d& c, const Knee& knee) {
  const ShapeValue s = shape_derivatives(bone, c, knee);
  const Eigen::Vector3d n = s.g.normalized();
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - n * n.transpose();
  return -(P * s.h * P) / s.g.norm();
}

SurfacePoint surface_point(Bone bone, const Eigen::Vector3d& p, const Knee& knee) {
  SurfacePoint result;
  result.c = project(bone, p, knee);
  result.n = normal(bone, result.c, knee);
  result.K = curvature(bone, result.c, knee);
  result.dual.setZero();
  return result;
}

Box bounds(Bone bone, const Knee& knee) {
  const Box box = bone == Bone::kFemur ? Box{{-28, -30, -46}, {48, 74, 46}}
                                       : Box{{-30, -114, -46}, {38, -6, 46}};
  return {sized(bone, box.low, knee), sized(bone, box.high, knee)};
}

const char* bone_name(Bone bone) { return bone == Bone::kFemur ? "femur" : "tibia"; }

}  // namespace condyle::phantom
