#pragma once

/// Lines of TOML of choices: what scene_grammar.cpp is written in.

#include <array>
#include <string>
#include <vector>

#include "fuzz/choices.h"

namespace condyle::fuzz {

/// Of a scene: as people write them, or with any line left out, doubled or misspelt.
enum class Temper { kTame, kWild };

class SceneLines {
 public:
  SceneLines(Choices& choices, Temper temper) : choices_(choices), wild_(temper == Temper::kWild) {}

  [[nodiscard]] Choices& choices() { return choices_; }
  [[nodiscard]] bool wild() const { return wild_; }
  [[nodiscard]] std::string take() { return std::move(text_); }

  /// "[sweep]" or "[[load]]".
  void table(const std::string& heading);
  /// A key with its value as it stands in the file; of a wild scene perhaps neither.
  void line(const std::string& key, const std::string& value);
  /// The same in one case of two.
  void perhaps(const std::string& key, const std::string& value);

  [[nodiscard]] std::string number(double least, double greatest);
  [[nodiscard]] std::string vector(double size);
  /// Within `size` of a point.
  [[nodiscard]] std::string point(double x, double y, double z, double size);
  /// Not far from a direction.
  [[nodiscard]] std::string direction(double x, double y, double z);
  [[nodiscard]] std::string word(const std::vector<std::string>& words);
  /// "[1, 2]", in the order in which its items are chosen by every compiler.
  [[nodiscard]] static std::string list(const std::vector<std::string>& items);
  /// Of a line: points on the fixed and on the moving body.
  [[nodiscard]] static std::string ends(const std::array<std::string, 2>& points);
  [[nodiscard]] static std::string quoted(const std::string& text);

 private:
  [[nodiscard]] bool strange(std::size_t often) { return wild_ && choices_.once_in(often); }

  Choices& choices_;
  bool wild_;
  std::string text_;
};

}  // namespace condyle::fuzz
