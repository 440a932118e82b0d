#pragma once

/// What a picture is measured by: colour bars, scale bar, length of force arrows, and the
/// anatomical directions.

#include "condyle/pictures/pen.h"
#include "condyle/pictures/scenery.h"

namespace condyle {

/// "up to 0.3 mm"
[[nodiscard]] std::string overlap_words(double overlap);
/// Colour bars of ligament strain and of the contact path or the gap, at the right.
void draw_bars(const Pen& pen, const PageLayout& page, const Scenery& scenery);
/// A cross with the letters of the anatomical directions, lower left; three arms where the view is
/// oblique.
void draw_directions(const Pen& pen, const PageLayout& page, const Scenery& scenery);
/// The longest of 1, 2, 5, 10, 20 ... [mm] that is not longer than this; longest > 0.
[[nodiscard]] double scale_bar_length(double longest);
void draw_scale_bar(const Pen& pen, const PageLayout& page, const Scenery& scenery);
/// The arrow of a round force, to compare the arrows in the picture with.
void draw_force_scale(const Pen& pen, const PageLayout& page, const Scenery& scenery);

/// What crosses, ellipses and a second line of contact paths are, lower right.
void draw_keys(const Pen& pen, const PageLayout& page, const Scenery& scenery);

}  // namespace condyle
