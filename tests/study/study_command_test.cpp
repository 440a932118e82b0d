/// The program samples a shipped knee, by threads, in parts and in spite of kills.

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "app/run_program.h"
#include "condyle/results/study_file.h"
#include "study/same_study.h"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStudy = R"(title = "strains"
specimens = ["knee.toml"]
design = "monte-carlo"
samples = 300

[[vary]]
what = "reference_strain"
of = "*"
sd = 0.02
)";

class StudyCommandLine : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("knee.toml", contents(fs::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml"));
    write("study.toml", kStudy);
  }
  [[nodiscard]] bool there(const std::string& name) const { return fs::exists(folder_ / name); }
  [[nodiscard]] Outcome study(const std::string& options, const std::string& prefix = "") const {
    return run("study study.toml " + options, prefix);
  }
  [[nodiscard]] std::string difference_to(const std::string& a, const std::string& b) const {
    return difference_of_studies(folder_ / a, folder_ / b);
  }
};

TEST_F(StudyCommandLine, SaysWhatItFoundAndWritesAllThatIsAskedFor) {
  const Outcome outcome = study("-o s.h5 --bands b.csv --indices i.csv --table t.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part : {"strains\n", "1 knee, 300 samples of ", "where each band is widest",
                           "rank correlations", "wrote s.h5\n", "wrote t.csv\n"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << outcome.out;
  std::vector<std::string> names = results();
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"b.csv", "i.csv", "s.h5", "study.toml", "t.csv"}));
  const StudyView view = read_study_file(folder_ / "s.h5");
  EXPECT_EQ(view.samples, 300);
  EXPECT_EQ(view.text, kStudy);
  const std::string table = contents(folder_ / "t.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'),
            1 + 300 * static_cast<long>(view.values.size()));
}

