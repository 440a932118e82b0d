#include "condyle/results/study_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "condyle/input_error.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

bool is_journal(const fs::path& file) { return file.extension() == ".chunks"; }
bool is_lock(const fs::path& file) { return file.filename().string().starts_with("lock"); }

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    files.push_back(it->path());
  if (error)
    throw InputError(fmt::format("{}: cannot be read: {}", folder.string(), error.message()));
  std::sort(files.begin(), files.end());
  return files;
}

/// Whoever held a lock before may have removed the folder.
bool still_there(int descriptor) {
  struct stat state {};
  return ::fstat(descriptor, &state) == 0 && state.st_nlink > 0;
}

}  // namespace

StudyFolder::StudyFolder(fs::path folder, StudyPart part) : folder_(std::move(folder)) {
  constexpr const char* kHeld =
      "another run is writing into it, expected an output of its own for each run";
  make();
  expect_study();
  try {
    lock("lock", part.whole() ? LOCK_EX : LOCK_SH, kHeld);
    if (!part.whole())
      lock(fmt::format("lock.{}-of-{}", part.i, part.n), LOCK_EX,
           fmt::format("another run is computing part {}/{}, expected each part once", part.i,
                       part.n));
  } catch (...) {
    for (const int descriptor : locks_) ::close(descriptor);
    throw;
  }
}

StudyFolder::~StudyFolder() {
  for (const int descriptor : locks_) ::close(descriptor);
}

void StudyFolder::make() {
  std::error_code error, unknown;
  fs::create_directory(folder_, error);
  if (fs::is_directory(folder_, unknown)) return;
  if (fs::exists(folder_, unknown))
    throw InputError(folder_.string() +
                     ": is no folder of a study's chunks, expected this name to be free for one");
  throw InputError(fmt::format("{}: cannot be made: {}", folder_.string(), error.message()));
}

void StudyFolder::expect_study() const {
  for (const fs::path& file : files_in(folder_))
    if (!is_journal(file) && !is_lock(file))
      throw InputError(
          fmt::format("{}: holds {}, which is no part of a study, expected a folder of "
                      "a study's chunks or none",
                      folder_.string(), file.filename().string()));
}

int StudyFolder::lock(const std::string& name, int how, const std::string& refusal) {
  const fs::path file = folder_ / name;
  for (;;) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == ENOENT) {
      make();
      continue;
    }
    if (descriptor < 0)
      throw InputError(fmt::format("{}: cannot be written: {}", file.string(),
                                   std::generic_category().message(errno)));
    if (::flock(descriptor, how | LOCK_NB) != 0) {
      const int code = errno;
      ::close(descriptor);
      if (code == EINTR) continue;
      throw InputError(code == EWOULDBLOCK
                           ? fmt::format("{}: {}", folder_.string(), refusal)
                           : fmt::format("{}: cannot be locked: {}, expected a file system with "
                                         "locks (flock)",
                                         file.string(), std::generic_category().message(code)));
    }
    if (still_there(descriptor)) return locks_.emplace_back(descriptor);
    ::close(descriptor);
  }
}

std::vector<fs::path> StudyFolder::journals() const {
  std::vector<fs::path> files = files_in(folder_);
  std::error_code unknown;
  std::erase_if(files, [&](const fs::path& file) {
    return !is_journal(file) || !fs::is_regular_file(file, unknown);
  });
  return files;
}

void StudyFolder::remove_journals(const std::string& prefix) const {
  std::error_code unknown;
  for (const fs::path& file : journals())
    if (file.filename().string().starts_with(prefix)) fs::remove(file, unknown);
}

void StudyFolder::remove() const {
  std::error_code unknown;
  for (const fs::path& file : files_in(folder_)) fs::remove(file, unknown);
  fs::remove(folder_, unknown);
}

}  // namespace condyle
