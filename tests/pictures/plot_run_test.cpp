#include "condyle/pictures/plot_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "condyle/input_error.h"
#include "condyle/network/simulate.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/png_file.h"
#include "pictures/plot_pages.h"
#include "support/block_knee.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

TEST(PlotRun, AnglesAreInDegreesAndFailedPosesLeaveGaps) {
  auto run = block_run();
  run.sweep.poses[2].joint.internal_rotation = 0.1;
  run.sweep.poses[1].status = PoseStatus::kIterationLimit;
  const Chart chart = joint_coordinate_chart(run);
  EXPECT_EQ(chart.x_label, "Flexion [°]");
  const Curve& rotation = chart.panels.at(0).curves.at(1);
  EXPECT_EQ(rotation.title, "internal rotation");
  EXPECT_NEAR(rotation.x[2], 57.2957795, 1e-6);  // 1 rad
  EXPECT_NEAR(rotation.y[2], 5.72957795, 1e-7);  // 0.1 rad
  EXPECT_TRUE(std::isnan(rotation.y[1]));
}

TEST(PlotRun, StrandsOfALigamentAreSummed) {
  auto run = block_run();
  run.sweep.poses[0].ligaments[1].force = 3;
  run.sweep.poses[0].ligaments[2].force = 4;
  const Chart chart = ligament_force_chart(run);
  ASSERT_EQ(chart.panels.at(0).curves.size(), 2u);
  EXPECT_DOUBLE_EQ(chart.panels[0].curves[1].y[0], 7);
}

TEST(PlotRun, ContactsKeepTheirNames) {
  const Chart chart = contact_force_chart(block_run());
  EXPECT_EQ(chart.panels.at(0).curves.at(0).title, "medial");
  EXPECT_DOUBLE_EQ(chart.panels[0].curves[1].y[2], 100);
}

TEST(PlotRun, WritesPicturesOfEveryChart) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto run = block_run();
  run.scene.title = "'s O'Brien's knee `date` \"x\" \\ $HOME_ {a}^2";
  run.sweep.poses[1].status = PoseStatus::kDiverged;
  const auto files = write_plots(run_plots(run), test::fresh_folder("condyle_plots"),
                                 {PlotFormat::kPng, PlotFormat::kSvg});
  ASSERT_EQ(files.size(), 12u);  // six charts: no energy without a motion, no stability
  for (const auto& file : files) {
    if (file.extension() != ".png") continue;
    const Image image = read_png(file);
    EXPECT_EQ(image.width, 1200);
    EXPECT_GT(image.height, 500);
  }
  std::stringstream svg;
  svg << std::ifstream(files[1]).rdbuf();
  EXPECT_NE(svg.str().find("O'Brien"), std::string::npos);
  EXPECT_NE(svg.str().find("`date`"), std::string::npos) << "taken as it is, not run";
}

TEST(PlotRun, ARunWithoutAnyValueStillPlots) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto run = block_run();
  for (PoseResult& pose : run.sweep.poses) pose.status = PoseStatus::kDiverged;
  EXPECT_EQ(
      write_plots(run_plots(run), test::fresh_folder("condyle_plots"), {PlotFormat::kPng}).size(),
      3u)
      << "joint coordinates and forces, with empty axes";
}

// An axis from -10 % on, and nothing on it.
TEST(PlotRun, ARunOfSlackLigamentsStillPlots) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto run = block_run();
  for (PoseResult& pose : run.sweep.poses)
    for (LigamentResult& ligament : pose.ligaments) ligament.strain = -0.3;
  EXPECT_GE(
      write_plots(run_plots(run), test::fresh_folder("condyle_plots"), {PlotFormat::kPng}).size(),
      3u);
}

TEST(PlotRun, AFolderThatDoesNotExistIsNamed) {
  EXPECT_THROW((void)write_plots(run_plots(block_run()), "no/such/folder", {PlotFormat::kPng}),
               InputError);
}

TEST(PlotRun, PlacesOfContactAreThoseOfTheTibia) {
  // The medial contact of the blocks goes back by 4 mm a pose, at 15 mm to the medial side.
  for (const double side : {1.0, -1.0}) {
    auto run = block_run(side);
    run.scene.joint->tibia.origin = {1, 0, 0};
    run.sweep.poses[2].contacts[0].closed = false;
    const Chart chart = contact_place_chart(run);
    const Curve &forward = chart.panels.at(0).curves.at(0),
                &outward = chart.panels.at(1).curves.at(0);
    EXPECT_DOUBLE_EQ(forward.y[1], -4 - 1);
    EXPECT_DOUBLE_EQ(outward.y[1], -15) << "lateral is positive on either side";
    EXPECT_TRUE(std::isnan(forward.y[2])) << "an open contact has no place";
  }
}

