#pragma once

/// What a picture shows and where on the page: what those who draw words around it are told.

#include <vector>

#include "condyle/pictures/camera.h"
#include "condyle/pictures/canvas.h"
#include "condyle/pictures/knee_shapes.h"
#include "condyle/pictures/staging.h"

namespace condyle {

/// Sizes follow the picture: 1 at 1200 x 900.
struct PageLayout {
  int width = 1200, height = 900;
  double scale = 1;
  Frame drawing;    ///< beyond it there is nothing of the knee
  double fade = 0;  ///< width of the band inside it in which bones turn to paper [pixel]
  /// Where the joint is, solid.
  [[nodiscard]] Frame joint() const {
    return {drawing.left + fade, drawing.top + fade, drawing.right - fade, drawing.bottom - fade};
  }
};
[[nodiscard]] PageLayout page_layout(int width, int height);
/// A knee without words around it, one of several on a page.
[[nodiscard]] PageLayout panel_layout(int width, int height);

/// What the colours of the articular surfaces tell.
enum class SurfaceColors {
  kPlain,
  kGap,      ///< the gap between them (gap_map.h), in place of the contact's path
  kPressure  ///< the pressure of elastic layers (pressure_map.h)
};

/// What a picture shows.
struct Scenery {
  const Run& run;
  const PoseResult& pose;
  View view;
  const Camera& camera;
  const PictureScales& scales;
  const Staging& staging;
  SurfaceColors colors = SurfaceColors::kPlain;
  bool hertz = false;
  std::vector<RigidTransform> X_P;      ///< of the bodies as the view shows them
  std::vector<ContactMark> marks = {};  ///< on the bodies that are shown
  std::vector<bool> seen = {};          ///< per ligament: of a view of one body
  double overlap = 0;                   ///< deepest of the gaps that are painted [mm]
  double pressure_top = 0;              ///< end of the colours of pressure [N/mm²]
};

/// Are force arrows drawn in this picture?
[[nodiscard]] bool shows_arrows(const Scenery& scenery);

}  // namespace condyle
