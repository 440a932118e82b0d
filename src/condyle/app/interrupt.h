#pragma once

/// Signals that end a program: Ctrl-C, SIGTERM and SIGXCPU, by which batch systems end a job, and SIGHUP of a
/// terminal that is gone. What the caller has ignored (nohup) stays ignored.

#include <string>

namespace condyle {

/// From now on such a signal removes files that are not whole, says a line in the name of `program`, and then
/// ends the program as it would have.
void tell_of_signals(const std::string& program);

/// While one of these lives the first signal is a question: it is noted, and the work may end in its own
/// way. A second one ends the program.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] bool asked() const;
};

/// While one of these lives the line of a signal ends with what is left of the work, and how to go on.
class LastWords {
 public:
  explicit LastWords(const std::string& words);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;
};

}  // namespace condyle
