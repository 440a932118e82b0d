/// OSMesa and its compiler are opened when something is drawn, not when the program starts: whoever
/// draws nothing does not pay for pictures.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace condyle {
namespace {

/// What the system loads with the program; empty where it does not tell.
std::string libraries_of(const std::string& program) {
  std::string text;
  FILE* pipe = popen(("ldd '" + program + "' 2>/dev/null").c_str(), "r");
  if (!pipe) return text;
  for (char line[512]; std::fgets(line, sizeof line, pipe);) text += line;
  return pclose(pipe) == 0 ? text : "";
}

TEST(GlLibrary, IsNotLoadedWithTheProgram) {
  const std::string libraries = libraries_of(CONDYLE_PROGRAM);
  if (libraries.find("libc.so") == std::string::npos) GTEST_SKIP() << "ldd does not tell";
  EXPECT_EQ(libraries.find("OSMesa"), std::string::npos) << libraries;
  EXPECT_EQ(libraries.find("LLVM"), std::string::npos) << libraries;
}

}  // namespace
}  // namespace condyle
