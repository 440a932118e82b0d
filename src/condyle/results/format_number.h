#pragma once

/// Formats of files end with a number: "condyle 1", "condyle journal 1". A program reads its own number and those
/// before it; what only adds to a file does not change the number.

#include <string>
#include <string_view>

namespace condyle {

/// One line about words that name `known` with a greater number, whatever follows it; else empty.
[[nodiscard]] std::string later_format(std::string_view words, std::string_view known);

}  // namespace condyle
