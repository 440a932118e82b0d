#include "condyle/app/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "condyle/input_error.h"

namespace condyle {
namespace {

bool reader_has_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

}  // namespace

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGCHLD, SIG_DFL);  // ignored, as a parent may leave it, no child's end could be told
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0)
      (void)::open("/dev/null", O_RDONLY);  // the lowest free number; writing to it fails
}

void finish_standard_output() {
  const bool taken = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (!taken && !reader_has_gone())
    throw InputError("the standard output cannot be written, expected room for it");
}

}  // namespace condyle
