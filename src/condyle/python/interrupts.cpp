#include "condyle/python/interrupts.h"

#include <atomic>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace condyle::python {

namespace py = pybind11;

namespace {

/// Ends work that is asked to stop.
struct Stopped {};

std::atomic<int> computing = 0;       // how many have let go of the lock
thread_local int computing_here = 0;  // of them in this thread
std::atomic<bool> ending = false;
std::thread::id ending_thread;  // set before

/// Ctrl-C while the interpreter waits at its end: nothing else would end the process.
[[noreturn]] void end_process() {
  PyErr_Clear();
  for (const char* stream : {"stdout", "stderr"}) try {
      py::module_::import("sys").attr(stream).attr("flush")();
    } catch (const py::error_already_set&) {  // closed, or full
    }
  std::_Exit(128 + SIGINT);
}

void wait_for_others() {
  ending_thread = std::this_thread::get_id();
  ending = true;
  while (computing > 0) {
    {
      const py::gil_scoped_release unlocked;
      for (int i = 0; i < 50 && computing > 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (PyErr_CheckSignals() != 0) end_process();
  }
}

/// In the child of a fork there is this thread alone.
void begin_child() {
  computing = computing_here;
  ending = false;
}

}  // namespace

Unlocked::Unlocked() {
  if (interpreter_ends()) end_thread();
  ++computing;
  ++computing_here;
  release_.emplace();
}

Unlocked::~Unlocked() {
  release_.reset();
  --computing_here;
  --computing;
}

bool interpreter_ends() { return ending && std::this_thread::get_id() != ending_thread; }

void end_thread() {
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

void wait_at_exit() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_others));
  py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") =
                                                         py::cpp_function(&begin_child));
}

void run_interruptibly(const std::function<void(const std::function<bool()>& should_stop)>& work) {
  std::atomic<bool> stop = false;
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr failure;
  std::optional<py::error_already_set> raised;
  const std::thread::id caller = std::this_thread::get_id();
  const auto should_stop = [&] { return stop || (ending && caller != ending_thread); };
  {
    const Unlocked unlocked;
    std::thread worker([&] {
      try {
        work(should_stop);
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return done; })) {
      if (raised) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire locked;
        if (PyErr_CheckSignals() != 0) {
          raised.emplace();
          stop = true;
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (raised) throw std::move(*raised);
  if (failure) std::rethrow_exception(failure);
  if (interpreter_ends()) end_thread();
}

void run_interruptibly(const OnProgress& progress,
                       const std::function<void(const OnProgress& on_progress)>& work) {
  run_interruptibly([&](const std::function<bool()>& should_stop) {
    std::exception_ptr raised;  // by `progress`, of which the first counts
    const OnProgress on_progress = [&](int done, int total) {
      if (should_stop() || raised) throw Stopped{};
      try {
        if (progress) progress(done, total);
      } catch (...) {
        raised = std::current_exception();
        throw Stopped{};
      }
    };
    try {
      work(on_progress);
    } catch (const Stopped&) {
      if (raised) std::rethrow_exception(raised);
    }
  });
}

}  // namespace condyle::python
