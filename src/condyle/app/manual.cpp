#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <string_view>

#include "condyle/app/command_tree.h"
#include "condyle/app/commands.h"
#include "condyle/app/tell.h"
#include "condyle/version.h"

namespace condyle {
namespace {

/// Plain text for roff: no escapes, no requests, hyphens that can be copied into a shell.
std::string roff(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

/// --output: OUTPUT
std::string value_name(const OptionFacts& option) {
  std::string name;
  for (const char c : option.names.back())
    if (c != '-') name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string heading(const OptionFacts& option) {
  if (option.positional) return italic(option.names.front());
  std::string text;
  for (const std::string& name : option.names) text += (text.empty() ? "" : ", ") + bold(name);
  return option.takes_value ? text + " " + italic(value_name(option)) : text;
}

std::string paragraph(const OptionFacts& option) {
  std::string text = ".TP\n" + heading(option) + "\n" + roff(option.description);
  if (!option.default_value.empty()) text += " (default " + roff(option.default_value) + ")";
  return text + "\n";
}

/// condyle sweep SCENE -o OUTPUT [options]
std::string synopsis(const ProgramFacts& program, const CommandFacts& command) {
  std::string line = bold(program.name) + " " + bold(command.name);
  for (const OptionFacts& option : command.options) {
    if (option.positional)
      line += " " + italic(option.names.front());
    else if (option.required)
      line += " " + bold(option.names.front()) + " " + italic(value_name(option));
  }
  return line + " [" + italic("options") + "]\n";
}

/// The footers begin with "Example: ", lines of a longer one stand below each other.
std::string example(const CommandFacts& command) {
  constexpr std::string_view kExample = "Example: ";
  std::string text = command.footer;
  if (text.rfind(kExample, 0) == 0) text.erase(0, kExample.size());
  return text.empty() ? "" : ".PP\nExample:\n.PP\n.nf\n.RS\n" + roff(text) + "\n.RE\n.fi\n";
}

constexpr const char* kExitCodes =
    ".SH EXIT STATUS\n"
    ".TP\n0\nall done\n"
    ".TP\n1\nbad input: one line on the standard error says what, where, and what was expected\n"
    ".TP\n2\ncomputed and written, but some pose did not succeed; the standard error says which\n";

}  // namespace

std::string manual_page(const ProgramFacts& program, const std::string& version) {
  std::string page = fmt::format(".TH CONDYLE 1 \"\" \"condyle {}\" \"User commands\"\n", version);
  page += ".SH NAME\ncondyle \\- positions of equilibrium of a knee, from its meshes\n";
  page += ".SH SYNOPSIS\n.nf\n";
  for (const CommandFacts& command : program.commands) page += synopsis(program, command);
  page += ".fi\n.SH DESCRIPTION\n" + roff(program.description) +
          ".\nA scene (TOML) describes the knee; results are HDF5 files.\n.SH OPTIONS\n";
  for (const OptionFacts& option : program.options) page += paragraph(option);
  page += ".SH COMMANDS\n";
  for (const CommandFacts& command : program.commands) {
    page +=
        ".SS " + roff(program.name + " " + command.name) + "\n" + roff(command.description) + ".\n";
    for (const OptionFacts& option : command.options) page += paragraph(option);
    page += example(command);
  }
  return page + kExitCodes;
}

void setup_manual(CLI::App& program, int& status) {
  CLI::App* command = program.add_subcommand("manual", "Print the manual page, for man");
  command->footer("Example: condyle manual | man -l -");
  command->callback([&program, &status] {
    tell("{}", manual_page(program_facts(program), CONDYLE_VERSION));
    status = 0;
  });
}

}  // namespace condyle
