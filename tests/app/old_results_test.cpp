/// Result files of format 0.1 as they were written then (tools/old_results.sh): every reader still reads them, and finds
/// the numbers that were in them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "app/run_program.h"
#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/journal.h"
#include "condyle/results/run_file.h"
#include "condyle/results/study_file.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::contents;
using test::Outcome;

const fs::path kKept = CONDYLE_SOURCE_DIR "/tests/results/format_0_1";

class OldResults : public test::CommandLine {
 protected:
  void unpack(const std::string& name) const {
    const std::string command =
        "gzip -dc '" + (kKept / (name + ".gz")).string() + "' > '" + at(name) + "'";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  void expect_success(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
  }
};

class OldRun : public OldResults, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    unpack(file_);
  }
  const std::string file_ = std::string(GetParam()) + ".h5";
};

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  const auto equal = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

/// Every dataset of a group stands in the other one, with the same numbers or texts: to the last bit but for a turn of units.
void expect_all_of(const Hdf5Group& old,
                   const Hdf5Group& now,
                   const std::string& place,
                   int& datasets) {
  for (const std::string& name : old.names()) {
    const std::string here = place + "/" + name;
    ASSERT_TRUE(now.has(name)) << here;
    if (old.is_group(name)) {
      expect_all_of(old.open(name), now.open(name), here, datasets);
      continue;
    }
    ++datasets;
    EXPECT_EQ(now.read_attribute(name, "units"), old.read_attribute(name, "units")) << here;
    std::vector<double> numbers;
    try {
      numbers = old.read(name).values;
    } catch (const InputError&) {
      EXPECT_EQ(now.read_texts(name), old.read_texts(name)) << here;
      continue;
    }
    std::vector<double> again = now.read(name).values;
    ASSERT_EQ(again.size(), numbers.size()) << here;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (std::abs(again[i] - numbers[i]) <= 4e-16 * std::abs(numbers[i])) again[i] = numbers[i];
    EXPECT_TRUE(same(again, numbers)) << here;
  }
}

/// What the reader takes out of the file is all that is in it: written again, no dataset is missing.
TEST_P(OldRun, GivesEveryNumberThatItHolds) {
  write_run(at("again.h5"), read_run(at(file_)));
  const Hdf5Reader old(at(file_)), now(at("again.h5"));
  int datasets = 0;
  expect_all_of(old.root(), now.root(), "", datasets);
  EXPECT_GT(datasets, 20);
  EXPECT_EQ(now.root().read_attribute("scene"), old.root().read_attribute("scene"));
}

TEST_P(OldRun, IsShownByEveryCommandThatShowsRuns) {
  expect_success("report " + file_ + " -o page.html --no-pictures --no-viewer");
  EXPECT_NE(contents(folder_ / "page.html").find("</html>"), std::string::npos);
#ifdef CONDYLE_PICTURES
  expect_success("plot " + file_ + " -o plots --format svg");
  EXPECT_FALSE(fs::is_empty(folder_ / "plots"));
#endif
}

INSTANTIATE_TEST_SUITE_P(
    Format01,
    OldRun,
    testing::Values("sweep", "layer", "uncertainty", "compare", "laxity", "simulate", "calibrate"),
    [](const auto& of) { return std::string(of.param); });

class OldSweep : public OldRun {};

std::set<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

/// Rows may come to it, none may go or change.
TEST_P(OldSweep, HasTheTableThatItHadThen) {
  const std::string table = std::string(GetParam()) + ".csv";
  unpack(table);
  expect_success("export " + file_ + " -o now.csv");
  const std::set<std::string> now = lines_of(contents(folder_ / "now.csv"));
  int rows = 0;
  for (const std::string& row : lines_of(contents(folder_ / table))) {
    ++rows;
    EXPECT_TRUE(now.count(row) == 1) << row;
  }
  EXPECT_GT(rows, 50);
}

TEST_P(OldSweep, IsVerified) {
  if (file_ == "uncertainty.h5") GTEST_SKIP() << "the meshes are not kept";
  expect_success("verify " + file_);
}

INSTANTIATE_TEST_SUITE_P(Format01,
                         OldSweep,
                         testing::Values("sweep", "layer", "uncertainty", "compare", "simulate"),
                         [](const auto& of) { return std::string(of.param); });

/// Its bands are those of its samples, as they stand in the file.
TEST_F(OldResults, AStudyIsReadAndShown) {
  unpack("study.h5");
  const StudyView view = read_study_file(at("study.h5"));
  EXPECT_EQ(view.title, "kept: study");
  ASSERT_EQ(view.outputs.size(), 2U);
  ASSERT_EQ(view.values.size(), 3U);
  const Hdf5Reader file(at("study.h5"));
  for (std::size_t o = 0; o < 2; ++o) {
    const Hdf5Group band = file.root().open("bands").open(view.outputs[o].name);
    EXPECT_TRUE(same(view.all.bands[o].mean, band.read("mean", {3})));
    EXPECT_TRUE(same(view.all.bands[o].sd, band.read("sd", {3})));
  }
  expect_success("report study.h5 -o page.html --no-pictures");
#ifdef CONDYLE_PICTURES
  expect_success("plot study.h5 -o plots --format svg");
#endif
}

/// Three poses of 20001, and the sweep goes on behind them.
TEST_F(OldResults, AJournalIsReadOn) {
  const Scene scene = read_scene(kKept / "journal.toml");
  const JournalContents journal = read_journal(kKept / "journal", scene);
  ASSERT_EQ(journal.poses.size(), 3U);
  write("journal.toml", contents(kKept / "journal.toml"));
  write("run.h5.journal", contents(kKept / "journal"));
  const Outcome outcome = run("sweep journal.toml -o run.h5 --resume --to 0.01");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 "), std::string::npos) << outcome.out;
}

/// The number of the format is that of a later program.
TEST_F(OldResults, AFileOfALaterProgramSaysSo) {
  for (const char* format : {"condyle 2", "condyle study 2"}) {
    const Hdf5Builder builder("later.h5");
    builder.root().write_attribute("format", format);
    write("later.h5", builder.bytes());
    const std::string known = std::string(format).substr(0, std::string(format).size() - 1) + "1";
    for (const char* command : {"report later.h5 -o page.html", "plot later.h5 -o plots"})
      test::expect_bad_input(run(command),
                             fmt::format("later.h5: /: written by a later condyle (format \"{}\"), "
                                         "this one reads up to \"{}\"",
                                         format, known));
  }
  write("run.h5.journal", "condyle journal 2 scene 0 surfaces 0\n");
  test::expect_bad_input(run("sweep knee.toml -o run.h5 --resume"),
                         "run.h5.journal: written by a later condyle (format \"condyle journal "
                         "2\"), this one reads up to \"condyle journal 1\"");
  EXPECT_EQ(contents(folder_ / "run.h5.journal"), "condyle journal 2 scene 0 surfaces 0\n");
}

}  // namespace
}  // namespace condyle
