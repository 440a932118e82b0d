#pragma once

/// The bytes of one mesh file, and errors that name it.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace condyle {

/// A whole file in one buffer: what a reader sees cannot change under it.
class MeshBytes {
 public:
  /// Throws InputError where the file is missing, no regular file, empty or cannot be read.
  explicit MeshBytes(std::filesystem::path file);
  /// The content of `file` as it is given.
  MeshBytes(std::filesystem::path file, std::string_view content);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::string_view all() const { return {bytes_.get(), size_}; }
  /// Throws InputError "FILE: what".
  [[noreturn]] void fail(std::string_view what) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// Text without control characters (each becomes '?'), cut after 60 bytes: fit for an error line.
[[nodiscard]] std::string quotable(std::string_view text);

}  // namespace condyle
