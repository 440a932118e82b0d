#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace condyle::phantom {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
class PhantomProgram : public testing::Test {
 protected:
  PhantomProgram()
      : folder_(fs::temp_directory_path() / ("condyle_phantom_" + std::to_string(::getpid()))) {
    fs::create_directory(folder_);
  }
  ~PhantomProgram() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  static int run(const std::string& arguments) {
    const std::string command =
        std::string("'") + CONDYLE_PHANTOM_PROGRAM + "' " + arguments + " >/dev/null 2>&1";
    return std::system(command.c_str());
  }
  std::string femur(const std::string& options) const {
    EXPECT_EQ(run("-o '" + folder_.string() + "' --resolution 6 " + options), 0);
    std::ifstream in(folder_ / "femur.stl", std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }

  fs::path folder_;
};

TEST_F(PhantomProgram, WritesTheSameBytesEachTimeAndNothingOfTheMachine) {
  const std::string first = femur(""), again = femur("");
  EXPECT_EQ(first, again);
  EXPECT_EQ(first.substr(0, 80).find_first_of("/\\:"), std::string::npos);  // no path, no date
  EXPECT_TRUE(fs::exists(folder_ / "tibia.stl"));
}

TEST_F(PhantomProgram, OptionsChangeTheRoughness) {
  const std::string rough = femur("");
  EXPECT_NE(rough, femur("--exact"));
  EXPECT_NE(rough, femur("--seed 7"));
  EXPECT_NE(rough, femur("--roughness 0.1 --correlation 3"));
  EXPECT_EQ(femur("--exact"), femur("--roughness 0"));
}

TEST_F(PhantomProgram, MakesItsFolder) {
  EXPECT_EQ(run("-o '" + (folder_ / "knees" / "new").string() + "' --resolution 6"), 0);
  EXPECT_TRUE(fs::exists(folder_ / "knees" / "new" / "tibia.stl"));
}

TEST_F(PhantomProgram, RefusesAFolderThatCannotBeMadeAndNonsenseNumbers) {
  std::ofstream(folder_ / "file") << "no folder";
  EXPECT_NE(run("-o '" + (folder_ / "file" / "knee").string() + "'"), 0);
  EXPECT_NE(run("-o '" + folder_.string() + "' --resolution -1"), 0);
  EXPECT_NE(run("-o '" + folder_.string() + "' --roughness nan"), 0);
  EXPECT_FALSE(fs::exists(folder_ / "femur.stl"));
}

}  // namespace
}  // namespace condyle::phantom
