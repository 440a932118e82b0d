#pragma once

/// Where labels with leader lines go: in a column left or right of what they name, in an order in
/// which no two lines of a column cross, and far enough apart that no two labels overlap.

#include <Eigen/Core>

#include <vector>

#include "condyle/pictures/camera.h"

namespace condyle {

struct PlacedLabel {
  std::size_t index = 0;        ///< into the anchors
  bool left = false;            ///< in the left column
  Eigen::Vector2d at = {0, 0};  ///< where the leader line ends and the label begins [pixel]
};

/// `frame` is what the columns stand beside; `spacing` the least distance between two labels
/// [pixel]. The columns keep within the frame's height where they fit.
[[nodiscard]] std::vector<PlacedLabel> place_labels(const std::vector<Eigen::Vector2d>& anchors,
                                                    const Frame& frame,
                                                    double spacing);

}  // namespace condyle
