#include "condyle/pictures/plot_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/run_program.h"
#include "condyle/results/study_shown.h"
#include "pictures/plot_pages.h"
#include "support/made_up_study.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using Names = std::vector<std::string>;

const PagePanel& panel_of(const std::vector<NamedPage>& pages, const std::string& title) {
  for (const NamedPage& page : pages)
    for (const PagePanel& panel : page.page.panels)
      if (panel.title == title) return panel;
  throw std::runtime_error("no panel " + title);
}

std::vector<const Mark*> marks_of(const PagePanel& panel, Mark::Kind kind) {
  std::vector<const Mark*> marks;
  for (const Mark& mark : panel.marks)
    if (mark.kind == kind) marks.push_back(&mark);
  return marks;
}

void expect_drawn(const StudyView& study, const char* folder) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const auto where = test::fresh_folder(folder);
  const auto files = write_plots(study_plots(study), where, {PlotFormat::kPng});
  EXPECT_EQ(files.size(), study_pages(study).size() + study_maps(study).size());
  for (const auto& file : files) {
    const Image image = read_png(file);
    EXPECT_GE(image.width, 600) << file;
    EXPECT_GE(image.height, 240) << file;
  }
  for (const NamedPage& page : study_pages(study))
    for (const PagePanel& panel : page.page.panels) {
      EXPECT_LE(panel.left + panel.width, page.page.width) << page.name;
      EXPECT_LE(panel.top + panel.height, page.page.height) << page.name;
    }
}

TEST(PlotStudy, WritesAllItsPages) { expect_drawn(test::made_up_study(), "study_one"); }

TEST(PlotStudy, KneesOfAPopulationAreDrawn) {
  for (const int knees : {2, 6, 30}) expect_drawn(test::made_up_study(false, knees), "study_knees");
}

// A contact that is held closed pulls in all samples: gnuplot would have nothing to draw from 0 on.
TEST(PlotStudy, ForcesBelowZeroAreDrawn) {
  StudyView study = test::made_up_study();
  const auto begins_at_zero = [&] {
    const auto pages = study_band_pages(study);
    const PagePanel& panel = pages.at(1).page.panels.at(0);
    ChartPage page{"title", "what"};
    page.panels = {panel};
    return gnuplot_script(page, PlotFormat::kPng).find("set yrange [0:*]") != std::string::npos;
  };
  EXPECT_TRUE(begins_at_zero());
  for (StudyBand& band : study.all.bands)
    for (std::vector<double>& quantile : band.quantiles)
      for (double& value : quantile) value = -std::abs(value) - 100;
  EXPECT_FALSE(begins_at_zero());
  expect_drawn(study, "study_pulls");
}

// A study of one pose: bands are strokes, lines are dots, and the axis is not a hundredth of an angle.
TEST(PlotStudy, OnePoseIsSeen) {
  Mark band{Mark::Kind::kBand, {30}, {}, {1}, {2}}, line{Mark::Kind::kLine, {30}, {1.5}};
  PagePanel panel;
  panel.marks = {band, line};
  ChartPage page{"title", "what"};
  page.panels = {panel};
  lay_in_grid(page, 1, 200);
  const std::string script = gnuplot_script(page, PlotFormat::kPng);
  EXPECT_NE(script.find("using 1:2:(0):($3-$2) with vectors nohead"), std::string::npos) << script;
  EXPECT_NE(script.find("alone using 1:2 with points"), std::string::npos);
  EXPECT_NE(script.find("set xrange [27:33]"), std::string::npos);
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const auto file = test::fresh_folder("study_of_one_pose") / "page.png";
  draw_script(gnuplot_script(page, PlotFormat::kPng), file);
  EXPECT_EQ(read_png(file).width, page.width);
}

TEST(PlotStudy, OneAndManyParametersAreDrawn) {
  for (const std::size_t parameters : {1, 24})
    expect_drawn(test::made_up_study(true, 1, parameters), "study_many");
}

