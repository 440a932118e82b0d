#pragma once

/// The lattices of both surfaces of a pair, and what both sides press on one of them: of layer_contact.cpp alone.

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/layer_side.h"

namespace condyle {

/// Cells in a knot span, in either direction, from the coarsest lattice on.
inline constexpr std::array<int, 6> kLayerCells = {1, 2, 3, 4, 6, 8};
inline constexpr std::size_t kLayerLevels = kLayerCells.size();

/// The lattices of a pair's surfaces, made when they are first asked for.
class PairLattices {
 public:
  explicit PairLattices(const ContactPair& pair)
      : on_B(pair.on_B),
        on_A(pair.on_A),
        into_B(*on_B),
        into_A(*on_A),
        uses_B_(has_fine_lattice(*on_B) || !has_fine_lattice(*on_A)),
        uses_A_(has_fine_lattice(*on_A) || !has_fine_lattice(*on_B)) {
    if (of_A(0) == nullptr && of_B(0) == nullptr)
      throw std::invalid_argument("contact \"" + pair.name +
                                  "\": a layer needs bounds of one of its surfaces at least");
  }

  /// Null for a surface without points.
  [[nodiscard]] const LayerLattice* of_A(std::size_t level) const {
    return uses_A_ ? lattice(*on_A, of_A_[level], level) : nullptr;
  }
  [[nodiscard]] const LayerLattice* of_B(std::size_t level) const {
    return uses_B_ ? lattice(*on_B, of_B_[level], level) : nullptr;
  }
  /// Of lattices that have points.
  [[nodiscard]] const LayerCorners& corners_of(bool A, std::size_t level) const {
    Entry& entry = A ? of_A_[level] : of_B_[level];
    std::call_once(entry.corners_once, [&] {
      entry.corners = layer_corners(A ? *on_A : *on_B, kLayerCells[level], entry.lattice);
    });
    return entry.corners;
  }

  const std::shared_ptr<const Surface> on_B, on_A;
  const LayerClosestPoints into_B, into_A;

 private:
  struct Entry {
    std::once_flag once, corners_once;
    LayerLattice lattice;
    LayerCorners corners;
  };
  static const LayerLattice* lattice(const Surface& surface, Entry& entry, std::size_t level) {
    std::call_once(entry.once, [&] { entry.lattice = layer_lattice(surface, kLayerCells[level]); });
    return entry.lattice.x.empty() ? nullptr : &entry.lattice;
  }

  bool uses_B_, uses_A_;
  mutable std::array<Entry, kLayerLevels> of_A_, of_B_;
};

/// Both sides on one lattice.
class LayerSides {
 public:
  LayerSides(const PairLattices& lattices, std::size_t level) : lattices_(lattices), level_(level) {
    if (const LayerLattice* points = lattices.of_A(level)) add(*points, true, lattices.into_B);
    if (const LayerLattice* points = lattices.of_B(level)) add(*points, false, lattices.into_A);
  }

  void reset() {
    for (LayerSide& side : sides_) side.reset();
    has_sums_ = false;
  }
  /// Of the sides that have points.
  [[nodiscard]] double count() const { return static_cast<double>(sides_.size()); }
  /// At a pose, of layers `factor` times as stiff.
  const LayerSums& sums(const RigidTransform& X, const LayerLaw& law, double factor = 1) {
    if (has_sums_ && X_.R == X.R && X_.p == X.p && factor_ == factor) return sums_;
    sums_ = {};
    for (LayerSide& side : sides_) side.add_to(X, law, factor * share(), sums_);
    X_ = X;
    factor_ = factor;
    has_sums_ = true;
    return sums_;
  }
  LayerRateSums rate_sums(const RigidTransform& X, const LayerLaw& law) {
    LayerRateSums all;
    for (LayerSide& side : sides_) side.add_to(X, law, share(), all);
    return all;
  }
  /// Their wrench on A, added; the sum of the forces' magnitudes [N].
  double add_to(
      const RigidTransform& X, const LayerLaw& law, double factor, LayerCare care, Wrench& wrench) {
    double force = 0;
    for (LayerSide& side : sides_) force += side.add_to(X, law, factor * share(), care, wrench);
    return force;
  }
  /// What the corners of the lattices' cells would carry.
  CornerForce at_corners(const RigidTransform& X, const LayerLaw& law) {
    CornerForce all;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const CornerForce side = sides_[i].at_corners(X, law, lattices_.corners_of(of_A_[i], level_));
      all.force += share() * side.force;
      all.along_n += share() * side.along_n;
    }
    return all;
  }
  /// How many points are pressed.
  std::size_t pressed(const RigidTransform& X) {
    std::size_t points = 0;
    for (LayerSide& side : sides_) points += side.pressed(X);
    return points;
  }
  [[nodiscard]] long looked_at() const {
    long points = 0;
    for (const LayerSide& side : sides_) points += side.looked_at();
    return points;
  }
  [[nodiscard]] bool come_within(const RigidTransform& X, double margin) {
    return std::any_of(sides_.begin(), sides_.end(),
                       [&](LayerSide& side) { return side.comes_within(X, margin); });
  }
  /// The points that are pressed, B's first.
  void add_pressures(const RigidTransform& X,
                     const LayerLaw& law,
                     std::vector<PressurePoint>& points) {
    for (std::size_t i = sides_.size(); i-- > 0;) sides_[i].add_pressures(X, law, points);
  }

 private:
  [[nodiscard]] double share() const { return 1 / count(); }
  void add(const LayerLattice& points, bool of_A, const LayerClosestPoints& into) {
    sides_.emplace_back(points, of_A, into);
    of_A_.push_back(of_A);
  }

  const PairLattices& lattices_;
  std::size_t level_;
  std::vector<LayerSide> sides_;
  std::vector<bool> of_A_;
  LayerSums sums_;  ///< at X_, of layers factor_ times as stiff
  RigidTransform X_;
  double factor_ = 1;
  bool has_sums_ = false;
};

}  // namespace condyle
