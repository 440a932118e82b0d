#include "condyle/pictures/plot_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "condyle/calibration/calibration.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/run_program.h"
#include "pictures/plot_pages.h"
#include "support/made_up_calibration.h"
#include "support/many_parameters.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

const ChartPage& page_of(const std::vector<NamedPage>& pages, const std::string& name) {
  const auto found = std::find_if(pages.begin(), pages.end(),
                                  [&](const NamedPage& page) { return page.name == name; });
  if (found == pages.end()) throw std::runtime_error("no page " + name);
  return found->page;
}

/// Marks of a panel that are of a kind and an ink.
const Mark& mark_of(const PagePanel& panel, Mark::Kind kind, const std::string& ink) {
  const auto found = std::find_if(panel.marks.begin(), panel.marks.end(), [&](const Mark& mark) {
    return mark.kind == kind && mark.ink == ink;
  });
  if (found == panel.marks.end()) throw std::runtime_error("no such mark");
  return *found;
}

void expect_drawn(const Scene& scene, const CalibrationResult& result, const char* folder) {
  const auto pages = calibration_pages(scene, result);
  const auto where = test::fresh_folder(folder);
  for (const NamedPage& page : pages) {
    const auto file = where / (page.name + ".png");
    draw_script(gnuplot_script(page.page, PlotFormat::kPng), file);
    const Image image = read_png(file);
    EXPECT_EQ(image.width, page.page.width) << page.name;
    EXPECT_EQ(image.height, page.page.height) << page.name;
  }
}

TEST(PlotCalibration, WritesAllItsPages) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  expect_drawn(test::made_up_calibration_scene(), test::made_up_calibration(), "calibration_small");
}

TEST(PlotCalibration, OneAndManyParametersAreDrawn) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  for (const int n : {1, 96}) {
    const auto [scene, result] = test::many_parameters(n, 1);
    expect_drawn(scene, result, "calibration_many");
  }
}

TEST(PlotCalibration, MeasuredPointsStandOverTheCurvesInTheirUnits) {
  const auto scene = test::made_up_calibration_scene();
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = measured_pages(scene, result);
  EXPECT_EQ(names_of(pages),
            (std::vector<std::string>{"calibration_curves", "calibration_other_curves"}));
  const ChartPage& page = page_of(pages, "calibration_curves");
  ASSERT_EQ(page.panels.size(), 5U);  // a drawer, three of varus, the passive path
  const PagePanel& drawer = page.panels[0];
  EXPECT_EQ(drawer.title, "ap30 at 30°");
  EXPECT_EQ(drawer.x_label, "anterior [N]");
  EXPECT_EQ(drawer.y_label, "Δ anterior drawer [mm]") << "told from its unloaded pose";
  const Mark& points = mark_of(drawer, Mark::Kind::kDots, kMeasuredInk);
  EXPECT_EQ(points.x, (std::vector<double>{-100, -50, 50, 100}));
  EXPECT_DOUBLE_EQ(points.y[0], result.table.rows[0].value);
  EXPECT_DOUBLE_EQ(points.high[0], 1.96 * result.rows[0].sd);
  EXPECT_DOUBLE_EQ(mark_of(drawer, Mark::Kind::kLine, kBeforeInk).y[1], result.rows[1].before);
  EXPECT_DOUBLE_EQ(mark_of(drawer, Mark::Kind::kLine, kAfterInk).y[1], result.rows[1].after);
  const PagePanel& varus = page.panels[1];
  EXPECT_EQ(varus.x_label, "varus [N m]");
  EXPECT_DOUBLE_EQ(mark_of(varus, Mark::Kind::kDots, kMeasuredInk).x[1], 10);  // 10 000 N mm
  EXPECT_NEAR(mark_of(varus, Mark::Kind::kDots, kMeasuredInk).y[0],
              result.table.rows[5].value * 180 / M_PI, 1e-12);
  EXPECT_EQ(page.panels[2].x_label, "Flexion [°]") << "the passive path has no level";
}

