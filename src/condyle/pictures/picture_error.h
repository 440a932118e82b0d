#pragma once

/// The machine cannot draw: OSMesa, a font or gnuplot is missing or refuses. `what()` is one clear
/// line.

#include <stdexcept>
#include <string>

namespace condyle {

class PictureError : public std::runtime_error {
 public:
  explicit PictureError(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace condyle