// The load that the sweep varies is drawn, too, and flexion is an output: each column has its own name.
TEST_F(StudyCommandLine, ItsTableHasNoTwoColumnsOfOneName) {
  const auto expect_own_names = [&](const std::string& swept) {
    const Outcome outcome = study("-o s.h5 --samples 2 --quiet --table t.csv");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string table = contents(folder_ / "t.csv");
    std::istringstream head(table.substr(0, table.find('\n')));
    std::vector<std::string> names;
    for (std::string name; std::getline(head, name, ',');) names.push_back(name);
    EXPECT_EQ(std::count(names.begin(), names.end(), swept), 1) << table.substr(0, 300);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << table.substr(0, 300);
  };
  write("study.toml",
        "specimens = [\"knee.toml\"]\ndesign = \"monte-carlo\"\nsamples = 2\noutputs = "
        "[\"joint.flexion\"]\n"
        "[[vary]]\nwhat = \"reference_strain\"\nof = \"*\"\nsd = 0.02\n");
  expect_own_names("swept flexion deg");
  write("knee.toml", contents(fs::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/drawer.toml"));
  write("study.toml",
        "specimens = [\"knee.toml\"]\ndesign = \"monte-carlo\"\nsamples = 2\n[[vary]]\nwhat = "
        "\"load\"\nof = \"*\"\nsd = "
        "0.1\n");
  expect_own_names("swept drawer.scale");
}

TEST_F(StudyCommandLine, SaysItAllAsJson) {
  const Outcome outcome = study("-o s.h5 --json --samples 70 --seed 3");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part : {"\"command\": \"study\"", "\"seed\": 3", "\"samples\": 70",
                           "\"failures\"", "\"by_quartile\"", "\"quantiles\"", "\"largest\""})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
}

TEST_F(StudyCommandLine, HasTheSameBitsWhoeverComputedIt) {
  ASSERT_EQ(study("-o one.h5 --threads 1 --quiet").code, 0);
  for (const int threads : {2, 3}) {
    ASSERT_EQ(study(fmt::format("-o n.h5 --threads {} --quiet", threads)).code, 0);
    EXPECT_EQ(difference_to("one.h5", "n.h5"), "") << threads;
  }
  for (const int i : {2, 3, 1}) ASSERT_EQ(study(fmt::format("-o parts.h5 --part {}/3", i)).code, 0);
  EXPECT_FALSE(there("parts.h5"));
  ASSERT_EQ(study("-o parts.h5 --merge --quiet").code, 0);
  EXPECT_EQ(difference_to("one.h5", "parts.h5"), "");
  EXPECT_FALSE(there("parts.h5.journal"));
  ASSERT_EQ(study("-o other.h5 --seed 2 --quiet").code, 0);
  EXPECT_NE(difference_to("one.h5", "other.h5"), "");
}

TEST_F(StudyCommandLine, GoesOnAfterKillsWithTheSameBits) {
  const std::string whole = "--samples 3000 --threads 2 --quiet";
  ASSERT_EQ(study("-o whole.h5 " + whole).code, 0);
  for (const char* seconds : {"0.15", "0.3", "0.6"})
    (void)study("-o killed.h5 --resume " + whole, fmt::format("timeout -s KILL {} ", seconds));
  ASSERT_EQ(study("-o killed.h5 --resume --threads 3 --samples 3000 --quiet").code, 0);
  EXPECT_EQ(difference_to("whole.h5", "killed.h5"), "");
  EXPECT_FALSE(there("killed.h5.journal"));
}

TEST_F(StudyCommandLine, AnInterruptKeepsTheChunksAndResumeGoesOn) {
  const std::string many = "-o s.h5 --samples 400000 --threads 2 ";
  write("study.toml",
        std::string("precision = \"float32\"\noutputs = [\"contact.force\"]\n") + kStudy);
  // --foreground: else the program gets the signal twice, once with its group, and the second one ends it.
  const Outcome stopped =
      study(many + "--quiet", "timeout --foreground --preserve-status -s INT 3 ");
  EXPECT_EQ(stopped.code, 2) << stopped.err;
  EXPECT_EQ(stopped.err.find("condyle: stopped: s.h5.journal holds "), 0U) << stopped.err;
  EXPECT_NE(stopped.err.find(" of 6250 chunks, --resume goes on from there\n"), std::string::npos);
  EXPECT_FALSE(there("s.h5"));
  const Outcome again =
      study(many + "--resume", "timeout --foreground --preserve-status -s INT 2 ");
  EXPECT_EQ(again.code, 2) << again.err;
  EXPECT_NE(again.out.find("going on with "), std::string::npos) << again.out;

  const std::string scene = contents(folder_ / "knee.toml");
  write("knee.toml", scene + "# another\n");
  expect_bad_input(study(many + "--resume --quiet"),
                   "s.h5.journal: the scene knee.toml is not the one that its chunks were computed "
                   "from, expected the same or another output");
  write("knee.toml", scene);
  expect_bad_input(study(many + "--resume --quiet --seed 5"),
                   "s.h5.journal: the seed is not the one that its chunks were computed from, "
                   "expected the same or another output");
}

TEST_F(StudyCommandLine, SaysWhereNoPoseOfAnySampleConverges) {
  std::string knee = contents(folder_ / "knee.toml");
  const std::size_t first = knee.find("[[ligament]]");
  knee.erase(first, knee.find("[[condition]]") - first);
  write("knee.toml", knee + R"(
[[load]]
name = "pull"
body = "tibia"
kind = "force"
vector = [0, 0, -50]
)");
  write("study.toml", R"(
title = "nothing holds the tibia"
specimens = ["knee.toml"]
design = "monte-carlo"
samples = 2
[[vary]]
what = "load"
of = "pull"
sd = 0.1
)");
  const Outcome outcome = study("-o s.h5");
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_NE(outcome.err.find("condyle: no pose of any sample converged\n"), std::string::npos)
      << outcome.err;
  const Outcome again = study("-o s.h5 --resume");  // it is complete, and no better
  EXPECT_EQ(again.code, 2);
  EXPECT_EQ(again.err, outcome.err);
}

/// A strand that is cut has the stiffness 0, whatever else of it varies.
TEST_F(StudyCommandLine, AStrandThatIsCutTakesPart) {
  const std::string knee = contents(folder_ / "knee.toml");
  const std::size_t at = knee.find("stiffness = ");
  write("knee.toml", knee.substr(0, at) + "stiffness = 0" + knee.substr(knee.find('\n', at)));
  write("study.toml", with(kStudy, "samples = 300", "samples = 3"));
  const Outcome outcome = study("-o cut.h5");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.find("not computed"), std::string::npos) << outcome.out;
}

TEST_F(StudyCommandLine, ResumeOfWhatIsCompleteComputesNothing) {
  ASSERT_EQ(study("-o s.h5 --quiet").code, 0);
  const std::string before = contents(folder_ / "s.h5");
  const Outcome again = study("-o s.h5 --resume --bands b.csv");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("s.h5 holds all of this study already\n"), std::string::npos);
  EXPECT_TRUE(there("b.csv"));
  expect_bad_input(study("-o s.h5 --resume --table t.csv --quiet"),
                   "s.h5: holds all of this study already, expected no --table: it is written from "
                   "samples as they are computed (without --resume)");
  EXPECT_EQ(contents(folder_ / "s.h5"), before);
  EXPECT_EQ(study("-o s.h5 --resume --seed 2 --quiet").code, 0);
  EXPECT_NE(contents(folder_ / "s.h5"), before);
}

