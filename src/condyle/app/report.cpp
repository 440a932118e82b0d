#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <system_error>

#include "condyle/app/commands.h"
#include "condyle/app/progress.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/input_error.h"
#include "condyle/report/report_page.h"
#include "condyle/report/study_page.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_file.h"
#include "condyle/results/study_file.h"

namespace condyle {
namespace {

struct ReportCommand {
  Talk talk;
  std::string run, output;
  bool no_pictures = false, no_viewer = false;
};

std::string page_of_study(const ReportCommand& command, Progress& progress) {
  StudyPageOptions options;
  options.pictures = !command.no_pictures;
  options.on_part = [&](int done, int total) { progress.at(done, total); };
  return study_page(read_study_file(command.run), command.run, options);
}

std::string page_of_run(const ReportCommand& command, const Run& run, Progress& progress) {
  ReportOptions options;
  options.pictures = !command.no_pictures;
  options.viewer = !command.no_viewer;
  options.on_part = [&](int done, int total) { progress.at(done, total); };
  return report_page(run, command.run, options);
}

int run_report(const ReportCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  check_output_file(command.output);
  std::error_code unknown;
  if (std::filesystem::equivalent(command.output, command.run, unknown))
    throw InputError(command.output + ": is read by this command, expected another file to write");
  const bool study = is_study_file(command.run);
  const Run run = study ? Run{} : read_run(command.run);
  Progress progress(talk, "sections");
  const std::string page =
      study ? page_of_study(command, progress) : page_of_run(command, run, progress);
  progress.clear();
  write_output_file(command.output, page);
  say(talk, "wrote {}\n", command.output);
  CommandSummary facts = clock.summary(talk, command.run, 0);
  facts.files.emplace_back(command.output);
  return finish(talk, facts, run);
}

}  // namespace

void setup_report(CLI::App& program, int& status) {
  const auto options = std::make_shared<ReportCommand>();
  CLI::App* command =
      program.add_subcommand("report", "Write a run or a study as one page that any browser opens");
  command->add_option("RUN", options->run, "result file (HDF5)")->required();
  command->add_option("-o,--output", options->output, "page to write (HTML)")->required();
  command->add_flag("--no-pictures", options->no_pictures, "without pictures and plots");
  command->add_flag("--no-viewer", options->no_viewer, "without the 3-D view");
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle report out/phantom.h5 -o out/phantom.html");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_report(*options); });
  });
}

}  // namespace condyle
