#include "condyle/math/round_ticks.h"

#include <algorithm>
#include <cmath>

namespace condyle {

std::vector<double> round_ticks(double low, double high, int most) {
  if (!(high - low > 1e-12 * std::max(std::abs(low), std::abs(high))) || most < 1) return {};
  const double least = (high - low) / most, power = std::pow(10, std::floor(std::log10(least)));
  double step = 10 * power;
  for (const double part : {1.0, 2.0, 5.0}) {
    if (part * power < least * (1 - 1e-9)) continue;
    step = part * power;
    break;
  }
  std::vector<double> ticks;
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n)
    ticks.push_back(n == 0 ? 0 : n * step);
  return ticks;
}

}  // namespace condyle
