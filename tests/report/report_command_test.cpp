/// condyle report, as a user runs it.

#include "app/run_program.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::contents;
using test::expect_bad_input;

TEST_F(CommandLine, WritesAReport) {
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0);
  const auto outcome = run("report run.h5 -o run.html");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "wrote run.html\n");
  EXPECT_EQ(outcome.err, "");
  const std::string page = contents(folder_ / "run.html");
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_EQ(page.substr(page.size() - 8), "</html>\n");
  EXPECT_NE(page.find("<h1>ball and socket</h1>"), std::string::npos);
  EXPECT_NE(page.find("<strong>5 of 5</strong> poses converged"), std::string::npos);
}

TEST_F(CommandLine, LeavesPicturesAndTheViewOutOfAReportWhereAsked) {
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0);
  ASSERT_EQ(run("report run.h5 -o run.html --no-pictures --no-viewer").code, 0);
  const std::string page = contents(folder_ / "run.html");
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_LT(page.size(), 100000U);
}

TEST_F(CommandLine, NamesARunThatIsNotThereInAReport) {
  const auto outcome = run("report nobody.h5 -o run.html");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err.rfind("condyle: nobody.h5", 0), 0U) << outcome.err;
  EXPECT_TRUE(results().empty());
}

TEST_F(CommandLine, WritesNoPageUnderTheNameOfAnotherFormat) {
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0);
  expect_bad_input(
      run("report run.h5 -o run.pdf"),
      "run.pdf: the page is HTML, expected a name that ends in .html; browsers print it");
  expect_bad_input(run("report run.h5 -o other.h5"),
                   "other.h5: expected a name that ends in .html");
  expect_bad_input(
      run("report knee.toml -o run.html"),
      "knee.toml: is a scene (TOML), expected a run (HDF5), as condyle sweep writes it");
}

TEST_F(CommandLine, DoesNotWriteAReportOrAPictureOverWhatItsRunWasComputedFrom) {
  const std::string said = ": the run was computed from it, expected another file to write";
  write("knee", test::kScene);
  write("knee.png", test::kScene);
  ASSERT_EQ(run("sweep knee -o run.h5 --quiet").code, 0);
  expect_bad_input(run("report run.h5 -o knee"), "knee" + said);
  expect_bad_input(run("report run.h5 run.h5 -o knee"), "knee" + said);
  expect_bad_input(run("report run.h5 -o table.csv"),
                   "table.csv: expected a name that ends in .html");
  EXPECT_EQ(contents(folder_ / "knee"), test::kScene);
#ifdef CONDYLE_PICTURES
  ASSERT_EQ(run("sweep knee.png -o run.h5 --quiet").code, 0);
  expect_bad_input(run("render run.h5 -o knee.png --at 0 --view medial"), "knee.png" + said);
  EXPECT_EQ(contents(folder_ / "knee.png"), test::kScene);
#endif
}

TEST_F(CommandLine, DoesNotWriteAReportOverItsRun) {
  ASSERT_EQ(run("sweep knee.toml -o run --quiet").code, 0);
  expect_bad_input(run("report run -o run"),
                   "run: is read by this command, expected another file to write");
  expect_bad_input(run("report run -o run.h5"), "run.h5: expected a name that ends in .html");
}

TEST_F(CommandLine, ComparesRunsInOneReport) {
  write("other.toml", with(test::kScene, "stiffness = 1500", "stiffness = 1800"));
  ASSERT_EQ(run("sweep knee.toml -o a.h5 --quiet").code, 0);
  ASSERT_EQ(run("sweep other.toml -o b.h5 --quiet --step 2.5").code, 0);
  const auto outcome = run("report a.h5 b.h5 a.h5 -o ab.html");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "wrote ab.html\n");
  const std::string page = contents(folder_ / "ab.html");
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_NE(page.find("<h1>ball and socket: a.h5, b and a.h5 (2)</h1>"), std::string::npos);
  EXPECT_NE(page.find("1800 (+20 %)"), std::string::npos);
  EXPECT_NE(run("report a.h5 b.h5 -o ab.html --json").out.find("\"scene_differences\""),
            std::string::npos);
}

TEST_F(CommandLine, RefusesRunsThatCannotBeCompared) {
  write("study.toml",
        "specimens = \"knee.toml\"\ndesign = \"monte-carlo\"\nsamples = 4\n[[vary]]\n"
        "what = \"stiffness\"\nof = \"*\"\nsd = 0.1\n");
  ASSERT_EQ(run("sweep knee.toml -o a.h5 --quiet").code, 0);
  ASSERT_EQ(run("study study.toml -o s.h5 --quiet").code, 0);
  expect_bad_input(run("report a.h5 s.h5 -o ab.html"),
                   "s.h5: is a study, expected runs; a study is reported by itself");
  expect_bad_input(run("report a.h5 a.h5 a.h5 a.h5 a.h5 a.h5 a.h5 -o ab.html"),
                   "7 runs to compare, expected at most 6");
  expect_bad_input(run("report a.h5 s.h5 -o s.h5"), "s.h5: expected a name that ends in .html");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "ab.html"));
}

TEST_F(CommandLine, ReportsAStudyAndRefusesItWhereARunIsNeeded) {
  write("study.toml",
        "specimens = \"knee.toml\"\ndesign = \"monte-carlo\"\nsamples = 8\n[[vary]]\n"
        "what = \"stiffness\"\nof = \"*\"\nsd = 0.1\n");
  ASSERT_EQ(run("study study.toml -o study.h5 --quiet").code, 0);
  EXPECT_EQ(run("report study.h5 -o study.html --no-pictures").out, "wrote study.html\n");
  const std::string page = contents(folder_ / "study.html");
  EXPECT_NE(page.find("<strong>40 of 40</strong> poses have a result"), std::string::npos);
  EXPECT_NE(page.find("aACL.stiffness"), std::string::npos);
  for (const char* command : {"render study.h5 -o pictures", "export study.h5 -o knee.glb",
                              "verify study.h5", "check study.h5"}) {
    const auto outcome = run(command);
    EXPECT_EQ(outcome.code, 1) << command;
    EXPECT_NE(outcome.err.find("condyle plot and condyle report show"), std::string::npos)
        << command << ": " << outcome.err;
  }
}

}  // namespace
}  // namespace condyle