TEST(PlotCalibration, UnseenRowsAreHollow) {
  const auto pages = measured_pages(test::made_up_calibration_scene(), test::made_up_calibration());
  const PagePanel& unseen = page_of(pages, "calibration_curves").panels[3];  // vv60
  EXPECT_TRUE(mark_of(unseen, Mark::Kind::kDots, kMeasuredInk).x.empty());
  const Mark& points = mark_of(unseen, Mark::Kind::kDots, kUnseenInk);
  EXPECT_EQ(points.x.size(), 2U);
  EXPECT_TRUE(points.hollow);
}

TEST(PlotCalibration, AnUnloadedRowIsLevelZeroOfTheCurvesOfItsTest) {
  const auto [scene, result] = test::many_parameters(5, 2);
  const auto pages = measured_pages(scene, result);
  const PagePanel& drawer = page_of(pages, "calibration_curves").panels[0];
  EXPECT_EQ(mark_of(drawer, Mark::Kind::kDots, kMeasuredInk).x,
            (std::vector<double>{-100, -50, 0, 50, 100}));
  EXPECT_EQ(page_of(pages, "calibration_other_curves").panels.size(), 8U)
      << "of five coordinates one is the main one";
}

TEST(PlotCalibration, LoadsAtOneLevelAreDrawnOverFlexion) {
  auto result = test::made_up_calibration();
  for (std::size_t i = 0; i < result.table.rows.size(); ++i) {
    Measurement& row = result.table.rows[i];
    row = test::made_up::row(2, "drawer", 10.0 * static_cast<double>(i), 0, 100, 4);
  }
  const auto pages = measured_pages(test::made_up_calibration_scene(), result);
  const ChartPage& page = page_of(pages, "calibration_curves");
  ASSERT_EQ(page.panels.size(), 1U);
  EXPECT_EQ(page.panels[0].x_label, "Flexion [°]");
  EXPECT_NEAR(mark_of(page.panels[0], Mark::Kind::kDots, kMeasuredInk).x.back(), 110, 1e-9);
}

TEST(PlotCalibration, ManyCurvesAreDividedIntoPages) {
  const auto [scene, result] = test::many_parameters(5, 26);
  const auto pages = measured_pages(scene, result);
  EXPECT_EQ(page_of(pages, "calibration_curves_1").panels.size(), 12U);
  EXPECT_EQ(page_of(pages, "calibration_curves_3").panels.size(), 2U);
  for (const NamedPage& page : pages)
    for (const PagePanel& panel : page.page.panels) {
      EXPECT_LT(panel.left + panel.width, page.page.width);
      EXPECT_LT(panel.top + panel.height, page.page.height);
    }
}

TEST(PlotCalibration, BandsReachFromFiveToNinetyFivePercent) {
  const auto scene = test::made_up_calibration_scene();
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = band_pages(scene, result);
  EXPECT_EQ(names_of(pages),
            (std::vector<std::string>{"calibration_bands", "calibration_ligament_bands"}));
  const PagePanel& drawer = page_of(pages, "calibration_bands").panels.at(0);
  const Mark& band = mark_of(drawer, Mark::Kind::kBand, kAfterInk);
  const Band& of = result.bands[0];
  EXPECT_DOUBLE_EQ(band.high[3] - band.low[3], 2 * 1.645 * of.after_sd[3]);
  EXPECT_DOUBLE_EQ(mark_of(drawer, Mark::Kind::kLine, kBeforeInk).y[3], of.before[3]);
  const PagePanel& force = page_of(pages, "calibration_ligament_bands").panels.at(0);
  EXPECT_EQ(force.title, "aACL");
  for (const double low : mark_of(force, Mark::Kind::kBand, kBeforeInk).low) EXPECT_GE(low, 0);
}

