#pragma once

/// The equations of the quadric knee (tests/support/quadric_knee.h) written down a second time and
/// in another way: implicit surfaces, nothing condensed, for numbers of any kind. The truth of the
/// study is their solution in long double; the peers solve them as they are.
///
/// Unknowns (17): translation a [mm], Cayley vector g of a rotation added to R0, multiplier of the
/// flexion, and for each contact its point c on the femur, the ratio μ of the normals and its
/// force. Equations: forces, moments/L, L (flexion - value); per contact φ_B(c) = 0, φ_A(Rᵀ(c - a))
/// = 0 and n_B + μ R ∇φ_A = 0.

#include <Eigen/Geometry>

#include <array>
#include <cmath>

#include "condyle/elements/force_law.h"
#include "condyle/equilibrium/model.h"
#include "condyle/equilibrium/newton.h"
#include "support/quadric_knee.h"

namespace condyle::accuracy {

inline constexpr int kUnknowns = 17;

template <class T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Mat3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Unknowns = Eigen::Matrix<T, kUnknowns, 1>;

/// An ellipsoidal condyle on the femur, and a cup or a plane on the tibia.
struct Compartment {
  Eigen::Vector3d center;
  Eigen::Matrix3d axes;
  Eigen::Vector3d semi_axes;
  bool cup;
  Eigen::Vector3d at, normal;  ///< the cup's centre; the plane's point and its normal
  double radius;
};

inline std::array<Compartment, 2> compartments() {
  return {
      {{{-23, -2, 0}, exp_rotation({0.05, -0.03, 0.08}), {19, 26, 24}, true, {-23, -4, 21}, {}, 45},
       {{23, -2, 0},
        exp_rotation({-0.04, 0.02, -0.06}),
        {18, 25, 23},
        false,
        {23, -2, -23.5},
        Eigen::Vector3d(0.03, -0.07, 1).normalized(),
        0}}};
}

/// I + 4/(4 + g²) ([g]x + [g]x²/2): a rotation about g by 2 atan(|g|/2).
template <class T>
Mat3<T> cayley(const Vec3<T>& g) {
  Mat3<T> S;
  S << T(0), -g[2], g[1], g[2], T(0), -g[0], -g[1], g[0], T(0);
  return Mat3<T>::Identity() + (S + S * S * T(0.5)) * (T(4) / (T(4) + g.squaredNorm()));
}

struct KneeEquations {
  Model model = test::quadric_knee();
  std::array<Compartment, 2> surfaces = compartments();
  Eigen::Matrix<long double, 3, 3> R0 = Eigen::Matrix<long double, 3, 3>::Identity();
  double flexion = 0;  ///< [rad]

  /// Of a ligament of that length.
  template <class T>
  static T tension(const LineElement& element, const T& length) {
    const auto& law = std::get<ToeLinearLaw>(element.law);
    const T strain = length / T(law.slack_length) - T(1);
    if (!(strain > T(0))) return T(0);
    const T transition(law.transition_strain), k(law.stiffness);
    return strain < transition ? k * strain * strain / (T(2) * transition)
                               : k * (strain - transition / T(2));
  }

  template <class T>
  void add_ligaments(const Vec3<T>& a, const Mat3<T>& R, Vec3<T>& f, Vec3<T>& m) const {
    using std::sqrt;
    for (const LineElement& element : model.elements) {
      const Vec3<T> s = R * element.s_D.template cast<T>();
      const Vec3<T> d = a + s - element.x_C.template cast<T>();
      const T length = sqrt(d.squaredNorm()), force = tension(element, length);
      if (!(force > T(0))) continue;
      const Vec3<T> F = d * (-force / length);
      f += F;
      m += s.cross(F);
    }
  }

  template <class T>
  [[nodiscard]] Unknowns<T> residual(const Unknowns<T>& x) const {
    using std::atan2;
    using std::sqrt;
    const T L(model.length);
    const Vec3<T> a = x.template segment<3>(0), turn = x.template segment<3>(3);
    const Mat3<T> R = cayley<T>(turn) * R0.template cast<T>();
    const Load& load = model.loads[0];
    Vec3<T> f = R * load.vector.template cast<T>();
    Vec3<T> m = (R * load.at.template cast<T>()).cross(f);
    add_ligaments<T>(a, R, f, m);
    const T &y = R(1, 2), &z = R(2, 2);
    const Vec3<T> k(R(0, 2), y, z), J(T(0), T(1), T(0)), K(T(0), T(0), T(1));
    m -= x[6] * (z * k.cross(J) - y * k.cross(K)) / (y * y + z * z);
    Unknowns<T> r;
    for (int i = 0; i < 2; ++i) {
      const Compartment& s = surfaces[static_cast<std::size_t>(i)];
      const int at = 7 + 5 * i;
      const Vec3<T> c = x.template segment<3>(at);
      const Mat3<T> Q = s.axes.template cast<T>();
      const Vec3<T> size = s.semi_axes.template cast<T>();
      const Vec3<T> local = Q.transpose() * (c - s.center.template cast<T>());
      const Vec3<T> ratio = local.cwiseQuotient(size);
      Vec3<T> n = Q * ratio.cwiseQuotient(size);
      n /= sqrt(n.squaredNorm());
      const Vec3<T> on_A = R.transpose() * (c - a) - s.at.template cast<T>();
      Vec3<T> grad;
      T outside;
      if (s.cup) {
        grad = on_A / T(-s.radius);
        outside = (on_A.squaredNorm() - T(s.radius) * T(s.radius)) / T(2 * s.radius);
      } else {
        grad = s.normal.template cast<T>();
        outside = grad.dot(on_A);
      }
      const Vec3<T> F = n * x[at + 4];
      f += F;
      m += (c - a).cross(F);
      r[at] = (ratio.squaredNorm() - T(1)) * L;
      r[at + 1] = outside;
      r.template segment<3>(at + 2) = (n + x[at + 3] * (R * grad)) * L;
    }
    r.template segment<3>(0) = f;
    r.template segment<3>(3) = m / L;
    r[6] = (atan2(y, z) - T(flexion)) * L;
    return r;
  }
};

}  // namespace condyle::accuracy
