#pragma once

/// Which points of a lattice are pressed into a surface of the other body at a pose, how deep, and
/// along which normals: the state of one thread that layer_side.h sums over. Points go in packets of
/// four neighbours (layer_closest.h), packets in blocks. Nowhere does φ change by more than the way
/// that a point went, so packets and blocks that were farther off than they have moved since are not
/// looked at; which may be is told once for all poses close to each other.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "condyle/contact/layer_closest.h"
#include "condyle/contact/layer_lattice.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// Cosine between the normals of two places that face each other, at most: others have passed
/// behind the other body.
inline constexpr double kOpposed = -0.3;

/// How well closest points are known.
enum class LayerCare {
  kExact,  ///< to round-off
  kRough   ///< for a step of Newton's method: told from places that are near enough
};

/// Up to four neighbours of a lattice; where there are fewer, the last stands for the others
/// without an area.
struct alignas(32) LayerPacket {
  FourPoints x, normal;  ///< in their body's frame [mm], outward
  double area[4];        ///< that they stand for [mm²]
  std::array<std::uint32_t, 4> point;
  FourClosestPoints closest;

  // At the pose that was asked for, in the frame of the body that carries the other surface:
  FourPoints p, n;    ///< where they are [mm], and out of the other solid
  double phi[4];      ///< signed distances [mm]
  double pressed[4];  ///< 1 where they are pressed, else 0
};

class LayerPackets {
 public:
  /// Both are referred to.
  LayerPackets(const LayerLattice& points, const LayerClosestPoints& find);

  /// As newly made. Allocates nothing.
  void reset();

  /// Finds the packets with points that are pressed, X being the pose of the points' body in the
  /// frame of the other, unless that is known. Allocates nothing.
  void press_at(const RigidTransform& X, LayerCare care);

  /// Is any point within `margin` of the other surface, or in it [mm]?
  [[nodiscard]] bool comes_within(const RigidTransform& X, double margin);

  /// Of the last pose.
  [[nodiscard]] std::size_t size() const { return pressed_.size(); }
  [[nodiscard]] const LayerPacket& operator[](std::size_t i) const { return packets_[pressed_[i]]; }
  [[nodiscard]] std::size_t points() const { return points_pressed_; }
  /// ContactPotential::looked_at. What making it takes counts at its first use, and so after each reset:
  /// a number that does not tell what was asked before.
  [[nodiscard]] long looked_at() const { return looked_at_; }

 private:
  /// The balls about four blocks.
  struct alignas(32) BlockPacket {
    FourPoints center;               ///< [mm]
    double radius[4];                ///< [mm]
    std::uint32_t first[4], end[4];  ///< packets of each, which are made when it first comes near
    FourClosestPoints closest;
  };
  static constexpr std::uint32_t kNotMade = std::numeric_limits<std::uint32_t>::max();
  void make(const LayerBlock& block, std::uint32_t& first, std::uint32_t& end);
  [[nodiscard]] unsigned near(BlockPacket& blocks, const RigidTransform& X, double margin);
  /// No point of a packet is nearer than φ less the way w that it went, which is that of the centre
  /// and what the body has turned since by the radius. Nor is a point outside nearer than
  /// φ + n·w - h w²/2, where h bounds ∂²φ below: closest points go by w/(1 - φ k) at most on a surface
  /// that does not bend towards the point by more than k, and h = k/(1 - φ k).
  struct Bound {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the packet [mm]
    double radius = 0;                                 ///< about it [mm]
    Eigen::Vector3d at = Eigen::Vector3d::Zero();      ///< where it was
    double phi = 0;                                    ///< least of its points there [mm]
    double turned = 0;                                 ///< turned_ there
    Eigen::Vector3d n = Eigen::Vector3d::Zero();       ///< mean of its points there
    double spread = 0;                                 ///< of their n about that
    double turning = 0;                                ///< h [1/mm]
    double reach = 0;                                  ///< longest w for which that holds [mm]
    bool known = false;
  };
  void find_anew(std::uint32_t packet, const FourClosestPoints& near, const RigidTransform& X);
  void keep_bound(std::uint32_t packet, const RigidTransform& X);
  void keep_bend(const LayerPacket& packet, Bound& bound) const;
  [[nodiscard]] bool is_clear(std::uint32_t packet, const RigidTransform& X, double margin) const;
  template <typename Each>
  bool any_near(const RigidTransform& X, double margin, const Each& each);
  void choose_candidates(const RigidTransform& X);
  [[nodiscard]] double way_from_candidates(const RigidTransform& X) const;
  void press(std::uint32_t packet, const RigidTransform& X, LayerCare care);

  const LayerLattice& lattice_;
  const LayerClosestPoints& find_;
  std::vector<BlockPacket> blocks_;
  std::size_t most_ = 0;  ///< packets of all blocks
  std::vector<LayerPacket> packets_;
  std::vector<Bound> bounds_;           ///< of packets
  std::vector<std::uint32_t> pressed_;  ///< packets, at X_; with room for all
  std::size_t points_pressed_ = 0;
  long looked_at_ = 0;
  bool is_charged_ = false;                ///< with what making it takes
  std::vector<std::uint32_t> candidates_;  ///< packets that may be pressed near X_candidates_
  RigidTransform X_candidates_;
  bool has_candidates_ = false;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double reach_ = 0;   ///< all points lie within this of the centre [mm]
  double turned_ = 0;  ///< sum of |ΔR| between the poses asked for
  RigidTransform X_;
  bool is_at_ = false;  ///< X_
  LayerCare care_ = LayerCare::kExact;
};

}  // namespace condyle
