#include "condyle/contact/layer_moments.h"

#include "condyle/math/rotation.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// As LayerMoments, of each of the four points of packets on its own; the symmetric ones as xx, xy,
/// xz, yy, yz, zz.
struct alignas(32) FourMoments {
  double force[4] = {}, f[3][4] = {}, s_f[3][3][4] = {}, G[6][4] = {}, S_G[3][3][4] = {},
         S_G_S[6][4] = {};
};

inline __attribute__((always_inline)) void add(double* sum, const Four& x) {
  store_four(sum, load_four(sum) + x);
}

/// With the forces w p and stiffnesses w W'' of the points.
inline __attribute__((always_inline)) void add_packet(const LayerPacket& packet,
                                                      const double* origin,
                                                      const Four& wp,
                                                      const Four& wk,
                                                      FourMoments& sums) {
  const Four none = {};
  // Of those that are not pressed nothing may be a number.
  const auto pressed = load_four(packet.pressed) > 0;
  Four s[3], n[3], G[3][3], SG[3][3];
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    s[i] = load_four(packet.p[i]) - origin[i];
    n[i] = pressed ? load_four(packet.n[i]) : none;
  }
  CONDYLE_UNROLL
  for (int i = 0, ij = 0; i < 3; ++i) {
    const Four pull = wk * n[i];
    CONDYLE_UNROLL
    for (int j = i; j < 3; ++j, ++ij) {
      const Four H = pressed ? load_four(packet.closest.H[ij]) : none;
      G[i][j] = G[j][i] = wp * H - pull * n[j];
      add(sums.G[ij], G[i][j]);
    }
  }
  add(sums.force, wp);
  CONDYLE_UNROLL
  for (int j = 0; j < 3; ++j) {
    SG[0][j] = s[1] * G[2][j] - s[2] * G[1][j];
    SG[1][j] = s[2] * G[0][j] - s[0] * G[2][j];
    SG[2][j] = s[0] * G[1][j] - s[1] * G[0][j];
    const Four f = wp * n[j];
    add(sums.f[j], f);
    CONDYLE_UNROLL
    for (int i = 0; i < 3; ++i) {
      add(sums.s_f[i][j], s[i] * f);
      add(sums.S_G[i][j], SG[i][j]);
    }
  }
  // The rows of [s]x G times [s]x.
  add(sums.S_G_S[0], SG[0][1] * s[2] - SG[0][2] * s[1]);
  add(sums.S_G_S[1], SG[0][2] * s[0] - SG[0][0] * s[2]);
  add(sums.S_G_S[2], SG[0][0] * s[1] - SG[0][1] * s[0]);
  add(sums.S_G_S[3], SG[1][2] * s[0] - SG[1][0] * s[2]);
  add(sums.S_G_S[4], SG[1][0] * s[1] - SG[1][1] * s[0]);
  add(sums.S_G_S[5], SG[2][0] * s[1] - SG[2][1] * s[0]);
}

CONDYLE_FMA_CLONE
void add_packets(const LayerPackets& packets,
                 const LayerLaw& law,
                 double share,
                 const double* origin,
                 FourMoments& sums) {
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const LayerPacket& packet = packets[i];
    const auto pressed = load_four(packet.pressed) > 0;
    const Four none = {}, w = share * load_four(packet.area),
               depth = pressed ? -load_four(packet.phi) : none;
    Four pressure, stiffness;
    if (law.is_linear()) {
      pressure = law.stiffness() * depth;
      stiffness = law.stiffness() * load_four(packet.pressed);
    } else {
      for (int k = 0; k < 4; ++k) {
        const LayerLaw::Answer answer = law.at(depth[k]);
        pressure[k] = answer.pressure;
        stiffness[k] = answer.stiffness;
      }
    }
    add_packet(packet, origin, w * pressure, w * stiffness, sums);
  }
}

double total(const double* x) { return (x[0] + x[1]) + (x[2] + x[3]); }

LayerMoments total(const FourMoments& four) {
  LayerMoments sums;
  sums.force = total(four.force);
  for (int i = 0, ij = 0; i < 3; ++i) {
    sums.f[i] = total(four.f[i]);
    for (int j = 0; j < 3; ++j) {
      sums.s_f(i, j) = total(four.s_f[i][j]);
      sums.S_G(i, j) = total(four.S_G[i][j]);
    }
    for (int j = i; j < 3; ++j, ++ij) {
      sums.G(i, j) = sums.G(j, i) = total(four.G[ij]);
      sums.S_G_S(i, j) = sums.S_G_S(j, i) = total(four.S_G_S[ij]);
    }
  }
  return sums;
}

Vector3d axis_of(const Matrix3d& s_f) {
  return {s_f(1, 2) - s_f(2, 1), s_f(2, 0) - s_f(0, 2), s_f(0, 1) - s_f(1, 0)};
}

}  // namespace

LayerMoments layer_moments(const LayerPackets& packets,
                           const LayerLaw& law,
                           double share,
                           const Vector3d& origin) {
  FourMoments sums;
  add_packets(packets, law, share, origin.data(), sums);
  return total(sums);
}

void add_to_wrench_of_A(const LayerMoments& sums, Wrench& wrench) {
  wrench.f += sums.f;
  wrench.m += axis_of(sums.s_f);
  wrench.F1 += sums.G;
  wrench.F2 += sums.S_G.transpose();  // -G S, G being symmetric
  wrench.M1 += sums.S_G;
  wrench.M2 += sums.s_f - sums.s_f.trace() * Matrix3d::Identity() - sums.S_G_S;
}

// f = -p n.
void add_to_wrench_of_B(const LayerMoments& sums, const Matrix3d& R, Wrench& wrench) {
  const Vector3d f = -(R * sums.f);
  const Matrix3d s_f = -(R * sums.s_f * R.transpose()), G = R * sums.G * R.transpose(),
                 S_G = R * sums.S_G * R.transpose(), S_G_S = R * sums.S_G_S * R.transpose(),
                 f_x = skew(f);
  wrench.f += f;
  wrench.m += axis_of(s_f);
  wrench.F1 += G;
  wrench.F2 += S_G.transpose() - f_x;
  wrench.M1 += S_G + f_x;
  wrench.M2 -= S_G_S + s_f.transpose() - s_f.trace() * Matrix3d::Identity();
}

}  // namespace condyle
