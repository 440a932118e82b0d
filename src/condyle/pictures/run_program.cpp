#include "condyle/pictures/run_program.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "condyle/pictures/picture_error.h"

extern char** environ;

namespace condyle {
namespace {

/// A file in memory, which a program may seek in as in one of its own: there is no folder that has to have room.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("condyle", MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  [[nodiscard]] std::string bytes() const;

 private:
  int descriptor_;
};

std::string MemoryFile::bytes() const {
  std::string bytes;
  std::array<char, 1 << 16> some;
  for (off_t at = 0;;) {
    const ssize_t n = pread(descriptor_, some.data(), some.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(some.data(), static_cast<std::size_t>(n));
    at += n;
  }
}

/// Through a socket pair: a program that ends early gives an error here instead of the signal of a
/// broken pipe.
void feed(int descriptor, const std::string& input) {
  for (std::size_t sent = 0; sent < input.size();) {
    const ssize_t n = send(descriptor, input.data() + sent, input.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    sent += static_cast<std::size_t>(n);
  }
}

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::size_t last = text.find_last_not_of(' ');
  return last == std::string::npos ? "" : text.substr(0, last + 1);
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

/// The number of the process, or 0 and why it was not started. What this program ignores the other one does not:
/// a file beyond the limit is its end, as it knows it.
std::pair<pid_t, int> start(const std::vector<std::string>& command,
                            int input,
                            int output,
                            int messages) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
  sigset_t usual;
  sigemptyset(&usual);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&usual, signal);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  const int code =
      posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return {code == 0 ? process : 0, code};
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const std::string& input) {
  ProgramResult result;
  const MemoryFile output, messages;
  int ends[2];
  if (output.descriptor() < 0 || messages.descriptor() < 0 ||
      socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    result.messages = command[0] + " cannot be started: " + strerror(errno);
    return result;
  }
  const auto [process, code] = start(command, ends[1], output.descriptor(), messages.descriptor());
  result.started = code == 0;
  close(ends[1]);
  if (result.started) feed(ends[0], input);
  close(ends[0]);
  if (!result.started) {
    if (code != ENOENT) result.messages = command[0] + " cannot be started: " + strerror(code);
    return result;
  }
  const int status = wait_for(process);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  result.output = output.bytes();
  result.messages = on_one_line(messages.bytes());
  if (result.messages.empty() && WIFSIGNALED(status))
    result.messages = std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
  return result;
}

void expect_started(const ProgramResult& result, const std::string& missing) {
  if (!result.started) throw PictureError(result.messages.empty() ? missing : result.messages);
}

}  // namespace condyle
