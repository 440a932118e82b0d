#include "condyle/results/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "condyle/input_error.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

/// A file that vanishes unless it is kept.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ < 0 && !closed_) return;
    if (!closed_) ::close(descriptor_);
    if (!kept_) ::unlink(path_.c_str());
  }

  /// Each returns 0 or an error number.
  [[nodiscard]] int opened() const { return descriptor_ < 0 ? errno : 0; }
  [[nodiscard]] int write(const std::string& bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno != EINTR) return errno;
      if (n > 0) done += static_cast<std::size_t>(n);
    }
    return ::fsync(descriptor_) == 0 ? 0 : errno;
  }
  [[nodiscard]] int keep_as(const fs::path& path) {
    closed_ = true;
    if (::close(descriptor_) != 0) return errno;
    if (::rename(path_.c_str(), path.c_str()) != 0) return errno;
    kept_ = true;
    return 0;
  }

 private:
  fs::path path_;
  int descriptor_ = -1;
  bool closed_ = false, kept_ = false;
};

}  // namespace

void check_output_file(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!path.has_filename())
    throw InputError(fmt::format("{}: expected the name of a file", path.string()));
  if (!fs::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: there is no folder {}, expected one that exists",
                                 path.string(), folder.string()));
  }
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw InputError(
        fmt::format("{}: is not a file, expected the name of a file to write", path.string()));
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("{}: cannot write into folder {}: {}", path.string(),
                                 folder.string(), reason(errno)));
  }
}

void write_output_file(const fs::path& path, const std::string& bytes) {
  check_output_file(path);
  TemporaryFile file(path.string() + fmt::format(".part{}", ::getpid()));
  int code = file.opened();
  if (code == 0) code = file.write(bytes);
  if (code == 0) code = file.keep_as(path);
  if (code != 0)
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), reason(code)));
}

FileBeside::FileBeside(fs::path path)
    : FileBeside(std::move(path), fmt::format(".part{}", ::getpid())) {}

FileBeside::FileBeside(fs::path path, const std::string& ending)
    : path_(std::move(path)), name_(path_.string() + ending) {}

FileBeside::~FileBeside() {
  if (!kept_) ::unlink(name_.c_str());
}

void FileBeside::keep() {
  const int descriptor = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool stored = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  kept_ = stored && ::rename(name_.c_str(), path_.c_str()) == 0;
  if (!kept_)
    throw InputError(
        fmt::format("{}: cannot be written: {}", path_.string(), reason(stored ? errno : code)));
  // The name, too: what the file was made of may be removed now.
  const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
  const int names = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (names < 0) return;
  ::fsync(names);
  ::close(names);
}

}  // namespace condyle
