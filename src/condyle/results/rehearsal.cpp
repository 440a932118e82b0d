#include "condyle/results/rehearsal.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

#include "condyle/input_error.h"
#include "condyle/mesh_files/child_limits.h"

namespace condyle {
namespace {

constexpr int kNoMemory = 3;

/// Results are compressed to a tenth at best, and are a few times as large in memory as on disk without it.
ChildLimits limits_of(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  const double size = unknown ? 0 : static_cast<double>(bytes);
  return {.seconds = 5 + size / 1e6, .memory = 1e9 + 100 * size};
}

[[noreturn]] void play(const std::function<void()>& read, const ChildLimits& limits) {
  confine(limits);
  try {
    read();
  } catch (const std::bad_alloc&) {
    _exit(kNoMemory);
  } catch (...) {  // will be told by whoever reads in earnest
  }
  _exit(0);
}

}  // namespace

void rehearse(const std::filesystem::path& file, const std::function<void()>& read) {
  const ChildLimits limits = limits_of(file);
  const pid_t child = fork();
  if (child == 0) play(read, limits);
  if (child < 0)
    throw InputError(file.string() + ": cannot be read: no process for it, expected room for one");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw InputError(
      fmt::format("{}: is damaged, expected a run (HDF5) that can be read within {:.0f} s and "
                  "{:.0f} MB",
                  file.string(), limits.seconds, limits.memory / 1e6));
}

}  // namespace condyle
