#pragma once

/// The pressure between two thin elastic layers that are bonded to rigid bones and pressed together
/// by a depth d: an elastic foundation, each point on its own. A layer that cannot give way
/// sideways has the confined modulus K = E (1 - ν)/((1 + ν)(1 - 2ν)); with its thickness h and its
/// share d_i of the depth [Blankevoort et al. 1991; Smith et al. 2018, there lumped into one]
///     linear:       p = K d_i/h,              energy of an area W_i = K d_i²/(2 h),
///     logarithmic:  p = -K ln(1 - d_i/h),     W_i = K [(h - d_i) ln(1 - d_i/h) + d_i].
/// The two stand in series: d = d_B + d_A under one pressure. W(0) = W'(0) = 0 and W' = p.

#include <array>
#include <optional>

#include "condyle/contact/hertz.h"
#include "condyle/contact/layer_options.h"

namespace condyle {

/// K [N/mm²].
[[nodiscard]] double confined_modulus(const ElasticSurface& layer);

class LayerLaw {
 public:
  /// A side that is absent is rigid. Throws std::invalid_argument where neither side has a layer,
  /// where one has no thickness, or ν outside [0, 0.49].
  LayerLaw(const std::optional<ElasticSurface>& on_B,
           const std::optional<ElasticSurface>& on_A,
           PressureLaw pressure);

  struct Answer {
    double pressure = 0;   ///< p = W' [N/mm²]
    double energy = 0;     ///< W [N/mm]
    double stiffness = 0;  ///< W'' [N/mm³]
  };
  /// To a depth d [mm]: zeros for d <= 0; beyond deepest() with the stiffness that it has there, so
  /// that it is finite at every pose.
  [[nodiscard]] Answer at(double d) const {
    if (!(d > 0)) return {};
    if (is_linear()) return {k_ * d, 0.5 * k_ * d * d, k_};
    return logarithmic_at(d);
  }

  /// Is p = stiffness() d?
  [[nodiscard]] bool is_linear() const { return law_ == PressureLaw::kLinear; }

  /// ∂p/∂ln E of the layers on B and on A at a depth d, 0 < d <= deepest() [N/mm²]: together p.
  [[nodiscard]] std::array<double, 2> pressure_by_moduli(double d) const;

  /// Of both layers together at d = 0 [N/mm³].
  [[nodiscard]] double stiffness() const { return k_; }
  /// Of both layers [mm].
  [[nodiscard]] double thickness() const { return sides_[0].h + sides_[1].h; }
  /// λ = h √(K/3μ) of the layer where it is greater [mm]: over contacts smaller than this a bonded
  /// layer gives way sideways, and pressures are those of the model rather than of tissue.
  [[nodiscard]] double lateral_length() const;
  /// As deep as the law is meant to go [mm]: half of the layers, 0.9 of them where it stiffens.
  [[nodiscard]] double deepest() const;

 private:
  struct Side {
    double K = 1, h = 0, mu = 1;  ///< [N/mm²], [mm], shear modulus [N/mm²]; h = 0: rigid
  };
  [[nodiscard]] Answer logarithmic_at(double d) const;
  [[nodiscard]] Answer logarithmic(double d) const;

  std::array<Side, 2> sides_;
  PressureLaw law_;
  double k_;
};

}  // namespace condyle
