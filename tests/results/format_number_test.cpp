#include "condyle/results/format_number.h"

#include <gtest/gtest.h>

namespace condyle {
namespace {

TEST(FormatNumber, ALaterOneIsToldByItsNumber) {
  EXPECT_EQ(
      later_format("condyle 2", "condyle 1"),
      "written by a later condyle (format \"condyle 2\"), this one reads up to \"condyle 1\"");
  // As numbers, and with what follows them.
  EXPECT_NE(later_format("condyle journal 10 scene 12", "condyle journal 9"), "");
}

TEST(FormatNumber, ItsOwnOneAnEarlierOneAndWhatIsNoneAreNot) {
  for (const char* words :
       {"condyle 1", "condyle 01", "condyle 0", "condyle", "", "condyle study 2", "condyle x2",
        "knee 2", "condyle 99999999999999999999"})
    EXPECT_EQ(later_format(words, "condyle 1"), "") << words;
}

}  // namespace
}  // namespace condyle
