#pragma once

/// The files that a command writes, asked for before it computes.

#include <filesystem>
#include <string>
#include <vector>

namespace condyle {

struct FileToWrite {
  std::filesystem::path path;  ///< empty: not asked for
  std::string ending;          ///< of its kind, ".csv"; empty: of no kind that has one
};

/// Throws InputError where one of them cannot be written, has the ending of another kind, whose place it would take, or is
/// written twice.
void check_files_to_write(const std::vector<FileToWrite>& files);

/// Without those that are not asked for.
[[nodiscard]] std::vector<FileToWrite> given_files(std::vector<FileToWrite> files);

}  // namespace condyle
