#include "condyle/design/spread.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace condyle {

namespace {

/// P(Z > z) of a standard normal number, accurate for large z.
double upper_tail(double z) { return std::erfc(z / std::numbers::sqrt2) / 2; }

/// z with P(Z > z) = q, 0 < q < 1.
double upper_quantile(double q) { return std::numbers::sqrt2 * boost::math::erfc_inv(2 * q); }

/// Of a standard normal number given a < Z < b. The quantile is told from whichever tail is smaller,
/// each a sum of positive numbers.
double cut_normal_quantile(double a, double b, double u) {
  if (a > 0)
    return -cut_normal_quantile(-b, -a, 1 - u);  // now a <= 0: the mass is next to b or within
  const double below = upper_tail(-a);
  const double above = upper_tail(b);
  const double mass = b < 0 ? upper_tail(-b) - below : 1 - below - above;
  const double from_below = below + u * mass;
  const double from_above = above + (1 - u) * mass;
  if (!(mass > 0) || from_below == 0) return b < 0 ? b : 0;
  return from_below < from_above ? -upper_quantile(from_below) : upper_quantile(from_above);
}

}  // namespace

double quantile(const Spread& spread, double u) {
  const auto [lower, upper] = spread.bounds;
  switch (spread.kind) {
    case Spread::Kind::kBits:
      return u;
    case Spread::Kind::kUniform:
      return std::clamp(lower + u * (upper - lower), lower, upper);
    case Spread::Kind::kNormal:
      break;
  }
  const double z = cut_normal_quantile(lower / spread.sd, upper / spread.sd, u);
  return std::clamp(spread.sd * z, lower, upper);
}

}  // namespace condyle
