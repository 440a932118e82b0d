#include "condyle/contact/layer_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace condyle {
namespace {

/// 1 - (1 + x) exp(-x), which is x²/2 - x³/3 + x⁴/8 - ... and would cancel for a small x.
double energy_of(double x) {
  if (x > 0.02) return -std::expm1(-x) - x * std::exp(-x);
  return x * x * (1. / 2 - x * (1. / 3 - x * (1. / 8 - x * (1. / 30 - x * (1. / 144 - x / 840)))));
}

}  // namespace

double confined_modulus(const ElasticSurface& layer) {
  const double nu = layer.poisson;
  return layer.modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
}

LayerLaw::LayerLaw(const std::optional<ElasticSurface>& on_B,
                   const std::optional<ElasticSurface>& on_A,
                   PressureLaw pressure)
    : law_(pressure) {
  double softness = 0;
  const std::array<const std::optional<ElasticSurface>*, 2> given = {&on_B, &on_A};
  for (std::size_t i = 0; i < 2; ++i) {
    if (!*given[i]) continue;
    const ElasticSurface& layer = **given[i];
    if (!(layer.layer > 0 && layer.modulus > 0))
      throw std::invalid_argument("a layer needs a thickness and a modulus above 0");
    if (!(layer.poisson >= 0 && layer.poisson <= kGreatestLayerPoisson))
      throw std::invalid_argument("the Poisson's ratio of a layer must lie within 0 and 0.49");
    sides_[i] = {confined_modulus(layer), layer.layer, layer.modulus / (2 + 2 * layer.poisson)};
    softness += sides_[i].h / sides_[i].K;
  }
  if (!(softness > 0)) throw std::invalid_argument("neither surface has a layer");
  k_ = 1 / softness;
}

double LayerLaw::deepest() const {
  return (law_ == PressureLaw::kLinear ? 0.5 : 0.9) * thickness();
}

double LayerLaw::lateral_length() const {
  double longest = 0;
  for (const Side& side : sides_)
    longest = std::max(longest, side.h * std::sqrt(side.K / (3 * side.mu)));
  return longest;
}

LayerLaw::Answer LayerLaw::logarithmic_at(double d) const {
  const double beyond = d - deepest();
  if (!(beyond > 0)) return logarithmic(d);
  const Answer edge = logarithmic(deepest());
  return {edge.pressure + edge.stiffness * beyond,
          edge.energy + beyond * (edge.pressure + 0.5 * edge.stiffness * beyond), edge.stiffness};
}

// Σ d_i(p/K_i) = d with d_i = h p/K or h (1 - exp(-p/K)): each side gives way by its share of Σ ∂d_i/∂p.
std::array<double, 2> LayerLaw::pressure_by_moduli(double d) const {
  const double p = at(d).pressure;
  std::array<double, 2> shares{};
  double softness = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Side& side = sides_[i];
    shares[i] = side.h / side.K * (law_ == PressureLaw::kLinear ? 1 : std::exp(-p / side.K));
    softness += shares[i];
  }
  for (double& share : shares) share *= p / softness;
  return shares;
}

/// Newton for p in Σ h (1 - exp(-p/K)) = d: the sum is concave, so from the linear pressure the
/// iterates grow towards the root and never pass it.
LayerLaw::Answer LayerLaw::logarithmic(double d) const {
  double p = k_ * d;
  for (int i = 0; i < 100; ++i) {
    double value = -d, slope = 0;
    for (const Side& side : sides_) {
      value -= side.h * std::expm1(-p / side.K);
      slope += side.h / side.K * std::exp(-p / side.K);
    }
    const double step = -value / slope;
    p += step;
    if (!(std::abs(step) > 4 * std::numeric_limits<double>::epsilon() * p)) break;
  }
  Answer answer{p, 0, 0};
  double softness = 0;
  for (const Side& side : sides_) {
    answer.energy += side.K * side.h * energy_of(p / side.K);
    softness += side.h / side.K * std::exp(-p / side.K);
  }
  answer.stiffness = 1 / softness;
  return answer;
}

}  // namespace condyle
