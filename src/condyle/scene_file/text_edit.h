#pragma once

/// Values of a scene's text replaced where they stand; all else stays as it was written.

#include <string>
#include <vector>

#include "condyle/scene_file/document.h"

namespace condyle {

/// What is to stand in place of one value of a text: a number, or a string.
struct TextEdit {
  int line = 0, column = 0, end = 0;  ///< as Value
  std::string text;
};

/// The shortest text that is read back as `inside`, a number of the unit `unit`, to the last bit where
/// such a number exists; with a point or an exponent, so that it stays a number with a fraction.
[[nodiscard]] std::string number_text(double inside, double unit);

[[nodiscard]] TextEdit edit_of(const Value& value, std::string text);

/// `text` with all edits, of which no two overlap.
[[nodiscard]] std::string edited(const std::string& text, std::vector<TextEdit> edits);

}  // namespace condyle
