/// A sweep that is stopped, in every way, and goes on with --resume.

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "app/run_program.h"
#include "condyle/results/run_file.h"
#include "support/same_sweep.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::expect_bad_input;
using test::Outcome;

// Problem 1 of the report: converges everywhere, swept from 0 to 4 cm.
const std::string kSphereInCylinder =
    test::contents(fs::path(CONDYLE_SOURCE_DIR) / "data/dortmans/problem1.toml");

class ResumeCommand : public test::CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("knee.toml", kSphereInCylinder);
  }

  [[nodiscard]] SweepResult result(const std::string& name) const {
    return read_run(folder_ / name).sweep;
  }

  /// Starts a long sweep and kills it without warning once its journal has grown.
  void kill_a_sweep(const std::vector<std::string>& arguments, const std::string& journal) const {
    const pid_t child = ::fork();
    if (child == 0) {
      if (::chdir(folder_.c_str()) != 0 || std::freopen("stdout.txt", "w", stdout) == nullptr)
        ::_exit(127);
      std::vector<char*> words;
      for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.data()));
      words.push_back(nullptr);
      ::execv(CONDYLE_PROGRAM, words.data());
      ::_exit(127);
    }
    std::error_code missing;
    for (int i = 0; i < 20000; ++i) {
      const std::uintmax_t bytes = fs::file_size(folder_ / journal, missing);
      if (!missing && bytes > 50000) break;
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the sweep had already ended";
  }
};

TEST_F(ResumeCommand, GoesOnAfterBeingKilled) {
  const std::string options = " --step 0.0001";
  kill_a_sweep({"condyle", "sweep", "knee.toml", "-o", "run.h5", "--step", "0.0001"},
               "run.h5.journal");
  ASSERT_EQ(results(), std::vector<std::string>{"run.h5.journal"});
  fs::copy_file(at("run.h5.journal"), at("again.h5.journal"));
  const Outcome resumed = run("sweep knee.toml -o run.h5 --resume" + options);
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.out.find("resuming with "), std::string::npos);
  EXPECT_NE(resumed.out.find(" poses taken over, "), std::string::npos);
  EXPECT_EQ(resumed.out.find("\n0 poses taken over, "), std::string::npos);
  EXPECT_FALSE(fs::exists(at("run.h5.journal")));

  // And what is resumed may be killed again.
  const auto bytes = fs::file_size(at("again.h5.journal"));
  kill_a_sweep({"condyle", "sweep", "knee.toml", "-o", "again.h5", "--resume", "--step", "0.0001"},
               "again.h5.journal");
  EXPECT_GE(fs::file_size(at("again.h5.journal")), bytes);
  EXPECT_EQ(run("sweep knee.toml -o again.h5 --resume" + options).code, 0);

  EXPECT_EQ(run("sweep knee.toml -o whole.h5" + options).code, 0);
  const SweepResult whole = result("whole.h5");
  EXPECT_EQ(whole.poses.size(), 40001u);
  test::expect_same_sweep(whole, result("run.h5"));
  test::expect_same_sweep(whole, result("again.h5"));
}

TEST_F(ResumeCommand, ComputesOnlyWhatAFinerAndWiderRangeLacks) {
  EXPECT_EQ(run("sweep knee.toml -o run.h5").code, 0);  // 0 to 4 by 0.8
  const Outcome resumed = run("sweep knee.toml -o run.h5 --resume --from -0.8 --to 4.4 --step 0.4");
  EXPECT_NE(resumed.out.find("resuming with 6 poses of run.h5"), std::string::npos) << resumed.out;
  EXPECT_NE(resumed.out.find("6 poses taken over, 8 computed"), std::string::npos) << resumed.out;
  EXPECT_EQ(run("sweep knee.toml -o whole.h5 --from -0.8 --to 4.4 --step 0.4").code, 0);
  test::expect_same_sweep(result("whole.h5"), result("run.h5"));
}

