#include "condyle/app/interrupt.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <string_view>

#include "condyle/results/unkept_file.h"

namespace condyle {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
constexpr std::array<std::string_view, kSignals.size()> kNames = {"SIGINT", "SIGTERM", "SIGHUP",
                                                                  "SIGXCPU"};

// What the handler reads is complete before it is told of.
std::atomic<int> questions = 0;
std::atomic<bool> interrupted = false;
std::atomic<std::size_t> words_there = 0;
std::array<char, 4096> last_words;
std::array<char, 64> program_name;
bool terminal = false;
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<std::size_t>::is_always_lock_free);

void say_at_once(std::string_view text) {
  if (::write(STDERR_FILENO, text.data(), text.size()) < 0) return;  // nobody listens
}

void say_ending(int signal) {
  const auto known = std::find(kSignals.begin(), kSignals.end(), signal) - kSignals.begin();
  if (terminal) say_at_once("\r\x1b[K");  // a progress line
  say_at_once(program_name.data());
  say_at_once(": ended by ");
  say_at_once(kNames[static_cast<std::size_t>(known)]);
  if (const std::size_t length = words_there; length > 0) {
    say_at_once("; ");
    say_at_once({last_words.data(), length});
  }
  say_at_once("\n");
}

extern "C" void on_signal(int signal) {
  if (questions > 0 && !interrupted.exchange(true)) return;
  say_ending(signal);
  remove_unkept_files();
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  sigaction(signal, &action, nullptr);
  ::raise(signal);  // when this handler returns
}

}  // namespace

void tell_of_signals(const std::string& program) {
  program_name.fill('\0');
  program.copy(program_name.data(), program_name.size() - 1);
  terminal = ::isatty(STDERR_FILENO) == 1;
  for (const int signal : kSignals) {
    struct sigaction before = {};
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    struct sigaction action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

Interrupt::Interrupt() {
  interrupted = false;
  ++questions;
}

Interrupt::~Interrupt() { --questions; }

bool Interrupt::asked() const { return interrupted; }

LastWords::LastWords(const std::string& words) {
  words_there = words.copy(last_words.data(), last_words.size());
}

LastWords::~LastWords() { words_there = 0; }

}  // namespace condyle
