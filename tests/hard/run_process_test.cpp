#include "accuracy/run_process.h"

#include <gtest/gtest.h>

namespace condyle::accuracy {
namespace {

TEST(RunProcess, TakesMoreThanAPipeHolds) {
  const Process process = run_process({"/usr/bin/head", "-c", "1000000", "/dev/zero"});
  if (!process.good) GTEST_SKIP() << "this system lets no process be traced";
  EXPECT_EQ(process.output.size(), 1000000U);
}

}  // namespace
}  // namespace condyle::accuracy
