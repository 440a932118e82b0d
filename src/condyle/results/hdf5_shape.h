#pragma once

/// How many numbers a dataset holds along each of its indices.

#include <cstddef>
#include <vector>

namespace condyle {

using Shape = std::vector<std::size_t>;

/// With one dimension more for columns of a table that hold several numbers.
[[nodiscard]] inline Shape with_width(Shape shape, std::size_t width) {
  if (width > 1) shape.push_back(width);
  return shape;
}

}  // namespace condyle
