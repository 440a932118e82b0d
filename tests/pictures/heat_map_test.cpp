#include "condyle/pictures/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/run_program.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

HeatMap small_map() {
  HeatMap map;
  map.title = "O'Brien's \"knee\" \\ $HOME";
  map.what = "what moves what";
  map.rows = {{"aACL.stiffness", "+10 %"}, {"drawer.scale", "+0.1"}};
  map.columns = {{"adduction", 0}, {"medial", 1}, {"lateral", 1}};
  map.scales = {{"rotation", "°", 0.5}, {"force", "N", 120}};
  map.panels = {{"Flexion 0°", {0.5, -120, 0, std::nan(""), 60, 1.26}}};
  return map;
}

std::string color(double t) {
  const Rgb rgb = map_color(ColorMap::kDiverging, 0.5 * (1 + t));
  return std::to_string((rgb[0] << 16) | (rgb[1] << 8) | rgb[2]);
}

// Colours by the scale of each column, three digits of its largest, nothing where they show nothing.
TEST(HeatMap, CellsHaveTheColoursAndDigitsOfTheirScale) {
  const std::string script = gnuplot_script(small_map(), PlotFormat::kSvg);
  EXPECT_NE(script.find("\"0.500\""), std::string::npos);
  EXPECT_NE(script.find("\"−120\""), std::string::npos);
  EXPECT_NE(script.find("\"60\""), std::string::npos);
  EXPECT_NE(script.find("\"1\""), std::string::npos);
  EXPECT_EQ(script.find("\"nan\""), std::string::npos);
  for (const double t : {1.0, -1.0, 0.5, 0.0})
    EXPECT_NE(script.find(" " + color(t) + "\n"), std::string::npos) << t;
  EXPECT_NE(script.find(" " + std::to_string(0xE6E8EB) + "\n"), std::string::npos);  // no number
}

TEST(HeatMap, ALongTitleIsCutAndDoesNotWidenThePage) {
  HeatMap map = small_map();
  const auto page = [&] {
    const std::string script = gnuplot_script(map, PlotFormat::kSvg);
    return script.substr(script.find("size "), script.find(',') - script.find("size "));
  };
  map.title = "";
  const std::string size = page();
  map.title = std::string(3000, 'w');
  EXPECT_EQ(page(), size);
  const std::string script = gnuplot_script(map, PlotFormat::kSvg);
  EXPECT_EQ(script.find(std::string(400, 'w')), std::string::npos);
  EXPECT_NE(script.find("w…\""), std::string::npos);
}

TEST(FittedWords, AreCutToTheLettersThatFit) {
  const auto width = [](const std::string& text) {
    return 10.0 * static_cast<double>(letters(text));
  };
  EXPECT_EQ(cut_words("knee", 40, width), "knee");
  EXPECT_EQ(cut_words("knees", 40, width), "kne…");
  EXPECT_EQ(cut_words("äöüß€", 40, width), "äöü…");
  EXPECT_EQ(cut_words("knees", 0, width), "k…");
  EXPECT_EQ(cut_words("", 0, width), "");
  EXPECT_EQ(letters(cut_words(std::string(100000, 'a'), 1000, width)), 100U);
  EXPECT_GT(words_width("knee", 12), words_width("kne", 12));
}

TEST(HeatMap, IsDrawnWhateverStandsInItsTitle) {
  if (run_program({"gnuplot", "--version"}, "").exit_code != 0)
    GTEST_SKIP() << "gnuplot is not installed";
  const auto folder = test::fresh_folder("condyle_heat_map");
  draw_script(gnuplot_script(small_map(), PlotFormat::kPng), folder / "map.png");
  const Image image = read_png(folder / "map.png");
  const Rgb highest = map_color(ColorMap::kDiverging, 1),
            lowest = map_color(ColorMap::kDiverging, 0);
  int high = 0, low = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      high += image.at(x, y) == highest ? 1 : 0;
      low += image.at(x, y) == lowest ? 1 : 0;
    }
  EXPECT_GT(high, 300);  // most of a cell of 36 by 25 pixels
  EXPECT_GT(low, 300);
}

}  // namespace
}  // namespace condyle
