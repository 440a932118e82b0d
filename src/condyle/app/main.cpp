/// condyle: the equilibrium of a knee, from meshes to a sweep. Exit codes: 0 all done, 1 bad input,
/// 2 some pose did not succeed.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "condyle/app/command_tree.h"
#include "condyle/app/commands.h"
#include "condyle/input_error.h"
#include "condyle/version.h"

namespace condyle {
namespace {

constexpr int kBadInput = 1;

void setup(CLI::App& program, int& status) {
  program.set_version_flag("--version", "condyle " CONDYLE_VERSION);
  program.require_subcommand(1);
  setup_check(program, status);
  setup_fit(program, status);
  setup_sweep(program, status);
  setup_compare(program, status);
  setup_laxity(program, status);
  setup_calibrate(program, status);
  setup_simulate(program, status);
  setup_export(program, status);
  setup_import(program, status);
  setup_new(program, status);
#ifdef CONDYLE_PICTURES
  setup_render(program, status);
  setup_plot(program, status);
#endif
  setup_verify(program, status);
  setup_report(program, status);
  setup_completion(program, status);
  setup_manual(program, status);
  refuse_empty_values(program);
}

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

int run(int argc, char** argv) {
  CLI::App program("condyle: positions of equilibrium of a knee, from its meshes", "condyle");
  int status = 0;
  setup(program, status);
  check_command(program, argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "condyle: {} (condyle --help says more)\n", error.what());
    return kBadInput;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw InputError("the standard output cannot be written, expected room for it");
  return status;
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  try {
    return condyle::run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("condyle: not enough memory\n", stderr);
  } catch (const std::exception& error) {  // InputError above all
    std::fprintf(stderr, "condyle: %s\n", error.what());
  }
  return condyle::kBadInput;
}
