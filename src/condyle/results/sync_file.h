#pragma once

/// What is written lies in memory until the system, or a sync, brings it to the disk: a machine that stops loses it.

#include <chrono>
#include <filesystem>

namespace condyle {

/// The names in a folder, too: until then a new or renamed file may be lost with the machine.
void sync_folder(const std::filesystem::path& folder);

/// All of a file. 0, or why the disk has not taken what was written (errno).
[[nodiscard]] int sync_file(int descriptor);

/// Of a file that grows: at most one sync a second, so that a crash of the machine costs a second or two of work.
class SyncNowAndThen {
 public:
  /// To be told after each write. 0, or why the disk has not taken what was written before (errno): it says so once.
  int wrote(int descriptor, const std::filesystem::path& file);

 private:
  std::chrono::steady_clock::time_point synced_ = std::chrono::steady_clock::now();
  bool named_ = false;  ///< its name is on the disk
};

}  // namespace condyle
