#include "condyle/report/html.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace condyle {
namespace {

TEST(Html, EscapesWhatCouldEndATextOrAnAttribute) {
  EXPECT_EQ(escaped(std::string("a\0b\x1b[2J\x7f\n\té", 12)), "a\\u0000b\\u001b[2J\\u007f\n\té");
  EXPECT_EQ(escaped("a\u202egpj.b\u2066 \u2014 \u2068"), "a\\u202egpj.b\\u2066 \u2014 \\u2068");
  EXPECT_EQ(escaped("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
}

TEST(Html, KeepsJsonFromEndingItsScript) {
  EXPECT_EQ(script_safe("{\"a\":\"</script><!--&\"}"),
            "{\"a\":\"\\u003c/script\\u003e\\u003c!--\\u0026\"}");
}

TEST(Html, WritesNumbersForPeople) {
  EXPECT_EQ(number(1.005, 1), "1.0");
  EXPECT_EQ(number(-0.001, 2), "0.00");  // no minus before nothing
  EXPECT_EQ(number(-0.01, 2), "-0.01");
  EXPECT_EQ(number(std::nan(""), 2), "-");
  EXPECT_EQ(short_number(0.012345), "0.0123");
}

TEST(Html, EscapesEveryCellOfATable) {
  const std::string text = html(HtmlTable{"<c>", {"<h>"}, {{"<d>"}}, {}});
  for (const char* raw : {"<c>", "<h>", "<d>"}) EXPECT_EQ(text.find(raw), std::string::npos) << raw;
  for (const char* safe : {"&lt;c&gt;", "&lt;h&gt;", "&lt;d&gt;"})
    EXPECT_NE(text.find(safe), std::string::npos) << safe;
}

TEST(Html, NoTextEndsAStringOfCss) {
  EXPECT_EQ(css_string("Knee 1"), "\"Knee 1\"");
  EXPECT_EQ(css_string("\"}</style>\n a"), R"("\22 \7d \3c \2f style\3e \a  a")");
  EXPECT_EQ(css_string("µ"), "\"µ\"");
}

TEST(Html, ATableOfManyColumnsBecomesSeveral) {
  HtmlTable table{"forces", {"flexion"}, {{"0"}, {"5"}}, {0, 20}, {"", "failed"}};
  for (int k = 1; k <= 20; ++k) {
    table.columns.push_back("c" + std::to_string(k));
    for (auto& row : table.rows) row.push_back("v" + std::to_string(k));
  }
  const std::string text = html(table);
  EXPECT_NE(text.find("<caption>forces, columns 2 to 16 of 21</caption>"), std::string::npos);
  EXPECT_NE(text.find("<caption>forces, columns 17 to 21 of 21</caption>"), std::string::npos);
  // Each part begins with the first column, and the last column keeps its side.
  EXPECT_NE(text.find("<tr class=\"failed\"><td class=\"text\">5</td><td>v16</td>"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<td class=\"text\">v20</td></tr>"), std::string::npos);
}

TEST(Html, LeavesOutASectionWithNothingInIt) {
  EXPECT_EQ(section("a", "A", ""), "");
  EXPECT_EQ(section("a", "A & B", "<p>x</p>\n"),
            "<section id=\"a\">\n<h2>A &amp; B</h2>\n<p>x</p>\n</section>\n");
}

}  // namespace
}  // namespace condyle
