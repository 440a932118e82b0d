#include "condyle/contact/layer_contact.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/contact_rates.h"
#include "condyle/contact/layer_sides.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kMostWrong = 0.01;  // of the forces that act, and 3 tolerances
constexpr double kLight =
    5;  // as if that acted besides: the first touch is known to no part of itself [N]
constexpr double kError = 0.39;  // N^5/4 times the error of N on a side

class LayerContact final : public ContactPotential {
 public:
  LayerContact(std::shared_ptr<const PairLattices> lattices,
               const ContactPair& pair,
               const LayerOptions& options,
               const Vector3d& origin)
      : lattices_(std::move(lattices)),
        name_(pair.name),
        law_(pair.elastic_B, pair.elastic_A, options.pressure),
        options_(options),
        origin_(origin) {}

  void reset() override {
    level_ = 0;
    factor_ = 1;
    tried_ = {};
    held_ = false;
    error_ = 0;
    forget_places();
  }

  void forget_places() override {
    for (auto& sides : sides_)
      if (sides) sides->reset();
  }

  void prepare(const RigidTransform& X_BA) override {
    tried_ = {};
    held_ = false;
    choose(X_BA);
  }

  void soften(double factor) override { factor_ = factor; }

  [[nodiscard]] double softest(double force, double L) const override {
    constexpr double kLeast = 1e-6;
    if (!(force > 0)) return 1;
    return std::clamp(540 * force / (L * L * L * law_.stiffness()), kLeast, 1.0);
  }

  void estimate_error(const RigidTransform& X_BA) override { error_ = lattice_error(X_BA); }

  /// Softer layers are on the way to others, and need no other lattice. Of two poses that ask for each other's lattice the
  /// finer one is held.
  bool accepts(const RigidTransform& X_BA) override {
    if (factor_ < 1) return true;
    const std::size_t before = level_;
    if (!held_) {
      choose_by_error(X_BA);
      const std::size_t chosen = level_;
      // A lattice whose points all lie beside what is pressed would tell less.
      const std::size_t wanted = presses(X_BA) ? chosen : before;
      if (wanted == before && chosen == before) return true;
      held_ = tried_[wanted];
      tried_[wanted] = true;
      level_ = held_ ? std::max(wanted, before) : wanted;
      if (level_ != before) return false;
    }
    estimate_error(X_BA);
    return true;
  }

  bool refines(const RigidTransform& X_BA) override {
    const std::size_t before = level_;
    estimate_error(X_BA);
    if (misses_tolerance(X_BA)) level_ = finer(level_, error_);
    return level_ == before;
  }

  double add_to(const RigidTransform& X_BA, Wrench& wrench) override {
    return sides().add_to(X_BA, law_, factor_, LayerCare::kExact, wrench);
  }

  double add_roughly_to(const RigidTransform& X_BA, Wrench& wrench) override {
    return sides().add_to(X_BA, law_, factor_, LayerCare::kRough, wrench);
  }

  [[nodiscard]] long looked_at() const override {
    long points = 0;
    for (const auto& sides : sides_)
      if (sides) points += sides->looked_at();
    return points;
  }

  double energy(const RigidTransform& X_BA) override {
    return sides().sums(X_BA, law_, factor_).energy;
  }

  [[nodiscard]] double bears() const override { return law_.deepest(); }
  std::optional<Objection> describe(const RigidTransform& X_BA, ContactResult& result) override;
  std::optional<Objection> uncertain(const RigidTransform& X_BA, double acting) override;

  [[nodiscard]] bool knows_rates() const override { return true; }
  bool rates(const RigidTransform& X_BA, ContactRates& rates) override;

