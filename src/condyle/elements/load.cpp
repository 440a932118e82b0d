#include "condyle/elements/load.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

void add_custom(const Load& load, double scale, const RigidTransform& X_BA, Wrench& wrench) {
  Wrench own;
  load.custom(X_BA, own);
  wrench.f += scale * own.f;
  wrench.m += scale * own.m;
  wrench.F1 += scale * own.F1;
  wrench.F2 += scale * own.F2;
  wrench.M1 += scale * own.M1;
  wrench.M2 += scale * own.M2;
}

void add_moment(const Eigen::Vector3d& m, bool follows_body, Wrench& wrench) {
  wrench.m += m;
  if (follows_body) wrench.M2 -= skew(m);  // dm = dπ x m
}

void add_force(const Eigen::Vector3d& f,
               const Eigen::Vector3d& q,
               bool follows_body,
               Wrench& wrench) {
  wrench.f += f;
  add_moment(q.cross(f), follows_body, wrench);
  if (follows_body) {
    wrench.F2 -= skew(f);  // df = dπ x f, and the moment q x f turns with the body too
  } else {
    wrench.M2.noalias() += q * f.transpose();  // dm = (dπ x q) x f = (q fᵀ - (q.f) I) dπ
    wrench.M2.diagonal().array() -= q.dot(f);
  }
}

}  // namespace

void add_load(const Load& load, double scale, const RigidTransform& X_BA, Wrench& wrench) {
  if (load.custom) return add_custom(load, scale, X_BA, wrench);
  Eigen::Vector3d vector = scale * load.vector;
  if (load.follows_body) vector = X_BA.R * vector;
  if (load.moment) {
    add_moment(vector, load.follows_body, wrench);
  } else {
    add_force(vector, X_BA.R * load.at, load.follows_body, wrench);
  }
}

}  // namespace condyle
