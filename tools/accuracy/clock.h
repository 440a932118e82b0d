#pragma once

#include <algorithm>
#include <chrono>

namespace condyle::accuracy {

/// Least time of several runs of `work` [us]: what it costs when nothing disturbs it.
template <class Work>
double least_microseconds(int runs, const Work& work) {
  using Clock = std::chrono::steady_clock;
  double least = 1e300;
  for (int run = 0; run < runs; ++run) {
    const Clock::time_point begin = Clock::now();
    work();
    least =
        std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  return least;
}

}  // namespace condyle::accuracy
