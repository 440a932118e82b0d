#include "condyle/contact/layer_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/layer_side.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr std::array<int, 6> kCells = {1, 2, 3, 4, 6, 8};  // in a knot span, in either direction
constexpr std::size_t kLevels = kCells.size();

/// The lattices of a pair's surfaces, made when they are first asked for.
class Lattices {
 public:
  explicit Lattices(const ContactPair& pair)
      : on_B(pair.on_B),
        on_A(pair.on_A),
        patch_B_(dynamic_cast<const Patch*>(on_B.get())),
        patch_A_(dynamic_cast<const Patch*>(on_A.get())) {
    if (patch_B_ == nullptr && patch_A_ == nullptr)
      throw std::invalid_argument("contact \"" + pair.name +
                                  "\": a layer needs a patch on one side at least");
  }

  /// Null for a surface that is no patch.
  [[nodiscard]] const LayerLattice* of_A(std::size_t level, bool shifted) const {
    return lattice(patch_A_, of_A_[2 * level + shifted], level, shifted);
  }
  [[nodiscard]] const LayerLattice* of_B(std::size_t level, bool shifted) const {
    return lattice(patch_B_, of_B_[2 * level + shifted], level, shifted);
  }

  const std::shared_ptr<const Surface> on_B, on_A;

 private:
  struct Entry {
    std::once_flag once;
    LayerLattice lattice;
  };
  static const LayerLattice* lattice(const Patch* patch,
                                     Entry& entry,
                                     std::size_t level,
                                     bool shifted) {
    if (patch == nullptr) return nullptr;
    std::call_once(entry.once,
                   [&] { entry.lattice = layer_lattice(*patch, kCells[level], shifted); });
    return &entry.lattice;
  }

  const Patch* patch_B_;
  const Patch* patch_A_;
  mutable std::array<Entry, 2 * kLevels> of_A_, of_B_;
};

/// Both sides on one lattice.
class BothSides {
 public:
  BothSides(const Lattices& lattices, std::size_t level, bool shifted) {
    if (const LayerLattice* points = lattices.of_A(level, shifted))
      sides_.emplace_back(*points, true, *lattices.on_B);
    if (const LayerLattice* points = lattices.of_B(level, shifted))
      sides_.emplace_back(*points, false, *lattices.on_A);
  }

  void reset() {
    for (LayerSide& side : sides_) side.reset();
  }
  /// At a pose, their wrench on A added where one is asked for.
  LayerSums sums(const RigidTransform& X, const LayerLaw& law, Wrench* wrench = nullptr) {
    LayerSums all;
    for (LayerSide& side : sides_) side.add_to(X, law, share(), wrench, all);
    return all;
  }

 private:
  [[nodiscard]] double share() const { return 1.0 / static_cast<double>(sides_.size()); }

  std::vector<LayerSide> sides_;
};

class LayerContact final : public ContactPotential {
 public:
  LayerContact(std::shared_ptr<const Lattices> lattices,
               const ContactPair& pair,
               const LayerOptions& options)
      : lattices_(std::move(lattices)),
        name_(pair.name),
        law_(pair.elastic_B, pair.elastic_A, options.pressure),
        options_(options) {}

  void reset() override {
    level_ = 0;
    for (auto& sides : sides_)
      if (sides) sides->reset();
  }

  void prepare(const RigidTransform&) override { level_ = 0; }

  bool accepts(const RigidTransform& X_BA) override {
    error_ = lattice_error(X_BA);
    if (error_ <= options_.tolerance || level_ + 1 == kLevels) return true;
    ++level_;
    return false;
  }

  double add_to(const RigidTransform& X_BA, Wrench& wrench) override {
    return sides(false).sums(X_BA, law_, &wrench).force;
  }

  double energy(const RigidTransform& X_BA) override {
    return sides(false).sums(X_BA, law_).energy;
  }

  std::optional<Objection> describe(const RigidTransform& X_BA, ContactResult& result) override;

 private:
  BothSides& sides(bool shifted) {
    std::optional<BothSides>& sides = sides_[2 * level_ + shifted];
    if (!sides) sides.emplace(*lattices_, level_, shifted);
    return *sides;
  }
  /// Errors of the lattice and of the shifted one have nearly opposite signs.
  [[nodiscard]] double lattice_error(const RigidTransform& X_BA) {
    const LayerSums here = sides(false).sums(X_BA, law_), shifted = sides(true).sums(X_BA, law_);
    const double force = std::max(here.force, shifted.force);
    return force > 0 ? 0.5 * (here.on_A - shifted.on_A).norm() / force : 0;
  }
  [[nodiscard]] std::optional<Objection> objection(const LayerSums& sums) const;

  std::shared_ptr<const Lattices> lattices_;
  std::string name_;
  LayerLaw law_;
  LayerOptions options_;
  std::array<std::optional<BothSides>, 2 * kLevels> sides_;
  std::size_t level_ = 0;
  double error_ = 0;
};

std::optional<Objection> LayerContact::describe(const RigidTransform& X_BA, ContactResult& result) {
  const LayerSums sums = sides(false).sums(X_BA, law_);
  result.closed = sums.force > 0;
  if (!result.closed) return std::nullopt;
  ContactPointResult point;
  point.force = sums.on_A.norm();
  point.point_ground = sums.peak;
  point.point_moving = X_BA.inverse() * sums.peak;
  point.normal_ground = sums.normal;
  point.gap = -sums.deepest;
  point.relative_curvature.fill(0);
  result.points.push_back(point);
  result.force = point.force;
  result.resultant_ground = sums.center_of_pressure();
  result.layer = LayerResult{.area = sums.area,
                             .mean_pressure = sums.force / sums.area,
                             .peak_pressure = sums.peak_pressure,
                             .deepest = sums.deepest,
                             .energy = sums.energy,
                             .error = error_,
                             .beyond = sums.beyond / sums.force,
                             .points = sums.points};
  return objection(sums);
}

std::optional<Objection> LayerContact::objection(const LayerSums& sums) const {
  if (sums.deepest > law_.deepest())
    return Objection{
        PoseStatus::kOverlap,
        fmt::format("contact \"{}\" is pressed {:.2f} mm deep, its layers of {:.2f} mm bear {:.2f}",
                    name_, sums.deepest, law_.thickness(), law_.deepest())};
  const double beyond = sums.beyond / sums.force;
  if (beyond > options_.beyond)
    return Objection{
        PoseStatus::kLeftPatch,
        fmt::format("{:.0f} % of the force of contact \"{}\" lies beyond the known part of its "
                    "surfaces, {:.0f} % at most",
                    100 * beyond, name_, 100 * options_.beyond)};
  return std::nullopt;
}

}  // namespace

ContactLaw layer_contact(const LayerOptions& options) {
  struct Shared {
    std::mutex mutex;
    std::shared_ptr<const Lattices> lattices;
  };
  return [options, shared = std::make_shared<Shared>()](const ContactPair& pair) {
    const std::lock_guard lock(shared->mutex);
    std::shared_ptr<const Lattices>& lattices = shared->lattices;
    if (!lattices || lattices->on_B != pair.on_B || lattices->on_A != pair.on_A)
      lattices = std::make_shared<const Lattices>(pair);
    return std::make_unique<LayerContact>(lattices, pair, options);
  };
}

}  // namespace condyle