TEST(PlotCalibration, AContactThatIsHeldClosedAndPullsIsDrawnBelowZero) {
  Scene scene = test::made_up_calibration_scene();
  CalibrationResult result = test::made_up_calibration();
  Band pulls = result.bands[0];
  pulls.quantity = "medial.force";
  pulls.units = "N";
  for (double& mean : pulls.after) mean = -500;
  result.bands = {pulls};
  const auto lowest = [&](ContactState state) {
    scene.contacts.resize(1);
    scene.contacts[0].name = "medial";
    scene.contacts[0].state = state;
    const auto pages = band_pages(scene, result);
    const PagePanel& panel = page_of(pages, "calibration_bands").panels.at(0);
    EXPECT_EQ(panel.title, "medial contact");
    return mark_of(panel, Mark::Kind::kBand, kAfterInk).low[3];
  };
  EXPECT_LT(lowest(ContactState::kClosed), -500);
  EXPECT_EQ(
      gnuplot_script(page_of(band_pages(scene, result), "calibration_bands"), PlotFormat::kPng)
          .find("set yrange [0:*]"),
      std::string::npos);
  EXPECT_EQ(lowest(ContactState::kAuto), 0);  // it opens before it pulls
}

TEST(PlotCalibration, LigamentsThatNeverCarryHaveNoBand) {
  auto result = test::made_up_calibration();
  Band& force = result.bands.back();
  for (auto* values : {&force.before, &force.before_sd, &force.after, &force.after_sd})
    std::fill(values->begin(), values->end(), 0);
  EXPECT_EQ(names_of(band_pages(test::made_up_calibration_scene(), result)),
            std::vector<std::string>{"calibration_bands"});
}

TEST(PlotCalibration, CorrelationsAreThoseOfTheCovariance) {
  auto result = test::made_up_calibration();
  result.known.covariance.setIdentity();
  result.known.covariance(3, 1) = result.known.covariance(1, 3) = -0.5;
  const auto pages = parameter_pages(test::made_up_calibration_scene(), result);
  const PagePanel& matrix = pages.at(0).page.panels.at(0);
  const Mark& cells = matrix.marks.back();
  ASSERT_EQ(cells.x.size(), 1U) << "all others are none";
  EXPECT_EQ(cells.x[0], 1);
  EXPECT_EQ(cells.y[0], 3);
  EXPECT_GT(cells.colors[0][2], cells.colors[0][0]) << "below zero is blue";
  EXPECT_EQ(matrix.words.at(0).text, "−0.50");
}

TEST(PlotCalibration, ShrinkageIsPosteriorOverPriorAndSamplesShowWhereTheyPart) {
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = parameter_pages(test::made_up_calibration_scene(), result);
  const PagePanel& bars = pages.at(0).page.panels.at(1);
  const Mark& posterior = mark_of(bars, Mark::Kind::kBars, kAfterInk);
  const Mark& samples = mark_of(bars, Mark::Kind::kDots, kUnseenInk);
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    EXPECT_DOUBLE_EQ(posterior.high[j], result.known.sd[at] / result.prior_sd[at]);
    EXPECT_EQ(std::isfinite(samples.x[j]), j == 1) << "25 % more by samples";
  }
}

TEST(PlotCalibration, WeakDirectionsAreTheLastOnes) {
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = spectrum_pages(test::made_up_calibration_scene(), result);
  const ChartPage& page = pages.at(0).page;
  ASSERT_EQ(page.panels.size(), 5U);
  const Mark& above = mark_of(page.panels[0], Mark::Kind::kDots, kAfterInk);
  EXPECT_EQ(above.x.size(), static_cast<std::size_t>(result.known.determined));
  Eigen::Index largest = 0;
  result.known.directions.col(4).cwiseAbs().maxCoeff(&largest);
  EXPECT_EQ(page.panels[1].y_names.at(0),
            (std::array{"aACL strain", "pPCL strain", "LCL stiffness",
                        "aMCL insertion femur normal", "ap30 anterior drawer offset"})
                .at(static_cast<std::size_t>(largest)));
}

