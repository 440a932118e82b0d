#include "condyle/study/quantiles.h"

#include <algorithm>

#include "condyle/math/no_number.h"

namespace condyle {

std::vector<double> take_quantiles(std::span<double> sample, std::span<const double> levels) {
  std::vector<double> quantiles(levels.size(), kNoNumber);
  if (sample.empty()) return quantiles;
  auto from = sample.begin();  // what is before it is in its place
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double place = levels[i] * static_cast<double>(sample.size() - 1);
    const auto whole = static_cast<std::ptrdiff_t>(place);
    const auto at = sample.begin() + whole;
    std::nth_element(from, at, sample.end());
    from = at;
    const double rest = place - static_cast<double>(whole);
    const double next = rest > 0 ? *std::min_element(at + 1, sample.end()) : *at;
    quantiles[i] = *at + rest * (next - *at);
  }
  return quantiles;
}

}  // namespace condyle
