#include "condyle/contact/layer_packets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/math/simd.h"
#include "condyle/math/simd_sqrt.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Longest last step to the closest points of points that nothing is known of [mm].
constexpr double kFound = 1e-7;

/// Packets that are farther off are no candidates for poses within this way of where they were
/// chosen [mm].
constexpr double kMargin = 0.02;

/// A closest point is followed so far [mm], else begun from that of a point beside it.
constexpr double kFollowed = 2;

constexpr long kMade = 8;  // points of surfaces that are looked at while a packet is made, about

/// How far closest points are relied on.
struct Reliance {
  double still;     ///< points that have moved by less are told from there [mm]
  double followed;  ///< longest last step to a closest point that is known from before [mm]
};

/// Told points have φ and n by their derivatives, with errors of `still` cubed and squared over
/// radii of curvature; the curvatures of those that were followed are wrong by `followed` over them.
Reliance reliance(LayerCare care) {
  return care == LayerCare::kExact ? Reliance{1e-5, 3e-6} : Reliance{0.02, 4e-3};
}

void set_point(const Vector3d& x, int k, FourPoints& points) {
  for (int i = 0; i < 3; ++i) points[i][k] = x[i];
}

Vector3d point_of(const FourPoints& points, int k) {
  return {points[0][k], points[1][k], points[2][k]};
}

inline __attribute__((always_inline)) void turn(const RigidTransform& X,
                                                const FourPoints& x,
                                                Four* out) {
  const double* R = X.R.data();  // column by column
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i)
    out[i] = R[i] * load_four(x[0]) + R[3 + i] * load_four(x[1]) + R[6 + i] * load_four(x[2]);
}

inline __attribute__((always_inline)) void place(const RigidTransform& X,
                                                 const FourPoints& x,
                                                 Four* out) {
  turn(X, x, out);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) out[i] += X.p.data()[i];
}

inline __attribute__((always_inline)) bool all(const auto& mask) {
  return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
}

enum class Told { kClear, kPressed, kUnknown };

/// What closest points say of the points of a packet at X.
CONDYLE_FMA_CLONE
Told tell(const RigidTransform& X, const Reliance& rely, LayerPacket& packet) {
  const FourClosestPoints& closest = packet.closest;
  Four p[3], v[3], n[3], Hv[3], facing[3];
  place(X, packet.x, p);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    store_four(packet.p[i], p[i]);
    v[i] = p[i] - load_four(closest.at[i]);
    n[i] = load_four(closest.n[i]);
  }
  if (!closest.known()) return Told::kUnknown;
  const Four phi = load_four(closest.phi), way = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const auto clear = (phi > 0) & (way < phi * phi);
  if (all(clear)) return Told::kClear;
  if (!all(clear | ((way < rely.still * rely.still) & (load_four(closest.step) <= rely.followed))))
    return Told::kUnknown;
  const Four xx = load_four(closest.H[0]), xy = load_four(closest.H[1]),
             xz = load_four(closest.H[2]), yy = load_four(closest.H[3]),
             yz = load_four(closest.H[4]), zz = load_four(closest.H[5]);
  Hv[0] = xx * v[0] + xy * v[1] + xz * v[2];
  Hv[1] = xy * v[0] + yy * v[1] + yz * v[2];
  Hv[2] = xz * v[0] + yz * v[1] + zz * v[2];
  turn(X, packet.normal, facing);
  Four now = phi, cosine = {};
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    now += v[i] * (n[i] + 0.5 * Hv[i]);
    n[i] += Hv[i];
    cosine += n[i] * facing[i];
    store_four(packet.n[i], n[i]);
  }
  store_four(packet.phi, now);
  const auto pressed = ~clear & (now < 0) & (cosine < kOpposed) & (load_four(packet.area) > 0);
  const Four one = {1, 1, 1, 1}, none = {};
  store_four(packet.pressed, pressed ? one : none);
  return (pressed[0] | pressed[1] | pressed[2] | pressed[3]) != 0 ? Told::kPressed : Told::kClear;
}

