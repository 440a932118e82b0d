#pragma once

/// The pressure of elastic layers for the 3-D view: a byte for each vertex of the articular
/// surfaces at each pose.

#include <string>
#include <vector>

#include "condyle/exchange/run_shapes.h"
#include "condyle/exchange/shown_poses.h"

namespace condyle {

struct ViewerPressures {
  double top = 0;  ///< pressure of 255 [N/mm²]; 0: the run has none
  struct OfSurface {
    std::string name;
    std::string levels;  ///< a byte each, vertex after vertex, pose after pose: 1 to 255 from no
                         ///< pressure to `top`, 0 where nothing is pressed
  };
  std::vector<OfSurface> surfaces;
};

/// Of the shapes that are articular surfaces; they are made only for a run that has pressures.
/// Empty in a build without pictures.
[[nodiscard]] ViewerPressures viewer_pressures(const Run& run,
                                               const ShapeOptions& options,
                                               const std::vector<ShownPose>& shown);

}  // namespace condyle
