#pragma once

/// Animated PNG: what browsers play as a picture. Of each frame only the rectangle that changed is
/// kept. The frames are ordinary PNG data of libpng in the chunks acTL, fcTL and fdAT [PNG third
/// edition, section 11.3.4]; programs that do not know them show the first frame.

#include <string>
#include <vector>

#include "condyle/pictures/image.h"

namespace condyle {

class AnimatedPng {
 public:
  /// Frames last 1 / frames_per_second; the last one is held for `hold` seconds before it all
  /// begins again.
  explicit AnimatedPng(int frames_per_second, double hold = 1);

  /// Frames must have one size.
  void add(const Image& frame);
  [[nodiscard]] int count() const { return static_cast<int>(frames_.size()); }

  /// The whole file. Needs a frame.
  [[nodiscard]] std::string bytes() const;

 private:
  struct Frame {
    int left, top, width, height;
    std::string data;  // compressed rows
  };
  int frames_per_second_;
  double hold_;
  Image last_;
  std::vector<Frame> frames_;
};

}  // namespace condyle
