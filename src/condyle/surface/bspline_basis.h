#pragma once

/// B-spline basis functions of degree p over a knot vector [Piegl and Tiller 1997,
/// sections 2.2-2.3].

#include <array>
#include <vector>

namespace condyle {

inline constexpr int kMaxDegree = 5;

/// The p + 1 basis functions that do not vanish at t and their first three derivatives.
struct BasisValues {
  int first = 0;  ///< index of the first of them
  std::array<std::array<double, kMaxDegree + 1>, 4>
      d{};  ///< d[k][j]: k-th derivative of B_{first+j}
};

/// Index i of the knot span with knots[i] <= t < knots[i+1], within [degree, n-1], n = number of
/// basis functions; t outside the domain gets the first or the last span.
[[nodiscard]] int find_span(const std::vector<double>& knots, int degree, double t);

/// Basis and `order` derivatives (0 to 3) at t. Polynomial continuation outside the domain.
[[nodiscard]] BasisValues basis(const std::vector<double>& knots, int degree, double t, int order);

/// Uniform knots for n basis functions of the degree over [a, b]; not clamped: the spline is a
/// restriction of a cardinal spline, equally smooth up to the boundary.
[[nodiscard]] std::vector<double> uniform_knots(int n, int degree, double a, double b);

}  // namespace condyle
