#pragma once

/// What is kept of the motion of a network in time.

#include <string>
#include <vector>

#include "condyle/network/line_component.h"

namespace condyle {

struct EnergySum {
  double kinetic = 0, gravity = 0, elastic = 0;  ///< [N mm]; elastic: of lines
  double layers = 0;                             ///< of contacts with a law of their own [N mm]
  double dissipation = 0;                        ///< [N mm/s]
  double driver_power = 0;                       ///< [N mm/s], after solve()
  [[nodiscard]] double stored() const { return kinetic + gravity + elastic + layers; }
};

struct MotionFrame {
  NetworkState state;
  std::vector<double> contact_force, contact_gap;  ///< [N], [mm]
  std::vector<Eigen::Vector3d> contact_point;      ///< ground frame [mm]
  std::vector<LineState> lines;
  std::vector<double> paths;                 ///< what the paths of lines keep (PathLines::kept)
  std::vector<double> condition_multiplier;  ///< σ [N] or [N mm]
  EnergySum energy;
  double dissipated = 0, driver_work = 0;  ///< since the start [N mm]; impacts dissipate too
  /// Constant along a motion.
  [[nodiscard]] double balance() const { return energy.stored() + dissipated - driver_work; }
};

struct ContactEvent {
  double t = 0;
  int contact = 0;
  bool closing = false;
  double speed = 0;  ///< at which the gap closed [mm/s]
};

struct Motion {
  bool completed = false;
  std::string reason;  ///< where it is not completed: time and cause
  std::vector<MotionFrame> frames;
  std::vector<ContactEvent> events;
  long steps = 0, evaluations = 0;  ///< of the integrator
  /// Largest departure of the balance from its start, and the largest energy that was met [N mm].
  double largest_imbalance = 0, energy_scale = 0;
};

/// A stretch of a motion from behind one frame to another, at which the integration began anew from
/// that frame alone: whoever has all stretches up to there goes on with the same bits.
struct MotionStretch {
  std::vector<MotionFrame> frames;
  std::vector<ContactEvent> events;
  long steps = 0, evaluations = 0;
  double seconds = 0;  ///< of computing
};

}  // namespace condyle
