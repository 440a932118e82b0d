/// Pictures and plots of runs, as a user asks for them.

#include <algorithm>

#include "app/run_program.h"
#include "condyle/network/simulate.h"
#include "condyle/pictures/png_file.h"
#include "condyle/results/run_file.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::Outcome;

const std::string kPendulum = CONDYLE_SOURCE_DIR "/data/phantom/pendulum.toml";

void expect_refusal(const Outcome& outcome, const std::string& part) {
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << "one clear line";
}

/// The small scene's run: a ball on a plateau from 0 to 20 degrees, without meshes.
class PictureCommands : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    const Outcome sweep = run("sweep knee.toml -o run.h5");
    ASSERT_EQ(sweep.code, 0) << sweep.err;
  }
};

TEST_F(PictureCommands, AStripIsOnePictureOfAllValues) {
  const Outcome strip = run("render run.h5 -o out --strip --at 0,10,20 --view medial");
  EXPECT_EQ(strip.code, 0) << strip.err;
  EXPECT_EQ(strip.out, "wrote out/medial_strip.png\n");
  EXPECT_EQ(read_png(at("out/medial_strip.png")).height, 640);
}

TEST_F(PictureCommands, AMovieMovesOverAllPoses) {
  const Outcome movie = run("render run.h5 -o knee.png --movie --view medial --size 320x240");
  EXPECT_EQ(movie.code, 0) << movie.err;
  const std::string bytes = test::contents(at("knee.png"));
  EXPECT_NE(bytes.find("acTL"), std::string::npos);
  std::size_t frames = 0;
  for (std::size_t i = 0; (i = bytes.find("fcTL", i)) != std::string::npos; ++i) ++frames;
  EXPECT_EQ(frames, read_run(at("run.h5")).sweep.poses.size());
}

TEST_F(PictureCommands, ASinglePictureMayGoIntoAFile) {
  const Outcome one = run("render run.h5 -o one.png --view plateau --at 10 --proximity");
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(read_png(at("one.png")).width, 1200);
  EXPECT_EQ(run("render run.h5 -o two.PNG --view plateau --at 10 --size 200x200").code, 0);
  EXPECT_EQ(read_png(at("two.PNG")).width, 200);
  expect_refusal(run("render run.h5 -o one.png"), "do not go into one file");
  expect_refusal(run("render run.h5 -o one.mp4 --at 10 --view plateau"), "add --movie");
}

TEST_F(PictureCommands, PosesThatLieCloseHaveAPictureEach) {
  ASSERT_EQ(run("sweep knee.toml -o close.h5 --from 10 --to 10.00002 --step 0.00001").code, 0);
  const Outcome three =
      run("render close.h5 -o out --view medial --size 200x200 --at 10,10.00001,10.00002");
  EXPECT_EQ(three.code, 0) << three.err;
  EXPECT_EQ(three.out,
            "wrote out/medial_010.png\nwrote out/medial_010.00001.png\n"
            "wrote out/medial_010.00002.png\n");
}

/// A scale of which the ends are neighbours among numbers has no steps that could be added up.
TEST_F(PictureCommands, ValuesThatAreNeighboursHaveAPicture) {
  const std::string loaded = with(test::kScene, "[0, 100, 0]", "[0, 1e-5, 0]");
  write("near.toml", with(with(loaded, "vary = \"bend\"", "vary = \"weight.scale\""),
                          "from = 0\nto = 20\nstep = 5", "values = [1e7, 10000000.000000002]"));
  ASSERT_EQ(run("sweep near.toml -o near.h5").code, 0);
  const Outcome one = run("render near.h5 -o near.png --view medial --at 1e7", "timeout 60 ");
  EXPECT_EQ(one.code, 0) << one.err;
}

