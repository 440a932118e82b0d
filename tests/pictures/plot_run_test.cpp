#include "pictures/plot_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "input_error.h"
#include "pictures/block_knee.h"
#include "pictures/png_file.h"
#include "pictures/run_program.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

bool has_gnuplot() { return run_program({"gnuplot", "--version"}, "").exit_code == 0; }

std::filesystem::path fresh_folder() {
  const auto folder = test::scratch_folder("condyle_plots");
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

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
  run.scene.title = "O'Brien's knee `date` \"x\" \\ $HOME_ {a}^2";
  run.sweep.poses[1].status = PoseStatus::kDiverged;
  const auto files = plot_run(run, fresh_folder(), {PlotFormat::kPng, PlotFormat::kSvg});
  ASSERT_EQ(files.size(), 6u);
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
  EXPECT_EQ(plot_run(run, fresh_folder(), {PlotFormat::kPng}).size(), 3u);
}

TEST(PlotRun, AFolderThatDoesNotExistIsNamed) {
  EXPECT_THROW((void)plot_run(block_run(), "no/such/folder", {PlotFormat::kPng}), InputError);
}

TEST(RunProgram, AMissingProgramIsSaid) {
  EXPECT_FALSE(run_program({"condyle-no-such-program"}, "x").started);
}

TEST(RunProgram, AProgramThatDoesNotListenDoesNotHurt) {
  const ProgramResult result = run_program({"false"}, std::string(10'000'000, 'x'));
  EXPECT_TRUE(result.started);
  EXPECT_EQ(result.exit_code, 1);
}

TEST(RunProgram, CollectsWhatTheProgramComplainsOf) {
  const ProgramResult result = run_program({"sh"}, "echo one >&2\necho two >&2\nexit 3\n");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.messages, "one two");
}

TEST(PlotRun, ACurveMayBeDashedInTheColourOfAnother) {
  Chart chart{"title", "what", "x", {{"y", {}}}};
  chart.panels[0].curves = {{"first", {0, 1}, {0, 1}, 3, false}, {"", {0, 1}, {1, 2}, 3, true}};
  const std::string script = gnuplot_script(chart, "file.png", PlotFormat::kPng);
  const std::size_t first = script.find("linecolor '#CC79A7' dashtype 1");
  EXPECT_NE(first, std::string::npos) << script;
  EXPECT_NE(script.find("linecolor '#CC79A7' dashtype 2", first), std::string::npos) << script;
}

}  // namespace
}  // namespace condyle