/// Of a point since its closest point was found [mm].
double way(const LayerPacket& packet, int k) {
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const double v = packet.p[i][k] - packet.closest.at[i][k];
    square += v * v;
  }
  return square > 0 ? std::sqrt(square) : 0;
}

/// Bits of the points that may be pressed, or have come near.
unsigned not_clear(const LayerPacket& packet) {
  unsigned bits = 0;
  for (int k = 0; k < 4; ++k)
    if (!(packet.closest.phi[k] > 0 && way(packet, k) < packet.closest.phi[k])) bits |= 1U << k;
  return bits;
}

/// May blocks hold points that are pressed? Bits of those that do, and of those of which it cannot
/// be said from where their closest points were found.
struct Near {
  unsigned near, unknown;
};

CONDYLE_FMA_CLONE
Near near_from(const FourPoints& center,
               const double* radius,
               double margin,
               const FourClosestPoints& closest) {
  constexpr double kSurely = 0.75;
  Four way = {}, along = {};
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) {
    const Four v = load_four(center[i]) - load_four(closest.at[i]);
    way += v * v;
    along += v * load_four(closest.n[i]);
  }
  const Four r = load_four(radius) + margin, phi = load_four(closest.phi), rest = phi - r;
  const auto clear = (rest > 0) & (way < rest * rest);
  // Of what is near closest points are followed, so those are to be of a place not far away.
  const auto surely =
      ((phi + sqrt_four(way) <= r) | (phi + along < kSurely * r)) & (way < kFollowed * kFollowed);
  Near all{0, 0};
  CONDYLE_UNROLL
  for (int k = 0; k < 4; ++k) {
    if (clear[k] != 0) continue;
    (surely[k] != 0 ? all.near : all.unknown) |= 1U << k;
  }
  return all;
}

CONDYLE_FMA_CLONE
void place_all(const RigidTransform& X, const FourPoints& x, FourPoints& out) {
  Four p[3];
  place(X, x, p);
  CONDYLE_UNROLL
  for (int i = 0; i < 3; ++i) store_four(out[i], p[i]);
}

}  // namespace

LayerPackets::LayerPackets(const LayerLattice& points, const LayerClosestPoints& find)
    : lattice_(points), find_(find) {
  for (std::size_t b = 0; b < points.blocks.size(); ++b) {
    const LayerBlock& block = points.blocks[b];
    most_ += (block.count + 3) / 4;
    for (int k = static_cast<int>(b % 4); k < 4; ++k) {
      if (b % 4 == 0 && k == 0) blocks_.emplace_back();
      BlockPacket& four = blocks_.back();
      set_point(block.center, k, four.center);
      four.radius[k] = block.radius;
      four.first[k] = k == static_cast<int>(b % 4) ? kNotMade : 0;
      four.end[k] = 0;
    }
  }
  packets_.reserve(most_);
  bounds_.reserve(most_);
  pressed_.reserve(most_);
  candidates_.reserve(most_);
  for (const Vector3d& x : points.x) center_ += x / static_cast<double>(points.x.size());
  for (const Vector3d& x : points.x) reach_ = std::max(reach_, (x - center_).norm());
}

/// There is room for the packets of all blocks, of which most never come near.
void LayerPackets::make(const LayerBlock& block, std::uint32_t& first, std::uint32_t& end) {
  first = static_cast<std::uint32_t>(packets_.size());
  for (std::size_t i = 0; i < block.count; ++i) {
    if (i % 4 == 0) packets_.emplace_back();
    LayerPacket& packet = packets_.back();
    const std::size_t point = block.first + i;
    for (int k = static_cast<int>(i % 4); k < 4; ++k) {
      set_point(lattice_.x[point], k, packet.x);
      set_point(lattice_.n[point], k, packet.normal);
      packet.area[k] = k == static_cast<int>(i % 4) ? lattice_.area[point] : 0;
      packet.point[k] = static_cast<std::uint32_t>(point);
    }
  }
  end = static_cast<std::uint32_t>(packets_.size());
  for (std::uint32_t i = first; i < end; ++i) {
    Bound bound;
    for (int k = 0; k < 4; ++k) bound.center += 0.25 * point_of(packets_[i].x, k);
    for (int k = 0; k < 4; ++k)
      bound.radius = std::max(bound.radius, (point_of(packets_[i].x, k) - bound.center).norm());
    bounds_.push_back(bound);
  }
}

