#pragma once

/// What a run tells of a motion beside its poses: energies, events, how well the balance was kept.
/// Plain numbers, so that those who show them need nothing of the room `network`.

#include <optional>
#include <string>
#include <vector>

#include "condyle/results/run_file.h"

namespace condyle {

/// At one frame [N mm].
struct MotionEnergies {
  double time = 0;  ///< [s]
  double kinetic = 0, gravity = 0, elastic = 0;
  double layers = 0;                ///< of elastic layers
  double dissipated = 0, work = 0;  ///< since the start; work of the loads
  double balance = 0;               ///< their sum, constant along a motion
};

struct MotionEvent {
  double time = 0;      ///< [s]
  std::string contact;  ///< name in the scene
  bool closing = false;
  double speed = 0;  ///< at which the gap closed [mm/s]
};

struct MotionView {
  bool completed = false;
  std::string reason;  ///< where it is not completed
  std::vector<MotionEnergies> energies;
  std::vector<MotionEvent> events;
  bool layered = false;  ///< some energy is that of elastic layers
  /// What only the motion that was just computed tells; a file has none of it.
  struct Computed {
    long steps = 0;        ///< of the integrator
    double seconds = 0;    ///< of computing
    double imbalance = 0;  ///< largest departure of the balance, over the largest energy met
  };
  std::optional<Computed> computed;
  /// From the first to the last frame [N mm].
  [[nodiscard]] double change(double MotionEnergies::*part) const {
    return energies.empty() ? 0 : energies.back().*part - energies.front().*part;
  }
};

/// Nothing for a run that is no motion.
[[nodiscard]] std::optional<MotionView> motion_view(const Run& run);

}  // namespace condyle
