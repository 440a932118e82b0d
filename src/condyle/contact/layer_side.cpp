#include "condyle/contact/layer_side.h"

#include <Eigen/Geometry>

#include <algorithm>

#include "condyle/contact/layer_moments.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

Vector3d one_of(const FourPoints& x, int k) { return {x[0][k], x[1][k], x[2][k]}; }

}  // namespace

LayerSide::LayerSide(const LayerLattice& points, bool of_A, const LayerClosestPoints& into)
    : points_(points), of_A_(of_A), into_(into.surface()), packets_(points, into) {}

void LayerSide::reset() { packets_.reset(); }

const LayerPackets& LayerSide::press_at(const RigidTransform& X_BA, LayerCare care) {
  packets_.press_at(of_A_ ? X_BA : X_BA.inverse(), care);
  return packets_;
}

std::size_t LayerSide::pressed(const RigidTransform& X_BA) {
  return press_at(X_BA, LayerCare::kExact).points();
}

bool LayerSide::comes_within(const RigidTransform& X_BA, double margin) {
  return packets_.comes_within(of_A_ ? X_BA : X_BA.inverse(), margin);
}

/// Of each pressed point.
template <typename Each>
void LayerSide::for_pressed(const RigidTransform& X_BA, const Each& each) {
  const LayerPackets& packets = press_at(X_BA, LayerCare::kExact);
  for (std::size_t i = 0; i < packets.size(); ++i)
    for (int k = 0; k < 4; ++k)
      if (packets[i].pressed[k] > 0) each(packets[i], k, packets[i].point[k]);
}

namespace {

/// What a pressed point does.
struct Push {
  LayerLaw::Answer answer;
  double w, faded;  ///< area that it stands for, and that a border took [mm²]
  double depth;     ///< [mm]
  Vector3d x, n;    ///< where, and out of B, ground frame
  bool beyond;      ///< it faces what lies beyond an edge
};

void add_to_sums(const Push& push, LayerSums& sums) {
  const double force = push.w * push.answer.pressure;
  ++sums.points;
  sums.energy += push.w * push.answer.energy;
  sums.area += push.w;
  sums.force += force;
  sums.moment += force * push.x;
  sums.on_A += force * push.n;
  sums.torque += force * push.x.cross(push.n);
  sums.deepest = std::max(sums.deepest, push.depth);
  const double faded = push.faded * push.answer.pressure, beyond = push.beyond ? force : 0;
  sums.faded += faded;
  sums.beyond += beyond;
  sums.lost_moment += (faded + beyond) * push.x;
  if (push.answer.pressure <= sums.peak_pressure) return;
  sums.peak_pressure = push.answer.pressure;
  sums.peak = push.x;
  sums.normal = push.n;
}

}  // namespace

double LayerSide::add_to(
    const RigidTransform& X_BA, const LayerLaw& law, double share, LayerCare care, Wrench& wrench) {
  const Vector3d origin = of_A_ ? X_BA.p : Vector3d(Vector3d::Zero());
  const LayerMoments sums = layer_moments(press_at(X_BA, care), law, share, origin);
  if (of_A_)
    add_to_wrench_of_A(sums, wrench);
  else
    add_to_wrench_of_B(sums, X_BA.R, wrench);
  return sums.force;
}

void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       LayerSums& sums) {
  for_pressed(X_BA, [&](const LayerPacket& packet, int k, std::size_t i) {
    const Vector3d n = one_of(packet.n, k);
    const double depth = -packet.phi[k];
    add_to_sums({law.at(depth), share * points_.area[i],
                 points_.faded.empty() ? 0 : share * points_.faded[i], depth,
                 of_A_ ? one_of(packet.p, k) : points_.x[i], of_A_ ? n : Vector3d(-(X_BA.R * n)),
                 into_.edge_distance(packet.closest.place_of(k)) < 0},
                sums);
  });
}

// With the arm s of the point and n out of B: dp = -W'' n.(da + dπ x s), whichever body carries the
// point; one of A moves by da + dπ x s, one of B stays.
void LayerSide::add_to(const RigidTransform& X_BA,
                       const LayerLaw& law,
                       double share,
                       LayerRateSums& sums) {
  for_pressed(X_BA, [&](const LayerPacket& packet, int k, std::size_t i) {
    const double depth = -packet.phi[k], w = share * points_.area[i];
    const LayerLaw::Answer answer = law.at(depth);
    const Vector3d n = of_A_ ? one_of(packet.n, k) : Vector3d(-(X_BA.R * one_of(packet.n, k)));
    const Vector3d x = of_A_ ? one_of(packet.p, k) : points_.x[i], s = x - X_BA.p;
    Eigen::Matrix<double, 1, 6> rate;
    rate << n.transpose(), s.cross(n).transpose();
    rate *= -w * answer.stiffness;
    sums.force += rate;
    sums.moment += x * rate;
    if (of_A_) {
      const double force = w * answer.pressure;
      sums.moment.leftCols<3>().diagonal().array() += force;
      sums.moment.rightCols<3>() -= force * skew(s);
    }
    const std::array<double, 2> by_moduli = law.pressure_by_moduli(depth);
    for (std::size_t side = 0; side < 2; ++side) {
      const double stiffer = w * by_moduli[side];
      sums.stiffer[side].force += stiffer;
      sums.stiffer[side].moment += stiffer * x;
      sums.stiffer[side].f += stiffer * n;
      sums.stiffer[side].m += stiffer * s.cross(n);
    }
  });
}

void LayerSide::add_pressures(const RigidTransform& X_BA,
                              const LayerLaw& law,
                              std::vector<PressurePoint>& points) {
  for_pressed(X_BA, [&](const LayerPacket& packet, int k, std::size_t i) {
    const double depth = -packet.phi[k];
    points.push_back(
        {of_A_, points_.place[i], points_.x[i], law.at(depth).pressure, depth, points_.area[i]});
  });
}

CornerForce LayerSide::at_corners(const RigidTransform& X_BA,
                                  const LayerLaw& law,
                                  const LayerCorners& corners) {
  const LayerPackets& packets = press_at(X_BA, LayerCare::kExact);
  CornerForce sums = corners_.force(packets, of_A_ ? X_BA : X_BA.inverse(), law, corners);
  if (!of_A_) sums.along_n = -(X_BA.R * sums.along_n);
  return sums;
}

}  // namespace condyle
