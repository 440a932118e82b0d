#pragma once

/// Small pieces of HTML. Whatever comes from a scene or a file goes through `escaped`.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/on_progress.h"

namespace condyle {

/// For text and for quoted attributes.
[[nodiscard]] std::string escaped(std::string_view text);

/// As a string of CSS, in quotes: only letters, digits and blanks stand for themselves.
[[nodiscard]] std::string css_string(std::string_view text);

/// JSON that may stand in a script of a page: nothing in it can end the script.
[[nodiscard]] std::string script_safe(std::string_view json);

/// "-" for a number that is none.
[[nodiscard]] std::string number(double value, int decimals);
/// With three significant digits.
[[nodiscard]] std::string short_number(double value);

struct HtmlTable {
  std::string caption;               ///< may be empty
  std::vector<std::string> columns;  ///< heads
  std::vector<std::vector<std::string>> rows;
  std::vector<int> text_columns = {0};  ///< set to the left, the others to the right
  std::vector<std::string> row_classes = {};
};
/// Everything in the table is escaped here. One of very many columns becomes several below each other,
/// each with the first column.
[[nodiscard]] std::string html(const HtmlTable& table);

/// A heading with what stands below it; nothing where that is nothing.
[[nodiscard]] std::string section(std::string_view id,
                                  std::string_view title,
                                  const std::string& body);
/// Folded away until it is asked for.
[[nodiscard]] std::string details(std::string_view title, const std::string& body);

/// All of a page before its sections. Nothing is fetched from anywhere, whatever stands in the page.
[[nodiscard]] std::string page_head(const std::string& title, const std::string& what);

/// A page of its head and its sections, which are made one after the other.
[[nodiscard]] std::string page_of(const std::vector<std::function<std::string()>>& parts,
                                  const OnProgress& on_part);

}  // namespace condyle