TEST(PlotStudy, BandsHoldTheQuantilesTheMedianAndTheNominalSweep) {
  const StudyView study = test::made_up_study();
  const auto pages = study_band_pages(study);
  EXPECT_EQ(names_of(pages), (Names{"study_joint", "study_contacts", "study_ligaments"}));
  const PagePanel& drawer = panel_of(pages, "anterior drawer");
  EXPECT_EQ(drawer.x_label, "Flexion [°]");
  EXPECT_EQ(drawer.y_label, "Translation [mm]");
  const StudyBand& band = study.all.bands[3];
  const auto bands = marks_of(drawer, Mark::Kind::kBand),
             lines = marks_of(drawer, Mark::Kind::kLine);
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[0]->low, band.quantiles[0]);
  EXPECT_EQ(bands[0]->high, band.quantiles[4]);
  EXPECT_EQ(bands[1]->low, band.quantiles[1]);
  EXPECT_EQ(bands[1]->high, band.quantiles[3]);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]->y, band.quantiles[2]);
  EXPECT_EQ(lines[1]->y, band.nominal);
  EXPECT_TRUE(lines[1]->dashed);
  for (std::size_t i = 0; i < study.values.size(); ++i)
    EXPECT_NEAR(lines[0]->x[i], study.values[i], 1e-9);
}

TEST(PlotStudy, LigamentsThatNeverCarryHaveNoBand) {
  const auto pages = study_band_pages(test::made_up_study());
  EXPECT_NO_THROW((void)panel_of(pages, "aACL"));
  EXPECT_THROW((void)panel_of(pages, "LCL"), std::runtime_error);
  EXPECT_EQ(panel_of(pages, "medial contact").y_label, "Force [N]");
}

TEST(PlotStudy, MapsSayWhatTheyShowBehindTheTitle) {
  StudyView study = test::made_up_study();
  study.title = "Knees";
  std::vector<std::string> titles;
  for (const NamedMap& map : study_maps(study)) {
    const std::string script = gnuplot_script(map.map, PlotFormat::kSvg);
    EXPECT_NE(script.find("\"Knees: " + map.map.what + "\""), std::string::npos) << map.name;
    titles.push_back(map.map.what);
  }
  EXPECT_EQ(titles, (std::vector<std::string>{"rank correlation", "total index"}));
}

TEST(PlotStudy, IndicesStandAtTheUsualAnglesTheGreatestFirst) {
  const StudyView study = test::made_up_study();
  const auto pages = study_index_pages(study);
  EXPECT_EQ(pages.size(), 4U) << "twelve quantities, three on a page";
  for (const char* angle : {"0°", "30°", "60°", "90°"})
    EXPECT_NO_THROW((void)panel_of(pages, std::string("anterior drawer at ") + angle));
  const PagePanel& first = panel_of(pages, "anterior drawer at 0°");
  const SweepEffects effects = sweep_effects(study, 3);
  const auto greatest = static_cast<std::size_t>(
      std::max_element(effects.total.begin(), effects.total.end()) - effects.total.begin());
  ASSERT_EQ(first.y_names.size(), 10U);
  EXPECT_EQ(first.y_names[0], shown_parameters(study)[greatest]);
  const auto bars = marks_of(first, Mark::Kind::kBars);
  ASSERT_EQ(bars.size(), 3U);
  EXPECT_EQ(bars[0]->high[0], study.all.effects[3].first[greatest][0].value);
  EXPECT_EQ(bars[1]->high[0], study.all.effects[3].total[greatest][0].value);
  EXPECT_EQ(bars[2]->high[1], study.all.effects[3].total[greatest][0].upper);
  EXPECT_TRUE(study_index_pages(test::made_up_study(false)).empty());
}

TEST(PlotStudy, MapsHoldCorrelationsAndTotalIndices) {
  const StudyView study = test::made_up_study();
  const auto maps = study_maps(study);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].name, "study_correlations");
  EXPECT_EQ(maps[1].name, "study_totals");
  EXPECT_FALSE(maps[0].map.scales.at(0).from_zero);
  EXPECT_TRUE(maps[1].map.scales.at(0).from_zero);
  EXPECT_EQ(maps[1].map.scales.at(0).largest, 0.5);
  const HeatMap& map = maps[0].map;
  EXPECT_EQ(map.rows.size(), 14U);
  EXPECT_EQ(map.rows[0].name, "aACL strain");
  EXPECT_EQ(map.panels.size(), 4U);
  EXPECT_EQ(map.columns.size(), 18U) << "five of the joint, two contacts, eleven that carry";
  EXPECT_EQ(map.panels[1].values.at(3), study.all.effects[3].rank[0][6]) << "at 30 degrees";
  EXPECT_EQ(study_maps(test::made_up_study(false)).size(), 1U);
}

