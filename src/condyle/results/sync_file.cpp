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

namespace {

/// Other codes are those of systems that cannot sync.
int code_of_disk(int result) {
  return result != 0 && (errno == EIO || errno == ENOSPC || errno == EDQUOT) ? errno : 0;
}

}  // namespace

int sync_file(int descriptor) { return code_of_disk(::fsync(descriptor)); }

int SyncNowAndThen::wrote(int descriptor, const std::filesystem::path& file) {
  constexpr std::chrono::seconds kBetween(1);
  const auto now = std::chrono::steady_clock::now();
  if (now - synced_ < kBetween) return 0;
  const int code = code_of_disk(::fdatasync(descriptor));
  if (!named_) sync_folder(file.parent_path());
  named_ = true;
  synced_ = now;
  return code;
}

}  // namespace condyle
