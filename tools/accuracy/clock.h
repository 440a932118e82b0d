#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace condyle::accuracy {

/// Processor time of this thread [us]: what others do on the machine does not count.
inline double thread_microseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) / 1e3;
}

/// Time on the wall [us].
inline double wall_microseconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(now).count();
}

/// Least processor time of several runs of `work` on this thread [us]. No run begins after
/// `seconds`, but for the first.
template <class Work>
double least_microseconds(int runs, const Work& work, double seconds = 1e300) {
  const double start = wall_microseconds();
  double least = 1e300;
  for (int run = 0; run < runs && (run == 0 || wall_microseconds() - start < seconds * 1e6);
       ++run) {
    const double begin = thread_microseconds();
    work();
    least = std::min(least, thread_microseconds() - begin);
  }
  return least;
}

/// The same on the wall, for work of several threads.
template <class Work>
double least_wall_microseconds(int runs, const Work& work) {
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const double begin = wall_microseconds();
    work();
    least = std::min(least, wall_microseconds() - begin);
  }
  return least;
}

}  // namespace condyle::accuracy
