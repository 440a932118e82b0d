#pragma once

/// The law of the layers of a contact, written from docs/contact.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "condyle/verify/pose_checks.h"

namespace condyle::verification {

/// A layer's thickness over its confined modulus [mm³/N], and its thickness.
struct LayerSpring {
  double h = 0, K = 1;
};

/// Two layers in series.
class LayersInSeries {
 public:
  LayersInSeries(const Scene& scene, const PairOfSides& pair, PressureLaw pressure)
      : pressure_(pressure) {
    int side = 0;
    for (const int surface : {pair.fixed_surface, pair.moving_surface}) {
      LayerSpring& spring = springs_[side++];
      const std::optional<ElasticSurface>& elastic =
          scene.surfaces[static_cast<std::size_t>(surface)].elastic;
      if (!elastic) continue;
      const double nu = elastic->poisson;
      spring = {elastic->layer, elastic->modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu))};
    }
  }
  [[nodiscard]] double thickness() const { return springs_[0].h + springs_[1].h; }
  [[nodiscard]] double deepest() const {
    return (pressure_ == PressureLaw::kLinear ? 0.5 : 0.9) * thickness();
  }
  /// Of both layers under a pressure [mm].
  [[nodiscard]] double depth(double p) const {
    double d = 0;
    for (const LayerSpring& s : springs_)
      d += pressure_ == PressureLaw::kLinear ? p * s.h / s.K : s.h * (1 - std::exp(-p / s.K));
    return d;
  }
  /// By bisection [N/mm²].
  [[nodiscard]] double pressure(double d) const {
    if (!(d > 0)) return 0;
    double low = 0, high = 1e-3;
    while (depth(high) < d && high < 1e9) high *= 2;
    for (int i = 0; i < 200 && high - low > 1e-16 * high; ++i) {
      const double middle = 0.5 * (low + high);
      (depth(middle) < d ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  /// ∫ p dd by Simpson's rule [N/mm].
  [[nodiscard]] double energy(double d) const {
    if (!(d > 0)) return 0;
    if (pressure_ == PressureLaw::kLinear) return 0.5 * d * pressure(d);
    constexpr int kParts = 16;
    double sum = pressure(d);
    for (int i = 1; i < kParts; ++i) sum += (i % 2 == 1 ? 4 : 2) * pressure(d * i / kParts);
    return sum * d / (3 * kParts);
  }

 private:
  std::array<LayerSpring, 2> springs_;
  PressureLaw pressure_;
};

}  // namespace condyle::verification
