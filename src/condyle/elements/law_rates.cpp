#include "condyle/elements/law_rates.h"

namespace condyle {
namespace {

// With f(ε): ∂f/∂l₀ = -f_ε L/l₀².
LawRates rates_of(const ToeLinearLaw& law, double length) {
  const double k = law.stiffness, eps_t = law.transition_strain, l0 = law.slack_length;
  const double eps = length / l0 - 1;
  if (!(eps > 0)) return {};
  const double by_l0 = -length / (l0 * l0);
  if (eps >= eps_t) return {k * by_l0, eps - eps_t / 2, -k / 2};
  const double part = eps / eps_t;
  return {k * part * by_l0, eps * part / 2, -k * part * part / 2};
}

LawRates rates_of(const QuadraticLaw& law, double length) {
  const double x = length - law.slack_length;
  if (!(x > 0)) return {};
  return {-2 * law.stiffness * x, x * x, 0};
}

}  // namespace

std::optional<LawRates> law_rates(const ForceLaw& law, double length) {
  if (const auto* toe_linear = std::get_if<ToeLinearLaw>(&law))
    return rates_of(*toe_linear, length);
  if (const auto* quadratic = std::get_if<QuadraticLaw>(&law)) return rates_of(*quadratic, length);
  return std::nullopt;
}

void set_slack_length(ForceLaw& law, double slack_length) {
  if (auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) toe_linear->slack_length = slack_length;
  if (auto* quadratic = std::get_if<QuadraticLaw>(&law)) quadratic->slack_length = slack_length;
}

}  // namespace condyle
