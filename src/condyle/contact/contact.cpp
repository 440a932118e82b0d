#include "condyle/contact/contact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

constexpr double kEdgeReach = 1e-4;  // at an edge: nearer than this, in radii of curvature

/// Two unit vectors that make a right-handed triad with n, without a singular direction [Duff et
/// al. 2017].
Eigen::Matrix<double, 3, 2> tangents(const Eigen::Vector3d& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1 / (sign + n.z());
  const double b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> T;
  T << 1 + sign * n.x() * n.x() * a, b, sign * b, sign + n.y() * n.y() * a, -sign * n.x(), -n.y();
  return T;
}

/// Q = Tᵀ (K + Kr) T with its principal values and the tangent coordinates of the greatest.
struct PlaneTensor {
  double q00, q01, q11, low, high;
  [[nodiscard]] Eigen::Vector2d direction_of_high() const {
    Eigen::Vector2d e(q01, high - q00), f(high - q11, q01);
    if (f.squaredNorm() > e.squaredNorm()) e = f;
    if (e.squaredNorm() < 1e-30 * (1 + high * high)) return {1, 0};
    return e.normalized();
  }
};

PlaneTensor plane_tensor(double q00, double q01, double q11) {
  const double mean = (q00 + q11) / 2,
               spread = std::sqrt((q00 - q11) * (q00 - q11) / 4 + q01 * q01);
  return {q00, q01, q11, mean - spread, mean + spread};
}

/// The tangent along which a surface with curvature C = Tᵀ K T is straight, or `otherwise`.
Eigen::Vector2d straight_direction(const Eigen::Matrix2d& C, const Eigen::Vector2d& otherwise) {
  const PlaneTensor tensor = plane_tensor(C(0, 0), C(0, 1), C(1, 1));
  const double least = std::min(std::abs(tensor.low), std::abs(tensor.high));
  const double most = std::max(std::abs(tensor.low), std::abs(tensor.high));
  if (!(least < kFlatAtEdge * most)) return otherwise;
  const Eigen::Vector2d high = tensor.direction_of_high();
  const Eigen::Vector2d along =
      least == std::abs(tensor.high) ? high : Eigen::Vector2d(-high.y(), high.x());
  return std::abs(along.dot(otherwise)) > 0.5 ? along : otherwise;
}

/// Distances of a contact from the edges of both surfaces [mm].
struct Edges {
  double on_B, on_A;
  [[nodiscard]] bool nearer_on_A() const { return std::abs(on_A) < std::abs(on_B); }
  [[nodiscard]] double nearest() const { return std::min(std::abs(on_B), std::abs(on_A)); }
};

double inverse_unless_flat(double curvature, double flat) {
  return std::abs(curvature) < flat ? 0 : 1 / curvature;
}

#define CONDYLE_INLINE inline __attribute__((always_inline))

/// γ for a gap: at most so much of the way to a centre of curvature, where 1 - γ κ vanishes.
CONDYLE_INLINE double reachable(double gap, const Eigen::Matrix2d& C) {
  constexpr double kNearest = 0.9;
  if (gap * gap * C.squaredNorm() < kNearest * kNearest) return gap;
  const PlaneTensor tensor = plane_tensor(C(0, 0), C(0, 1), C(1, 1));
  const double part = std::max(gap * tensor.low, gap * tensor.high);
  return part > kNearest ? gap * kNearest / part : gap;
}

/// K' T of the parallel surface for K T: Tᵀ K' T = C (I - γ C)^-1 with C = Tᵀ K T.
CONDYLE_INLINE void set_across(ContactLinearization& contact) {
  const Eigen::Matrix2d C = contact.T.transpose() * contact.K_T;
  contact.across = reachable(contact.gap(), C);
  const double a = 1 - contact.across * C(0, 0), b = -contact.across * C(0, 1),
               c = -contact.across * C(1, 0), d = 1 - contact.across * C(1, 1);
  Eigen::Matrix2d inverse;
  inverse << d, -b, -c, a;
  contact.K_T = (contact.K_T * (inverse / (a * d - b * c))).eval();
}

