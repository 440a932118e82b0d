#pragma once

/// Whether a file that is held open has been written into meanwhile.

#include <sys/stat.h>

#include <filesystem>

namespace condyle {

struct FileState {
  struct stat status {};
  bool known = false;  ///< there is such a file
};

[[nodiscard]] inline FileState file_state(const std::filesystem::path& path) {
  FileState state;
  state.known = ::stat(path.c_str(), &state.status) == 0;
  return state;
}

/// The same file, of another size or time. One that stands in its place is another file: what was opened is as it was.
[[nodiscard]] inline bool is_written_into(const FileState& before, const FileState& now) {
  const struct stat &a = before.status, &b = now.status;
  return before.known && now.known && a.st_dev == b.st_dev && a.st_ino == b.st_ino &&
         (a.st_size != b.st_size || a.st_mtim.tv_sec != b.st_mtim.tv_sec ||
          a.st_mtim.tv_nsec != b.st_mtim.tv_nsec);
}

}  // namespace condyle
