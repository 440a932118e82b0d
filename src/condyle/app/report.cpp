#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/progress.h"
#include "condyle/app/run_names.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/report/compared_runs_json.h"
#include "condyle/report/compared_runs_page.h"
#include "condyle/report/report_page.h"
#include "condyle/report/study_page.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_file.h"
#include "condyle/results/study_file.h"

namespace condyle {
namespace {

struct ReportCommand {
  Talk talk;
  std::vector<std::string> runs;
  std::string output;
  bool no_pictures = false, no_viewer = false;
};

void check_output(const ReportCommand& command) {
  if (file_ending(command.output) == ".pdf")
    throw InputError(command.output +
                     ": the page is HTML, expected a name that ends in .html; browsers print it");
  check_output_file(command.output, ".html");
  refuse_to_overwrite(command.output, {command.runs.begin(), command.runs.end()});
}

Run read_source(const ReportCommand& command, const std::string& file) {
  Run run = read_run(file);
  refuse_to_overwrite_sources(command.output, run);
  return run;
}

std::string page_of_study(const ReportCommand& command, Progress& progress) {
  StudyPageOptions options;
  options.pictures = !command.no_pictures;
  options.on_part = [&](int done, int total) { progress.at(done, total); };
  const std::string& file = command.runs.front();
  return study_page(read_study_file(file), file, options);
}

std::string page_of_run(const ReportCommand& command, const Run& run, Progress& progress) {
  ReportOptions options;
  options.pictures = !command.no_pictures;
  options.viewer = !command.no_viewer;
  options.on_part = [&](int done, int total) { progress.at(done, total); };
  return report_page(run, command.runs.front(), options);
}

void write_page(const ReportCommand& command, Progress& progress, const std::string& page) {
  progress.clear();
  write_output_file(command.output, page);
  say(command.talk, "wrote {}\n", command.output);
}

int report_one(const ReportCommand& command) {
  CommandClock clock;
  const std::string& file = command.runs.front();
  const bool study = is_study_file(file);
  const Run run = study ? Run{} : read_source(command, file);
  Progress progress(command.talk, "sections");
  write_page(command, progress,
             study ? page_of_study(command, progress) : page_of_run(command, run, progress));
  CommandSummary facts = clock.summary(command.talk, file, 0);
  facts.files.emplace_back(command.output);
  return finish(command.talk, facts, run);
}

std::vector<Run> read_compared(const ReportCommand& command) {
  const std::vector<std::string>& files = command.runs;
  if (files.size() > kMostComparedRuns)
    throw InputError(
        fmt::format("{} runs to compare, expected at most {}", files.size(), kMostComparedRuns));
  std::vector<Run> runs;
  for (const std::string& file : files) {
    if (is_study_file(file))
      throw InputError(file + ": is a study, expected runs; a study is reported by itself");
    runs.push_back(read_source(command, file));
  }
  return runs;
}

int report_compared(const ReportCommand& command) {
  CommandClock clock;
  const std::vector<Run> runs = read_compared(command);
  const std::vector<std::string> names = run_names(command.runs);
  std::vector<ComparedRun> compared;
  for (std::size_t i = 0; i < runs.size(); ++i)
    compared.push_back({names[i], command.runs[i], &runs[i]});
  const RunComparison comparison = compare_runs(compared);
  Progress progress(command.talk, "sections");
  ComparedRunsPageOptions options;
  options.pictures = !command.no_pictures;
  options.on_part = [&](int done, int total) { progress.at(done, total); };
  write_page(command, progress, compared_runs_page(comparison, options));
  CommandSummary facts = clock.summary(command.talk, "", 0);
  facts.files.emplace_back(command.output);
  if (command.talk.json) tell("{}\n", json_compared_runs(facts, comparison));
  return facts.exit_code;
}

int run_report(const ReportCommand& command) {
  check_output(command);
  return command.runs.size() == 1 ? report_one(command) : report_compared(command);
}

}  // namespace

void setup_report(CLI::App& program, int& status) {
  const auto options = std::make_shared<ReportCommand>();
  CLI::App* command =
      program.add_subcommand("report",
                             "Write a run or a study as one page that any browser opens; several "
                             "runs beside each other");
  command->add_option("RUN", options->runs, "result file (HDF5); of two to six runs what differs")
      ->required();
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
