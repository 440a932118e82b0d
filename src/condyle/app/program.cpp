#include "condyle/app/program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "condyle/app/command_tree.h"
#include "condyle/app/standard_streams.h"
#include "condyle/app/talk.h"
#include "condyle/app/tell.h"
#include "condyle/build_info.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/section.h"
#include "condyle/version.h"

namespace condyle {
namespace {

/// CLI11 would only say that a subcommand is missing. None before options of the program.
const CLI::App* find_command(const CLI::App& program, int argc, char** argv) {
  if (argc >= 2 && argv[1][0] == '-') return nullptr;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    if (argc >= 2 && command->check_name(argv[1])) return command;
    names.push_back(command->get_name());
  }
  const std::string expected = fmt::format("expected one of {}", fmt::join(names, ", "));
  if (argc < 2)
    throw InputError(
        fmt::format("no command, {} ({} --help says more)", expected, program.get_name()));
  const std::string meant = nearest(argv[1], names);
  throw InputError(
      fmt::format("unknown command \"{}\", {}", argv[1],
                  meant.empty() ? expected : expected + "; did you mean \"" + meant + "\"?"));
}

/// Memory that one fit or sweep gives back the next one asks for: kept meanwhile, it need not be mapped and cleared anew (a
/// sixth of the time of a sweep of the phantom). tools/test.sh has the same for the programs of tests.
void keep_memory() {
#ifdef __GLIBC__
  constexpr int kLargestKept = 32 << 20, kMostKept = 256 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, kLargestKept);
  mallopt(M_TRIM_THRESHOLD, kMostKept);
#endif
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// An option that is cut short, as --out, or mistyped; empty where none is like it.
std::string meant_option(const std::string& word, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (word.size() > 3 && name.rfind(word, 0) == 0) return name;
  return nearest(word, names);
}

/// CLI11 would only say that a subcommand is missing.
void check_program_option(const CLI::App& program, int argc, char** argv) {
  if (argc < 2) return;
  const std::string word = argv[1], name = word.substr(0, word.find('='));
  if (name.size() > 1 && program.get_option_no_throw(name) != nullptr) return;
  const std::string meant = meant_option(name, option_names(program));
  throw InputError(fmt::format(
      "unknown option {}, {} ({} --help says more)", word,
      meant.empty() ? "expected --help, --version or a command" : "did you mean " + meant + "?",
      program.get_name()));
}

/// CLI11 would first ask for options that are missing, also for the one that was mistyped.
void check_options(const CLI::App& command, int argc, char** argv, const std::string& help) {
  const std::vector<std::string> names = option_names(command);
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i], name = word.substr(0, word.find('='));
    if (name == "--") return;
    if (name.rfind("--", 0) != 0 || std::find(names.begin(), names.end(), name) != names.end())
      continue;
    const std::string meant = meant_option(name, names);
    throw InputError(fmt::format("unknown option {}{}{}", name,
                                 meant.empty() ? "" : ", did you mean " + meant + "?", help));
  }
}

/// Whether a command that knows --json is asked for it, though its options may not be read.
bool asks_for_json(const CLI::App* command, int argc, char** argv) {
  if (command == nullptr || command->get_option_no_throw("--json") == nullptr) return false;
  for (int i = 2; i < argc && std::string(argv[i]) != "--"; ++i)
    if (std::string(argv[i]) == "--json") return true;
  return false;
}

/// Of a word too many after an option whose value has to be joined to it, as its description says.
std::string joined_option(const CLI::App& command, int argc, char** argv, const std::string& word) {
  for (int i = 3; i < argc; ++i) {
    const std::string name = argv[i - 1];
    if (argv[i] != word || name.rfind("--", 0) != 0) continue;
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option != nullptr && option->get_description().find(name + "=") != std::string::npos)
      return fmt::format(", did you mean {}={}?", name, word);
  }
  return "";
}

/// Of the words that no option and no place has taken.
std::string words_of_extras(const CLI::App& program,
                            const CLI::App* command,
                            int argc,
                            char** argv) {
  const std::vector<std::string> extras = program.remaining(true);
  std::string words = fmt::format("too many arguments: {}", fmt::join(extras, " "));
  if (command != nullptr && !extras.empty())
    words += joined_option(*command, argc, argv, extras.front());
  return words;
}

/// What CLI11 says, in our words where its own say less than it knows.
std::string words_of(const CLI::ParseError& error) {
  const std::string unconverted = "Could not convert: ";
  std::string words = error.what();
  if (words.rfind(unconverted, 0) == 0)
    return words.substr(unconverted.size()) + ", expected a number";
  return words;
}

}  // namespace

int run_program(const std::string& name,
                const std::string& description,
                const std::vector<SetupCommand>& commands,
                int argc,
                char** argv) {
  keep_memory();
  prepare_standard_streams();
  CLI::App program(description, name);
  int status = 0;
  program.set_version_flag("--version",
                           name + " " CONDYLE_VERSION "\n" + build_lines(build_info()));
  program.require_subcommand(1);
  for (const SetupCommand& setup : commands) setup(program, status);
  check_values(program);
  const CLI::App* command = find_command(program, argc, argv);
  const std::string help = fmt::format(" ({}{} --help says more)", name,
                                       command == nullptr ? "" : " " + command->get_name());
  Talk talk;  // that of the command is not known before its options are
  talk.json = asks_for_json(command, argc, argv);
  if (command != nullptr) talk.command = command->get_name();
  const auto refuse = [&](const std::function<void()>& check) {
    (void)run_telling_errors(talk, [&] {
      check();
      return 0;
    });
  };
  if (command == nullptr)
    check_program_option(program, argc, argv);
  else
    refuse([&] { check_options(*command, argc, argv, help); });
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked) {  // --help, --version
    std::ostringstream text;
    (void)program.exit(asked, text, text);
    tell("{}", text.str());
  } catch (const CLI::ParseError& error) {
    const bool extras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    refuse([&] {
      throw InputError((extras ? words_of_extras(program, command, argc, argv) : words_of(error)) +
                       help);
    });
  }
  finish_standard_output();
  return status;
}

}  // namespace condyle
