#pragma once

/// Room on the disk for what is wanted only while something is computed.

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "condyle/input_error.h"

namespace condyle {

/// A folder that is gone with all it holds when the work is done. Throws InputError where none can be made.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const char* named = std::getenv("TMPDIR");
    const std::filesystem::path parent = named != nullptr && *named != '\0' ? named : "/tmp";
    std::string name = (parent / "condyle-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(parent.string() +
                       ": no folder can be made there, expected room for temporary files (TMPDIR)");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace condyle
