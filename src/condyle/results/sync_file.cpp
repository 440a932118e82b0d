#include "condyle/results/sync_file.h"

#include <fcntl.h>
#include <unistd.h>

namespace condyle {

void sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path there = folder.empty() ? std::filesystem::path(".") : folder;
  const int names = ::open(there.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (names < 0) return;
  ::fsync(names);
  ::close(names);
}

void SyncNowAndThen::wrote(int descriptor, const std::filesystem::path& file) {
  constexpr std::chrono::seconds kBetween(1);
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < kBetween) return;
  ::fdatasync(descriptor);  // what a disk refuses is met by the next write
  if (!named_) sync_folder(file.parent_path());
  named_ = true;
  synced_ = now;
}

}  // namespace condyle
