#include "condyle/network/ode_integrator.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

/// A point on the unit circle, kept there, that falls through y = 0 at π.
OdeSystem circle() {
  OdeSystem system;
  system.rate = [](double, const double* y, double* rate) {
    rate[0] = -y[1];
    rate[1] = y[0];
    return true;
  };
  system.project = [](double, const double* y, double* correction, double* error) {
    const double r = std::hypot(y[0], y[1]);
    for (int k = 0; k < 2; ++k) correction[k] = y[k] / r - y[k];
    if (error == nullptr) return true;
    const double radial = (error[0] * y[0] + error[1] * y[1]) / (r * r);
    for (int k = 0; k < 2; ++k) error[k] -= radial * y[k];
    return true;
  };
  system.events = [](double, const double* y, double* values) {
    values[0] = y[1];
    return true;
  };
  system.event_count = 1;
  return system;
}

TEST(OdeIntegrator, StopsWhereAFunctionFallsThroughZero) {
  OdeIntegrator ode(circle(), 0, {1, 0}, 1e-10, {1e-10, 1e-10}, 10000);
  double t = 0;
  ASSERT_EQ(ode.advance(t, 5, 10), OdeOutcome::kEvent);
  EXPECT_NEAR(t, M_PI, 1e-8);
  EXPECT_EQ(ode.found(), std::vector<int>{0});
  ASSERT_EQ(ode.advance(t, 5, 10), OdeOutcome::kReached);
  EXPECT_EQ(t, 5);
  EXPECT_NEAR(ode.y()[0], std::cos(5), 5e-8);                // errors of some 500 steps
  EXPECT_NEAR(std::hypot(ode.y()[0], ode.y()[1]), 1, 1e-9);  // interpolated
  EXPECT_GT(ode.evaluations(), ode.steps());
}

// From other numbers at another time; the counts go on.
TEST(OdeIntegrator, StartsAnew) {
  OdeIntegrator ode(circle(), 0, {1, 0}, 1e-10, {1e-10, 1e-10}, 10000);
  double t = 0;
  ASSERT_EQ(ode.advance(t, 1, 10), OdeOutcome::kReached);
  const long steps = ode.steps();
  ode.y()[0] = 0;
  ode.y()[1] = 1;
  t = 2;
  ode.restart(t);
  EXPECT_EQ(ode.steps(), steps);
  ASSERT_EQ(ode.advance(t, 3, 3), OdeOutcome::kReached);
  EXPECT_NEAR(ode.y()[0], -std::sin(1), 1e-8);
  EXPECT_GT(ode.steps(), steps);
}

TEST(OdeIntegrator, SaysWhyItFailed) {
  OdeIntegrator few(circle(), 0, {1, 0}, 1e-10, {1e-10, 1e-10}, 5);
  double t = 0;
  ASSERT_EQ(few.advance(t, 3, 3), OdeOutcome::kFailed);
  EXPECT_EQ(few.reason(), "too many steps for one frame");
  OdeSystem wall = circle();  // nothing is known beyond t = 1
  const auto rate = wall.rate;
  wall.rate = [rate](double time, const double* y, double* out) {
    return time < 1 && rate(time, y, out);
  };
  OdeIntegrator lost(wall, 0, {1, 0}, 1e-8, {1e-8, 1e-8}, 100000);
  t = 0;
  ASSERT_EQ(lost.advance(t, 3, 3), OdeOutcome::kFailed);
  EXPECT_NEAR(t, 1, 1e-3);
  EXPECT_FALSE(lost.reason().empty());
}

}  // namespace
}  // namespace condyle
