#include "condyle/verify/verify.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "condyle/app/commands.h"
#include "condyle/app/progress.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/input_error.h"
#include "condyle/results/run_columns.h"

namespace condyle {
namespace {

constexpr int kSomePoseIsFalse = 2;

struct VerifyCommand {
  Talk talk;
  std::string run;
  bool pushes = false, no_meshes = false;
};

Verification verified(const std::string& file, const Run& run, const VerifyOptions& options) {
  try {
    return verify_run(run, options);
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

int run_verify(const VerifyCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  const RunWithColumns read = read_run_with_columns(command.run);
  const Run& run = read.run;
  Progress progress(talk, "poses");
  VerifyOptions options;
  options.pushes = command.pushes;
  options.meshes = !command.no_meshes;
  options.columns = &read.columns;
  options.on_pose = [&](int done, int total) { progress.at(done, total); };
  const Verification verification = verified(command.run, run, options);
  progress.clear();
  for (const std::string& line : check_lines(verification)) say(talk, "{}\n", line);
  say(talk, "\n");
  for (const std::string& line : verification.warnings) say(talk, "warning: {}\n", line);
  for (const std::string& line : verification.not_checked) say(talk, "not checked: {}\n", line);
  say(talk, "{}\n", verdict(verification));
  std::fflush(stdout);
  for (const Fault& fault : verification.faults) tell(stderr, "condyle: {}\n", fault.text);
  const CommandSummary facts =
      clock.summary(talk, command.run, verification.verified() ? 0 : kSomePoseIsFalse);
  if (talk.json) tell("{}\n", json_verification(facts, run, verification));
  return facts.exit_code;
}

}  // namespace

void setup_verify(CLI::App& program, int& status) {
  const auto options = std::make_shared<VerifyCommand>();
  CLI::App* command = program.add_subcommand(
      "verify", "Check every converged pose of a run by code that shares nothing with the solver");
  command->add_option("RUN", options->run, "result file (HDF5)")->required();
  command->add_flag("--pushes", options->pushes,
                    "also push the body a little: the energy of a stable pose must not fall");
  command->add_flag("--no-meshes", options->no_meshes, "do not look at the bones' meshes");
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle verify out/phantom.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_verify(*options); });
  });
}

}  // namespace condyle
