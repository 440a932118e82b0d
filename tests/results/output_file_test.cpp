#include "condyle/results/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "condyle/input_error.h"
#include "condyle/results/line_file.h"
#include "support/small_files.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class WrittenFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("condyle_output_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string contents(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::string message_of(const fs::path& path, const std::string& bytes) {
    try {
      write_output_file(path, bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  [[nodiscard]] std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_), {});
  }

  fs::path folder_;
};

TEST_F(WrittenFile, HoldsTheBytes) {
  write_output_file(folder_ / "a", std::string("x\0y", 3));
  EXPECT_EQ(contents(folder_ / "a"), std::string("x\0y", 3));
  EXPECT_EQ(files(), 1);
}

TEST_F(WrittenFile, ReplacesAnOlderOne) {
  write_output_file(folder_ / "a", "older and longer");
  write_output_file(folder_ / "a", "new");
  EXPECT_EQ(contents(folder_ / "a"), "new");
}

// A patient's data stay as open as they are.
TEST_F(WrittenFile, KeepsThePermissionsOfTheOneThatItReplaces) {
  const fs::perms own = fs::perms::owner_read | fs::perms::owner_write,
                  shared = own | fs::perms::group_read | fs::perms::group_write;
  for (const fs::perms mode : {own, shared}) {
    std::ofstream(folder_ / "a") << "older";
    fs::permissions(folder_ / "a", mode);
    write_output_file(folder_ / "a", "new");
    EXPECT_EQ(fs::status(folder_ / "a").permissions(), mode);
    FileBeside beside(folder_ / "a");
    std::ofstream(beside.name()) << "newer";
    beside.keep();
    EXPECT_EQ(contents(folder_ / "a"), "newer");
    EXPECT_EQ(fs::status(folder_ / "a").permissions(), mode);
    const LineFile journal(folder_ / "a.journal", folder_ / "a");
    EXPECT_EQ(fs::status(folder_ / "a.journal").permissions(), mode);
  }
}

TEST_F(WrittenFile, ByTheNameOfALinkIsWhatThatNames) {
  fs::create_directories(folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere" / "real") << "older";
  fs::create_symlink("elsewhere/real", folder_ / "one");
  fs::create_symlink(folder_ / "one", folder_ / "two");
  fs::create_symlink("elsewhere/none yet", folder_ / "dangling");
  write_output_file(folder_ / "two", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "one") && fs::is_symlink(folder_ / "two"));
  EXPECT_EQ(contents(folder_ / "elsewhere" / "real"), "new");
  write_output_file(folder_ / "dangling", "there");
  EXPECT_EQ(contents(folder_ / "elsewhere" / "none yet"), "there");
  fs::create_symlink("round", folder_ / "round");
  EXPECT_NE(message_of(folder_ / "round", "x").find("is a link that leads nowhere"),
            std::string::npos);
  fs::create_symlink("missing/a", folder_ / "lost");
  EXPECT_NE(message_of(folder_ / "lost", "x").find("there is no folder"), std::string::npos);
}

TEST_F(WrittenFile, IsWrittenByAndBy) {
  {
    OutputFile file(folder_ / "a");
    file.append("one ");
    EXPECT_FALSE(fs::exists(folder_ / "a"));
    file.append("two");
    file.keep();
  }
  EXPECT_EQ(contents(folder_ / "a"), "one two");
  EXPECT_EQ(files(), 1);
}

TEST_F(WrittenFile, ThatIsNotKeptVanishes) {
  write_output_file(folder_ / "a", "older");
  { OutputFile(folder_ / "a").append("half"); }
  EXPECT_EQ(contents(folder_ / "a"), "older");
  EXPECT_EQ(files(), 1);
}

// As a signal handler does.
TEST_F(WrittenFile, ThatIsNotKeptIsRemovedByASignal) {
  OutputFile file(folder_ / "a");
  file.append("half");
  EXPECT_EQ(files(), 1);
  remove_unkept_files();
  EXPECT_EQ(files(), 0);
}

TEST_F(WrittenFile, RemovesWhatAKillLeftAndNothingElse) {
  for (const char* name : {"a.part123", "a.part9x", "a.part", "b.part123"})
    std::ofstream(folder_ / name) << "half";
  write_output_file(folder_ / "a", "whole");
  EXPECT_FALSE(fs::exists(folder_ / "a.part123"));
  EXPECT_EQ(files(), 4);
}

// The lock of its writer says that a part is no remains.
TEST_F(WrittenFile, OfAnotherProcessIsLeftAlone) {
  const int other = ::open((folder_ / "a.part123").c_str(), O_WRONLY | O_CREAT, 0666);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  write_output_file(folder_ / "a", "whole");
  EXPECT_TRUE(fs::exists(folder_ / "a.part123"));
  ::close(other);
}

// Containers number their processes anew, so two of one number may write into one folder: each has a part of its own.
TEST_F(WrittenFile, IsWholeWhereTwoOfOneProcessNumberWriteIt) {
  OutputFile first(folder_ / "a"), second(folder_ / "a");
  first.append("first");
  second.append("second, and longer");
  EXPECT_EQ(files(), 2);
  first.keep();
  EXPECT_EQ(contents(folder_ / "a"), "first");
  second.keep();
  EXPECT_EQ(contents(folder_ / "a"), "second, and longer");
  EXPECT_EQ(files(), 1);
}

TEST_F(WrittenFile, HasANameWithRoomForAnEnding) {
  const fs::path path = folder_ / std::string(250, 'n');
  EXPECT_EQ(message_of(path, "x"),
            path.string() + ": is too long a name, expected one with room for an ending");
}

TEST_F(WrittenFile, NeedsAFolder) {
  const fs::path path = folder_ / "nowhere" / "a.h5";
  EXPECT_EQ(message_of(path, "x"), path.string() + ": there is no folder " +
                                       (folder_ / "nowhere").string() +
                                       ", expected one that exists");
}

TEST_F(WrittenFile, IsNotAFolder) {
  EXPECT_EQ(message_of(folder_, "x"),
            folder_.string() + ": is not a file, expected the name of a file to write");
}

TEST_F(WrittenFile, NeverReplacesADevice) {
  EXPECT_EQ(message_of("/dev/full", "x"),
            "/dev/full: is not a file, expected the name of a file to write");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(WrittenFile, OfAFullDiskLeavesTheOlderOneAndNothingElse) {
  write_output_file(folder_ / "a", "older");
  std::string message;
  {
    const test::FilesUpTo small(10000);
    message = message_of(folder_ / "a", std::string(20000, 'x'));
  }
  EXPECT_EQ(message, (folder_ / "a").string() + ": cannot be written: File too large");
  EXPECT_EQ(contents(folder_ / "a"), "older");
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace condyle
