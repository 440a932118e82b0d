#include "condyle/pictures/text.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>

#include "condyle/pictures/picture_error.h"

namespace condyle {
namespace {

/// Next code point of a UTF-8 text; a broken byte stands for itself.
char32_t next_code(const std::string& text, std::size_t& i) {
  const auto lead = static_cast<unsigned char>(text[i++]);
  const int more = lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : 0;
  if (more == 0 || i + static_cast<std::size_t>(more) > text.size()) return lead;
  char32_t code = lead & (0x3Fu >> more);
  for (int k = 0; k < more; ++k)
    code = (code << 6) | (static_cast<unsigned char>(text[i++]) & 0x3Fu);
  return code;
}

}  // namespace

struct Font::State {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (face) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  /// Calls put(left, rise) for each letter, placed in pixels from the start of the pen; returns the
  /// advance.
  template <typename Put>
  int walk(const std::string& text, int size, FT_Int32 flags, Put put) {
    FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(size));
    FT_Pos pen = 0;  // [1/64 pixel]
    FT_UInt before = 0;
    for (std::size_t i = 0; i < text.size();) {
      const FT_UInt glyph = FT_Get_Char_Index(face, next_code(text, i));
      FT_Vector kern = {0, 0};
      if (before) FT_Get_Kerning(face, before, glyph, FT_KERNING_UNFITTED, &kern);
      pen += kern.x;
      if (FT_Load_Glyph(face, glyph, flags) == 0) {
        put(static_cast<int>((pen + 32) / 64) + face->glyph->bitmap_left, face->glyph->bitmap_top);
        pen += face->glyph->linearHoriAdvance >> 10;
      }
      before = glyph;
    }
    return static_cast<int>((pen + 63) / 64);
  }
};

Font::Font(bool bold) : state_(std::make_unique<State>()) {
  const char* file = bold ? CONDYLE_FONT_BOLD : CONDYLE_FONT_REGULAR;
  if (FT_Init_FreeType(&state_->library) != 0) throw PictureError("FreeType does not start");
  if (FT_New_Face(state_->library, file, 0, &state_->face) != 0) {
    state_->face = nullptr;
    throw PictureError(std::string(file) +
                       ": cannot read this font (Debian package fonts-dejavu-core)");
  }
}
Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

int Font::width(const std::string& text, int size) {
  return state_->walk(text, size, FT_LOAD_NO_HINTING, [](int, int) {});
}

TextMask Font::render(const std::string& text, int size, int margin) {
  TextMask mask;
  mask.advance = width(text, size);
  mask.origin = {margin + size / 4, margin + size + size / 8};
  mask.width = mask.advance + 2 * mask.origin.x();
  mask.height = 2 * margin + size + size / 2 + 1;
  mask.coverage.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height),
                       0);
  state_->walk(text, size, FT_LOAD_RENDER | FT_LOAD_NO_HINTING, [&](int left, int rise) {
    const FT_Bitmap& bitmap = state_->face->glyph->bitmap;
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
      for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
        const int x = mask.origin.x() + left + column, y = mask.origin.y() - rise + row;
        if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) continue;
        std::uint8_t& pixel =
            mask.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) +
                          static_cast<std::size_t>(x)];
        pixel = std::max(pixel, bitmap.buffer[row * bitmap.pitch + column]);
      }
    }
  });
  return mask;
}

Font& shared_font(bool bold) {
  thread_local Font regular(false), heavy(true);
  return bold ? heavy : regular;
}

}  // namespace condyle
