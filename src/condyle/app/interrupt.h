#pragma once

/// Ctrl-C as a question, and SIGTERM, by which batch systems end a job: while one of these lives the
/// first of each is noted and the work may end in its own way; a second one ends the program at once.

#include <csignal>

namespace condyle {

class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] bool asked() const;

 private:
  struct sigaction before_, before_term_;
};

}  // namespace condyle
