/// Lines that differ: what is taken out of the first text and put in gives the second.

#include "condyle/report/text_difference.h"

#include <gtest/gtest.h>

#include <random>

namespace condyle {
namespace {

using Kind = DifferenceLine::Kind;

std::string shown(const std::string& a, const std::string& b, std::size_t context) {
  const auto lines = text_difference(a, b, context);
  if (!lines) return "too many";
  std::string text;
  for (const DifferenceLine& line : *lines) {
    const char* mark[] = {" ", "-", "+", "~"};
    text += mark[static_cast<int>(line.kind)] + line.text + "\n";
  }
  return text;
}

TEST(TextDifference, ShowsLinesThatDifferAndThoseAboutThem) {
  EXPECT_EQ(shown("a\nb\nc\nd\ne\nf\n", "a\nb\nc\nx\ne\nf\ng\n", 1), "~\n c\n-d\n+x\n e\n f\n+g\n");
  EXPECT_EQ(shown("a\nb\n", "a\nb\n", 2), "");
  EXPECT_EQ(shown("a\r\nb\r\n", "a\nb\n", 2), "") << "ends of lines are none of its business";
  EXPECT_EQ(shown("", "a\n", 2), "+a\n");
  EXPECT_EQ(shown("a\n", "", 2), "-a\n");
  EXPECT_EQ(shown("", "", 2), "");
}

TEST(TextDifference, LeadsFromTheFirstTextToTheSecond) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::string a, b;
    for (std::string* text : {&a, &b})
      for (auto n = random() % 30; n > 0; --n)
        *text += std::string(1, static_cast<char>('a' + random() % 4)) + "\n";
    const auto lines = text_difference(a, b, 100);
    ASSERT_TRUE(lines);
    if (lines->empty()) {
      EXPECT_EQ(a, b);
      continue;
    }
    std::string first, second;
    for (const DifferenceLine& line : *lines) {
      if (line.kind != Kind::kOnlySecond) first += line.text + "\n";
      if (line.kind != Kind::kOnlyFirst) second += line.text + "\n";
    }
    EXPECT_EQ(first, a);
    EXPECT_EQ(second, b);
  }
}

TEST(TextDifference, GivesUpOnTextsThatHaveNothingInCommon) {
  std::string a, b;
  for (int i = 0; i < 3000; ++i) {
    a += "a" + std::to_string(i) + "\n";
    b += "b" + std::to_string(i) + "\n";
  }
  EXPECT_EQ(shown(a, b, 2), "too many");
}

}  // namespace
}  // namespace condyle
