#pragma once

/// How a motion is integrated, and what an impact is like.

#include <vector>

#include "condyle/on_progress.h"

namespace condyle {

struct IntegrationOptions {
  double end = 1;            ///< [s]
  double interval = 0.01;    ///< of stored frames [s]
  double tolerance = 1e-9;   ///< relative, and absolute for quantities scaled to a knee
  double restitution = 0;    ///< 0 to 1, of the velocity along the normal
  double least_rebound = 1;  ///< a contact that would rebound more slowly stays closed [mm/s]
  std::vector<double> breaks = {};  ///< times at which a driver jumps [s]
  long most_steps = 200000;         ///< from one frame to the next
  long stretch =
      5000;  ///< steps, after which the integration begins anew at a frame (MotionStretch)
  OnProgress on_frame = {};  ///< told of each frame after the first
};

}  // namespace condyle
