#pragma once

#include <algorithm>
#include <chrono>

namespace condyle::accuracy {

/// Least time of several runs of `work` [us]: what it costs when nothing disturbs it.
/// No run begins after `seconds`, but for the first.
template <class Work>
double least_microseconds(int runs, const Work& work, double seconds = 1e300) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto since = [](Clock::time_point begin) {
    return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
  };
  double least = 1e300;
  for (int run = 0; run < runs && (run == 0 || since(start) < seconds * 1e6); ++run) {
    const Clock::time_point begin = Clock::now();
    work();
    least = std::min(least, since(begin));
  }
  return least;
}

}  // namespace condyle::accuracy