// Seconds of a motion are no degrees.
TEST_F(ResumeCommand, GoesOnFromNoOtherKindOfResult) {
  const std::string scene =
      "'" CONDYLE_SOURCE_DIR "/data/wismans-type/knee.toml' -o run.h5 --from 0 --to 10";
  ASSERT_EQ(run("compare " + scene).code, 0);
  const Outcome outcome = run("sweep " + scene + " --resume");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("run.h5: is no sweep, expected the result of condyle sweep\n"),
            std::string::npos)
      << outcome.err;
}

TEST_F(ResumeCommand, SaysWhenThereIsNothingToGoOnFrom) {
  const Outcome outcome = run("sweep knee.toml -o run.h5 --resume");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("nothing to resume from"), std::string::npos) << outcome.out;
  EXPECT_EQ(result("run.h5").poses.size(), 6u);
}

TEST_F(ResumeCommand, IsOfferedWhereAStoppedRunIsReplaced) {
  EXPECT_EQ(run("sweep knee.toml -o run.h5", "trap '' XFSZ; ulimit -f 8; ").code, 1);
  ASSERT_TRUE(fs::exists(at("run.h5.journal")));
  const Outcome anew = run("sweep knee.toml -o run.h5");
  EXPECT_NE(anew.out.find("run.h5.journal holds 6 poses of a run that was stopped"),
            std::string::npos)
      << anew.out;
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5"});
}

TEST_F(ResumeCommand, TakesOverAFullDisksJournal) {
  EXPECT_EQ(run("sweep knee.toml -o run.h5", "trap '' XFSZ; ulimit -f 8; ").code, 1);
  const Outcome resumed = run("sweep knee.toml -o run.h5 --resume");
  EXPECT_NE(resumed.out.find("6 poses taken over, 0 computed"), std::string::npos) << resumed.out;
  EXPECT_EQ(run("sweep knee.toml -o whole.h5").code, 0);
  test::expect_same_sweep(result("whole.h5"), result("run.h5"));
}

TEST_F(ResumeCommand, RefusesPosesOfAnotherScene) {
  EXPECT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  write("knee.toml", with(kSphereInCylinder, "[0, 0, -50]", "[0, 0, -51]"));
  expect_bad_input(
      run("sweep knee.toml -o run.h5 --resume"),
      "run.h5: was computed from another scene, expected that of knee.toml: line 78 is "
      "\"vector = [0, 0, -50]\" there and \"vector = [0, 0, -51]\" here");
  write("knee.toml", kSphereInCylinder);
  fs::remove(at("run.h5"));
  EXPECT_EQ(run("sweep knee.toml -o run.h5", "trap '' XFSZ; ulimit -f 8; ").code, 1);
  write("knee.toml", with(kSphereInCylinder, "[0, 0, -50]", "[0, 0, -51]"));
  expect_bad_input(
      run("sweep knee.toml -o run.h5 --resume"),
      "run.h5.journal: belongs to another text of the scene, expected that of knee.toml");
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5.journal"});  // and it stays
}

TEST_F(ResumeCommand, DoesNotGoOnAlongAPath) {
  write("knee.toml", with(kSphereInCylinder, "[sweep]\n", "[sweep]\npath = \"arc length\"\n"));
  EXPECT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  expect_bad_input(run("sweep knee.toml -o run.h5 --resume"),
                   "knee.toml: [sweep]: path = \"arc length\", expected \"steps\" for --resume");
}

TEST_F(ResumeCommand, DoesNotWriteOverAFileThatIsNoJournal) {
  write("run.h5.journal", "notes of mine\n");
  expect_bad_input(
      run("sweep knee.toml -o run.h5"),
      "run.h5.journal: is no journal of a sweep, expected this name to be free for one");
  EXPECT_EQ(test::contents(at("run.h5.journal")), "notes of mine\n");
}

}  // namespace
}  // namespace condyle
