#include "condyle/mesh_files/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

namespace condyle {
namespace {

using std::string_view;

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Is a number that no double stands for nearer to 0 than any? The place of its first digit that is not 0 tells.
bool is_tiny(string_view digits) {
  const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
  string_view mantissa = digits.substr(0, e),
              exponent = digits.substr(std::min(e + 1, digits.size()));
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == string_view::npos) return true;
  const auto point = static_cast<long>(std::min(mantissa.find('.'), mantissa.size()));
  const long tens = point - static_cast<long>(first);  // 10 to that is about the mantissa
  long more = 0;
  const auto [end, error] =
      std::from_chars(exponent.data(), exponent.data() + exponent.size(), more);
  if (error == std::errc::result_out_of_range) return exponent.starts_with('-');
  return static_cast<double>(tens) + static_cast<double>(more) < 0;
}

void skip_blanks(string_view& text) {
  std::size_t n = 0;
  while (n < text.size() && is_blank(text[n])) ++n;
  text.remove_prefix(n);
}

}  // namespace

TextLines::TextLines(const MeshBytes& bytes, string_view text, Format format, long first_line)
    : bytes_(bytes),
      format_(format),
      end_of_line_(text.find('\n') == string_view::npos ? '\r' : '\n'),
      rest_(text),
      line_(first_line - 1) {
  constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.substr(0, 3) == kByteOrderMark) rest_.remove_prefix(3);
}

bool TextLines::next_physical() {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find(end_of_line_);
  ended_ = end != string_view::npos;
  words_ = rest_.substr(0, end);
  rest_.remove_prefix(ended_ ? end + 1 : rest_.size());
  if (format_.comment != 0) words_ = words_.substr(0, words_.find(format_.comment));
  ++line_;
  return true;
}

bool TextLines::next() {
  while (next_physical()) {
    skip_blanks(words_);
    if (!words_.empty()) return true;
  }
  words_ = {};
  return false;
}

string_view TextLines::word() {
  while (true) {
    skip_blanks(words_);
    std::size_t n = 0;
    while (n < words_.size() && !is_blank(words_[n])) ++n;
    string_view result = words_.substr(0, n);
    words_.remove_prefix(n);
    if (!format_.continuation || result.empty() || result.back() != '\\') return result;
    skip_blanks(words_);
    if (!words_.empty()) return result;
    if (!next_physical()) fail("a backslash continues the line, but the file ends here");
    result.remove_suffix(1);
    if (!result.empty()) return result;
  }
}

string_view TextLines::peek() const {
  TextLines copy = *this;
  return copy.word();
}

void TextLines::skip_rest() {
  if (!format_.continuation) {
    words_ = {};
    return;
  }
  while (!word().empty()) {
  }
}

void TextLines::expect_line_end() {
  if (!ended_) fail("the last line has no line end");
}

void TextLines::expect_end() {
  if (const string_view more = word(); !more.empty())
    fail(fmt::format("\"{}\" follows, expected the end of the line", quotable(more)));
  expect_line_end();
}

double TextLines::number(string_view what) {
  const string_view text = word();
  const string_view digits = text.substr(text.size() > 1 && text.front() == '+' ? 1 : 0);
  double value = 0;
  const char* last = digits.data() + digits.size();
  auto [end, error] = std::from_chars(digits.data(), last, value);
  if (error == std::errc::result_out_of_range && is_tiny(digits))
    error = {}, value = 0;  // nearer to 0 than any double
  if (error != std::errc{} || end != last || !std::isfinite(value)) {
    if (text.empty()) fail(fmt::format("{} is missing, expected a finite number", what));
    fail(fmt::format("{} \"{}\", expected a finite number", what, quotable(text)));
  }
  return value;
}

Eigen::Vector3d TextLines::point(string_view what) {
  const double x = number(what), y = number(what), z = number(what);
  return {x, y, z};
}

long TextLines::integer(string_view what, long least, long greatest) {
  const string_view text = word();
  const string_view digits = text.substr(text.size() > 1 && text.front() == '+' ? 1 : 0);
  long value = 0;
  const char* last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, value);
  if (error != std::errc{} || end != last || value < least || value > greatest)
    fail(fmt::format("{} \"{}\", expected {} to {}", what, quotable(text), least, greatest));
  return value;
}

void TextLines::fail(string_view what) const {
  bytes_.fail(fmt::format("line {}: {}{}", line_, what,
                          ended_ ? "" : fmt::format(" ({} is cut short)", format_.name)));
}

void TextLines::fail_cut_short(string_view what) const {
  bytes_.fail(fmt::format("{} is cut short: {}", format_.name, what));
}

}  // namespace condyle