void LayerPackets::reset() {
  for (BlockPacket& blocks : blocks_) blocks.closest = {};
  for (LayerPacket& packet : packets_) packet.closest = {};
  is_charged_ = false;
  for (Bound& bound : bounds_) bound.known = false;
  X_ = {};
  turned_ = 0;
  is_at_ = has_candidates_ = false;
}

/// Bits of the blocks that may hold points nearer than `margin`.
unsigned LayerPackets::near(BlockPacket& blocks, const RigidTransform& X, double margin) {
  alignas(32) FourPoints center;
  place_all(X, blocks.center, center);
  Near found{0, 15};
  if (blocks.closest.known()) {
    found = near_from(center, blocks.radius, margin, blocks.closest);
    if (found.unknown == 0) return found.near;
    looked_at_ += find_.find(center, blocks.closest, kFound, blocks.closest, found.unknown);
  } else {
    looked_at_ += find_.find_anew(center, blocks.closest);
  }
  unsigned near = found.near;
  for (int k = 0; k < 4; ++k)
    if ((found.unknown >> k & 1U) != 0 && !(blocks.closest.phi[k] > blocks.radius[k] + margin))
      near |= 1U << k;
  return near;
}

/// Hands the packets of blocks that come within `margin` to `each`, with closest points to begin from, until one
/// says true.
template <typename Each>
bool LayerPackets::any_near(const RigidTransform& X, double margin, const Each& each) {
  if (!std::exchange(is_charged_, true)) looked_at_ += kMade * static_cast<long>(most_);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    BlockPacket& blocks = blocks_[b];
    const unsigned found = near(blocks, X, margin);
    for (std::size_t k = 0; k < 4; ++k) {
      if ((found >> k & 1U) == 0) continue;
      if (blocks.first[k] == kNotMade)
        make(lattice_.blocks[4 * b + k], blocks.first[k], blocks.end[k]);
      for (std::uint32_t i = blocks.first[k]; i < blocks.end[k]; ++i)
        if (each(i, [&] { return blocks.closest.repeated(static_cast<int>(k)); })) return true;
    }
  }
  return false;
}

/// Those that may hold points that are pressed at a pose at which no point is farther from where it
/// is at X than kMargin.
void LayerPackets::choose_candidates(const RigidTransform& X) {
  candidates_.clear();
  any_near(X, kMargin, [&](std::uint32_t i, const auto& closest) {
    if (bounds_[i].known && is_clear(i, X, kMargin)) return false;
    // Its block was looked for at this pose; it itself perhaps at one long ago.
    const Vector3d way = X * bounds_[i].center - bounds_[i].at;
    const bool fresh = bounds_[i].known && way.squaredNorm() < kFollowed * kFollowed;
    if (!fresh) find_anew(i, closest(), X);
    if (fresh || !is_clear(i, X, kMargin)) candidates_.push_back(i);
    return false;
  });
  X_candidates_ = X;
  has_candidates_ = true;
}

bool LayerPackets::comes_within(const RigidTransform& X, double margin) {
  press_at(X, LayerCare::kExact);
  return any_near(X, margin, [&](std::uint32_t i, const auto& closest) {
    if (bounds_[i].known && is_clear(i, X, margin)) return false;
    find_anew(i, closest(), X);
    return !is_clear(i, X, margin);
  });
}

void LayerPackets::find_anew(std::uint32_t index,
                             const FourClosestPoints& near,
                             const RigidTransform& X) {
  LayerPacket& packet = packets_[index];
  place_all(X, packet.x, packet.p);
  looked_at_ += find_.find(packet.p, near, kFound, packet.closest);
  keep_bound(index, X);
}

