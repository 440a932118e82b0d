/// `condyle new` as a user meets it: from the phantom's meshes to a swept knee, and what it says of
/// files that are no knee.

#include <algorithm>

#include "app/run_program.h"

namespace condyle {
namespace {

using test::Outcome;

class NewCommand : public test::CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    std::filesystem::create_directory_symlink(std::filesystem::path(CONDYLE_SOURCE_DIR) / "meshes",
                                              folder_ / "meshes");
  }
};

TEST_F(NewCommand, MakesASceneThatSweeps) {
  const Outcome made = run("new meshes/femur.stl meshes/tibia.stl -o new.toml --report new.png");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("side       right"), std::string::npos) << made.out;
  EXPECT_GT(std::filesystem::file_size(folder_ / "new.png"), 100000u);
  EXPECT_EQ(run("check new.toml").code, 0);
  const Outcome swept = run("sweep new.toml -o new.h5");
  EXPECT_EQ(swept.code, 0) << swept.err;
  EXPECT_NE(swept.out.find("25 of 25 poses converged"), std::string::npos);
  EXPECT_EQ(run("verify new.h5").code, 0);
}

TEST_F(NewCommand, RefusesInOneLineAndWritesNothing) {
  const std::vector<std::string> before = results();
  for (const char* arguments :
       {"new meshes/femur.stl meshes/nothing.stl -o new.toml",
        "new meshes/femur.stl meshes/femur.stl -o new.toml --report new.png",
        "new meshes/tibia.stl meshes/femur.stl -o new.toml",
        "new meshes/femur.stl meshes/tibia.stl -o new.toml --side both",
        "new meshes/femur.stl meshes/tibia.stl -o new.toml --units km",
        "new meshes/femur.stl meshes/tibia.stl -o new.toml --units m",
        "new meshes/femur.stl meshes/tibia.stl -o new.toml --template nothing.toml",
        "new meshes/femur.stl meshes/tibia.stl -o new.toml --cartilage meshes/femur.stl",
        "new meshes/femur.stl meshes/tibia.stl -o nowhere/new.toml",
        "new meshes/femur.stl meshes/tibia.stl -o meshes/femur.stl"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(results(), before) << arguments;
  }
}

TEST_F(NewCommand, NamesEachFileThatASceneCannotName) {
  for (const char* arguments : {"'fe\tmur.stl' meshes/tibia.stl", "meshes/femur.stl 'ti\tbia.stl'",
                                "meshes/femur.stl meshes/tibia.stl --cartilage 'a\tb.stl' c.stl",
                                "meshes/femur.stl meshes/tibia.stl --cartilage c.stl 'a\tb.stl'"}) {
    const Outcome outcome = run(std::string("new ") + arguments + " -o new.toml");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("a name with control characters, which a scene cannot hold"),
              std::string::npos)
        << outcome.err;
  }
}

// Rounding at a vertex that is 1e30 away is larger than the bone.
TEST_F(NewCommand, NamesTheFileOfAVertexThatIsFarOff) {
  write("tibia.off", "OFF\n5 2 0\n0 0 0\n80 0 0\n0 80 0\n0 0 300\n1e30 0 0\n3 0 1 2\n3 1 2 4\n");
  const Outcome outcome = run("new meshes/femur.stl tibia.off -o new.toml");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("tibia.off: no triangle is left"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("the farthest at 1e+30"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace condyle
