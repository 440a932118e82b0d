#pragma once

/// A text as a cell of a table (CSV, RFC 4180).

#include <string>
#include <string_view>

namespace condyle {

/// What a text begins with that gets an apostrophe before it.
inline constexpr std::string_view kGuardedStarts = "=+-@'\t\r";

/// Quoted where it holds a comma, a quote or a line's end. One that a spreadsheet would take for a formula, with = + - @
/// or a tab in front, or that begins with an apostrophe, gets an apostrophe before it, which read_csv takes off again.
[[nodiscard]] std::string csv_text(std::string_view text);

}  // namespace condyle
