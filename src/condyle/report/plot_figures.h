#pragma once

/// Plots as parts of a page.

#include <filesystem>
#include <string>

namespace condyle {

/// An SVG file as a figure. Several share one page: `prefix` goes before its own names.
[[nodiscard]] std::string plot_figure(const std::filesystem::path& svg, const std::string& prefix);

}  // namespace condyle
