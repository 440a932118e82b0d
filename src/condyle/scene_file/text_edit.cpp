#include "condyle/scene_file/text_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace condyle {
namespace {

/// The factor whose product with `unit` is nearest to `inside`: division alone may miss it by a bit.
double factor_of(double inside, double unit) {
  double best = inside / unit;
  const double neighbours[] = {std::nextafter(best, -HUGE_VAL), std::nextafter(best, HUGE_VAL)};
  for (const double factor : neighbours)
    if (std::abs(factor * unit - inside) < std::abs(best * unit - inside)) best = factor;
  return best;
}

/// Where each line begins, the first one behind a byte-order mark, and the end of the text.
std::vector<std::size_t> line_starts(const std::string& text) {
  std::vector<std::size_t> starts = {text.starts_with("\xEF\xBB\xBF") ? 3U : 0U};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') starts.push_back(i + 1);
  return starts;
}

bool begins_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

/// The byte at which a column, counted in code points from 1, begins.
std::size_t byte_at(const std::string& text, std::size_t line_start, int column) {
  std::size_t at = line_start;
  for (int passed = 1; passed < column && at < text.size(); ++passed) {
    ++at;
    while (at < text.size() && !begins_code_point(text[at])) ++at;
  }
  return at;
}

}  // namespace

std::string number_text(double inside, double unit) {
  std::string text = fmt::format("{}", factor_of(inside, unit));
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

TextEdit edit_of(const Value& value, std::string text) {
  return {value.line, value.column, value.end, std::move(text)};
}

std::string edited(const std::string& text, std::vector<TextEdit> edits) {
  std::sort(edits.begin(), edits.end(), [](const TextEdit& a, const TextEdit& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  const std::vector<std::size_t> starts = line_starts(text);
  std::string result;
  std::size_t done = 0;
  for (const TextEdit& edit : edits) {
    const std::size_t start = starts.at(static_cast<std::size_t>(edit.line) - 1);
    const std::size_t from = byte_at(text, start, edit.column);
    result.append(text, done, from - done);
    result += edit.text;
    done = byte_at(text, start, edit.end);
  }
  return result.append(text, done);
}

}  // namespace condyle
