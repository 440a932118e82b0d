#include "condyle/results/line_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/results/file_mode.h"

namespace condyle {

LineFile::LineFile(std::filesystem::path path, const std::filesystem::path& like)
    : path_(std::move(path)), empty_(path_, UnkeptFile::Unless::kHoldsBytes) {
  const auto fail = [&](const std::string& why) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(path_.string() + ": " + why);
  };
  struct stat state {};
  while (state.st_nlink == 0) {  // whoever held the lock before may have removed the file
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ =
        ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("cannot be written: " + std::generic_category().message(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail("another run is writing it, expected an output of its own for each run");
    if (::fstat(descriptor_, &state) != 0)
      fail("cannot be written: " + std::generic_category().message(errno));
  }
  if (state.st_size == 0) take_mode(descriptor_, like, S_IRUSR | S_IWUSR);  // to be resumed
}

LineFile::~LineFile() {
  struct stat state {};
  if (::fstat(descriptor_, &state) == 0 && state.st_size == 0 && state.st_nlink > 0) remove();
  ::close(descriptor_);
}

void LineFile::keep(std::size_t bytes) {
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0)
    throw InputError(path_.string() +
                     ": cannot be written: " + std::generic_category().message(errno));
}

void LineFile::append(const std::string& line) {
  if (!failure_.empty()) return;
  const ssize_t written = ::write(descriptor_, line.data(), line.size());
  int code = written < 0 ? errno : ENOSPC;
  if (written == static_cast<ssize_t>(line.size())) code = sync_.wrote(descriptor_, path_);
  if (code != 0)
    failure_ = fmt::format("{}: cannot be written: {}", path_.string(),
                           std::generic_category().message(code));
}

void LineFile::remove() { ::unlink(path_.c_str()); }

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace condyle
