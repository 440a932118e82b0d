#include "support/instruction_count.h"

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CONDYLE_COUNTS_INSTRUCTIONS 1
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#endif

namespace condyle::test {

#ifdef CONDYLE_COUNTS_INSTRUCTIONS
namespace {

/// Between two stops that the child asks for.
std::optional<long> step_through(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) return std::nullopt;
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    raise(SIGSTOP);
    work();
    raise(SIGSTOP);
    _exit(0);
  }
  int status = 0;
  std::optional<long> count;
  if (waitpid(child, &status, 0) == child && WIFSTOPPED(status)) {
    long steps = 0;
    while (ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr) == 0 &&
           waitpid(child, &status, 0) == child && WIFSTOPPED(status) && WSTOPSIG(status) == SIGTRAP)
      ++steps;
    if (WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP) count = steps;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return count;
}

}  // namespace

std::optional<long> count_instructions(const std::function<void()>& work) {
  const std::optional<long> nothing = step_through([] {}), all = step_through(work);
  if (!nothing || !all) return std::nullopt;
  return *all - *nothing;
}
#else
std::optional<long> count_instructions(const std::function<void()>&) { return std::nullopt; }
#endif

}  // namespace condyle::test
