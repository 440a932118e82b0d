#pragma once

/// The program itself in a folder of its own, for tests that run it as a user does.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "scene/small_scene.h"

namespace condyle::test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A ball on a plateau that turns about the ball's centre: the position of equilibrium is known.
inline const std::string kScene = with(kSmallScene, "to = 120", "to = 20");

/// Nothing holds the tibia up: the load pulls it away from the ball and there is no ligament.
inline std::string scene_that_falls_apart() {
  std::string text = kScene;
  const std::size_t ligament = text.find("[[ligament]]");
  text.erase(ligament, text.find("[[condition]]") - ligament);
  return with(text, "vector = [0, 100, 0]", "vector = [0, -100, 0]");
}

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) / ("condyle_app_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    write("knee.toml", kScene);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }

  /// Runs the program in the folder; `prefix` are shell commands before it.
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& prefix = "") const {
    const std::string command = "cd '" + folder_.string() + "' && " + prefix +
                                "'" CONDYLE_PROGRAM "' " + arguments +
                                " > stdout.txt 2> stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder_ / "stdout.txt"),
            contents(folder_ / "stderr.txt")};
  }

  /// Names in the folder apart from the scene and the captured output.
  [[nodiscard]] std::vector<std::string> results() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name != "knee.toml" && name != "stdout.txt" && name != "stderr.txt")
        names.push_back(name);
    }
    return names;
  }

  std::filesystem::path folder_;
};

inline void expect_bad_input(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "condyle: " + message + "\n");
}

}  // namespace condyle::test
