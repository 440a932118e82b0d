#include "accuracy/run_process.h"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>

namespace condyle::accuracy {
namespace {

[[noreturn]] void become(const std::vector<char*>& words, int out) {
  dup2(out, STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  execv(words[0], words.data());
  _exit(127);
}

/// The resource usage that `wait4` tells would hold the peak of this process too, from before exec.
double peak_megabytes(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string word; file >> word;) {
    double kilobytes = 0;
    if (word == "VmHWM:" && file >> kilobytes) return kilobytes / 1024;
  }
  return 0;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

/// Lets the child run to its end, and looks at it just before.
int follow(pid_t child, Process& process) {
  int status = 0;
  bool first = true;
  rusage use{};
  while (wait4(child, &status, 0, &use) == child && WIFSTOPPED(status)) {
    long signal = WSTOPSIG(status);
    if (signal == SIGTRAP) signal = 0;  // exec, or the end
    if (status >> 8 == (SIGTRAP | (PTRACE_EVENT_EXIT << 8)))
      process.megabytes = peak_megabytes(child);
    if (first) ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACEEXIT | PTRACE_O_EXITKILL);
    first = false;
    ptrace(PTRACE_CONT, child, nullptr, signal);
  }
  process.seconds = seconds(use.ru_utime) + seconds(use.ru_stime);
  return status;
}

std::string read_all(int from) {
  std::string text;
  std::array<char, 4096> some;
  for (ssize_t got; (got = read(from, some.data(), some.size())) > 0;)
    text.append(some.data(), static_cast<std::size_t>(got));
  return text;
}

}  // namespace

Process run_process(const std::vector<std::string>& command) {
  Process process;
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return process;
  const pid_t child = fork();
  if (child == 0) become(words, ends[1]);
  close(ends[1]);
  if (child > 0) {
    const int status = follow(child, process);
    process.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  process.output = read_all(ends[0]);
  close(ends[0]);
  return process;
}

}  // namespace condyle::accuracy
