/// condyle compare and condyle laxity as a user runs them: each command line of
/// docs/command-line.md.

#include <algorithm>
#include <sstream>

#include "app/run_program.h"
#include "condyle/compare/compare.h"
#include "condyle/results/run_file.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::expect_bad_input;
using test::Outcome;

const std::string kData = CONDYLE_SOURCE_DIR "/data/";

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(CommandLine, ComparesTheWismansTypeKnee) {
  const Outcome outcome = run("compare '" + kData + "wismans-type/knee.toml' -o cmp.h5 --degree 6");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // The recalled slack length of one bundle.
  EXPECT_EQ(
      outcome.err,
      "condyle: warning: ligament \"lCAP\": its slack length of 37.93 mm means a strain of +22 "
      "% at the start pose\n");
  for (const char* part : {"polynomials of degree 6", "polynomial rms, max mm", "internal rotation",
                           "flexion moment", "iterations of 16 equations", "wrote cmp.h5"})
    EXPECT_TRUE(holds(outcome.out, part)) << part;
  const condyle::Run back = read_run(folder_ / "cmp.h5");
  ASSERT_TRUE(back.comparison() != nullptr);
  EXPECT_EQ(back.comparison()->options.degree, 6);
  EXPECT_EQ(back.sweep.poses.size(), 19U);
}

TEST_F(CommandLine, ComparesThePhantomAndSaysWhichPosesDidNotSucceed) {
  // Quartics over 120 degrees of flexion do not carry the reference to the end of the sweep.
  const Outcome outcome = run("compare '" + kData + "phantom/knee.toml' -o cmp.h5");
  const condyle::Run back = read_run(folder_ / "cmp.h5");
  const int failed = 25 - back.comparison()->reference.count_converged();
  EXPECT_EQ(back.sweep.count_converged(), 25);
  EXPECT_LE(failed, 2);
  EXPECT_EQ(outcome.code, failed > 0 ? 2 : 0);
  // Beside warnings of strands that run through bone.
  std::istringstream lines(outcome.err);
  int told = 0;
  for (std::string line; std::getline(lines, line);)
    told += line.starts_with("condyle: warning: straight through") ? 0 : 1;
  EXPECT_EQ(told, failed) << outcome.err;
}

TEST_F(CommandLine, ComparesOverARangeOfItsOwn) {
  const Outcome outcome = run("compare '" + kData +
                              "wismans-type/knee.toml' -o cmp.h5 --from 10 --to 30 --step 10 "
                              "--strain 0.03");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "equal force at a strain of 0.03")) << outcome.out;
  EXPECT_EQ(read_run(folder_ / "cmp.h5").comparison()->reference.poses.size(), 3U);
}

TEST_F(CommandLine, TestsTheLaxityOfTheWismansTypeKnee) {
  const Outcome outcome = run("laxity '" + kData + "wismans-type/drawer.toml' -o lax.h5");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(holds(outcome.out, "anterior drawer [mm] from -100 to 100 N of drawer"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 13) << outcome.out;
  EXPECT_TRUE(read_run(folder_ / "lax.h5").laxity() != nullptr);
}

TEST_F(CommandLine, ChecksASceneWithATestOfLaxity) {
  const Outcome outcome = run("check '" + kData + "wismans-type/drawer.toml'");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(
      holds(outcome.out, "laxity     at 0 30 60 90 deg of flexion, also without aACL, pACL\n"))
      << outcome.out;
}

TEST_F(CommandLine, RefusesToCompareWhatWismansCannotHold) {
  expect_bad_input(run("compare knee.toml -o cmp.h5"),
                   "knee.toml: 1 [[contact]] that may close, expected 2: Wismans' model has one in "
                   "each compartment");
  expect_bad_input(run("laxity knee.toml -o lax.h5"),
                   "knee.toml: [laxity] is missing, expected the angles of flexion of the test");
  expect_bad_input(run("compare knee.toml -o knee.toml"),
                   "knee.toml: expected a name that ends in .h5");
  EXPECT_TRUE(results().empty());
  write("knee", test::contents(folder_ / "knee.toml"));
  expect_bad_input(run("compare knee -o knee"),
                   "knee: is read by this command, expected another file to write");
}

TEST_F(CommandLine, TakesDegreesFromTwoToSix) {
  for (const char* degree : {"1", "7", "x"}) {
    const Outcome outcome = run("compare knee.toml -o cmp.h5 --degree " + std::string(degree));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(holds(outcome.err, "--degree")) << outcome.err;
  }
}

#ifdef CONDYLE_PICTURES
TEST_F(CommandLine, PlotsAndDrawsBothModels) {
  ASSERT_EQ(run("compare '" + kData + "wismans-type/knee.toml' -o cmp.h5 --step 15").code, 0);
  const Outcome plots = run("plot cmp.h5 -o pictures --format svg");
  if (holds(plots.err, "gnuplot is not installed")) GTEST_SKIP() << plots.err;
  EXPECT_EQ(plots.code, 0) << plots.err;
  for (const char* name : {"compare_joint", "compare_contacts", "compare_ligaments",
                           "compare_moment", "compare_parts"}) {
    const std::string svg = test::contents(folder_ / "pictures" / (std::string(name) + ".svg"));
    EXPECT_TRUE(holds(svg, "Wismans")) << name;
  }
  const Outcome picture = run("render cmp.h5 -o pictures --view plateau --at 45 --size 400x300");
  EXPECT_EQ(picture.code, 0) << picture.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures/plateau_045.png"));
}

TEST_F(CommandLine, PlotsTheDrawerTest) {
  ASSERT_EQ(run("laxity '" + kData + "wismans-type/drawer.toml' -o lax.h5").code, 0);
  const Outcome plots = run("plot lax.h5 -o pictures --format svg");
  if (holds(plots.err, "gnuplot is not installed")) GTEST_SKIP() << plots.err;
  EXPECT_EQ(plots.code, 0) << plots.err;
  EXPECT_EQ(plots.out, "wrote pictures/laxity.svg\n");
  EXPECT_TRUE(holds(test::contents(folder_ / "pictures/laxity.svg"), "drawer"));
}
#endif

}  // namespace
}  // namespace condyle
