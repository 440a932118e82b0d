#include "support/instruction_count.h"

#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CONDYLE_COUNTS_INSTRUCTIONS 1
#include <sched.h>
#include <sys/auxv.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#endif

namespace condyle::test {

#ifdef CONDYLE_COUNTS_INSTRUCTIONS
namespace {

/// Is the child about to read the clock? That is the kernel's code in the child's memory, and it
/// begins anew where the clock has ticked meanwhile: not to be counted.
bool reads_clock([[maybe_unused]] pid_t child) {
#ifdef __x86_64__
  constexpr unsigned long kSize = 0x2000;  // two pages
  const unsigned long vdso = getauxval(AT_SYSINFO_EHDR);
  const auto at = static_cast<unsigned long>(
      ptrace(PTRACE_PEEKUSER, child, offsetof(user_regs_struct, rip), nullptr));
  return at - vdso < kSize;
#else
  return false;
#endif
}

/// While it lives this thread, and what it forks, run on the processor where it is now: two that
/// wait for each other after every instruction take a quarter of the time on one.
class OnOneProcessor {
 public:
  OnOneProcessor() {
    const int here = sched_getcpu();
    cpu_set_t one;
    CPU_ZERO(&one);
    if (here >= 0) CPU_SET(here, &one);
    kept_ = here >= 0 && sched_getaffinity(0, sizeof before_, &before_) == 0 &&
            sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~OnOneProcessor() {
    if (kept_) sched_setaffinity(0, sizeof before_, &before_);
  }
  OnOneProcessor(const OnOneProcessor&) = delete;
  OnOneProcessor& operator=(const OnOneProcessor&) = delete;

 private:
  cpu_set_t before_{};
  bool kept_ = false;
};

/// Between two stops that the child asks for.
std::optional<long> step_through(const std::function<void()>& work) {
  const OnOneProcessor close;
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
      steps += reads_clock(child) ? 0 : 1;
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
