#include "condyle/results/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/results/file_mode.h"
#include "condyle/results/sync_file.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

/// Another one each time: processes of two machines, or in two containers, may have one number.
std::string part_name(const fs::path& path) {
  constexpr std::uint64_t kSixteenDigits = 10000000000000000U;
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof random, GRND_NONBLOCK) != sizeof random) random = 0;
  return path.string() + fmt::format(".part{}{:016}", ::getpid(), random % kSixteenDigits);
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// What is written by the name of a symbolic link is the file that it names, there or not.
fs::path target_of(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    const fs::path to = fs::read_symlink(path, error);
    if (error || links == kMostLinks)
      throw InputError(path.string() +
                       ": is a link that leads nowhere, expected the name of a file");
    path = path.parent_path() / to;  // `to` alone where it is absolute
  }
  return path;
}

bool is_part_of(const std::string& name, const std::string& of) {
  const std::string prefix = of + ".part";
  return name.starts_with(prefix) && name.size() > prefix.size() &&
         name.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
}

/// Whoever writes a part holds its lock.
void remove_if_left_behind(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(part.c_str());
  ::close(descriptor);
}

void remove_parts_left_behind(const fs::path& path) {
  std::error_code error;
  const std::string name = path.filename().string();
  for (fs::directory_iterator it(folder_of(path), error), end; !error && it != end;
       it.increment(error))
    if (is_part_of(it->path().filename().string(), name)) remove_if_left_behind(it->path());
}

}  // namespace

void check_output_file(const fs::path& name) {
  const fs::path path = target_of(name), folder = folder_of(path);
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
  struct stat unknown {};
  if (::lstat((part_name(path) + ".journal").c_str(), &unknown) != 0 && errno == ENAMETOOLONG)
    throw InputError(path.string() + ": is too long a name, expected one with room for an ending");
  if (::access(folder.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("{}: cannot write into folder {}: {}", path.string(),
                                 folder.string(), reason(errno)));
  }
}

bool ends_like_another_kind(const fs::path& path, const std::string& own) {
  static const std::set<std::string> known = {".csv",  ".glb",  ".h5",   ".html", ".jpeg", ".jpg",
                                              ".json", ".mot",  ".mp4",  ".obj",  ".off",  ".osim",
                                              ".pdf",  ".ply",  ".png",  ".sto",  ".stl",  ".svg",
                                              ".tif",  ".tiff", ".toml", ".vtp",  ".webp"};
  const std::string ending = file_ending(path);
  return ending != own && known.contains(ending);
}

void check_output_file(const fs::path& path, const std::string& ending) {
  if (ends_like_another_kind(path, ending))
    throw InputError(fmt::format("{}: expected a name that ends in {}", path.string(), ending));
  check_output_file(path);
}

void write_output_file(const fs::path& path, const std::string& bytes) {
  OutputFile file(path);
  file.append(bytes);
  file.keep();
}

OutputFile::OutputFile(fs::path path)
    : path_(target_of(std::move(path))), name_(part_name(path_)), unkept_(name_) {
  check_output_file(path_);
  remove_parts_left_behind(path_);
  open();
}

/// Between its making and its lock another process may have taken it for left behind.
void OutputFile::open() {
  struct stat state {};
  while (state.st_nlink == 0) {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(errno);
    (void)::flock(descriptor_,
                  LOCK_EX);  // where there are no locks nothing is taken for left behind
    if (::fstat(descriptor_, &state) != 0) fail(errno);
  }
  take_mode(descriptor_, path_);
}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  if (!kept_) ::unlink(name_.c_str());
  ::close(descriptor_);
}

void OutputFile::fail(int code) {
  if (descriptor_ >= 0) {
    ::unlink(name_.c_str());
    ::close(descriptor_);
    descriptor_ = -1;
  }
  throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), reason(code)));
}

void OutputFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR) fail(errno);
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void OutputFile::keep() {
  if (const int code = sync_file(descriptor_); code != 0) fail(code);
  if (::rename(name_.c_str(), path_.c_str()) != 0) fail(errno);
  kept_ = true;
  sync_folder(path_.parent_path());
}

FileBeside::FileBeside(fs::path path)
    : path_(target_of(std::move(path))), name_(part_name(path_)), unkept_(name_) {
  remove_parts_left_behind(path_);
}

FileBeside::~FileBeside() {
  if (!kept_) ::unlink(name_.c_str());
}

void FileBeside::keep() {
  const int descriptor = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor >= 0) take_mode(descriptor, path_);
  int code = descriptor < 0 ? errno : sync_file(descriptor);
  if (descriptor >= 0) ::close(descriptor);
  if (code == 0 && ::rename(name_.c_str(), path_.c_str()) != 0) code = errno;
  kept_ = code == 0;
  if (!kept_)
    throw InputError(fmt::format("{}: cannot be written: {}", path_.string(), reason(code)));
  sync_folder(path_.parent_path());  // what the file was made of may be removed now
}

}  // namespace condyle
