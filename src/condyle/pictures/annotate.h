#pragma once

/// The words and scales around a picture: title, labels of ligaments with leader lines, contact
/// forces, colour bars, scale bar, length of force arrows, and the anatomical directions.

#include <string>
#include <vector>

#include "condyle/pictures/image.h"
#include "condyle/pictures/pen.h"
#include "condyle/pictures/scenery.h"

namespace condyle {

/// "Anterior view  ·  flexion 60°"; without `with_value` what all poses of the run share.
[[nodiscard]] std::string caption(const Scenery& scenery, bool with_value = true);
/// Title and, in quiet ink below it, another line; smaller where they would leave the page, and cut
/// where that is not enough.
void draw_title(const Pen& pen, int width, const std::string& title, const std::string& below);
/// Below the title, where the pose is no result: a sign and what is wrong, in one or two lines.
void draw_alarm(const Pen& pen, int width, const Scenery& scenery);
/// A triangle with its tip up and an exclamation mark, `size` high, its lower left corner at `at`.
void draw_alarm_sign(const Pen& pen, const Eigen::Vector2d& at, double size);
/// Forces beside their arrows; peak pressures where ellipses are drawn. Where there is room, clear of what is taken.
void draw_contact_forces(const Pen& pen,
                         int page_width,
                         const Scenery& scenery,
                         std::vector<Frame> taken = {});
void annotate(Image& image, const PageLayout& page, const Scenery& scenery);

}  // namespace condyle
