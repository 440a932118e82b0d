#pragma once

/// Jacobi's elliptic functions by descending Landen transformation [Abramowitz and Stegun 1964,
/// 16.4].

#include <cmath>
#include <vector>

namespace condyle::test {

struct Jacobi {
  double sn, cn, dn;
};

/// Modulus k, 0 <= k < 1.
inline Jacobi jacobi(double u, double k) {
  std::vector<double> a = {1}, c = {k};
  double b = std::sqrt(1 - k * k);
  while (std::abs(c.back()) > 1e-16) {
    const double mean = (a.back() + b) / 2;
    c.push_back((a.back() - b) / 2);
    b = std::sqrt(a.back() * b);
    a.push_back(mean);
  }
  double phi = std::ldexp(a.back() * u, static_cast<int>(a.size()) - 1);
  for (std::size_t n = a.size() - 1; n > 0; --n)
    phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  const double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - k * k * sn * sn)};
}

}  // namespace condyle::test
