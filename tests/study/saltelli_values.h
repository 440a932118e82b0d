#pragma once

/// Values of a function at the points of a design of Saltelli, in its order.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "condyle/design/sample_design.h"

namespace condyle {

template <class Function>
std::vector<double> saltelli_values(std::size_t parameters,
                                    std::uint64_t points,
                                    std::uint64_t seed,
                                    const Function& f) {
  const SampleDesign design(
      {.kind = DesignKind::kSaltelli, .dimensions = parameters, .points = points, .seed = seed});
  std::vector<double> y(design.size()), u;
  for (std::uint64_t k = 0; k < y.size(); ++k) {
    design.point(k, u);
    y[k] = f(u);
  }
  return y;
}

/// sin x₁ + 7 sin² x₂ + 0.1 x₃⁴ sin x₁ of -π < x < π.
inline double ishigami(const std::vector<double>& u) {
  const auto x = [&](std::size_t j) { return std::numbers::pi * (2 * u[j] - 1); };
  const double s1 = std::sin(x(0)), s2 = std::sin(x(1)), x3 = x(2);
  return s1 + 7 * s2 * s2 + 0.1 * x3 * x3 * x3 * x3 * s1;
}

/// Closed values of its indices.
struct IshigamiIndices {
  double first[3] = {0.313905, 0.442411, 0};
  double total[3] = {0.557589, 0.442411, 0.243684};
};

}  // namespace condyle
