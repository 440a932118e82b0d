#include "condyle/results/format_number.h"

#include <fmt/format.h>

#include <algorithm>

namespace condyle {
namespace {

constexpr std::string_view kDigits = "0123456789";

std::string_view without_leading_zeros(std::string_view digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

bool greater_number(std::string_view a, std::string_view b) {
  a = without_leading_zeros(a);
  b = without_leading_zeros(b);
  return a.size() != b.size() ? a.size() > b.size() : a > b;
}

}  // namespace

std::string later_format(std::string_view words, std::string_view known) {
  const std::size_t at = known.rfind(' ') + 1;
  if (!words.starts_with(known.substr(0, at))) return "";
  const std::string_view rest = words.substr(at);
  const std::string_view number = rest.substr(0, rest.find_first_not_of(kDigits));
  if (number.size() > 9 || !greater_number(number, known.substr(at))) return "";
  return fmt::format("written by a later condyle (format \"{}{}\"), this one reads up to \"{}\"",
                     known.substr(0, at), number, known);
}

}  // namespace condyle
