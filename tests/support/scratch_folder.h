#pragma once

/// A folder for the files of one test program: tests run side by side, each in a process of its
/// own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace condyle::test {

/// Folders that are removed when the process that asked for them ends; one that it forks leaves
/// them alone.
struct ScratchFolders {
  ~ScratchFolders() {
    std::error_code ignored;
    if (::getpid() == owner)
      for (const std::filesystem::path& folder : folders)
        std::filesystem::remove_all(folder, ignored);
  }
  pid_t owner = ::getpid();
  std::vector<std::filesystem::path> folders;
};

/// Not yet there; the name holds the process and, to try paths that need quoting, a blank and an
/// apostrophe. It is removed at the end of the program.
inline std::filesystem::path scratch_folder(const std::string& name) {
  static ScratchFolders scratch;
  scratch.folders.push_back(std::filesystem::path(::testing::TempDir()) /
                            (name + "'s " + std::to_string(::getpid())));
  return scratch.folders.back();
}

/// There, and empty.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path folder = scratch_folder(name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace condyle::test
