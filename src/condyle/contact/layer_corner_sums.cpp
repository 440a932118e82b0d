#include "condyle/contact/layer_corner_sums.h"

#include "condyle/math/simd.h"

namespace condyle {
namespace {

inline __attribute__((always_inline)) void transpose(Four* a) {
  const Four even_01 = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6),
             odd_01 = __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7),
             even_23 = __builtin_shufflevector(a[2], a[3], 0, 4, 2, 6),
             odd_23 = __builtin_shufflevector(a[2], a[3], 1, 5, 3, 7);
  a[0] = __builtin_shufflevector(even_01, even_23, 0, 1, 4, 5);
  a[1] = __builtin_shufflevector(odd_01, odd_23, 0, 1, 4, 5);
  a[2] = __builtin_shufflevector(even_01, even_23, 2, 3, 6, 7);
  a[3] = __builtin_shufflevector(odd_01, odd_23, 2, 3, 6, 7);
}

/// Adds what each closest point of a packet says of a corner beside it.
CONDYLE_FMA_CLONE
void tell_corners(const LayerPacket& packet,
                  const RigidTransform& X,
                  const std::uint32_t* index,
                  const LayerCorners::Point* corners,
                  LayerCornerSums::Told* told) {
  const FourClosestPoints& closest = packet.closest;
  const double* R = X.R.data();  // column by column
  Four x[4], v[3], H[6], sums[8];
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k) x[k] = load_four(corners[index[k]].x_area);
  transpose(x);
  CONDYLE_UNROLL
  for (int i = 0; i < 6; ++i) H[i] = load_four(closest.H[i]);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i)
    v[i] = R[i] * x[0] + R[3 + i] * x[1] + R[6 + i] * x[2] +
           (X.p.data()[i] - load_four(closest.at[i]));
  sums[4] = H[0] * v[0] + H[1] * v[1] + H[2] * v[2];
  sums[5] = H[1] * v[0] + H[3] * v[1] + H[4] * v[2];
  sums[6] = H[2] * v[0] + H[4] * v[1] + H[5] * v[2];
  sums[7] = Four{1, 1, 1, 1};
  sums[0] = load_four(closest.phi);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    sums[1 + i] = load_four(closest.n[i]);
    sums[0] += v[i] * (sums[1 + i] + 0.5 * sums[4 + i]);
  }
  transpose(sums);
  transpose(sums + 4);
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k) {
    LayerCornerSums::Told& corner = told[index[k]];
    store_four(corner.phi_n, load_four(corner.phi_n) + sums[k]);
    store_four(corner.turn_count, load_four(corner.turn_count) + sums[4 + k]);
  }
}

/// Σ w p and Σ w p n, four corners beside each other.
struct alignas(32) FourSums {
  double force[4] = {};
  FourPoints along_n = {};
};

/// Adds what four corners carry, and forgets what was told of them.
CONDYLE_FMA_CLONE
void add_corners(const std::uint32_t* index,
                 const RigidTransform& X,
                 const LayerLaw& law,
                 const LayerCorners::Point* corners,
                 LayerCornerSums::Told* told,
                 FourSums& sums) {
  const double* R = X.R.data();  // column by column
  const Four none = {}, all = {4, 4, 4, 4}, half = {0.5, 0.5, 0.5, 0.5}, one = {1, 1, 1, 1};
  Four phi_n[4], turn_count[4], m[4], area;
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k) {
    LayerCornerSums::Told& corner = told[index[k]];
    phi_n[k] = load_four(corner.phi_n);
    turn_count[k] = load_four(corner.turn_count);
    store_four(corner.phi_n, none);
    store_four(corner.turn_count, none);
    m[k] = load_four(corners[index[k]].n);
    area[k] = corners[index[k]].x_area[3];
  }
  transpose(phi_n);
  transpose(turn_count);
  transpose(m);
  // Between four points a cubic has the mean of their normals and half of the turns.
  const Four share = turn_count[3] == all ? half : one, inverse = 1 / turn_count[3];
  Four n[3], cosine = none;
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    n[i] = (phi_n[1 + i] + share * turn_count[i]) * inverse;
    cosine += n[i] * (R[i] * m[0] + R[3 + i] * m[1] + R[6 + i] * m[2]);
  }
  const auto pressed = (phi_n[0] < 0) & (cosine < kOpposed);
  const Four depth = pressed ? -phi_n[0] * inverse : none;
  Four pressure;
  if (law.is_linear()) {
    pressure = law.stiffness() * depth;
  } else {
    for (int k = 0; k < 4; ++k) pressure[k] = law.at(depth[k]).pressure;
  }
  const Four force = area * pressure;
  store_four(sums.force, load_four(sums.force) + force);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    const Four along = pressed ? force * n[i] : none;
    store_four(sums.along_n[i], load_four(sums.along_n[i]) + along);
  }
}

double total(const double* x) { return (x[0] + x[1]) + (x[2] + x[3]); }

}  // namespace

CornerForce LayerCornerSums::force(const LayerPackets& packets,
                                   const RigidTransform& X,
                                   const LayerLaw& law,
                                   const LayerCorners& corners) {
  const std::uint32_t none = corners.none();
  told_.resize(none + 1);
  touched_.resize(none + 4);
  std::size_t touched = 0;
  for (std::size_t p = 0; p < packets.size(); ++p) {
    const LayerPacket& packet = packets[p];
    for (std::size_t direction = 0; direction < 4; ++direction) {
      std::uint32_t index[4];
      for (int k = 0; k < 4; ++k) {
        // Of one direction no two points of a packet have the same.
        const std::uint32_t corner = corners.of_cell[packet.point[k]][direction];
        index[k] = packet.pressed[k] > 0 ? corner : none;
        touched_[touched] = index[k];
        touched += told_[index[k]].turn_count[3] == 0 && index[k] != none ? 1 : 0;
      }
      tell_corners(packet, X, index, corners.points.data(), told_.data());
    }
  }
  told_[none] = {};
  for (std::size_t k = 0; k < 3; ++k) touched_[touched + k] = none;
  FourSums sums;
  for (std::size_t i = 0; i < touched; i += 4)
    add_corners(&touched_[i], X, law, corners.points.data(), told_.data(), sums);
  return {total(sums.force),
          {total(sums.along_n[0]), total(sums.along_n[1]), total(sums.along_n[2])}};
}

}  // namespace condyle
