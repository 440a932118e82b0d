#pragma once

/// A study of the small scene in a folder of its own, as text that tests change line by line.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_study.h"
#include "scene/small_scene.h"

namespace condyle::test {

inline const std::string kSmallStudy = R"(title = "a small study"
specimens = ["knee.toml"]
design = "sobol"
samples = 1024
seed = 7
outputs = ["joint", "aACL.force"]

[[vary]]
what = "stiffness"
of = "*"
sd = 0.1

[[vary]]
what = "slack_length"
of = ["aACL"]
range = [-1, 1]
)";

class StudyOnDisk : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "knees");
    write("knee.toml", kSmallScene);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] ReadStudy read(const std::string& text) const {
    write("study.toml", text);
    return read_study(folder_ / "study.toml");
  }
  /// What is said of it, the folder left out.
  [[nodiscard]] std::string message_of(const std::string& text) const {
    std::string message = "no error";
    try {
      (void)read(text);
    } catch (const InputError& error) {
      message = error.what();
    }
    const std::string place = folder_.string() + "/";
    for (std::size_t at = message.find(place); at != std::string::npos; at = message.find(place))
      message.erase(at, place.size());
    return message;
  }
  [[nodiscard]] std::string message_of(const std::string& from, const std::string& to) const {
    return message_of(with(kSmallStudy, from, to));
  }

  /// One for each test: they may run at the same time.
  static std::filesystem::path own_folder() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test.test_suite_name()) + "_" + test.name();
    std::replace(name.begin(), name.end(), '/', '_');
    return std::filesystem::path(testing::TempDir()) / ("condyle_" + name);
  }

  std::filesystem::path folder_ = own_folder();
};

}  // namespace condyle::test
