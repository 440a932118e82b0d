#pragma once

/// Text as coverage masks, through FreeType and DejaVu Sans. Sizes in pixels.

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace condyle {

/// How much of each pixel a line of text covers, 0 to 255; the pen starts at `origin` inside the
/// mask.
struct TextMask {
  int width = 0, height = 0;
  Eigen::Vector2i origin = {0, 0};
  int advance = 0;  ///< [pixel]
  std::vector<std::uint8_t> coverage;
};

class Font {
 public:
  /// Throws PictureError when the font that was found at configure time cannot be read.
  explicit Font(bool bold);
  ~Font();
  Font(Font&&) noexcept;
  Font& operator=(Font&&) noexcept;

  /// `text` is UTF-8; `margin` pixels stay free around the letters.
  [[nodiscard]] TextMask render(const std::string& text, int size, int margin = 0);
  [[nodiscard]] int width(const std::string& text, int size);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The font of this thread, opened once. Throws as Font does.
[[nodiscard]] Font& shared_font(bool bold);

}  // namespace condyle
