#include "condyle/app/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "condyle/app/command_tree.h"
#include "condyle/app/standard_streams.h"
#include "condyle/build_info.h"
#include "condyle/input_error.h"
#include "condyle/version.h"

namespace condyle {
namespace {

/// CLI11 would only say that a command is missing.
void check_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string names;
  for (const CLI::App* command : program.get_subcommands(nullptr)) {
    if (command->check_name(argv[1])) return;
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  throw InputError(fmt::format("unknown command \"{}\", expected one of {}", argv[1], names));
}

}  // namespace

int run_program(const std::string& name,
                const std::string& description,
                const std::vector<SetupCommand>& commands,
                int argc,
                char** argv) {
  prepare_standard_streams();
  CLI::App program(description, name);
  int status = 0;
  program.set_version_flag("--version",
                           name + " " CONDYLE_VERSION "\n" + build_lines(build_info()));
  program.require_subcommand(1);
  for (const SetupCommand& setup : commands) setup(program, status);
  refuse_empty_values(program);
  check_command(program, argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{} ({} --help says more)", error.what(), name));
  }
  finish_standard_output();
  return status;
}

}  // namespace condyle
