#pragma once

/// Which file of the project includes which: #include "..." of all .h and .cpp under src, tests and
/// tools, as paths below the root of the project.

#include <filesystem>
#include <string>
#include <vector>

namespace condyle::test {

struct Include {
  std::string from;  ///< "src/math/rotation.cpp"
  std::string to;    ///< a file of the project, or as it is written: "<hdf5.h>"
  [[nodiscard]] bool of_project() const { return to.front() != '<'; }
};

/// Those of the sources; of angle brackets too. Throws where a quoted name is no file.
[[nodiscard]] std::vector<Include> includes_of_project(const std::filesystem::path& root);

/// The first `count` folders of a path, or fewer where it has fewer: "src/math".
[[nodiscard]] std::string folder(const std::string& path, int count);

struct Room {
  std::string name, library;  ///< "math", "mechanics"
};

/// The rows of the table of docs/architecture.md, the one headed "room", from top to bottom.
[[nodiscard]] std::vector<Room> rooms_of_page(const std::filesystem::path& page);

/// Circles among ideas; NAME.h and NAME.cpp are one. Each is the set of all that reach each other,
/// "src/a/x, src/a/y", sorted.
[[nodiscard]] std::vector<std::string> circles(const std::vector<Include>& includes);

}  // namespace condyle::test
