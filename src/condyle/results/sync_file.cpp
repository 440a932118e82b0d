#include "condyle/results/sync_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace condyle {

void sync_folder(const std::filesystem::path& folder) {
  const std::filesystem::path there = folder.empty() ? std::filesystem::path(".") : folder;
  const int names = ::open(there.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (names < 0) return;
  ::fsync(names);
  ::close(names);
}

int SyncNowAndThen::wrote(int descriptor, const std::filesystem::path& file) {
  constexpr std::chrono::seconds kBetween(1);
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < kBetween) return 0;
  const int code = ::fdatasync(descriptor) == 0 ? 0 : errno;
  if (!named_) sync_folder(file.parent_path());
  named_ = true;
  synced_ = now;
  // Other codes are those of systems that cannot sync.
  return code == EIO || code == ENOSPC || code == EDQUOT ? code : 0;
}

}  // namespace condyle
