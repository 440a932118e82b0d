#pragma once

/// What kind of file a name says: FEMUR.STL is an STL file, too.

#include <cctype>
#include <filesystem>
#include <string>

namespace condyle {

/// ASCII letters.
[[nodiscard]] inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// ".stl", in lower case; empty where the name has none.
[[nodiscard]] inline std::string file_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace condyle
