#pragma once

/// Helpers for work that any number of threads can share.

#include <algorithm>
#include <system_error>
#include <thread>
#include <vector>

namespace condyle {

/// As many as are asked for; 0 or fewer: one for each processor.
[[nodiscard]] inline int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Threads that do work(first), work(first + 1), ... work(end - 1), or the first of them where the system gives
/// no more (a limit on processes or memory). They are waited for where the list ends.
template <class Work>
[[nodiscard]] std::vector<std::jthread> start_threads(int first, int end, const Work& work) {
  std::vector<std::jthread> threads;
  for (int i = first; i < end; ++i) {
    try {
      threads.emplace_back(work, i);
    } catch (const std::system_error&) {
      break;
    }
  }
  return threads;
}

}  // namespace condyle
