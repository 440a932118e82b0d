#include "condyle/app/progress.h"

#include <pty.h>

#include <array>

#include "app/run_program.h"

namespace condyle {
namespace {

TEST(ProgressLine, EstimatesTheTimeThatIsLeft) {
  // 12 of 48 in 10 s: 36 more at the same pace take 30 s. A quarter of 23 is 5 and a bit.
  EXPECT_EQ(progress_line("poses", 12, 48, 10, 60),
            "poses  [#####------------------]  12 of 48, about 30 s left");
  // 100 more of 40 s each.
  EXPECT_EQ(progress_line("poses", 1, 101, 40, 48),
            "poses  [-----]  1 of 101, about 1 h 06 min left");
  EXPECT_EQ(progress_line("poses", 0, 4, 1, 30), "poses  [------------]  0 of 4");
}

TEST(ProgressLine, FitsIntoTheTerminal) {
  for (int width = 10; width < 120; ++width)
    EXPECT_LT(progress_line("frames", 517, 1000, 3, width).size(), static_cast<std::size_t>(width));
}

TEST(ProgressLine, CountsWhereTheEndIsNotKnown) {
  EXPECT_EQ(progress_line("poses", 31, 0, 65, 80), "poses  31 so far, 1 min 05 s");
}

/// What a terminal shows of a command.
std::string typed(const std::string& command) {
  int terminal = -1;
  const ::pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    ::setenv("TERM", "xterm", 1);
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::string text;
  std::array<char, 4096> buffer{};
  for (::ssize_t n = 0; (n = ::read(terminal, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(n));
  ::close(terminal);
  ::waitpid(child, nullptr, 0);
  return text;
}

using test::CommandLine;

/// 24,000 poses take longer than the half second that the line waits, on any machine.
std::string long_sweep_in(const std::filesystem::path& folder) {
  return "cd '" + folder.string() +
         "' && '" CONDYLE_PROGRAM "' sweep '" CONDYLE_SOURCE_DIR
         "/data/phantom/knee.toml' --step 0.005 -o run.h5 > stdout.txt";
}

TEST_F(CommandLine, ShowsProgressWhereATerminalWatches) {
  const std::string seen = typed(long_sweep_in(folder_));
  EXPECT_NE(seen.find("poses  ["), std::string::npos) << seen;
  EXPECT_NE(seen.find(" of 24001, about "), std::string::npos) << seen;
  ASSERT_GE(seen.size(), 4U);
  EXPECT_EQ(seen.substr(seen.size() - 4), "\r\x1b[K");  // wiped off in the end
  EXPECT_EQ(test::contents(folder_ / "stdout.txt").find('\r'), std::string::npos);
}

TEST_F(CommandLine, ShowsNoProgressWhereItIsToBeQuiet) {
  EXPECT_EQ(typed(long_sweep_in(folder_) + " --quiet"), "");
}

TEST_F(CommandLine, ShowsNoProgressInAPipe) {
  const std::string err = run("fit '" CONDYLE_SOURCE_DIR "/data/phantom/knee.toml' -o fit.h5").err;
  EXPECT_EQ(err.find('\r'), std::string::npos);
  EXPECT_EQ(err.find("patches"), std::string::npos);  // warnings may be there
}

}  // namespace
}  // namespace condyle