TEST(PlotCalibration, TheParabolaHasTheDeviationOfTheDeltaMethod) {
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = profile_pages(test::made_up_calibration_scene(), result);
  ASSERT_EQ(pages.at(0).page.panels.size(), 5U);
  const Mark& strain = mark_of(pages[0].page.panels[0], Mark::Kind::kLine, kBeforeInk);
  // Profiles go to three deviations: χ² is 9 there, the number that of the scene and θ.
  EXPECT_NEAR(strain.y.front(), 9, 1e-9);
  EXPECT_NEAR(strain.x.front(), 100 * (0.002 + result.fit.theta[0] - 3 * result.known.sd[0]),
              1e-10);
  EXPECT_EQ(pages[0].page.panels[2].x_label, "factor [-]");
  const Mark& factor = mark_of(pages[0].page.panels[2], Mark::Kind::kLine, kAfterInk);
  EXPECT_NEAR(factor.x[9], 1.25, 1e-12) << "the factor on the stiffness";
}

TEST(PlotCalibration, ResidualsAreInDeviationsOfTheRows) {
  const CalibrationResult result = test::made_up_calibration();
  const auto pages = residual_pages(test::made_up_calibration_scene(), result);
  const ChartPage& page = pages.at(0).page;
  const Mark& fitted = mark_of(page.panels.at(0), Mark::Kind::kDots, kAfterInk);
  const Mark& unseen = mark_of(page.panels.at(0), Mark::Kind::kDots, kUnseenInk);
  EXPECT_EQ(fitted.y.size(), 9U);
  EXPECT_EQ(unseen.y.size(), 3U);
  EXPECT_NEAR(fitted.y[0], -0.9 / 1.1, 1e-12);  // made 0.9 sd above, and more of it is allowed
  EXPECT_EQ(page.panels.at(1).x_names.size(), 5U);
}

TEST(PlotCalibration, SuggestedTestsWithoutAPoseAreLeftOut) {
  const auto pages =
      suggestion_pages(test::made_up_calibration_scene(), test::made_up_calibration());
  EXPECT_EQ(pages.at(0).page.panels.at(0).y_names,
            (std::vector<std::string>{"60°, varus, 10 N m", "90°, anterior, −100 N"}));
}

TEST(PlotCalibration, WhatIsMissingIsLeftOut) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto result = test::made_up_calibration();
  result.samples.resize(0, 0);
  result.sample_sd.resize(0);
  result.bands.clear();
  result.profiles.clear();
  result.suggested.clear();
  const auto scene = test::made_up_calibration_scene();
  EXPECT_EQ(names_of(calibration_pages(scene, result)),
            (std::vector<std::string>{"calibration_curves", "calibration_other_curves",
                                      "calibration_residuals", "calibration_parameters",
                                      "calibration_spectrum"}));
  expect_drawn(scene, result, "calibration_little");
  EXPECT_TRUE(calibration_pages(scene, CalibrationResult{}).empty());
}

TEST(PlotCalibration, NumbersThatAreNoneBreakNothing) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto result = test::made_up_calibration();
  const double nan = std::nan("");
  for (CalibratedRow& row : result.rows) row.before = row.after = row.after_sd = nan;
  for (Band& band : result.bands) std::fill(band.after.begin(), band.after.end(), nan);
  for (Profile& profile : result.profiles) profile.chi_square[0] = nan;
  result.known.covariance.setConstant(nan);
  result.known.sd.setConstant(nan);
  result.known.singular_values[2] = nan;
  result.prior_sd[1] = INFINITY;
  result.suggested[0].information = nan;
  expect_drawn(test::made_up_calibration_scene(), result, "calibration_nan");
}

TEST(PlotCalibration, NamesOfAScenesOwnAreTakenAsTheyAre) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto scene = test::made_up_calibration_scene();
  scene.title = "O'Brien's knee `date` \"x\" \\ $HOME_ {a}^2";
  auto result = test::made_up_calibration();
  result.parameters[0].name = "it's `date`.reference_strain";
  const auto file = test::fresh_folder("calibration_names") / "page.svg";
  draw_script(gnuplot_script(parameter_pages(scene, result).at(0).page, PlotFormat::kSvg), file);
  std::stringstream svg;
  svg << std::ifstream(file).rdbuf();
  EXPECT_NE(svg.str().find("it's `date` strain"), std::string::npos);
  EXPECT_NE(svg.str().find("O'Brien"), std::string::npos);
}

}  // namespace
}  // namespace condyle
