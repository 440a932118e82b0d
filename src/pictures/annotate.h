#pragma once

/// The words and scales around a picture: title, labels of ligaments with leader lines, contact
/// forces, colour bars, scale bar, length of force arrows, and the anatomical directions.

#include "pictures/camera.h"
#include "pictures/knee_picture.h"
#include "pictures/knee_shapes.h"
#include "pictures/pen.h"
#include "pictures/staging.h"

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

/// What a picture shows.
struct Scenery {
  const Run& run;
  const PoseResult& pose;
  View view;
  const Camera& camera;
  const PictureScales& scales;
  const Staging& staging;
  bool proximity = false, hertz = false;
  std::vector<RigidTransform> X_P;      ///< of the bodies as the view shows them
  std::vector<ContactMark> marks = {};  ///< on the bodies that are shown
  std::vector<bool> seen = {};          ///< per ligament: of a view of one body
  double overlap = 0;                   ///< deepest of the gaps that are painted [mm]
};

/// The scenery refers to the pictures that drew it.
struct KneePictures::Drawn {
  Image image;
  Scenery shown;
};

/// "Anterior view  ·  flexion 60°"; without `with_value` what all poses of the run share.
[[nodiscard]] std::string caption(const Scenery& scenery, bool with_value = true);
/// Title and, in quiet ink below it, another line; smaller where they would leave the page, and cut
/// where that is not enough.
void draw_title(const Pen& pen, int width, const std::string& title, const std::string& below);
/// Below the title, where the pose is no result: a sign and what is wrong, in one or two lines.
void draw_alarm(const Pen& pen, int width, const Scenery& scenery);
/// A triangle with its tip up and an exclamation mark, `size` high, its lower left corner at `at`.
void draw_alarm_sign(const Pen& pen, const Eigen::Vector2d& at, double size);
/// Forces beside their arrows; peak pressures where ellipses are drawn.
void draw_contact_forces(const Pen& pen, int page_width, const Scenery& scenery);
/// Are force arrows drawn in this picture?
[[nodiscard]] bool shows_arrows(const Scenery& scenery);

void annotate(Image& image, const PageLayout& page, const Scenery& scenery);

}  // namespace condyle
