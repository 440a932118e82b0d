#pragma once

/// The words and scales around a picture: title, labels of ligaments with leader lines, contact
/// forces, colour bars, scale bar, length of force arrows, and the anatomical directions.

#include "pictures/camera.h"
#include "pictures/canvas.h"
#include "pictures/knee_shapes.h"

namespace condyle {

/// Sizes follow the picture: 1 at 1200 x 900.
struct PageLayout {
  int width = 1200, height = 900;
  double scale = 1;
  Frame drawing;  ///< where the knee is
};
[[nodiscard]] PageLayout page_layout(int width, int height);

/// What a picture shows.
struct Scenery {
  const Run& run;
  const PoseResult& pose;
  View view;
  const Camera& camera;
  const PictureScales& scales;
  const std::vector<bool>& seen_from_above;  ///< per ligament
};

void annotate(Image& image, const PageLayout& page, const Scenery& scenery);

}  // namespace condyle