/// Closest points of all that are not clear have just been found.
void LayerPackets::keep_bound(std::uint32_t index, const RigidTransform& X) {
  const LayerPacket& packet = packets_[index];
  Bound& bound = bounds_[index];
  bound.at = X * bound.center;
  bound.phi = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k)
    bound.phi =
        std::min(bound.phi, packet.closest.phi[k] - (find_.finds_in_fours() ? 0 : way(packet, k)));
  bound.turned = turned_;
  bound.known = true;
  bound.reach = 0;
  if (bound.phi > 0) keep_bend(packet, bound);
}

/// Places, φ and n are wrong by less than the last step.
void LayerPackets::keep_bend(const LayerPacket& packet, Bound& bound) const {
  const FourClosestPoints& closest = packet.closest;
  double bend = 0, along = std::numeric_limits<double>::infinity(), farthest = 0;
  bound.n.setZero();
  for (int k = 0; k < 4; ++k) {
    const BendBound about = find_.bends_about(closest, k);
    bend = std::max(bend, about.most);
    along = std::min(along, about.way - closest.step[k]);
    farthest = std::max(farthest, closest.phi[k]);
    bound.n += 0.25 * point_of(closest.n, k);
  }
  if (!(along > 0 && farthest * bend < 1)) return;
  double spread = 0, step = 0;
  for (int k = 0; k < 4; ++k) {
    spread = std::max(spread, (point_of(closest.n, k) - bound.n).squaredNorm());
    step = std::max(step, closest.step[k]);
  }
  bound.spread = std::sqrt(spread) + step;
  bound.reach = along * (1 - farthest * bend) / (1 + along * bend);
  bound.turning = bend * along / bound.reach;
}

/// Is all of a packet farther off than `margin`?
bool LayerPackets::is_clear(std::uint32_t index, const RigidTransform& X, double margin) const {
  const Bound& bound = bounds_[index];
  const double turn = (turned_ - bound.turned) * bound.radius, rest = bound.phi - margin - turn;
  if (!(rest > 0) && !(bound.reach > 0)) return false;
  const Vector3d w = X * bound.center - bound.at;
  const double square = w.squaredNorm();
  if (rest > 0 && square < rest * rest) return true;
  const double way = std::sqrt(square) + turn;
  return way < bound.reach &&
         rest + bound.n.dot(w) > (bound.spread + 0.5 * bound.turning * way) * way;
}

/// No point is farther from where it was when candidates were chosen.
double LayerPackets::way_from_candidates(const RigidTransform& X) const {
  return (X * center_ - X_candidates_ * center_).norm() + reach_ * (X.R - X_candidates_.R).norm();
}

void LayerPackets::press(std::uint32_t index, const RigidTransform& X, LayerCare care) {
  const Reliance rely = reliance(care);
  LayerPacket& packet = packets_[index];
  Told told = tell(X, rely, packet);
  ++looked_at_;
  if (told == Told::kUnknown) {
    looked_at_ += find_.find(packet.p, packet.closest, rely.followed, packet.closest,
                             find_.finds_in_fours() ? 15 : not_clear(packet));
    keep_bound(index, X);
    told = tell(X, rely, packet);
  }
  if (told != Told::kPressed) return;
  ++looked_at_;
  pressed_.push_back(index);
  points_pressed_ += static_cast<std::size_t>((packet.pressed[0] + packet.pressed[1]) +
                                              (packet.pressed[2] + packet.pressed[3]));
}

void LayerPackets::press_at(const RigidTransform& X, LayerCare care) {
  if (is_at_ && X_.R == X.R && X_.p == X.p && (care == care_ || care == LayerCare::kRough)) return;
  pressed_.clear();
  points_pressed_ = 0;
  turned_ += (X.R - X_.R).norm();
  const bool chosen = has_candidates_ && way_from_candidates(X) < kMargin;
  if (!chosen) choose_candidates(X);
  for (const std::uint32_t i : candidates_) press(i, X, care);
  if (!chosen) std::erase_if(candidates_, [&](std::uint32_t i) { return is_clear(i, X, kMargin); });
  X_ = X;
  care_ = care;
  is_at_ = true;
}

}  // namespace condyle
