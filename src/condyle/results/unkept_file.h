#pragma once

/// Names of files that are being written and are to vanish unless they become whole.

#include <cstddef>
#include <filesystem>

namespace condyle {

/// While one of these lives `remove_unkept_files` knows of the name.
class UnkeptFile {
 public:
  enum class Unless { kNever, kHoldsBytes };

  /// `unless` it holds bytes: of one that is written line by line, and of use as soon as it has one.
  explicit UnkeptFile(const std::filesystem::path& name, Unless unless = Unless::kNever);
  ~UnkeptFile();
  UnkeptFile(const UnkeptFile&) = delete;
  UnkeptFile& operator=(const UnkeptFile&) = delete;

 private:
  std::size_t slot_;
};

/// Removes them. A signal handler may call it; the program is to end then.
void remove_unkept_files() noexcept;

}  // namespace condyle
