#include "fuzz/scene_lines.h"

#include <fmt/format.h>

namespace condyle::fuzz {
namespace {

constexpr const char* kStrangeValues[] = {"0",
                                          "-1",
                                          "1",
                                          "1e308",
                                          "-1e308",
                                          "1e-308",
                                          "5e-324",
                                          "1e16",
                                          "nan",
                                          "inf",
                                          "-inf",
                                          "9223372036854775807",
                                          "true",
                                          "\"\"",
                                          "\"a word\"",
                                          "\"a/b\"",
                                          "\"..\"",
                                          "\"\\u001b[31m\\u0007\\n\\u0085\"",
                                          "'''\n\n'''",
                                          "\"\\u0000\"",
                                          "\"<b>&amp;\"",
                                          "[]",
                                          "{}",
                                          "[1]",
                                          "[0, 0, 0]",
                                          "[1e-200, 0, 0]",
                                          "[1e200, 1e200, 1e200]",
                                          "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                                          "[[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
                                          "[[[]]]",
                                          "[\"*\"]",
                                          "[\"tie 0\", \"tie 0\"]",
                                          "{ body = \"A\", at = [0, 0, 0] }",
                                          "1979-05-27"};

}  // namespace

void SceneLines::table(const std::string& heading) {
  if (strange(64)) return;
  text_ += fmt::format("{}\n", heading);
}

void SceneLines::line(const std::string& key, const std::string& value) {
  if (strange(32)) return;
  if (strange(64)) text_ += fmt::format("{} = {}\n", key, value);
  const char* plural = strange(64) ? "s" : "";
  text_ +=
      fmt::format("{}{} = {}\n", key, plural, strange(16) ? choices_.of(kStrangeValues) : value);
}

void SceneLines::perhaps(const std::string& key, const std::string& value) {
  if (choices_.once_in(2)) line(key, value);
}

std::string SceneLines::number(double least, double greatest) {
  if (strange(32)) return choices_.of(kStrangeValues);
  const double share = choices_.byte() / 255.0;
  return fmt::format("{:.6g}", least + share * (greatest - least));
}

std::string SceneLines::point(double x, double y, double z, double size) {
  return list({number(x - size, x + size), number(y - size, y + size), number(z - size, z + size)});
}

std::string SceneLines::list(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ", "));
}

std::string SceneLines::ends(const std::array<std::string, 2>& points) {
  return fmt::format("[{{ body = \"B\", at = {} }}, {{ body = \"A\", at = {} }}]", points[0],
                     points[1]);
}

std::string SceneLines::quoted(const std::string& text) { return fmt::format("\"{}\"", text); }

std::string SceneLines::vector(double size) { return point(0, 0, 0, size); }

std::string SceneLines::direction(double x, double y, double z) { return point(x, y, z, 0.15); }

std::string SceneLines::word(const std::vector<std::string>& words) {
  if (words.empty()) return quoted("none");
  return quoted(words[choices_.below(words.size())]);
}

}  // namespace condyle::fuzz
