#pragma once

/// A folder for the files of one test program: tests run side by side, each in a process of its
/// own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace condyle::test {

/// Not yet there; the name holds the process and, to try paths that need quoting, a blank and an
/// apostrophe.
inline std::filesystem::path scratch_folder(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / (name + "'s " + std::to_string(::getpid()));
}

/// There, and empty.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path folder = scratch_folder(name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace condyle::test
