#include "accuracy/run_process.h"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>

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

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string bytes_of(std::FILE* file) {
  std::string bytes;
  std::array<char, 4096> some;
  std::rewind(file);
  for (std::size_t got; (got = std::fread(some.data(), 1, some.size(), file)) > 0;)
    bytes.append(some.data(), got);
  return bytes;
}

}  // namespace

Process run_process(const std::vector<std::string>& command) {
  Process process;
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const File output(std::tmpfile(), std::fclose);  // a pipe holds 64 kB and is read by nobody yet
  if (!output) return process;
  const pid_t child = fork();
  if (child == 0) become(words, fileno(output.get()));
  if (child > 0) {
    const int status = follow(child, process);
    process.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  process.output = bytes_of(output.get());
  return process;
}

}  // namespace condyle::accuracy