template <bool kAcrossGap>
CONDYLE_INLINE ContactLinearization linearize(const SurfacePair& surfaces,
                                              const ContactPlaces& places,
                                              const RigidTransform& X_BA) {
  ContactLinearization contact;
  contact.B = surfaces.on_B.evaluate(places.on_B);
  contact.A = surfaces.on_A.evaluate(places.on_A);
  const Eigen::Matrix3d& R = X_BA.R;
  const Eigen::Vector3d& n = contact.B.n;
  const Eigen::Vector3d s = R * contact.A.c, m = R * contact.A.n;
  contact.s = s;
  contact.m = m;
  contact.g = X_BA.p + s - contact.B.c;
  contact.h = n + m;
  contact.arm = s.cross(n);

  contact.T = tangents(n);
  const Eigen::Matrix<double, 3, 2>& T = contact.T;
  // Tᵀ Kr and, with it, the equivalent curvature Q = Tᵀ (K + Kr) T.
  const Eigen::Matrix<double, 3, 2> RT = R.transpose() * T;
  const Eigen::Matrix<double, 3, 2> K_RT = contact.A.K * RT;
  const Eigen::Matrix<double, 3, 2> Kr_T = R * K_RT;
  contact.K_T.noalias() = contact.B.K * T;
  if constexpr (kAcrossGap) set_across(contact);
  const Eigen::Matrix<double, 3, 2>& K_T = contact.K_T;
  const double q00 = T.col(0).dot(K_T.col(0)) + RT.col(0).dot(K_RT.col(0));
  const double q01 = T.col(0).dot(K_T.col(1)) + RT.col(0).dot(K_RT.col(1));
  const double q11 = T.col(1).dot(K_T.col(1)) + RT.col(1).dot(K_RT.col(1));
  const PlaneTensor Q = plane_tensor(q00, q01, q11);
  contact.relative_curvature = {-Q.high, -Q.low};

  // P = T Q⁻¹ Tᵀ, without the directions in which the principal value vanishes.
  Eigen::Matrix2d Q_inverse;
  enum class Pinned { kNot, kToB, kToA } pinned = Pinned::kNot;
  Eigen::Vector2d along = Eigen::Vector2d::Zero();  // in tangent coordinates
  Eigen::Vector3d fixed = Eigen::Vector3d::Zero();
  const double small = std::min(std::abs(Q.high), std::abs(Q.low));
  if (small > kFlatAtEdge * std::abs(Q.low) && small > kFlatCurvature) {
    const double d = 1 / (q00 * q11 - q01 * q01);
    Q_inverse << q11 * d, -q01 * d, -q01 * d, q00 * d;
  } else {
    const Edges edges{surfaces.on_B.edge_distance(places.on_B),
                      surfaces.on_A.edge_distance(places.on_A)};
    const double at_edge = kEdgeReach / std::max(std::abs(Q.low), kFlatCurvature);
    const double flat = edges.nearest() < at_edge
                            ? std::max(kFlatCurvature, kFlatAtEdge * std::abs(Q.low))
                            : kFlatCurvature;
    const Eigen::Vector2d e = Q.direction_of_high(), f(-e.y(), e.x());
    Q_inverse = inverse_unless_flat(Q.high, flat) * e * e.transpose() +
                inverse_unless_flat(Q.low, kFlatCurvature) * f * f.transpose();
    if (std::abs(Q.high) < flat) {
      const Eigen::Matrix2d C = edges.nearer_on_A() ? T.transpose() * Kr_T : T.transpose() * K_T;
      const Eigen::Vector2d u = straight_direction(C, e);
      pinned = edges.nearer_on_A() ? Pinned::kToA : Pinned::kToB;
      along = e;
      fixed = T * u / u.dot(e);
    }
  }
  // Rows of Tᵀ Kr [s]x: (Kr t) x s transposed.
  Eigen::Matrix<double, 2, 3> to_da = Kr_T.transpose();
  Eigen::Matrix<double, 2, 3> to_dpi;
  for (int k = 0; k < 2; ++k)
    to_dpi.row(k) = (m.cross(T.col(k)) + s.cross(Kr_T.col(k))).transpose();
  Eigen::Vector2d to_0 = T.transpose() * contact.h + Kr_T.transpose() * contact.g;
  if constexpr (kAcrossGap) to_0 -= contact.across * (Kr_T.transpose() * n);
  contact.S1.noalias() = Q_inverse * to_da;
  contact.S2.noalias() = Q_inverse * to_dpi;
  contact.S0.noalias() = Q_inverse * to_0;
  if (pinned == Pinned::kNot) return contact;
  // Along the line the point moves so that, on the surface it is pinned to, u.dc = 0.
  const Eigen::RowVector2d fixed_T = fixed.transpose() * T;
  contact.S0 -= along * fixed_T.dot(contact.S0);
  contact.S1 -= (along * (fixed_T * contact.S1)).eval();
  contact.S2 -= (along * (fixed_T * contact.S2)).eval();
  if (pinned == Pinned::kToB) return contact;
  contact.S0 += along * fixed.dot(contact.g);
  contact.S1 += along * fixed.transpose();
  contact.S2 += along * s.cross(fixed).transpose();
  return contact;
}

}  // namespace

