#include "condyle/scene/sweep_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/scene/usable_number.h"

namespace condyle {

double in_unit(double inside, const Unit& unit) {
  if (unit.factor == 1) return inside;
  constexpr double kTwoConversions = 4 * std::numeric_limits<double>::epsilon();
  const double exact = inside / unit.factor;
  const double shorter = std::strtod(fmt::format("{:.14g}", exact).c_str(), nullptr);
  return std::abs(shorter - exact) <= kTwoConversions * std::abs(exact) ? shorter : exact;
}

std::vector<double> range_values(const WrittenRange& range) {
  const auto [from, to, step] = range;
  constexpr double kMost = 1e6, kRounding = 1e-9, kApart = 1e-10;
  if (!is_usable(from) || !is_usable(to) || !is_usable(step)) {
    throw InputError(fmt::format("from = {}, to = {}, step = {}, expected numbers below {:g}", from,
                                 to, step, kGreatestNumber));
  }
  if (from == to) return {from};
  if (step == 0 || (step > 0) != (to > from)) {
    throw InputError(fmt::format("step = {}, expected a step {} 0 to get from {} to {}", step,
                                 to > from ? ">" : "<", from, to));
  }
  const double steps = (to - from) / step;
  if (!(steps + 1 <= kMost)) {
    throw InputError(fmt::format("step = {}, expected at most {:.0f} values from {} to {}", step,
                                 kMost, from, to));
  }
  const double told_apart = kApart * std::max({1.0, std::abs(from), std::abs(to)});
  if (std::abs(step) < told_apart) {
    throw InputError(
        fmt::format("step = {}, expected at least {:.2g} from {} to {}: values nearer than that "
                    "are not told apart",
                    step, told_apart, from, to));
  }
  std::vector<double> values;
  const auto count = static_cast<int>(std::floor(steps + kRounding));
  for (int i = 0; i <= count; ++i) values.push_back(from + i * step);
  if (std::abs(values.back() - to) <= 2 * kRounding * std::abs(step)) values.back() = to;
  return values;
}

}  // namespace condyle
