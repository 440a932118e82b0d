#pragma once

/// Elastic contact estimated afterwards from the rigid solution: how a contact force would spread.
///
/// Two bulk materials (Hertz): half spaces with the relative curvatures of the contact touch in an
/// ellipse [Johnson 1985, section 4.2]. With A = κ1/2 <= B = κ2/2 the halves of the principal
/// relative curvatures, m = (b/a)², e² = 1 - m, K and E the complete elliptic integrals of modulus
/// e:
///     A/B = m (K - E)/(E - m K),     a³ = 3 P E/(2π E* (A + B) m),
///     p0 = 3 P/(2π a b),             δ = p0 b K/E*,     1/E* = Σ (1 - ν²)/E over both sides.
///
/// Thin layers on rigid bone (an elastic foundation): pressure = k (δ - gap), with the springs of
/// both layers in series, 1/k = Σ h (1 + ν)(1 - 2ν)/(E (1 - ν)) [Johnson 1985, section 4.3]. With
/// the gap A x² + B y²:  a² = δ/A, b² = δ/B, P = π k δ²/(2 √(A B)), p0 = k δ.

#include <array>
#include <optional>

namespace condyle {

struct ElasticSurface {
  double modulus = 0;  ///< Young's modulus [N/mm²], > 0
  double poisson = 0;  ///< in [0, 0.5)
  double layer = 0;    ///< thickness of a layer on a rigid body [mm]; 0: elastic throughout
};

struct ElasticContact {
  double semi_major = 0, semi_minor = 0;  ///< a >= b [mm]
  double peak_pressure = 0;               ///< p0 [N/mm²]
  double approach = 0;                    ///< δ [mm]
};

/// For a force P > 0 [N] and principal relative curvatures 0 < κ1 <= κ2 [1/mm]; a side that is
/// absent is rigid. Nothing where an argument is outside that range (a line or a conforming contact
/// has no ellipse), where both sides are rigid, or where a layer meets a bulk material.
[[nodiscard]] std::optional<ElasticContact> elastic_contact(
    double force,
    const std::array<double, 2>& relative_curvature,
    const std::optional<ElasticSurface>& on_B,
    const std::optional<ElasticSurface>& on_A);

}  // namespace condyle