Eigen::Matrix3d ContactLinearization::D1() const { return T * S1; }
Eigen::Matrix3d ContactLinearization::D2() const { return T * S2; }
Eigen::Vector3d ContactLinearization::D0() const { return T * S0; }

CONDYLE_FMA_CLONE
ContactLinearization linearize_contact(const SurfacePair& surfaces,
                                       const ContactPlaces& places,
                                       const RigidTransform& X_BA) {
  return linearize<false>(surfaces, places, X_BA);
}

CONDYLE_FMA_CLONE
ContactLinearization linearize_across_gap(const SurfacePair& surfaces,
                                          const ContactPlaces& places,
                                          const RigidTransform& X_BA) {
  return linearize<true>(surfaces, places, X_BA);
}

Eigen::Vector3d direction_of_least_curvature(const ContactLinearization& contact,
                                             const Eigen::Matrix3d& R_BA) {
  const Eigen::Matrix<double, 3, 2> T = tangents(contact.B.n);
  const Eigen::Matrix2d Q =
      T.transpose() * (contact.B.K + R_BA * contact.A.K * R_BA.transpose()) * T;
  return T * plane_tensor(Q(0, 0), Q(0, 1), Q(1, 1)).direction_of_high();
}

CONDYLE_FMA_CLONE
void add_contact_force(const ContactLinearization& contact, double p, Wrench& wrench) {
  // dF = dp n - p K dc;  dM = (dc - g - da) x F + s x dF;  dc = T (S0 + S1 da + S2 dπ)
  const Eigen::Vector3d F = p * contact.B.n;
  const Eigen::Matrix<double, 3, 2> G = -p * contact.K_T;
  Eigen::Matrix<double, 3, 2> H;
  for (int k = 0; k < 2; ++k) H.col(k) = contact.s.cross(G.col(k)) + contact.T.col(k).cross(F);
  wrench.f += F + G * contact.S0;
  wrench.m += (contact.s - contact.g).cross(F) + H * contact.S0;
  wrench.F1.noalias() += G * contact.S1;
  wrench.F2.noalias() += G * contact.S2;
  wrench.M1.noalias() += H * contact.S1;
  wrench.M2.noalias() += H * contact.S2;
  wrench.M1 += skew(F);
}

CONDYLE_FMA_CLONE
void slide_contact(const SurfacePair& surfaces,
                   ContactPlaces& places,
                   const ContactLinearization& contact,
                   const RigidTransform& X_BA,
                   const Eigen::Vector3d& da,
                   const Eigen::Vector3d& dpi,
                   double longest_slide) {
  const Eigen::Vector2d slide = contact.S0 + contact.S1 * da + contact.S2 * dpi;
  Eigen::Vector3d dc = contact.T * slide;
  Eigen::Vector3d dc_A = dc - contact.g - da - dpi.cross(contact.s);
  if (contact.across != 0) {
    dc_A += contact.gap() * contact.B.n;
    dc += contact.across * (contact.K_T * slide);
  }
  const double longest = std::sqrt(std::max(dc.squaredNorm(), dc_A.squaredNorm()));
  if (longest > longest_slide) {
    dc *= longest_slide / longest;
    dc_A *= longest_slide / longest;
  }
  places.on_B = surfaces.on_B.moved(places.on_B, contact.B, dc);
  places.on_A = surfaces.on_A.moved(places.on_A, contact.A, X_BA.R.transpose() * dc_A);
}

}  // namespace condyle
