#include "condyle/pictures/fitted_words.h"

#include <algorithm>
#include <cmath>

#include "condyle/pictures/text.h"

namespace condyle {
namespace {

bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

}  // namespace

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_letter));
}

std::string shortened(const std::string& text, std::size_t most) {
  std::size_t passed = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (begins_letter(text[i]) && passed++ == most) return text.substr(0, i) + "…";
  return text;
}

std::string cut_words(const std::string& text,
                      double room,
                      const std::function<double(const std::string&)>& width) {
  const std::size_t all = letters(text);
  if (all <= kMostLetters && width(text) <= room) return text;
  std::size_t fits = 1, too_many = std::max<std::size_t>(2, std::min(all, kMostLetters));
  while (too_many - fits > 1) {
    const std::size_t middle = (fits + too_many) / 2;
    (width(shortened(text, middle)) <= room ? fits : too_many) = middle;
  }
  return shortened(text, fits);
}

double words_width(const std::string& text, double size, bool bold) {
  return shared_font(bold).width(text, static_cast<int>(std::ceil(kPixelPerPoint * size)));
}

}  // namespace condyle
