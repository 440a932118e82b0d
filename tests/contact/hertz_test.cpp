#include "condyle/contact/hertz.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

const ElasticSurface kSoft{10, 0.3, 0}, kHard{2000, 0.2, 0};

/// 1/E* of both sides.
double compliance(const ElasticSurface& a, const ElasticSurface& b) {
  return (1 - a.poisson * a.poisson) / a.modulus + (1 - b.poisson * b.poisson) / b.modulus;
}

// Hertz's sphere: a³ = 3PR/(4E*), δ = a²/R, p0 = 3P/(2πa²). The same for crossed equal cylinders.
TEST(Hertz, SphereOnPlane) {
  const double P = 300, R = 25, C = compliance(kSoft, kHard);
  const auto contact = elastic_contact(P, {1 / R, 1 / R}, kSoft, kHard);
  ASSERT_TRUE(contact);
  const double a = std::cbrt(0.75 * P * R * C);
  EXPECT_NEAR(contact->semi_major, a, 1e-7 * a);
  EXPECT_NEAR(contact->semi_minor, a, 1e-7 * a);
  EXPECT_NEAR(contact->approach, a * a / R, 1e-6);
  EXPECT_NEAR(contact->peak_pressure, 1.5 * P / (M_PI * a * a), 1e-6);
}

/// Displacement of both half spaces under the pressure p0 √(1 - x²/a² - y²/b²) at a point within
/// the ellipse, by adding up Boussinesq's 1/(π E* r) in polar coordinates about the point: along a
/// ray the pressure is p0 √(A - 2Bs - Cs²), whose integral from 0 to its zero is in closed form.
double displacement(const ElasticContact& c, double inverse_E, double x, double y) {
  const double a = c.semi_major, b = c.semi_minor;
  constexpr int kRays = 2000;
  double sum = 0;
  for (int k = 0; k < kRays; ++k) {
    const double angle = 2 * M_PI * (k + 0.5) / kRays, u = std::cos(angle), v = std::sin(angle);
    const double A = 1 - x * x / (a * a) - y * y / (b * b);
    const double B = x * u / (a * a) + y * v / (b * b), C = u * u / (a * a) + v * v / (b * b);
    const double D = A + B * B / C;  // = C (half chord)²
    // ∫ √(D - C (s + B/C)²) ds from s = 0 to the edge
    const double from = B / std::sqrt(C * D);
    sum +=
        D / std::sqrt(C) * 0.5 * (M_PI / 2 - std::asin(from) - from * std::sqrt(1 - from * from));
  }
  return inverse_E / M_PI * c.peak_pressure * sum * 2 * M_PI / kRays;
}

// What makes it Hertz's solution: under the elliptical pressure the surfaces sink by δ - Ax² - By²
// everywhere within the ellipse, and the pressure adds up to P.
TEST(Hertz, TheEllipseFitsTheGap) {
  const double C = compliance(kSoft, kHard);
  for (const double ratio : {0.9, 0.3, 0.02}) {
    const double P = 500, B = 0.03, A = ratio * B;
    const auto contact = elastic_contact(P, {2 * A, 2 * B}, kSoft, kHard);
    ASSERT_TRUE(contact);
    const double a = contact->semi_major, b = contact->semi_minor;
    EXPECT_NEAR(2. / 3 * M_PI * a * b * contact->peak_pressure, P, 1e-9 * P);
    for (const double x : {0.0, 0.4, 0.8})
      for (const double y : {0.0, 0.5}) {
        const double gap = contact->approach - A * x * x * a * a - B * y * y * b * b;
        EXPECT_NEAR(displacement(*contact, C, x * a, y * b), gap, 1e-5 * contact->approach)
            << ratio << " at " << x << " a, " << y << " b";
      }
  }
}

// Sides count by the sum of their compliances, so the order and a rigid side do not matter.
TEST(Hertz, ARigidSideIsOneThatDoesNotYield) {
  const ElasticSurface stiff{1e15, 0.3, 0};
  const auto one = elastic_contact(100, {0.01, 0.04}, kSoft, std::nullopt);
  const auto other = elastic_contact(100, {0.01, 0.04}, stiff, kSoft);
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(one->semi_major, other->semi_major, 1e-9);
  EXPECT_NEAR(one->approach, other->approach, 1e-9);
}

// Layers: the pressure k (δ - Ax² - By²) over the ellipse adds up to P; k of 2 mm with E = 5, ν =
// 0.4.
TEST(Hertz, LayersCarryTheForce) {
  const ElasticSurface thin{5, 0.4, 2}, thick{8, 0.45, 3};
  const double P = 400, A = 0.008, B = 0.03;
  const auto contact = elastic_contact(P, {2 * A, 2 * B}, thin, thick);
  ASSERT_TRUE(contact);
  const double k = 1 / (2 * 1.4 * 0.2 / (5 * 0.6) + 3 * 1.45 * 0.1 / (8 * 0.55));
  EXPECT_NEAR(contact->peak_pressure, k * contact->approach, 1e-9 * contact->peak_pressure);
  constexpr int kCells = 800;
  double sum = 0;
  const double dx = 2 * contact->semi_major / kCells, dy = 2 * contact->semi_minor / kCells;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double x = (i + 0.5) * dx - contact->semi_major;
      const double y = (j + 0.5) * dy - contact->semi_minor;
      sum += std::max(0.0, k * (contact->approach - A * x * x - B * y * y)) * dx * dy;
    }
  EXPECT_NEAR(sum, P, 1e-4 * P);
}

TEST(Hertz, SaysNothingWhereThereIsNoEllipse) {
  const ElasticSurface layer{5, 0.4, 2};
  EXPECT_FALSE(elastic_contact(100, {0.0, 0.1}, kSoft, kHard));    // a line
  EXPECT_FALSE(elastic_contact(100, {-0.01, 0.1}, kSoft, kHard));  // no contact
  EXPECT_FALSE(elastic_contact(0, {0.01, 0.1}, kSoft, kHard));     // open
  EXPECT_FALSE(elastic_contact(100, {0.01, 0.1}, std::nullopt, std::nullopt));
  EXPECT_FALSE(elastic_contact(100, {0.01, 0.1}, kSoft, layer));
}

}  // namespace
}  // namespace condyle
