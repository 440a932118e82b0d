/// Tables of measurements: what is read, and what is refused in which words.

#include <gtest/gtest.h>

#include "condyle/calibration/measurement_table.h"

namespace condyle::test {
namespace {

TEST(MeasurementTable, RowsAreFittedUnlessTheySayOtherwise) {
  EXPECT_EQ(Measurement{}.use, MeasuredUse::kFit);
}

}  // namespace
}  // namespace condyle::test