TEST(PlotRun, OfTheStrandsTheGreatestStrainCounts) {
  auto run = block_run();
  run.sweep.poses[0].ligaments[1].strain = 0.03;
  const Chart chart = ligament_strain_chart(run);
  EXPECT_DOUBLE_EQ(chart.panels.at(0).curves.at(1).y[0], 3);   // %
  EXPECT_DOUBLE_EQ(chart.panels.at(0).curves.at(1).y[1], -5);  // both strands
}

TEST(PlotRun, ASweptLoadIsShownByItsSize) {
  auto run = block_run();
  LoadDescription load;
  load.name = "drawer";
  load.vector = {0, 3, 4};
  run.scene.loads = {load};
  run.scene.sweep = SweepDescription{true, 0, "drawer.scale", {}};
  const Chart chart = contact_force_chart(run);
  EXPECT_EQ(chart.x_label, "drawer [N]");
  EXPECT_DOUBLE_EQ(chart.panels.at(0).curves.at(0).x[2], 5);  // scale 1 of a load of 5 N
}

TEST(PlotRun, EnergiesAreThoseSinceTheStart) {
  auto run = block_run();
  EXPECT_TRUE(energy_chart(run).panels.empty());
  const auto simulation = std::make_shared<Simulation>();
  run.study = std::shared_ptr<const Simulation>(simulation);
  simulation->motion.frames.resize(2);
  MotionFrame &first = simulation->motion.frames[0], &last = simulation->motion.frames[1];
  first.energy.gravity = 5000;
  last.state.t = 0.1;
  last.energy.gravity = 3000;
  last.energy.kinetic = 1999;  // N mm; 1 of 2000 is lost
  const Chart chart = energy_chart(run);
  EXPECT_DOUBLE_EQ(chart.panels.at(0).curves.at(1).y[1], -2);  // J
  EXPECT_EQ(chart.panels.at(1).y_label, "Balance [mJ]");
  EXPECT_NEAR(chart.panels.at(1).curves.at(0).y[1], -1, 1e-12);
}

TEST(PlotRun, RunsOverEachOtherShareColoursAndDifferInLines) {
  auto a = block_run(), b = block_run();
  b.scene.contacts[0].name = "middle";
  const auto charts = overlay({{"first", &a}, {"second", &b}});
  const auto forces = std::find_if(charts.begin(), charts.end(), [](const auto& chart) {
    return chart.name == "contact_forces";
  });
  ASSERT_NE(forces, charts.end());
  const std::vector<Curve>& curves = forces->chart.panels.at(0).curves;
  ASSERT_EQ(curves.size(), 4u);  // medial, lateral, middle, lateral
  EXPECT_EQ(curves[1].color, curves[3].color) << "lateral of both runs";
  EXPECT_NE(curves[1].style, curves[3].style);
  EXPECT_NE(curves[2].color, curves[0].color);
  EXPECT_EQ(forces->chart.runs, (std::vector<std::string>{"first", "second"}));
  const std::string script = gnuplot_script(forces->chart, PlotFormat::kPng);
  EXPECT_NE(script.find("title \"first\""), std::string::npos);
  const std::size_t once = script.find("title \"lateral\"");
  EXPECT_NE(once, std::string::npos);
  EXPECT_EQ(script.find("title \"lateral\"", once + 1), std::string::npos);
}

TEST(PlotRun, ManyCurvesOfSeveralRunsAreDividedSoThatNoColourStandsForTwo) {
  auto run = block_run();
  run.scene.contacts.resize(11);
  for (std::size_t i = 0; i < 11; ++i) run.scene.contacts[i].name = std::string(i + 1, 'c');
  for (PoseResult& pose : run.sweep.poses) pose.contacts.resize(11);
  const auto charts = overlay({{"first", &run}, {"second", &run}});
  EXPECT_EQ(charts.at(1).chart.panels.size(), 2u);
  for (const Panel& panel : charts.at(1).chart.panels)
    for (const Curve& curve : panel.curves) EXPECT_LT(curve.color, 8);
}

TEST(PlotRun, RunsOverDifferentQuantitiesAreRefused) {
  auto angle = block_run(), load = block_run();
  load.scene.sweep->varies_load = true;
  load.scene.loads.resize(1);
  EXPECT_THROW((void)overlay({{"a", &angle}, {"b", &load}}), InputError);
  auto nothing = block_run();
  nothing.sweep.poses.clear();
  EXPECT_THROW((void)overlay({{"a", &angle}, {"b", &nothing}}), InputError);
}

