#pragma once

/// C++ that computes without the interpreter's lock: Ctrl-C, as Python's handlers run only where its interpreter is asked, and
/// an interpreter that ends while a daemon thread computes.

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>
#include <optional>

#include "condyle/on_progress.h"

namespace condyle::python {

/// Without the interpreter's lock, which the caller has and gets back. The interpreter does not end meanwhile: a thread that
/// waits for its lock then would be ended within C++. Ends the thread where it is about to end.
class Unlocked {
 public:
  Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked();

 private:
  std::optional<pybind11::gil_scoped_release> release_;
};

/// Is the interpreter about to end, and this not the thread that ends it? What computes then has to stop.
[[nodiscard]] bool interpreter_ends();
/// Ends a Python thread without a word, under the interpreter's lock: SystemExit.
[[noreturn]] void end_thread();

/// Has the end of the interpreter wait for what computes, as it does for threads that are no daemons; Ctrl-C ends the process.
void wait_at_exit();

/// For loops without the interpreter's lock: asks it some twenty times a second. Throws what a handler raises.
class Interrupts {
 public:
  void check() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    const pybind11::gil_scoped_acquire lock;
    if (interpreter_ends()) end_thread();
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

/// Does work in another thread and asks the interpreter meanwhile; the caller has its lock, and gets it back. `work` is
/// told whether it should stop and may throw then. Throws what `work` throws, or what a handler raised.
void run_interruptibly(const std::function<void(const std::function<bool()>& should_stop)>& work);

/// The same for work that tells of its progress, which ends there where it should, or with what `progress` throws. `work` must
/// be such that its progress may throw.
void run_interruptibly(const OnProgress& progress,
                       const std::function<void(const OnProgress& on_progress)>& work);

}  // namespace condyle::python
