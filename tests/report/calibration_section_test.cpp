/// The report of a calibration as a text.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "condyle/report/report_page.h"
#include "condyle/results/run_file.h"
#include "support/made_up_calibration.h"

namespace condyle {
namespace {

Run run_of(const CalibrationResult& result) {
  Run run;
  run.scene = test::made_up_calibration_scene();
  run.study = std::make_shared<const CalibrationResult>(result);
  return run;
}

std::string page_of(const CalibrationResult& result, bool pictures = false) {
  ReportOptions options;
  options.viewer = false;
  options.pictures = pictures;
  return report_page(run_of(result), "fit.h5", options);
}

TEST(CalibrationSection, TellsWhatItIsAndHoldsItsTables) {
  const std::string page = page_of(test::made_up_calibration());
  EXPECT_NE(page.find("<section id=\"calibration\">"), std::string::npos);
  for (const char* words : {"pPCL.reference_strain", "6.1 → 0.97", "4.4 → 1.2", "at its bound",
                            "vv60", "unseen", "no pose", "the descent found no rest"})
    EXPECT_EQ(page.find(words) == std::string::npos, std::string(words) == "at its bound") << words;
}

// What is a table on the terminal is a table of the page, and told once.
TEST(CalibrationSection, WordsAreAListAndNoTablesOfLetters) {
  const std::string page = page_of(test::made_up_calibration());
  const std::size_t begin = page.find("<section id=\"calibration\">");
  const std::string section = page.substr(begin, page.find("</section>", begin) - begin);
  EXPECT_EQ(section.find("<pre>"), std::string::npos);
  const std::size_t list = section.find("<ul class=\"words\">");
  ASSERT_NE(list, std::string::npos);
  const std::string words = section.substr(list, section.find("<div class=\"table", list) - list);
  const auto count = [&](const std::string& part) {
    int n = 0;
    for (std::size_t at = 0; (at = words.find(part, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  EXPECT_EQ(count("<li>"), count("</li>"));
  EXPECT_EQ(count("<ul"), count("</ul>"));
  EXPECT_GT(count("<ul"), 1) << "lists within lines";
  EXPECT_EQ(words.find("sd/prior"), std::string::npos) << "a head of a table";
}

TEST(CalibrationSection, AParameterAtItsBoundHasNoDeviation) {
  auto result = test::made_up_calibration();
  result.at_bound[0] = true;
  EXPECT_NE(page_of(result).find("<td>at its bound</td>"), std::string::npos);
}

TEST(CalibrationSection, TheWorstRowStandsFirst) {
  auto result = test::made_up_calibration();
  result.table.rows[6].value = result.rows[6].after - 20 * result.rows[6].sd;
  const std::string page = page_of(result);
  const std::size_t table = page.find("Rows that the fitted knee meets worst");
  ASSERT_NE(table, std::string::npos);
  const std::size_t first = page.find("<tbody>", table);
  const std::string row = page.substr(first, page.find("</tr>", first) - first);
  EXPECT_NE(row.find("knee.csv:8"), std::string::npos) << row;
  EXPECT_NE(row.find("<td>20.00</td>"), std::string::npos) << row;
}

TEST(CalibrationSection, NumbersThatAreNoneBreakNothing) {
  auto result = test::made_up_calibration();
  for (CalibratedRow& row : result.rows) row.before = row.after = row.after_sd = std::nan("");
  result.known.sd.setConstant(std::nan(""));
  result.sample_sd.resize(0);
  result.samples.resize(0, 0);
  result.bands.clear();
  result.tests.clear();
  result.suggested.clear();
  const std::string page = page_of(result);
  EXPECT_EQ(page.find(">nan<"), std::string::npos);
  EXPECT_EQ(page.find("Tests that were not made"), std::string::npos);
}

#ifdef CONDYLE_PICTURES
TEST(CalibrationSection, PicturesOfSecondRankAreFoldedAway) {
  const std::string page = page_of(test::made_up_calibration(), true);
  const std::size_t plots = page.find("<section id=\"plots\">");
  if (plots == std::string::npos) GTEST_SKIP() << "gnuplot is not installed";
  const std::size_t fold = page.find("<summary>Profiles and the other coordinates", plots);
  ASSERT_NE(fold, std::string::npos);
  std::size_t before = 0, after = 0;
  for (std::size_t at = plots; (at = page.find("<figure class=\"plot\">", at)) != std::string::npos;
       ++at)
    ++(at < fold ? before : after);
  EXPECT_EQ(before, 7U);
  EXPECT_EQ(after, 2U);
}
#endif

}  // namespace
}  // namespace condyle