TEST(PlotRun, WritesPdf) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const auto files =
      write_plots(run_plots(block_run()), test::fresh_folder("condyle_plots"), {PlotFormat::kPdf});
  ASSERT_FALSE(files.empty());
  std::stringstream pdf;
  pdf << std::ifstream(files[0], std::ios::binary).rdbuf();
  EXPECT_EQ(pdf.str().substr(0, 5), "%PDF-");
  EXPECT_GT(pdf.str().size(), 3000u);
}

// What is interrupted leaves no file half written: gnuplot knows no name of one.
TEST(PlotRun, GnuplotWritesNoFileItself) {
  const std::string script = gnuplot_script(contact_force_chart(block_run()), PlotFormat::kPng);
  EXPECT_EQ(script.find("set output '"), std::string::npos) << script;
}

// A contact that is held closed may pull: then nothing of it is cut off.
TEST(PlotRun, AnAxisBeginsAtZeroWhereNothingIsNegative) {
  auto run = block_run();
  EXPECT_NE(gnuplot_script(contact_force_chart(run), PlotFormat::kPng).find("set yrange [0:*]"),
            std::string::npos);
  run.sweep.poses[1].contacts[0].force = -5;
  EXPECT_EQ(gnuplot_script(contact_force_chart(run), PlotFormat::kPng).find("set yrange [0:*]"),
            std::string::npos);
}

// A line of one point shows nothing: where points are not marked anyway, those without a neighbour are.
TEST(PlotRun, APoseThatStandsAloneIsSeen) {
  const double none = std::nan("");
  Chart few{"title", "what", "x", {{"y", {}}}};
  few.panels[0].curves = {{"first", {0, 1, 2}, {5, none, 7}}};
  EXPECT_EQ(gnuplot_script(few, PlotFormat::kPng).find("alone"), std::string::npos);
  Chart runs = few;
  runs.runs = {"a", "b"};
  runs.panels[0].curves[0].color = 0;
  EXPECT_NE(gnuplot_script(runs, PlotFormat::kPng)
                .find("$panel0curve0alone << END_OF_DATA\n0 5\n2 7\nEND_OF_DATA"),
            std::string::npos);
  Chart many = few;
  Curve& curve = many.panels[0].curves[0];
  for (int i = 3; i < 100; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(i == 50 || i == 60 || i == 61 ? i : none);
  }
  const std::string script = gnuplot_script(many, PlotFormat::kPng);
  EXPECT_NE(script.find("$panel0curve0alone << END_OF_DATA\n0 5\n2 7\n50 50\nEND_OF_DATA"),
            std::string::npos);
  EXPECT_NE(script.find("$panel0curve0alone using 1:2 with points"), std::string::npos);
}

TEST(PlotRun, SixRunsHaveSixStyles) {
  Chart chart{"title", "what", "x", {{"y", {}}}};
  for (int run = 0; run < 6; ++run) {
    chart.runs.push_back(std::string(1, static_cast<char>('a' + run)));
    chart.panels[0].curves.push_back({"force", {0, 1}, {0, 1}, 0, false, run});
  }
  const std::string script = gnuplot_script(chart, PlotFormat::kPng);
  std::vector<std::string> styles;
  const std::string begin = "' dashtype ";
  for (std::size_t at = script.find("using 1:2 with lines"); at != std::string::npos;
       at = script.find("using 1:2 with lines", at + 1)) {
    const std::size_t style = script.find(begin, at) + begin.size();
    styles.push_back(script.substr(style, script.find(' ', style) - style));
  }
  ASSERT_EQ(styles.size(), 6U);
  std::sort(styles.begin(), styles.end());
  EXPECT_EQ(std::adjacent_find(styles.begin(), styles.end()), styles.end());
}

// Held closed it may pull, and lies somewhere all the same.
TEST(PlotRun, AContactThatPullsHasAPlace) {
  auto run = block_run();
  const auto curve_of_first = [&] { return contact_place_chart(run).panels.at(0).curves.at(0).y; };
  const std::vector<double> pushing = curve_of_first();
  ASSERT_TRUE(std::isfinite(pushing.at(0)));
  for (PoseResult& pose : run.sweep.poses)
    for (ContactResult& contact : pose.contacts) {
      contact.force = -contact.force;
      for (ContactPointResult& point : contact.points) point.force = -point.force;
    }
  EXPECT_EQ(curve_of_first().at(0), pushing.at(0));
}

