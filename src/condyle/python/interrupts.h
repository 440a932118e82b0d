#pragma once

/// Ctrl-C while C++ computes: Python's handlers run only where its interpreter is asked.

#include <pybind11/pybind11.h>

#include <chrono>
#include <functional>

#include "condyle/on_progress.h"

namespace condyle::python {

/// For loops without the interpreter's lock: asks it some twenty times a second. Throws what a handler raises.
class Interrupts {
 public:
  void check() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    const pybind11::gil_scoped_acquire lock;
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