TEST(PlotStudy, FailuresAreSharesOfTheSamples) {
  StudyView study = test::made_up_study();
  const auto pages = study_failure_pages(study);
  ASSERT_EQ(pages.size(), 1U);
  const PagePanel &curve = pages[0].page.panels.at(0), &quarters = pages[0].page.panels.at(1);
  EXPECT_NEAR(curve.marks[0].y.back(), 100.0 * 240 / static_cast<double>(study.samples), 1e-12);
  EXPECT_EQ(quarters.y_names[0], shown_parameters(study)[2]) << "whose quarters differ most";
  const auto dots = marks_of(quarters, Mark::Kind::kDots);
  ASSERT_EQ(dots.size(), 4U);
  EXPECT_EQ(dots[3]->x[0], 100 * study.all.failures.by_quartile[2][3]);
  study.all.failures.failed = 0;
  EXPECT_TRUE(study_failure_pages(study).empty());
}

TEST(PlotStudy, FewKneesHaveBandsAndManyHaveMedians) {
  const StudyView few = test::made_up_study(false, 3), many = test::made_up_study(false, 30);
  const auto few_pages = study_knee_pages(few), many_pages = study_knee_pages(many);
  const PagePanel &of_few = panel_of(few_pages, "anterior drawer"),
                  &of_many = panel_of(many_pages, "anterior drawer");
  EXPECT_EQ(marks_of(of_few, Mark::Kind::kBand).size(), 3U);
  EXPECT_EQ(few_pages[0].page.key.at(2).words, "knee3");
  EXPECT_EQ(marks_of(of_many, Mark::Kind::kBand).size(), 1U) << "of all together";
  const auto lines = marks_of(of_many, Mark::Kind::kLine);
  ASSERT_EQ(lines.size(), 31U);
  EXPECT_EQ(lines[4]->y, many.by_knee[4].bands[3].quantiles[2]);
  EXPECT_TRUE(study_knee_pages(test::made_up_study()).empty());
}

TEST(PlotStudy, NumbersThatAreNoneBreakNothing) {
  StudyView study = test::made_up_study();
  const double nan = std::nan("");
  for (StudyBand& band : study.all.bands) {
    for (auto& quantile : band.quantiles) quantile[5] = nan;
    band.nominal.assign(band.nominal.size(), nan);
    band.sd[5] = nan;
  }
  for (StudyEffects& effects : study.all.effects)
    for (std::size_t j = 0; j < study.parameters.size(); ++j) {
      effects.first[j][0] = effects.total[j][0] = {nan, nan, nan};
      effects.rank[j][0] = nan;
    }
  study.scenes = {"no TOML ["};
  study.title = "O'Brien's `date` \"x\" \\ $HOME_ {a}^2";
  expect_drawn(study, "study_nan");
}

TEST(PlotStudy, OtherQuantitiesThanFlexionAreSweptToo) {
  StudyView study = test::made_up_study();
  study.swept = {"drawer.scale", "Factor on drawer", "factor", "×", {"1", 1}, {"1", 1}, -1, 0,
                 false,          "drawer [N]",       100};
  const auto poses = shown_poses(study);
  EXPECT_EQ(poses, (std::vector<std::size_t>{0, 8, 16, 24})) << "evenly";
  EXPECT_EQ(shown_values(study).back(), 12000);
  EXPECT_EQ(shown_pose(study, 24), "120×");
}

TEST(PlotStudy, APanelWithoutValuesKeepsItsRangesAndNames) {
  ChartPage page;
  page.height = 400;
  PagePanel panel;
  panel.width = panel.height = 200;
  panel.y_range = {1.5, -0.5};
  panel.y_names = {"first", "second"};
  page.panels = {panel};
  const std::string script = gnuplot_script(page, PlotFormat::kSvg);
  EXPECT_EQ(script.find("set yrange [0:1]"), std::string::npos);
  EXPECT_NE(script.find("set xrange [0:1]"), std::string::npos) << "where none is given";
}

}  // namespace
}  // namespace condyle
