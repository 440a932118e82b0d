#pragma once

/// A mistake in the small scene, and the line that names it.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"

namespace condyle::test {

/// What is said of a scene "some/knee.toml".
inline std::string message_of(const std::string& text) {
  try {
    (void)parse_scene(text, "some/knee.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

struct Mistake {
  std::string from, to;  ///< what is changed in the small scene
  std::string message;   ///< the whole message after "some/knee.toml:"
  friend std::ostream& operator<<(std::ostream& stream, const Mistake& mistake) {
    return stream << mistake.to;
  }
};

/// Line numbers are those of tests/scene/small_scene.h, where the text begins on line 1.
class MistakeTest : public testing::TestWithParam<Mistake> {
 protected:
  static void expect_named() {
    const Mistake& mistake = GetParam();
    EXPECT_EQ(message_of(small_scene_with(mistake.from, mistake.to)),
              "some/knee.toml:" + mistake.message);
  }
};

}  // namespace condyle::test
