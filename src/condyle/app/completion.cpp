#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "condyle/app/command_tree.h"
#include "condyle/app/commands.h"
#include "condyle/app/tell.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  return fmt::format("{}", fmt::join(words, between));
}

/// For single quotes in a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_names(const ProgramFacts& program) {
  std::vector<std::string> names;
  for (const CommandFacts& command : program.commands) names.push_back(command.name);
  return joined(names, " ");
}

// ---- bash

std::string bash_words(const std::string& words) {
  return fmt::format("COMPREPLY=($(compgen -W {} -- \"$word\"))", quoted(words));
}

/// What follows an option that takes a value; with none of its own words, files.
std::string bash_values(const OptionFacts& option) {
  const std::string action =
      option.choices.empty() ? "COMPREPLY=()" : bash_words(joined(option.choices, " "));
  return fmt::format("        {}) {}; return ;;\n", joined(option.names, "|"), action);
}

std::string bash_command(const CommandFacts& command) {
  std::vector<std::string> names;
  std::string values, positional;
  for (const OptionFacts& option : command.options) {
    if (option.positional) {
      if (!option.choices.empty()) positional = joined(option.choices, " ");
      continue;
    }
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.takes_value) values += bash_values(option);
  }
  std::string text = fmt::format("    {})\n", command.name);
  if (!values.empty()) text += fmt::format("      case \"$before\" in\n{}      esac\n", values);
  text += fmt::format("      case \"$word\" in -*) {}; return ;; esac\n",
                      bash_words(joined(names, " ")));
  if (!positional.empty()) text += fmt::format("      {}\n", bash_words(positional));
  return text + "      ;;\n";
}

std::string bash_script(const ProgramFacts& program) {
  std::vector<std::string> options;
  for (const OptionFacts& option : program.options)
    options.insert(options.end(), option.names.begin(), option.names.end());
  std::string cases;
  for (const CommandFacts& command : program.commands) cases += bash_command(command);
  return fmt::format(
      "# bash completion of {0}\n"
      "_{0}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    {1}\n"
      "    return\n"
      "  fi\n"
      "  case \"${{COMP_WORDS[1]}}\" in\n"
      "{2}"
      "  esac\n"
      "}}\n"
      "complete -o default -F _{0} {0}\n",
      program.name, bash_words(command_names(program) + " " + joined(options, " ")), cases);
}

// ---- zsh

/// Within [...] of _arguments, or behind a colon.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_option(const OptionFacts& option) {
  const std::string action =
      option.choices.empty() ? "_files" : "(" + joined(option.choices, " ") + ")";
  if (option.positional)
    return quoted(fmt::format(":{}:{}", zsh_text(option.names.front()), action));
  const std::string value =
      option.takes_value ? fmt::format(":{}:{}", zsh_text(option.names.back()), action) : "";
  std::vector<std::string> forms;
  for (const std::string& name : option.names) {
    forms.push_back(quoted(fmt::format("{}[{}]{}", name, zsh_text(option.description), value)));
  }
  return joined(forms, " ");
}

std::string zsh_script(const ProgramFacts& program) {
  std::string names, cases;
  for (const CommandFacts& command : program.commands) {
    names += "    " + quoted(zsh_text(command.name) + ":" + command.description) + "\n";
    std::vector<std::string> options;
    for (const OptionFacts& option : command.options) options.push_back(zsh_option(option));
    cases +=
        fmt::format("    {}) _arguments {} ;;\n", command.name, joined(options, " \\\n      "));
  }
  return fmt::format(
      "#compdef {0}\n"
      "_{0}() {{\n"
      "  local -a commands=(\n{1}  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local chosen=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $chosen in\n{2}  esac\n"
      "}}\n"
      "if [[ $funcstack[1] == _{0} ]]; then _{0} \"$@\"; else compdef _{0} {0}; fi\n",
      program.name, names, cases);
}

// ---- fish

std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string fish_option(const ProgramFacts& program,
                        const CommandFacts& command,
                        const OptionFacts& option) {
  std::string line =
      fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", program.name, command.name);
  if (!option.positional) {
    for (const std::string& name : option.names)
      line += name.rfind("--", 0) == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (option.takes_value) line += " -r";
  }
  if (!option.choices.empty()) line += " -f -a " + fish_quoted(joined(option.choices, " "));
  if (option.positional && option.choices.empty()) return "";
  return line + " -d " + fish_quoted(option.description) + "\n";
}

std::string fish_script(const ProgramFacts& program) {
  std::string text = fmt::format("# fish completion of {}\n", program.name);
  for (const CommandFacts& command : program.commands) {
    text += fmt::format("complete -c {} -f -n __fish_use_subcommand -a {} -d {}\n", program.name,
                        command.name, fish_quoted(command.description));
    for (const OptionFacts& option : command.options) text += fish_option(program, command, option);
  }
  return text;
}

}  // namespace

std::string completion_script(const ProgramFacts& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  if (shell == "zsh") return zsh_script(program);
  if (shell == "fish") return fish_script(program);
  throw InputError("completion " + shell + ": expected bash, zsh or fish");
}

void setup_completion(CLI::App& program, int& status) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "completion", "Print what makes a shell complete commands and options");
  command->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer("Example: source <(condyle completion bash)");
  command->callback([&program, shell, &status] {
    tell("{}", completion_script(program_facts(program), *shell));
    status = 0;
  });
}

}  // namespace condyle
