#pragma once

/// Flat marks on a finished picture: lines, discs, rectangles and text, anti-aliased. Pixels from
/// the upper left corner, pixel (0, 0) covers [0, 1] x [0, 1].

#include <Eigen/Core>

#include <string>

#include "condyle/pictures/camera.h"
#include "condyle/pictures/image.h"
#include "condyle/pictures/text.h"

namespace condyle {

enum class Align { kLeft, kCenter, kRight };

struct TextStyle {
  int size = 15;  ///< [pixel]
  Rgb color = {45, 50, 56};
  bool bold = false;
  Align align = Align::kLeft;
  int halo = 0;  ///< width of the white rim that sets letters off from what is below [pixel]
};

class Canvas {
 public:
  /// Draws into `image`, which must outlive the canvas.
  explicit Canvas(Image& image) : image_(image) {}

  void line(const Eigen::Vector2d& a,
            const Eigen::Vector2d& b,
            double width,
            Rgb color,
            double opacity = 1);
  void disc(const Eigen::Vector2d& center, double radius, Rgb color, double opacity = 1);
  void rectangle(const Frame& frame, Rgb color);
  /// `at` is the left end, middle or right end of the base line.
  void text(const Eigen::Vector2d& at, const std::string& text, const TextStyle& style);
  [[nodiscard]] int width() const { return image_.width; }  ///< of the page [pixel]
  [[nodiscard]] int text_width(const std::string& text, const TextStyle& style);

 private:
  void blend(int x, int y, Rgb color, double opacity);

  Image& image_;
};

}  // namespace condyle
