#pragma once

/// The files that plots become.

namespace condyle {

enum class PlotFormat { kPng, kSvg, kPdf };

/// Of the file's name: "png", "svg", "pdf".
[[nodiscard]] constexpr const char* ending(PlotFormat format) {
  constexpr const char* kEndings[] = {"png", "svg", "pdf"};
  return kEndings[static_cast<int>(format)];
}

}  // namespace condyle
