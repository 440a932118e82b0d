#pragma once

/// A text file that grows by whole lines while a command works, and belongs to one process at a time.

#include <filesystem>
#include <string>

#include "condyle/results/sync_file.h"
#include "condyle/results/unkept_file.h"

namespace condyle {

class LineFile {
 public:
  /// Takes the file, before anything is read of it; a new one has the permissions of `like`, where that is one.
  /// Throws InputError where it cannot be written or another run is writing it.
  explicit LineFile(std::filesystem::path path, const std::filesystem::path& like = {});
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile();  ///< removes it where it holds nothing

  /// What comes next is appended to its first bytes.
  void keep(std::size_t bytes);
  /// A line with its end, in one write, which the next one after a second brings to the disk. The first failure
  /// is kept, and nothing more is written.
  void append(const std::string& line);
  [[nodiscard]] const std::string& failure() const { return failure_; }
  /// The file is no longer needed.
  void remove();

 private:
  std::filesystem::path path_;
  UnkeptFile empty_;  ///< as long as it is, a signal removes it
  int descriptor_ = -1;
  SyncNowAndThen sync_;
  std::string failure_;
};

/// All bytes of a file; none where it cannot be read.
[[nodiscard]] std::string bytes_of_file(const std::filesystem::path& path);

}  // namespace condyle
