/// A second way to the answer is one only as long as it borrows no solver.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace condyle {
namespace {

TEST(Independence, TheReferenceModelUsesNothingOfTheEngineButItsResults) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(CONDYLE_SOURCE_DIR "/src/reference")) {
    std::ifstream stream(entry.path());
    ++files;
    for (std::string line; std::getline(stream, line);) {
      if (line.find("#include \"equilibrium/") == std::string::npos) continue;
      EXPECT_EQ(line, "#include \"equilibrium/pose_result.h\"") << entry.path();
    }
  }
  EXPECT_GT(files, 10);
}

}  // namespace
}  // namespace condyle
