#include "condyle/contact/hertz.h"

#include <cmath>

namespace condyle {
namespace {

/// A/B as a function of m = (b/a)², falling from 1 to 0 as the ellipse gets longer.
double curvature_ratio(double m) {
  const double e = std::sqrt(1 - m);
  if (e < 1e-4) return 1 - 0.75 * e * e;  // series; the formula cancels
  const double K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
  return m * (K - E) / (E - m * K);
}

/// The m that has a given A/B: bisection on log m, in which the ratio is monotone.
double axes_ratio_squared(double ratio) {
  double low = -60, high = 0;
  for (int k = 0; k < 200 && high - low > 1e-15 * (1 - low); ++k) {
    const double middle = (low + high) / 2;
    (curvature_ratio(std::exp(middle)) < ratio ? low : high) = middle;
  }
  return std::exp((low + high) / 2);
}

double bulk_compliance(const std::optional<ElasticSurface>& side) {
  return side ? (1 - side->poisson * side->poisson) / side->modulus : 0;
}

double layer_compliance(const std::optional<ElasticSurface>& side) {
  if (!side) return 0;
  const double nu = side->poisson;
  return side->layer * (1 + nu) * (1 - 2 * nu) / (side->modulus * (1 - nu));
}

ElasticContact bulk_contact(double force, double A, double B, double compliance) {
  const double m = axes_ratio_squared(A / B), e = std::sqrt(1 - m);
  const double K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
  ElasticContact contact;
  contact.semi_major = std::cbrt(3 * force * E * compliance / (2 * M_PI * (A + B) * m));
  contact.semi_minor = contact.semi_major * std::sqrt(m);
  contact.peak_pressure = 3 * force / (2 * M_PI * contact.semi_major * contact.semi_minor);
  contact.approach = contact.peak_pressure * contact.semi_minor * K * compliance;
  return contact;
}

ElasticContact layer_contact(double force, double A, double B, double compliance) {
  ElasticContact contact;
  contact.approach = std::sqrt(2 * force * compliance * std::sqrt(A * B) / M_PI);
  contact.semi_major = std::sqrt(contact.approach / A);
  contact.semi_minor = std::sqrt(contact.approach / B);
  contact.peak_pressure = contact.approach / compliance;
  return contact;
}

}  // namespace

std::optional<ElasticContact> elastic_contact(double force,
                                              const std::array<double, 2>& relative_curvature,
                                              const std::optional<ElasticSurface>& on_B,
                                              const std::optional<ElasticSurface>& on_A) {
  const double A = relative_curvature[0] / 2, B = relative_curvature[1] / 2;
  if (!(A > 0) || !(B >= A) || !(force > 0) || !(on_B || on_A)) return std::nullopt;
  const bool layer_B = on_B && on_B->layer > 0, layer_A = on_A && on_A->layer > 0;
  const bool bulk_B = on_B && !layer_B, bulk_A = on_A && !layer_A;
  if ((layer_B && bulk_A) || (bulk_B && layer_A)) return std::nullopt;
  if (layer_B || layer_A)
    return layer_contact(force, A, B, layer_compliance(on_B) + layer_compliance(on_A));
  return bulk_contact(force, A, B, bulk_compliance(on_B) + bulk_compliance(on_A));
}

}  // namespace condyle
