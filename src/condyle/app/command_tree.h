#pragma once

/// The commands and options of the program as plain data, read off what CLI11 knows, for shell
/// completion and the manual page: nothing about them is written twice.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace condyle {

struct OptionFacts {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional one its name, "SCENE"
  std::string description, default_value;
  std::vector<std::string> choices;  ///< where only some words will do
  bool positional = false, takes_value = false, required = false;
};

struct CommandFacts {
  std::string name, description, footer;
  std::vector<OptionFacts> options;  ///< --help too
};

struct ProgramFacts {
  std::string name, description;
  std::vector<OptionFacts> options;
  std::vector<CommandFacts> commands;
};

[[nodiscard]] ProgramFacts program_facts(const CLI::App& program);

/// Has every option refuse an empty text, which CLI11 would read as the number 0; one of numbers also NaN and infinity,
/// and one of whole numbers all others. After all commands are there.
void check_values(CLI::App& program);

/// What makes bash, zsh or fish complete commands and options, as text to be sourced. Throws
/// InputError for another shell.
[[nodiscard]] std::string completion_script(const ProgramFacts& program, const std::string& shell);

/// The manual page, for man(1).
[[nodiscard]] std::string manual_page(const ProgramFacts& program, const std::string& version);

}  // namespace condyle
