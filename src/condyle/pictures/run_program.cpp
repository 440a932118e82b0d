#include "condyle/pictures/run_program.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

extern char** environ;

namespace condyle {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

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

std::string bytes_of(std::FILE* file) {
  std::string bytes;
  std::rewind(file);
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) bytes += static_cast<char>(c);
  return bytes;
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

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const std::string& input) {
  ProgramResult result;
  const File output(std::tmpfile(), std::fclose), messages(std::tmpfile(), std::fclose);
  int ends[2];
  if (!output || !messages || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return result;
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(output.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages.get()), STDERR_FILENO);
  // What this program ignores: a file beyond the limit is the end of the other one, as it knows it.
  sigset_t usual;
  sigemptyset(&usual);
  for (const int signal : {SIGPIPE, SIGXFSZ}) sigaddset(&usual, signal);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  result.started =
      posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  close(ends[1]);
  if (result.started) feed(ends[0], input);
  close(ends[0]);
  if (!result.started) return result;
  const int status = wait_for(process);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  result.output = bytes_of(output.get());
  result.messages = on_one_line(bytes_of(messages.get()));
  if (result.messages.empty() && WIFSIGNALED(status))
    result.messages = std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
  return result;
}

}  // namespace condyle
