#pragma once

/// Ordinary differential equations dy/dt = f(t, y) on a manifold, with events: CVODE (SUNDIALS)
/// behind plain numbers.
///
/// Backward differentiation where states are projected, Adams' method where they are not; implicit
/// steps by fixed-point iteration.

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace condyle {

/// Each function may answer false: the step is tried again, shorter.
struct OdeSystem {
  std::function<bool(double t, const double* y, double* rate)> rate;
  /// What to add to y so that it lies on the manifold, and the part of `error` that stays on it.
  /// Absent: there is no manifold.
  std::function<bool(double t, const double* y, double* correction, double* error)> project;
  /// Events are where one of `event_count` functions falls through zero.
  std::function<bool(double t, const double* y, double* values)> events;
  int event_count = 0;
};

enum class OdeOutcome { kReached, kEvent, kFailed };

class OdeIntegrator {
 public:
  /// `absolute`: tolerances of the numbers, beside the relative one.
  OdeIntegrator(OdeSystem system,
                double t,
                std::vector<double> y,
                double relative,
                std::vector<double> absolute,
                long most_steps);
  OdeIntegrator(const OdeIntegrator&) = delete;
  OdeIntegrator& operator=(const OdeIntegrator&) = delete;
  ~OdeIntegrator();

  /// Goes on from t to `to` or the next event, changing t and y. No step sees a time after
  /// `not_beyond`; y between steps is interpolated.
  OdeOutcome advance(double& t, double to, double not_beyond);
  /// After kEvent: which functions fell through zero.
  [[nodiscard]] std::vector<int> found() const;
  /// After kFailed.
  [[nodiscard]] std::string reason() const;

  /// The present numbers.
  [[nodiscard]] double* y();
  /// Forgets the past and starts anew from t and the present numbers.
  void restart(double t);

  [[nodiscard]] long steps() const;        ///< of all starts
  [[nodiscard]] long evaluations() const;  ///< of the rate

 private:
  struct Memory;
  std::unique_ptr<Memory> m_;
};

}  // namespace condyle
