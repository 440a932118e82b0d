#pragma once

/// Files that the program carries along.

#include <string_view>

namespace condyle {

[[nodiscard]] std::string_view page_style();     ///< page.css
[[nodiscard]] std::string_view viewer_script();  ///< the bundled viewer; empty: built without

}  // namespace condyle
