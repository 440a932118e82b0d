/// A file of a stranger is read by another process: whatever becomes of that, this one goes on.

#include "condyle/results/hdf5_process.h"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "condyle/results/hdf5_wire.h"
#include "condyle/results/line_file.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using Kind = Hdf5Question::Kind;

/// Answers with what it was asked; some names do more.
Hdf5Answer echo(const Hdf5Question& question) {
  if (question.name == "crash") std::abort();
  if (question.name == "leave") _exit(0);
  if (question.name == "no memory") throw std::bad_alloc();
  if (question.name == "refuse") throw InputError("run.h5: /: nothing of that name");
  if (question.name == "many")
    return {.texts = {}, .values = std::vector<double>(200000, 0.5), .shape = {400, 500}};
  return {.number = question.group,
          .texts = {question.name, "", question.attribute},
          .values = {1, -0.0, 3},
          .shape = {3, 1}};
}

TEST(Hdf5Process, AnswersAsThisProcessWould) {
  Hdf5Process process("run.h5", [] { return echo; });
  const Hdf5Answer answer = process.ask({Kind::kNumbers, 7, "force", "units"});
  EXPECT_EQ(answer.number, 7u);
  EXPECT_EQ(answer.texts, (std::vector<std::string>{"force", "", "units"}));
  EXPECT_EQ(answer.values, (std::vector<double>{1, 0, 3}));
  EXPECT_TRUE(std::signbit(answer.values[1]));
  EXPECT_EQ(answer.shape, (Shape{3, 1}));
  EXPECT_EQ(process.ask({Kind::kNumbers, 0, "many", ""}).values, std::vector<double>(200000, 0.5));
}

TEST(Hdf5Process, RefusesAsThatDidAndIsAskedOn) {
  Hdf5Process process("run.h5", [] { return echo; });
  try {
    (void)process.ask({Kind::kHas, 0, "refuse", ""});
    FAIL();
  } catch (const DamagedFile&) {
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "run.h5: /: nothing of that name");
  }
  EXPECT_THROW((void)process.ask({Kind::kHas, 0, "no memory", ""}), std::bad_alloc);
  EXPECT_EQ(process.ask({Kind::kHas, 5, "", ""}).number, 5u);
}

/// How many of this process's open files are this one.
std::uint64_t times_open(const std::filesystem::path& file) {
  std::uint64_t count = 0;
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    count += std::filesystem::read_symlink(entry.path(), gone) == file ? 1 : 0;
  return count;
}

// A child that outlives its process, which a signal ended, would keep others from its output.
TEST(Hdf5Process, HoldsNoLockOfTheProcessThatMadeIt) {
  const std::filesystem::path file = test::fresh_folder("hdf5 process") / "run.h5.journal";
  {
    const LineFile journal(file);
    ASSERT_EQ(times_open(file), 1U);
    Hdf5Process process("run.h5", [&] {
      const std::uint64_t there = times_open(file);
      return [there](const Hdf5Question&) {
        return Hdf5Answer{.number = there, .texts = {}, .values = {}, .shape = {}};
      };
    });
    EXPECT_EQ(process.ask({Kind::kHas, 0, "", ""}).number, 0U);
    EXPECT_EQ(times_open(file), 1U);
  }
  std::filesystem::remove_all(file.parent_path());
}

// Of copies that share its stream one could take the answer to another one's question.
TEST(Hdf5Process, AnswersNoCopyOfTheProcessThatOpenedTheFile) {
  Hdf5Process process("run.h5", [] { return echo; });
  const pid_t copy = fork();
  if (copy == 0) {
    int code = 1;
    try {
      (void)process.ask({Kind::kNumbers, 7, "force", "units"});
    } catch (const InputError& error) {
      code = std::string(error.what()) ==
                     "run.h5: was opened by another process, expected to be read by the one that "
                     "opened it"
                 ? 0
                 : 2;
    }
    std::optional<Hdf5Process> own;
    own.emplace("run.h5", [] { return echo; });
    if (own->ask({Kind::kNumbers, 4, "", ""}).number != 4U) code = 3;
    _exit(code);
  }
  int status = -1;
  ASSERT_EQ(waitpid(copy, &status, 0), copy);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(process.ask({Kind::kNumbers, 5, "", ""}).number, 5U);
}

TEST(Hdf5Process, ThatDoesNotLiveToAnswerLeavesADamagedFile) {
  for (const char* end : {"crash", "leave"}) {
    Hdf5Process process("run.h5", [] { return echo; });
    EXPECT_THROW((void)process.ask({Kind::kHas, 0, end, ""}), DamagedFile) << end;
    EXPECT_THROW((void)process.ask({Kind::kHas, 0, "", ""}), DamagedFile) << end;
  }
  EXPECT_THROW(Hdf5Process("run.h5", []() -> Hdf5Process::Answering { std::abort(); }),
               DamagedFile);
  EXPECT_THROW(
      Hdf5Process("run.h5", []() -> Hdf5Process::Answering { throw InputError("no run"); }),
      InputError);
}

TEST(Hdf5Process, IsAskedByOneThreadAtATime) {
  Hdf5Process process("run.h5", [] { return echo; });
  std::vector<std::thread> threads;
  std::vector<int> wrong(4);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&process, &wrong, t] {
      for (std::uint64_t i = 0; i < 100; ++i)
        wrong[static_cast<std::size_t>(t)] +=
            process.ask({Kind::kHas, 4 * i + static_cast<std::uint64_t>(t), "", ""}).number !=
            4 * i + static_cast<std::uint64_t>(t);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

/// What a process that lost its wits may send.
bool is_taken(const std::string& bytes) {
  std::FILE* stream = std::tmpfile();
  std::fwrite(bytes.data(), 1, bytes.size(), stream);
  std::rewind(stream);
  WireReader in(stream, 1e6);
  std::vector<double> values;
  in.take(values);
  std::fclose(stream);
  return in.ok();
}

TEST(Hdf5Wire, TakesNoMoreThanItMayAndNothingCutShort) {
  const auto announcing = [](std::uint64_t count) {
    return std::string(reinterpret_cast<const char*>(&count), sizeof count);
  };
  EXPECT_TRUE(is_taken(announcing(0)));
  EXPECT_TRUE(is_taken(announcing(2) + std::string(16, 'x')));
  EXPECT_FALSE(is_taken(announcing(2) + std::string(15, 'x')));
  EXPECT_FALSE(is_taken(announcing(125001)));
  EXPECT_FALSE(is_taken(announcing(std::uint64_t{1} << 61)));
  EXPECT_FALSE(is_taken("short"));
}

}  // namespace
}  // namespace condyle