 private:
  LayerSides& sides() {
    std::optional<LayerSides>& sides = sides_[level_];
    if (!sides) sides.emplace(*lattices_, level_);
    return *sides;
  }
  /// The coarsest lattice that should do by the number of its points, as one that is coarser tells
  /// that. What is pressed between the points of a coarse one, finer ones tell.
  void choose(const RigidTransform& X_BA) {
    constexpr double kEnough = 8;  // points, to tell those of other lattices
    constexpr double kBetween =
        0.5;  // a ball of 2 mm rises so far over points 2 mm from each other [mm]
    level_ = 0;
    double points = pressed_on_a_side(X_BA);
    if (points == 0 && !sides().come_within(X_BA, kBetween)) return;
    for (; level_ + 1 < kLayerLevels; points = pressed_on_a_side(X_BA)) {
      const double finer = points > 0 ? std::sqrt(fewest_points(options_.tolerance) / points) : 2;
      if (!(finer > 1)) return;
      if (points >= kEnough) {
        level_ = level_of(finer * kLayerCells[level_]);
        return;
      }
      ++level_;
    }
    if (points == 0) level_ = 0;
  }
  /// With an error that is told there: a function of the pose alone.
  void choose_by_error(const RigidTransform& X_BA) {
    choose(X_BA);
    for (estimate_error(X_BA); misses_tolerance(X_BA); estimate_error(X_BA)) {
      const std::size_t coarser = level_;
      level_ = finer(level_, error_);
      if (presses(X_BA)) continue;
      level_ = coarser;
      return;
    }
  }
  [[nodiscard]] bool presses(const RigidTransform& X_BA) {
    return sides().sums(X_BA, law_).force > 0;
  }
  /// What is pressed deeper than the layers bear is refused, and needs no finer lattice.
  [[nodiscard]] bool misses_tolerance(const RigidTransform& X_BA) {
    return error_ > options_.tolerance && level_ + 1 < kLayerLevels &&
           !(sides().sums(X_BA, law_).deepest > law_.deepest());
  }
  [[nodiscard]] double pressed_on_a_side(const RigidTransform& X_BA) {
    return static_cast<double>(sides().pressed(X_BA)) / sides().count();
  }
  /// Of the force, relative. An error that goes along one direction of the lattice changes its sign
  /// with a shift of half a cell, so half the difference is that error; what goes along diagonals
  /// keeps its sign and is not seen: of N points on a side it has a root mean square of
  /// 0.15 N^(-5/4), 0.38 of all.
  [[nodiscard]] double lattice_error(const RigidTransform& X_BA) {
    constexpr double kUnseen = 0.15;
    const LayerSums& here = sides().sums(X_BA, law_);
    const CornerForce shifted = sides().at_corners(X_BA, law_);
    const double force = std::max(here.force, shifted.force);
    if (!(force > 0)) return 0;
    const double seen = 0.5 * (here.on_A - shifted.along_n).norm() / force;
    const double points = std::max(1.0, here.points / sides().count());
    return std::hypot(seen, kUnseen * std::pow(points, -1.25));
  }
  /// Part of the force that an edge takes away.
  [[nodiscard]] static double lost(const LayerSums& sums) {
    return (sums.beyond + sums.faded) / (sums.force + sums.faded);
  }
  [[nodiscard]] std::string place(const Vector3d& x) const {
    const Vector3d at = x + origin_;
    return fmt::format("[{:.1f}, {:.1f}, {:.1f}] mm of the fixed body", at.x(), at.y(), at.z());
  }
  /// Points on a side that leave an error of the force of that, root mean square.
  [[nodiscard]] static double fewest_points(double error) { return std::pow(kError / error, 0.8); }
  /// The coarsest with at least so many cells, or the finest.
  [[nodiscard]] static std::size_t level_of(double cells) {
    std::size_t level = 0;
    while (level + 1 < kLayerLevels && kLayerCells[level] < cells) ++level;
    return level;
  }
  /// The coarsest lattice that should do: errors of the force fall as the width of cells to 5/2.
  [[nodiscard]] std::size_t finer(std::size_t level, double error) const {
    return std::max(level + 1,
                    level_of(kLayerCells[level] * std::pow(error / options_.tolerance, 0.4)));
  }
  [[nodiscard]] std::optional<Objection> objection(const LayerSums& sums) const;

  std::shared_ptr<const PairLattices> lattices_;
  std::string name_;
  LayerLaw law_;
  LayerOptions options_;
  Vector3d origin_;  ///< of the model's frame of B, in the file's [mm]
  std::array<std::optional<LayerSides>, kLayerLevels> sides_;
  std::size_t level_ = 0;
  std::array<bool, kLayerLevels> tried_{};  ///< of those that a solved pose asked for since prepare
  bool held_ = false;                       ///< whatever the next one asks for
  double error_ = 0;
  double factor_ = 1;  ///< of the stiffness
};

