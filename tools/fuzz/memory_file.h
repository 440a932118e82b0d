#pragma once

/// Bytes under a name that readers of files can open, without a disk.

#include <filesystem>

#include "fuzz/doors.h"

namespace condyle::fuzz {

class MemoryFile {
 public:
  /// Throws std::runtime_error where the system has none.
  explicit MemoryFile(Bytes bytes);
  explicit MemoryFile(const std::string& bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  /// "/proc/self/fd/7"
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_ = -1;
  std::filesystem::path path_;
};

/// A folder for files that have to lie beside each other, of this process, removed when it ends.
[[nodiscard]] const std::filesystem::path& scratch();
void write_scratch(const std::string& name, const std::string& bytes);

}  // namespace condyle::fuzz
