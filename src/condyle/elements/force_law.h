#pragma once

/// Force laws f(L) of line elements, tension positive [N], length L [mm]. Each gives force, slope
/// and energy.
///
///   toe-linear   0 for ε = L/l₀ - 1 <= 0, k ε²/(2 ε_t), then k (ε - ε_t/2)  [Blankevoort 1991]
///   quadratic    k (L - l₀)² for L > l₀, else 0                             [Wismans 1980]
///   polynomial   c₀ + c₁ L + c₂ L² ..., cut off where negative if asked     [Dortmans 1986, 4]
///   table        monotone cubic, constant slope outside         [Fritsch and Carlson 1980]
///   custom       any function of yours

#include <functional>
#include <variant>
#include <vector>

namespace condyle {

struct Tension {
  double force;   ///< f [N]
  double slope;   ///< df/dL [N/mm]
  double energy;  ///< ∫ f dL from the slack length (or 0) [N mm]
};

struct ToeLinearLaw {
  double stiffness;                 ///< k, force per unit strain [N]
  double transition_strain = 0.06;  ///< ε_t [-], > 0
  double slack_length;              ///< l₀ [mm], > 0
};
struct QuadraticLaw {
  double stiffness;     ///< k [N/mm²]
  double slack_length;  ///< l₀ [mm], > 0
};
struct PolynomialLaw {
  std::vector<double> coefficients;  ///< c_i [N/mm^i]
  bool tension_only = false;
};
/// Built by make_table_law.
struct TableLaw {
  std::vector<double> lengths;  ///< strictly increasing [mm]
  std::vector<double> forces;   ///< [N]
  std::vector<double>
      slopes;  ///< at the lengths [N/mm], limited so that monotone data stay monotone
  std::vector<double> energies;  ///< ∫ f dL from lengths[0] [N mm]
};
[[nodiscard]] TableLaw make_table_law(std::vector<double> lengths, std::vector<double> forces);

struct CustomLaw {
  std::function<Tension(double length)>
      tension;  ///< must not allocate; twice differentiable energy
};

using ForceLaw = std::variant<ToeLinearLaw, QuadraticLaw, PolynomialLaw, TableLaw, CustomLaw>;

/// Force, slope and energy at length L [mm], L > 0.
[[nodiscard]] Tension tension(const ForceLaw& law, double length);

/// The law that most elements have, inline for speed.
[[nodiscard]] inline Tension tension(const ToeLinearLaw& law, double length) {
  const double k = law.stiffness, eps_t = law.transition_strain, l0 = law.slack_length;
  const double stretch = length - l0;
  if (!(stretch > 0)) return {0, 0, 0};
  const double eps = stretch / l0, slope = k / l0;
  if (eps >= eps_t)
    return {k * (eps - eps_t / 2), slope, k * (eps * (eps - eps_t) / 2 + eps_t * eps_t / 6) * l0};
  const double part = eps / eps_t;
  return {k * eps * part / 2, slope * part, k * eps * eps * part / 6 * l0};
}

/// Slack length [mm] for laws that have one (toe-linear, quadratic), else 0.
[[nodiscard]] double slack_length(const ForceLaw& law);

/// A strain is told of laws that have a slack length; of others the number stays 0 and says nothing.
[[nodiscard]] inline bool has_strain(const ForceLaw& law) { return slack_length(law) > 0; }

}  // namespace condyle
