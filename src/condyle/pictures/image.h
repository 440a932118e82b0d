#pragma once

/// An 8-bit sRGB image as plain data.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace condyle {

using Rgb = std::array<std::uint8_t, 3>;

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 bytes per pixel, rows from the top

  [[nodiscard]] std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x));
  }
  [[nodiscard]] Rgb at(int x, int y) const {
    const std::uint8_t* p = rgb.data() + offset(x, y);
    return {p[0], p[1], p[2]};
  }
};

[[nodiscard]] inline Image blank_image(int width, int height, Rgb color) {
  Image image{width, height, {}};
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  image.rgb.reserve(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    image.rgb.insert(image.rgb.end(), color.begin(), color.end());
  return image;
}

/// Lays a picture onto a page on which there is room for it.
inline void paste(const Image& picture, Image& page, int left, int top) {
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.rgb.begin() + static_cast<std::ptrdiff_t>(picture.offset(0, y)),
                3 * picture.width,
                page.rgb.begin() + static_cast<std::ptrdiff_t>(page.offset(left, top + y)));
}

}  // namespace condyle
