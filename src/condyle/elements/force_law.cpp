#include "condyle/elements/force_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "condyle/input_error.h"

namespace condyle {
namespace {

Tension tension_of(const ToeLinearLaw& law, double length) { return tension(law, length); }

Tension tension_of(const QuadraticLaw& law, double length) {
  const double x = length - law.slack_length;
  if (x <= 0) return {0, 0, 0};
  return {law.stiffness * x * x, 2 * law.stiffness * x, law.stiffness * x * x * x / 3};
}

/// Value, slope and integral from 0, by Horner.
Tension polynomial(const std::vector<double>& c, double x) {
  Tension t{0, 0, 0};
  for (std::size_t i = c.size(); i-- > 0;) {
    t.slope = t.slope * x + t.force;
    t.force = t.force * x + c[i];
    t.energy = t.energy * x + c[i] / static_cast<double>(i + 1);
  }
  t.energy *= x;
  return t;
}

/// The length between `slack` and `taut` where the force changes sign.
double bisected_root(const std::vector<double>& c, double slack, double taut) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (slack + taut) / 2;
    (polynomial(c, middle).force > 0 ? taut : slack) = middle;
  }
  return taut;
}

/// ∫ max(f, 0) dL from 0 to L. Two changes of sign closer than L/32 may be missed.
double energy_of_taut_lengths(const std::vector<double>& c, double length) {
  constexpr int kSteps = 32;
  double energy = 0, x = 0;
  Tension at_x = polynomial(c, x);
  for (int i = 1; i <= kSteps; ++i) {
    const double y = length * i / kSteps;
    const Tension at_y = polynomial(c, y);
    if (at_x.force > 0 && at_y.force > 0) energy += at_y.energy - at_x.energy;
    if (at_x.force <= 0 && at_y.force > 0) {
      energy += at_y.energy - polynomial(c, bisected_root(c, x, y)).energy;
    }
    if (at_x.force > 0 && at_y.force <= 0) {
      energy += polynomial(c, bisected_root(c, y, x)).energy - at_x.energy;
    }
    x = y;
    at_x = at_y;
  }
  return energy;
}

Tension tension_of(const PolynomialLaw& law, double length) {
  Tension t = polynomial(law.coefficients, length);
  if (!law.tension_only) return t;
  if (t.force <= 0) t.force = t.slope = 0;
  t.energy = energy_of_taut_lengths(law.coefficients, length);
  return t;
}

Tension continued_from(double force, double slope, double energy, double x) {
  return {force + slope * x, slope, energy + (force + slope * x / 2) * x};
}

Tension tension_of(const TableLaw& law, double length) {
  const std::vector<double>&l = law.lengths, &f = law.forces, &m = law.slopes, &E = law.energies;
  if (length <= l.front())
    return continued_from(f.front(), m.front(), E.front(), length - l.front());
  if (!(length < l.back()))  // nor where it is no number
    return continued_from(f.back(), m.back(), E.back(), length - l.back());
  const std::size_t i =
      static_cast<std::size_t>(std::upper_bound(l.begin(), l.end(), length) - l.begin()) - 1;
  // Cubic Hermite on [l_i, l_i+1] in powers of x = L - l_i.
  const double h = l[i + 1] - l[i], x = length - l[i];
  const double secant = (f[i + 1] - f[i]) / h;
  const double c2 = (3 * secant - 2 * m[i] - m[i + 1]) / h;
  const double c3 = (m[i] + m[i + 1] - 2 * secant) / (h * h);
  return {f[i] + x * (m[i] + x * (c2 + x * c3)), m[i] + x * (2 * c2 + x * 3 * c3),
          E[i] + x * (f[i] + x * (m[i] / 2 + x * (c2 / 3 + x * c3 / 4)))};
}

Tension tension_of(const CustomLaw& law, double length) { return law.tension(length); }

void check_table(const std::vector<double>& lengths, const std::vector<double>& forces) {
  if (lengths.size() != forces.size()) {
    throw InputError(
        fmt::format("law \"table\": {} lengths and {} forces, expected as many of each",
                    lengths.size(), forces.size()));
  }
  if (lengths.size() < 2) {
    throw InputError(fmt::format("law \"table\": {} entries, expected at least 2", lengths.size()));
  }
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!std::isfinite(forces[i])) {
      throw InputError(
          fmt::format("law \"table\": forces[{}] = {}, expected a number", i, forces[i]));
    }
    if (!std::isfinite(lengths[i]) || (i > 0 && lengths[i] <= lengths[i - 1])) {
      throw InputError(fmt::format(
          "law \"table\": lengths[{}] = {}, expected lengths that increase from entry to entry", i,
          lengths[i]));
    }
  }
}

/// Slopes of the parabolas through three neighbours.
std::vector<double> parabolic_slopes(const std::vector<double>& h,
                                     const std::vector<double>& secant) {
  const std::size_t last = h.size();
  std::vector<double> m(last + 1, secant.front());
  if (last == 1) return m;
  for (std::size_t i = 1; i < last; ++i) {
    m[i] = (h[i] * secant[i - 1] + h[i - 1] * secant[i]) / (h[i - 1] + h[i]);
  }
  m.front() = 2 * secant.front() - m[1];
  m.back() = 2 * secant.back() - m[last - 1];
  return m;
}

/// Keeps each cubic monotone: slopes of the secant's sign, (m_i, m_i+1)/secant within a circle of
/// radius 3.
void limit_slopes(const std::vector<double>& secant, std::vector<double>& m) {
  for (std::size_t i = 0; i < secant.size(); ++i) {
    if (m[i] * secant[i] <= 0) m[i] = 0;
    if (m[i + 1] * secant[i] <= 0) m[i + 1] = 0;
  }
  for (std::size_t i = 0; i < secant.size(); ++i) {
    const double radius = std::hypot(m[i], m[i + 1]), largest = 3 * std::abs(secant[i]);
    if (radius <= largest) continue;
    m[i] *= largest / radius;
    m[i + 1] *= largest / radius;
  }
}

}  // namespace

TableLaw make_table_law(std::vector<double> lengths, std::vector<double> forces) {
  check_table(lengths, forces);
  const std::size_t intervals = lengths.size() - 1;
  std::vector<double> h(intervals), secant(intervals);
  for (std::size_t i = 0; i < intervals; ++i) {
    h[i] = lengths[i + 1] - lengths[i];
    secant[i] = (forces[i + 1] - forces[i]) / h[i];
  }
  std::vector<double> m = parabolic_slopes(h, secant);
  limit_slopes(secant, m);
  std::vector<double> energies(intervals + 1, 0.0);
  for (std::size_t i = 0; i < intervals; ++i) {
    energies[i + 1] =
        energies[i] + h[i] * (forces[i] + forces[i + 1]) / 2 + h[i] * h[i] * (m[i] - m[i + 1]) / 12;
  }
  return {std::move(lengths), std::move(forces), std::move(m), std::move(energies)};
}

Tension tension(const ForceLaw& law, double length) {
  return std::visit([length](const auto& any) { return tension_of(any, length); }, law);
}

double slack_length(const ForceLaw& law) {
  if (const auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) return toe_linear->slack_length;
  if (const auto* quadratic = std::get_if<QuadraticLaw>(&law)) return quadratic->slack_length;
  return 0;
}

}  // namespace condyle