TEST(PlotRun, ACurveMayBeDashedInTheColourOfAnother) {
  Chart chart{"title", "what", "x", {{"y", {}}}};
  chart.panels[0].curves = {{"first", {0, 1}, {0, 1}, 3, false}, {"", {0, 1}, {1, 2}, 3, true}};
  const std::string script = gnuplot_script(chart, PlotFormat::kPng);
  const std::size_t first = script.find("linecolor '#CC79A7' dashtype 1");
  EXPECT_NE(first, std::string::npos) << script;
  EXPECT_NE(script.find("linecolor '#CC79A7' dashtype 2", first), std::string::npos) << script;
}

TEST(PlotRun, APoseBeyondAnEdgeIsAHollowPointInAGap) {
  auto run = block_run();
  run.sweep.poses[1].status = PoseStatus::kLeftPatch;
  const Chart chart = contact_force_chart(run);
  const Curve& medial = chart.panels.at(0).curves.at(0);
  EXPECT_TRUE(std::isnan(medial.y[1]));
  ASSERT_EQ(medial.hollow_y.size(), 1U);
  EXPECT_DOUBLE_EQ(medial.hollow_y[0], 200);
  EXPECT_NEAR(medial.hollow_x[0], 28.6478898, 1e-6);  // 0.5 rad
  const std::string script = gnuplot_script(chart, PlotFormat::kPng);
  EXPECT_NE(script.find("pointtype 6"), std::string::npos);
  EXPECT_NE(script.find("title \"left patch\""), std::string::npos);
  run.sweep.poses[1].status = PoseStatus::kSingular;
  const std::string none = gnuplot_script(contact_force_chart(run), PlotFormat::kPng);
  EXPECT_EQ(none.find("left patch"), std::string::npos);
}

TEST(PlotRun, TheLegendHasRoomForWhatHollowPointsAre) {
  const auto right_margin = [](const condyle::Run& run) {
    const std::string script = gnuplot_script(contact_force_chart(run), PlotFormat::kPng);
    return std::stod(script.substr(script.find("rmargin at screen ") + 18));
  };
  auto run = block_run();
  run.scene.contacts[0].name = "m";
  run.scene.contacts[1].name = "l";
  const double without = right_margin(run);
  run.sweep.poses[1].status = PoseStatus::kLeftPatch;
  // "left patch" has nine letters more than a name, of at least 8 of 1200 pixels each.
  EXPECT_LT(right_margin(run), without - 9 * 8 / 1200.0);
}

TEST(PlotRun, APlaceOfContactIsNotJoinedThroughAJump) {
  auto run = block_run();
  EXPECT_EQ(contact_place_chart(run).panels.at(0).curves.at(0).y.size(), 3U);
  run.sweep.events = {{0.75, EventKind::kJump, 0}};
  const Chart chart = contact_place_chart(run);
  const Curve& medial = chart.panels.at(0).curves.at(0);
  ASSERT_EQ(medial.y.size(), 4U);
  EXPECT_TRUE(std::isnan(medial.y[2])) << "a blank line ends a line of gnuplot";
  EXPECT_DOUBLE_EQ(medial.y[3], -8);
  EXPECT_EQ(chart.panels.at(0).curves.at(1).y.size(), 3U) << "the lateral contact did not jump";
}

/// Columns from the right end in which nothing is drawn.
int free_columns(const Image& image, int rows) {
  for (int x = image.width - 1; x >= 0; --x) {
    for (int y = 0; y < rows; ++y)
      if (image.at(x, y)[0] < 200) return image.width - 1 - x;
  }
  return image.width;
}

TEST(PlotRun, ALongTitleStandsInTwoLinesAndEndsOnThePage) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  auto run = block_run();
  const auto drawn = [&](const std::string& title) {
    run.scene.title = title;
    const std::filesystem::path file = test::fresh_folder("condyle_plots") / "title.png";
    draw_script(gnuplot_script(contact_force_chart(run), PlotFormat::kPng), file);
    return read_png(file);
  };
  const Image short_title = drawn("Blocks");
  EXPECT_GT(free_columns(short_title, 60), 600);
  for (const std::string& title :
       {std::string(
            "Clouthier 2019 statistical shape model, member S025, right knee of a woman, 300 N"),
        std::string(64, 'W'), std::string(300, 'm')}) {
    const Image image = drawn(title);
    EXPECT_GE(image.height, short_title.height + 20) << "a second line";
    EXPECT_GT(free_columns(image, 90), 4) << title;
  }
}

}  // namespace
}  // namespace condyle
