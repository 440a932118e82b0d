#pragma once

/// A line on the standard error that tells how far a long work is and how long it may still take.
/// It is there only where a terminal watches and the command talks in plain lines, from half a
/// second on, and is wiped off in the end: logs and pipes see nothing of it.

#include <chrono>
#include <string>

#include "condyle/app/talk.h"

namespace condyle {

class Progress {
 public:
  /// `what` is counted: "poses".
  Progress(const Talk& talk, std::string what);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws the line where it is time; `total` 0: not known.
  void at(int done, int total);
  /// Wipes the line off, as has to be done before anything else is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool watched_, drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// "poses  [######--------]  12 of 25, about 3 s left", no longer than `width`.
[[nodiscard]] std::string progress_line(
    const std::string& what, int done, int total, double seconds, int width);

}  // namespace condyle
