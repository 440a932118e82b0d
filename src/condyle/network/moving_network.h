#pragma once

/// A network as a system of differential equations: its state, its equations and the integrator
/// that takes it on in time.
///
/// One evaluation serves a whole step: the projection onto the constraints and the search for
/// events look at a state that differs from the one evaluated last by about the tolerance, and go
/// there along the tangents.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "condyle/network/integrate_options.h"
#include "condyle/network/motion.h"
#include "condyle/network/ode_integrator.h"
#include "condyle/network/state_numbers.h"

namespace condyle {

class MovingNetwork {
 public:
  /// Keeps a reference to the network. Throws InputError for an inconsistent one or a body without
  /// mass.
  MovingNetwork(const Network& network, NetworkState start, const IntegrationOptions& options);
  MovingNetwork(const MovingNetwork&) = delete;
  MovingNetwork& operator=(const MovingNetwork&) = delete;

  /// Throws InputError for a start that violates its constraints, and puts it exactly onto them.
  void check_start();

  [[nodiscard]] NetworkState& state() { return state_; }
  [[nodiscard]] OdeIntegrator& ode() { return ode_; }

  /// What is needed to take a stretch of time back.
  struct Moment {
    double t;
    std::vector<double> numbers;
    NetworkState state;
    std::vector<double> paths;  ///< how strings lie, which they go on from
  };
  [[nodiscard]] Moment moment(double t);
  void go_back(const Moment& moment);

  /// After an event: contacts whose root was found.
  [[nodiscard]] std::vector<int> found() const;
  /// The state from the present numbers, put onto the constraints. False where that fails.
  bool land(double t);
  /// Of the state; then restart() has to follow.
  [[nodiscard]] bool change_contacts(const std::vector<int>& struck,
                                     const std::vector<int>& released,
                                     std::vector<ContactEvent>& events);
  /// From the state.
  void restart(double t);
  /// From a frame alone: what is computed from now on does not depend on anything before it.
  void begin_anew(const MotionFrame& frame);
  /// Adds a frame of the state, which lies on the constraints.
  bool record(Motion& motion);

  /// A closed contact whose surfaces have come to bend alike in one direction: its point runs away,
  /// and the contact will be somewhere else.
  [[nodiscard]] std::optional<std::string> lost_contact();

 private:
  [[nodiscard]] OdeSystem system();
  bool evaluate(double t, const double* y);
  bool project(double t, const double* y, double* correction, double* error);
  bool find_events(double t, const double* y, double* values);
  [[nodiscard]] bool event_is_far(const double* values) const;
  bool set_event_values(double* values);

  const Network& network_;
  IntegrationOptions options_;
  NetworkEquations equations_;
  NetworkState state_;
  StateNumbers numbers_;
  std::vector<int> watched_;  ///< contacts that open and close
  double remainder_;          ///< what tangents may leave out [mm]
  double evaluated_ = NAN;    ///< the time at which the equations are solved
  double dissipated_ = 0, work_ = 0;
  OdeIntegrator ode_;
};

}  // namespace condyle
