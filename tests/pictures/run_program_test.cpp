#include "condyle/pictures/run_program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "support/scratch_folder.h"

namespace condyle {
namespace {

TEST(RunProgram, AMissingProgramIsSaid) {
  EXPECT_FALSE(run_program({"condyle-no-such-program"}, "x").started);
}

TEST(RunProgram, SaysWhichSignalEndedTheOtherOne) {
  const ProgramResult result = run_program({"sh", "-c", "kill -9 $$"}, "");
  EXPECT_EQ(result.exit_code, -1);
  EXPECT_EQ(result.messages, "ended by a signal: Killed");
}

TEST(RunProgram, SaysWhyAProgramCannotBeStarted) {
  const auto file = test::fresh_folder("condyle_no_program") / "program";
  std::ofstream(file) << "#!/bin/sh\n";
  const ProgramResult result = run_program({file.string()}, "");
  EXPECT_FALSE(result.started);
  EXPECT_EQ(result.messages, file.string() + " cannot be started: Permission denied");
}

// gnuplot says nothing of a disk that is full: what it writes to is none.
TEST(RunProgram, NeedsNoRoomOnTheDisk) {
  const ProgramResult result = run_program({"readlink", "/proc/self/fd/1", "/proc/self/fd/2"}, "");
  EXPECT_EQ(result.output, "/memfd:condyle (deleted)\n/memfd:condyle (deleted)\n");
}

// What this program ignores the other one does not.
TEST(RunProgram, LetsTheOtherOneEndAsItKnows) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(run_program({"sh", "-c", "kill -PIPE $$"}, "").messages,
            "ended by a signal: Broken pipe");
  std::signal(SIGPIPE, before);
}

TEST(RunProgram, TakesMoreThanAPipeHolds) {
  EXPECT_EQ(run_program({"head", "-c", "1000000", "/dev/zero"}, "").output.size(), 1000000U);
}

TEST(RunProgram, AProgramThatDoesNotListenDoesNotHurt) {
  const ProgramResult result = run_program({"false"}, std::string(10'000'000, 'x'));
  EXPECT_TRUE(result.started);
  EXPECT_EQ(result.exit_code, 1);
}

TEST(RunProgram, CollectsEveryByteThatTheProgramWrites) {
  const ProgramResult result = run_program({"cat"}, std::string("a\0\n\xff b", 6));
  EXPECT_EQ(result.output, std::string("a\0\n\xff b", 6));
  EXPECT_EQ(run_program({"cat"}, std::string(300'000, 'x')).output.size(), 300'000U);
}

TEST(RunProgram, CollectsWhatTheProgramComplainsOf) {
  const ProgramResult result = run_program({"sh"}, "echo one >&2\necho two >&2\nexit 3\n");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.messages, "one two");
}

}  // namespace
}  // namespace condyle
