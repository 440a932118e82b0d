#include "condyle/start_threads.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <vector>

namespace condyle {
namespace {

TEST(StartThreads, EachHasItsNumber) {
  std::vector<int> numbers(5, 0);
  {
    const auto threads = start_threads(1, 5, [&](int i) { numbers[i] = i; });
  }
  EXPECT_EQ(numbers, (std::vector<int>{0, 1, 2, 3, 4}));
}

// A stack is 8 MB of address space: a limit on it gives less than a thousand.
TEST(StartThreadsDeathTest, AreAsManyAsCanBeHad) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need all of the address space";
#endif
  const auto start_a_thousand = [] {
    const rlimit little{rlim_t{1} << 30, rlim_t{1} << 30};
    setrlimit(RLIMIT_AS, &little);
    std::atomic<bool> all_there = false;
    std::atomic<int> worked = 0;
    std::size_t started = 0;
    {
      const auto threads = start_threads(0, 1000, [&](int) {
        all_there.wait(false);
        ++worked;
      });
      started = threads.size();
      all_there = true;
      all_there.notify_all();
    }
    const bool good = started > 0 && started < 1000 && worked == static_cast<int>(started);
    std::_Exit(good ? 7 : 1);
  };
  EXPECT_EXIT(start_a_thousand(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace condyle
