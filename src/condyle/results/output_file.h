#pragma once

/// Files that are there whole or not at all. A symbolic link stays: what it names is written. What is written over
/// keeps its permissions.

#include <filesystem>
#include <string>
#include <string_view>

#include "condyle/results/unkept_file.h"

namespace condyle {

/// Throws InputError where `path` cannot become a file: its folder does not exist or cannot be
/// written, or something that is no file stands there. To be asked before a long computation.
void check_output_file(const std::filesystem::path& path);
/// Does a name end as files of another kind do? `own` is the ending of its kind, ".png".
[[nodiscard]] bool ends_like_another_kind(const std::filesystem::path& path,
                                          const std::string& own);
/// And where its name ends as files of another kind do, whose place it would take; `ending` is its own, ".h5".
void check_output_file(const std::filesystem::path& path, const std::string& ending);

/// Writes a file beside `path` and renames it when all of it is on the disk. Throws InputError (no
/// such folder, disk full, ...) and then leaves nothing behind. What a kill left behind is removed by the
/// next one that writes `path`; several processes that do at the same time each write all of it.
void write_output_file(const std::filesystem::path& path, const std::string& bytes);

/// The same by and by.
class OutputFile {
 public:
  /// Throws InputError, as the others do.
  explicit OutputFile(std::filesystem::path path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  ///< removes it where it was not kept

  void append(std::string_view bytes);
  /// To the disk, and in the place of `path`.
  void keep();

 private:
  void open();
  [[noreturn]] void fail(int code);

  std::filesystem::path path_, name_;
  UnkeptFile unkept_;
  int descriptor_ = -1;
  bool kept_ = false;
};

/// The same for a file that HDF5 makes by its name, which is nobody else's, and holds the lock of.
class FileBeside {
 public:
  /// What a kill left behind is removed.
  explicit FileBeside(std::filesystem::path path);
  FileBeside(const FileBeside&) = delete;
  FileBeside& operator=(const FileBeside&) = delete;
  ~FileBeside();  ///< removes it where it was not kept

  [[nodiscard]] const std::filesystem::path& name() const { return name_; }
  /// To the disk, and in the place of `path`. Throws InputError.
  void keep();

 private:
  std::filesystem::path path_, name_;
  UnkeptFile unkept_;
  bool kept_ = false;
};

}  // namespace condyle