TEST_F(StudyCommandLine, AResultThatDoesNotFitIsToldAndTheChunksAreKept) {
  for (const char* part : {"--part 1/4", "--part 2/4", "--part 3/4", "--part 4/4"})
    ASSERT_EQ(study(std::string("-o s.h5 --quiet --threads 1 ") + part).code, 0);
  ASSERT_EQ(study("-o whole.h5 --quiet").code, 0);
  const auto kilobytes = static_cast<long>(fs::file_size(folder_ / "whole.h5") / 1024);
  // Of the size of files, by the shell in units of 512 bytes.
  for (const long limit : {kilobytes, kilobytes * 3 / 2, 2 * kilobytes - 20}) {
    const Outcome full = study("-o s.h5 --merge --quiet", fmt::format("ulimit -f {} && ", limit));
    EXPECT_EQ(full.code, 1) << limit;
    EXPECT_EQ(full.err.find("condyle: s.h5: "), 0U) << full.err;
    EXPECT_EQ(std::count(full.err.begin(), full.err.end(), '\n'), 1) << full.err;
    EXPECT_FALSE(there("s.h5"));
    for (const auto& entry : fs::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(study("-o s.h5 --merge --quiet").code, 0);
  EXPECT_EQ(difference_to("s.h5", "whole.h5"), "");
}

TEST_F(StudyCommandLine, MergesOnlyWhatIsThere) {
  const Outcome nothing = study("-o s.h5 --merge --quiet");
  EXPECT_EQ(nothing.code, 1);
  EXPECT_FALSE(there("s.h5.journal"));
  ASSERT_EQ(study("-o s.h5 --part 1/2 --quiet").code, 0);
  expect_bad_input(
      study("-o s.h5 --merge --quiet"),
      "s.h5.journal: 2 of 5 chunks are missing (the first: samples 64 to 127), expected "
      "all of them: parts that were stopped go on with --part i/n --resume");
  ASSERT_EQ(study("-o s.h5 --part 2/2 --quiet").code, 0);
  EXPECT_EQ(study("-o s.h5 --merge --quiet").code, 0);
}

TEST_F(StudyCommandLine, RefusesBadInputInOneLineAndWritesNothing) {
  const std::vector<std::string> before = results();
  const std::string read = "is read by this command, expected another file to write";
  expect_bad_input(study("-o study.toml"), "study.toml: expected a name that ends in .h5");
  expect_bad_input(study("-o s.h5 --bands knee.toml"), "knee.toml: " + read);
  expect_bad_input(study("-o s.h5 --table other.h5"),
                   "other.h5: expected a name that ends in .csv");
  expect_bad_input(study("-o s.h5 --bands ./s.h5"),
                   "./s.h5: is to be written twice, expected a file for each");
  expect_bad_input(study("-o no/s.h5"), "no/s.h5: there is no folder no, expected one that exists");
  expect_bad_input(study("-o s.h5 --merge --resume"),
                   "--merge and --resume: expected one of them (--resume computes what --merge "
                   "misses)");
  expect_bad_input(study("-o s.h5 --merge --part 1/2"),
                   "--merge and --part: expected one of them (parts first, then --merge)");
  for (const char* typo :
       {"--thread 2", "--threads 0", "--part 4/3", "--part 0/3", "--part 2", "--part a/b",
        "--samples 0", "--seed -1", "--seed 18446744073709551616", "--samples ''"}) {
    const Outcome outcome = study(std::string("-o s.h5 ") + typo);
    EXPECT_EQ(outcome.code, 1) << typo;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  const Outcome large = study("-o s.h5 --samples 1000000000000");
  EXPECT_EQ(large.code, 1);
  EXPECT_NE(large.err.find(", the disk has "), std::string::npos) << large.err;
  fs::create_directory(folder_ / "s.h5.journal");
  write("s.h5.journal/diary", "mine\n");
  EXPECT_EQ(study("-o s.h5").code, 1);
  fs::remove_all(folder_ / "s.h5.journal");
  EXPECT_EQ(results(), before);
}

}  // namespace
}  // namespace condyle::test