std::optional<Objection> LayerContact::describe(const RigidTransform& X_BA, ContactResult& result) {
  const LayerSums& sums = sides().sums(X_BA, law_);
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
  result.layer =
      LayerResult{.area = sums.area,
                  .mean_pressure = sums.force / sums.area,
                  .peak_pressure = sums.peak_pressure,
                  .deepest = sums.deepest,
                  .energy = sums.energy,
                  .error = error_,
                  .lost = lost(sums),
                  .lateral = law_.lateral_length() / std::sqrt(sums.area / std::numbers::pi),
                  .points = sums.points,
                  .force = sums.on_A,
                  .moment = sums.torque - X_BA.p.cross(sums.on_A)};
  sides().add_pressures(X_BA, law_, result.pressures);
  return objection(sums);
}

// The resultant Σ w p x / Σ w p.
bool LayerContact::rates(const RigidTransform& X_BA, ContactRates& rates) {
  const LayerSums& sums = sides().sums(X_BA, law_);
  if (!(sums.force > 0)) return false;
  const LayerRateSums change = sides().rate_sums(X_BA, law_);
  const Vector3d center = sums.center_of_pressure();
  rates.resultant = (change.moment - center * change.force) / sums.force;
  for (std::size_t side = 0; side < 2; ++side) {
    const LayerRateSums::Stiffer& stiffer = change.stiffer[side];
    rates.stiffer[side] = {stiffer.f, stiffer.m,
                           (stiffer.moment - stiffer.force * center) / sums.force};
  }
  return true;
}

std::optional<Objection> LayerContact::objection(const LayerSums& sums) const {
  if (sums.deepest > law_.deepest())
    return Objection{
        PoseStatus::kOverlap,
        fmt::format("contact \"{}\" is pressed {:.2f} mm deep at {}, its layers of "
                    "{:.2f} mm bear {:.2f}",
                    name_, sums.deepest, place(sums.peak), law_.thickness(), law_.deepest())};
  if (lost(sums) > options_.beyond)
    return Objection{
        PoseStatus::kLeftPatch,
        fmt::format(
            "{:.1f} % of the force of contact \"{}\" is lost at an edge of the known part of "
            "its surfaces, about {}, {:g} % at most",
            100 * lost(sums), name_, place(sums.lost_moment / (sums.beyond + sums.faded)),
            100 * options_.beyond)};
  return std::nullopt;
}

/// A lattice that is as fine as there is may be too coarse for a ring or a very large ball. A light touch of few points may err
/// by a great part of its force, which is a small one of those that act.
std::optional<Objection> LayerContact::uncertain(const RigidTransform& X_BA, double acting) {
  const double wrong = kMostWrong + 3 * options_.tolerance;
  const double force = sides().sums(X_BA, law_).force;
  if (!(error_ * force > wrong * (acting + kLight))) return std::nullopt;
  return Objection{
      PoseStatus::kIterationLimit,
      fmt::format(
          "contact \"{}\": the force of its layers is uncertain by {:.1f} %, by {:.1f} % of "
          "the forces that act, {:.1f} % at most: the finest lattice has few points for "
          "surfaces of that size",
          name_, 100 * error_, 100 * error_ * force / acting, 100 * wrong)};
}

}  // namespace

ContactLaw layer_contact(const LayerOptions& options, const Vector3d& origin) {
  struct Shared {
    std::mutex mutex;
    std::shared_ptr<const PairLattices> lattices;
  };
  return [options, origin, shared = std::make_shared<Shared>()](const ContactPair& pair) {
    const std::lock_guard lock(shared->mutex);
    std::shared_ptr<const PairLattices>& lattices = shared->lattices;
    if (!lattices || lattices->on_B != pair.on_B || lattices->on_A != pair.on_A)
      lattices = std::make_shared<const PairLattices>(pair);
    return std::make_unique<LayerContact>(lattices, pair, options, origin);
  };
}

}  // namespace condyle
