#include "condyle/verify/laws.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace condyle::verification {
namespace {

double force_of(const ToeLinearLaw& law, double length) {
  const double strain = (length - law.slack_length) / law.slack_length;
  if (strain <= 0) return 0;
  if (strain < law.transition_strain)
    return law.stiffness * strain * strain / (2 * law.transition_strain);
  return law.stiffness * (strain - law.transition_strain / 2);
}

double force_of(const QuadraticLaw& law, double length) {
  const double stretch = std::max(0.0, length - law.slack_length);
  return law.stiffness * stretch * stretch;
}

double force_of(const PolynomialLaw& law, double length) {
  double force = 0, power = 1;
  for (const double c : law.coefficients) force += c * power, power *= length;
  return law.tension_only ? std::max(0.0, force) : force;
}

/// Slope of the parabola through three neighbours at the middle one.
double middle_slope(const std::vector<double>& x, const std::vector<double>& y, std::size_t i) {
  const double h = x[i] - x[i - 1], k = x[i + 1] - x[i];
  return ((y[i] - y[i - 1]) / h * k + (y[i + 1] - y[i]) / k * h) / (h + k);
}

/// Hermite's cubic between the entries; slopes that would overshoot are cut [Fritsch and Carlson
/// 1980].
double force_of(const TableLaw& law, double length) {
  const std::vector<double>&x = law.lengths, &y = law.forces;
  const std::size_t n = x.size();
  std::vector<double> secant, m(n);
  for (std::size_t i = 0; i + 1 < n; ++i) secant.push_back((y[i + 1] - y[i]) / (x[i + 1] - x[i]));
  m.front() = m.back() = secant.front();
  for (std::size_t i = 1; i + 1 < n; ++i) m[i] = middle_slope(x, y, i);
  if (n > 2) {
    m.front() = 2 * secant.front() - m[1];
    m.back() = 2 * secant.back() - m[n - 2];
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (m[i] * secant[i] <= 0) m[i] = 0;
    if (m[i + 1] * secant[i] <= 0) m[i + 1] = 0;
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double over = std::hypot(m[i], m[i + 1]) / 3, least = std::abs(secant[i]);
    if (over > least) m[i] *= least / over, m[i + 1] *= least / over;
  }
  if (length <= x.front()) return y.front() + m.front() * (length - x.front());
  if (length >= x.back()) return y.back() + m.back() * (length - x.back());
  std::size_t i = 0;
  while (length >= x[i + 1]) ++i;
  const double h = x[i + 1] - x[i], t = (length - x[i]) / h, s = 1 - t;
  return y[i] * s * s * (1 + 2 * t) + y[i + 1] * t * t * (3 - 2 * t) +
         h * t * s * (m[i] * s - m[i + 1] * t);
}

double force_of(const CustomLaw& law, double length) { return law.tension(length).force; }

}  // namespace

double force_at(const ForceLaw& law, double length) {
  return std::visit([length](const auto& any) { return force_of(any, length); }, law);
}

double slope_at(const ForceLaw& law, double length) {
  const double h = 1e-6 * length;
  return (force_at(law, length + h) - force_at(law, length - h)) / (2 * h);
}

double work_between(const ForceLaw& law, double from, double to) {
  return (to - from) / 6 *
         (force_at(law, from) + 4 * force_at(law, (from + to) / 2) + force_at(law, to));
}

}  // namespace condyle::verification
