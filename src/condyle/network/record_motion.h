#pragma once

/// What is kept of a motion, and the audit of its energy.

#include "condyle/network/motion.h"
#include "condyle/network/network_equations.h"

namespace condyle {

/// Adds a frame from equations that are solved at `state`.
void record_frame(const NetworkEquations& equations,
                  const NetworkState& state,
                  double dissipated,
                  double driver_work,
                  Motion& motion);

/// Adds a frame as it was recorded.
void add_frame(MotionFrame frame, Motion& motion);

/// May a frame be of a motion that began with `first`, and go on?
[[nodiscard]] bool is_of_motion(const MotionFrame& frame, const MotionFrame& first);

}  // namespace condyle
