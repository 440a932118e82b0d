#pragma once

/// Several poses side by side on one page, to one scale, with one title and one set of bars.

#include <vector>

#include "condyle/pictures/knee_picture.h"

namespace condyle {

/// A page that gives n poses room: more width for plateau and condyles than for the upright views.
[[nodiscard]] PictureOptions strip_size(View view, std::size_t poses);

/// `options.width` and `height` are those of the whole page. `poses` must have a place and not be
/// empty; those that are no results have a sign. Throws as KneePictures does, and where the page leaves too little for each pose.
[[nodiscard]] Image draw_strip(const Run& run,
                               View view,
                               const std::vector<std::size_t>& poses,
                               const PictureOptions& options);

}  // namespace condyle
