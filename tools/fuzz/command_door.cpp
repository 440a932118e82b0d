/// Command lines, one argument a line: read as the program reads them, but what is understood is not done.

#include <CLI/CLI.hpp>
#include <map>

#include "condyle/app/commands.h"
#include "condyle/app/program.h"
#include "fuzz/door_list.h"
#include "fuzz/refusal.h"

namespace condyle::fuzz {
namespace {

using Setup = void (*)(CLI::App&, int&);

const std::map<std::string, Setup>& setups() {
  static const std::map<std::string, Setup> all = {
      {"check", setup_check},     {"fit", setup_fit},           {"sweep", setup_sweep},
      {"compare", setup_compare}, {"laxity", setup_laxity},     {"calibrate", setup_calibrate},
      {"study", setup_study},     {"simulate", setup_simulate}, {"export", setup_export},
      {"import", setup_import},   {"new", setup_new},
#ifdef CONDYLE_PICTURES
      {"render", setup_render},   {"plot", setup_plot},
#endif
      {"verify", setup_verify},   {"report", setup_report},     {"completion", setup_completion},
      {"manual", setup_manual}};
  return all;
}

/// The command without its deed, which CLI11 calls after this.
SetupCommand harmless(Setup setup) {
  return [setup](CLI::App& program, int& status) {
    setup(program, status);
    program.parse_complete_callback([] { throw CLI::Success(); });
  };
}

/// Only the command that is named, where one is: all of them take a hundred times as long to set up.
std::vector<SetupCommand> commands_for(const std::string& word) {
  const auto named = setups().find(word);
  if (named != setups().end()) return {harmless(named->second)};
  return {harmless(setup_check), harmless(setup_verify)};
}

}  // namespace

void open_command_line(Bytes bytes) {
  std::vector<std::string> words = {"condyle"};
  for (const std::uint8_t byte : bytes) {
    if (words.size() == 1 || byte == '\n') words.emplace_back();
    if (byte == 0) break;  // an argument ends there
    if (byte != '\n') words.back() += static_cast<char>(byte);
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string first = words.size() > 1 ? words[1] : "";
  taken([&] {
    (void)run_program("condyle", "a knee", commands_for(first), static_cast<int>(words.size()),
                      arguments.data());
  });
}

}  // namespace condyle::fuzz
