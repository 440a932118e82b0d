#include "condyle/results/output_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "condyle/input_error.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
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

TEST_F(OutputFile, HoldsTheBytes) {
  write_output_file(folder_ / "a", std::string("x\0y", 3));
  EXPECT_EQ(contents(folder_ / "a"), std::string("x\0y", 3));
  EXPECT_EQ(files(), 1);
}

TEST_F(OutputFile, ReplacesAnOlderOne) {
  write_output_file(folder_ / "a", "older and longer");
  write_output_file(folder_ / "a", "new");
  EXPECT_EQ(contents(folder_ / "a"), "new");
}

TEST_F(OutputFile, NeedsAFolder) {
  const fs::path path = folder_ / "nowhere" / "a.h5";
  EXPECT_EQ(message_of(path, "x"), path.string() + ": there is no folder " +
                                       (folder_ / "nowhere").string() +
                                       ", expected one that exists");
}

TEST_F(OutputFile, IsNotAFolder) {
  EXPECT_EQ(message_of(folder_, "x"),
            folder_.string() + ": is not a file, expected the name of a file to write");
}

TEST_F(OutputFile, NeverReplacesADevice) {
  EXPECT_EQ(message_of("/dev/full", "x"),
            "/dev/full: is not a file, expected the name of a file to write");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// A limit on the size of files stands for a full disk: the kernel refuses the write in the same
// way.
TEST_F(OutputFile, OfAFullDiskLeavesTheOlderOneAndNothingElse) {
  write_output_file(folder_ / "a", "older");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{10000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of(folder_ / "a", std::string(20000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  (void)std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, (folder_ / "a").string() + ": cannot be written: File too large");
  EXPECT_EQ(contents(folder_ / "a"), "older");
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace condyle