TEST_F(PictureCommands, SayWhatIsWrong) {
  expect_refusal(run("render run.h5 -o one.jpg --at 10 --view plateau"), "pictures are PNG");
  expect_refusal(run("render run.h5 -o out --hertz"), "holds no estimates of contact pressure");
  expect_refusal(run("render run.h5 -o out --pressure"), "holds no pressures");
  expect_refusal(run("render run.h5 -o out --pressure --proximity"), "--proximity");
  expect_refusal(run("render run.h5 -o out --view front"), "condyles, exploded");
  expect_refusal(run("render run.h5 -o out --strip --movie"), "--strip");
  expect_refusal(run("render run.h5 -o out --fps 20"), "--movie");
  expect_refusal(
      run("render run.h5 -o out --strip --view medial --size 500x800 --at 0,5,10,15,20"),
      "a strip of 5 poses on 500x800 pixels leaves 76x566 for each, expected at least 200 "
      "each way: fewer poses (--at) or a larger page (--size)");
  expect_refusal(run("plot run.h5 missing.h5 -o out"), "missing.h5");
  expect_refusal(run("plot run.h5 -o out --format jpg"), "expected png, svg or pdf");
  expect_refusal(run("plot run.h5 run.h5 run.h5 run.h5 run.h5 run.h5 run.h5 -o out"),
                 "7 runs over each other, expected at most 6");
}

TEST_F(PictureCommands, SeveralRunsLieOverEachOther) {
  ASSERT_EQ(run("sweep knee.toml -o other.h5 --to 10").code, 0);
  const Outcome plot = run("plot run.h5 other.h5 -o out --format svg");
  EXPECT_EQ(plot.code, 0) << plot.err;
  const std::string svg = test::contents(at("out/joint_coordinates.svg"));
  EXPECT_NE(svg.find(">other<"), std::string::npos) << "the legend names the runs";
}

TEST_F(PictureCommands, CurvesWithoutAPoseAreWarnedOf) {
  const std::string slack = with(test::kScene, "slack_length = 30", "slack_length = 3000");
  write("adrift.toml", with(slack, "[0, 100, 0]", "[0, -100, 0]"));
  ASSERT_EQ(run("sweep adrift.toml -o adrift.h5 --to 5").code, 2);
  const std::string warning =
      "condyle: warning: adrift.h5: no pose converged, so its curves are empty\n";
  EXPECT_EQ(run("plot adrift.h5 -o out --format svg").err, warning);
  EXPECT_EQ(run("plot run.h5 adrift.h5 -o out --format svg").err, warning);
  EXPECT_EQ(run("plot adrift.h5 -o out --format svg --quiet").err, "");
}

TEST_F(CommandLine, AMotionIsDrawnAndPlottedOverTime) {
  const Outcome motion = run("simulate '" + kPendulum + "' -o dyn.h5");
  ASSERT_EQ(motion.code, 0) << motion.err;
  const Outcome picture = run("render dyn.h5 -o out --at 0.25 --view lateral --size 400x300");
  EXPECT_EQ(picture.out, "wrote out/lateral_000.25.png\n") << picture.err;
  expect_refusal(run("render dyn.h5 -o out --at 2.5"), "holds 0 to 2");
  const Outcome plot = run("plot dyn.h5 -o out --format svg");
  EXPECT_EQ(plot.code, 0) << plot.err;
  EXPECT_NE(test::contents(at("out/energy.svg")).find("dissipated"), std::string::npos);

  const auto read = read_run(at("dyn.h5"));
  ASSERT_TRUE(read.simulation());
  const std::vector<MotionFrame>& frames = read.simulation()->motion.frames;
  ASSERT_EQ(frames.size(), read.sweep.poses.size());
  EXPECT_TRUE(read.simulation()->motion.completed);
  EXPECT_NEAR(read.simulation()->mass.mass, 4e-3, 1e-12);  // 4 kg in tonne
  // The program says that the balance is kept to some 1e-8 of a joule.
  EXPECT_NEAR(frames.back().balance(), frames.front().balance(), 1e-3);  // N mm
  EXPECT_GT(frames.back().energy.kinetic, 100);
}

}  // namespace
}  // namespace condyle
