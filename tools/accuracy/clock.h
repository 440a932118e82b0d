#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace condyle::accuracy {

/// Time on the wall [us].
inline double wall_microseconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(now).count();
}

/// Least time of several runs of `work` [us]: what it costs when nothing disturbs it. No run begins
/// after `seconds`, but for the first.
template <class Work>
double least_microseconds(int runs, const Work& work, double seconds = 1e300) {
  const double start = wall_microseconds();
  double least = 1e300;
  for (int run = 0; run < runs && (run == 0 || wall_microseconds() - start < seconds * 1e6);
       ++run) {
    const double begin = wall_microseconds();
    work();
    least = std::min(least, wall_microseconds() - begin);
  }
  return least;
}

/// Processor time of one long run on this thread [us]: what others do on the machine hardly counts.
/// Not for microseconds, and not for the least of many: the clock of a virtual machine may slip.
template <class Work>
double processor_microseconds(const Work& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) / 1e3;
  };
  const double begin = now();
  work();
  return now() - begin;
}

}  // namespace condyle::accuracy
