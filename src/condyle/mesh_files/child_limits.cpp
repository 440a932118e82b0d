#include "condyle/mesh_files/child_limits.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace condyle {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// Address space in use [bytes].
double address_space() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0;
  statm >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void limit(decltype(RLIMIT_CPU) resource, double value) {
  const auto whole = static_cast<rlim_t>(std::ceil(value));
  const rlimit both{whole, whole};
  setrlimit(resource, &both);
}

/// As executing another program would: those with O_CLOEXEC.
void close_files(int channel) {
  std::vector<int> open;
  if (DIR* folder = opendir("/proc/self/fd")) {
    while (const dirent* entry = readdir(folder)) open.push_back(std::atoi(entry->d_name));
    closedir(folder);
  }
  for (const int file : open) {
    const int flags = file == channel ? -1 : fcntl(file, F_GETFD);
    if (flags >= 0 && (flags & FD_CLOEXEC) != 0) close(file);
  }
}

}  // namespace

void confine(const ChildLimits& limits, int channel) {
  close_files(channel);
  for (const int signal :
       {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTERM, SIGINT, SIGXCPU, SIGALRM})
    std::signal(signal, SIG_DFL);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (!kSanitized) limit(RLIMIT_AS, address_space() + limits.memory);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

}  // namespace condyle
