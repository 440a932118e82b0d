#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/list_option.h"
#include "condyle/app/run_names.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/app/tell.h"
#include "condyle/input_error.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/picture_folder.h"
#include "condyle/pictures/plot_run.h"
#include "condyle/pictures/plot_study.h"
#include "condyle/results/run_file.h"
#include "condyle/results/study_file.h"

namespace condyle {
namespace {

struct PlotCommand {
  Talk talk;
  std::vector<std::string> runs;
  std::string folder;
  std::vector<std::string> formats = {"png"};
};

PlotFormat format_from_name(const std::string& text) {
  for (const PlotFormat format : {PlotFormat::kPng, PlotFormat::kSvg, PlotFormat::kPdf})
    if (text == ending(format)) return format;
  throw InputError("--format " + text + ": expected png, svg or pdf");
}

void warn_of_empty_curves(const Talk& talk, const std::string& file, const Run& run) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  const bool some =
      std::any_of(poses.begin(), poses.end(), [](const PoseResult& pose) { return pose.solved(); });
  if (poses.empty() || some || run.comparison() != nullptr || talk.quiet) return;
  tell(stderr, "condyle: warning: {}: no pose converged, so its curves are empty\n", file);
}

Run read_plottable(const std::string& file, bool alone) {
  if (!alone && is_study_file(file))
    throw InputError(file + ": is a study, expected runs; a study is plotted by itself");
  Run run = read_run(file);
  if (run.sweep.poses.empty() && !run.laxity() && !run.calibration())
    throw InputError(file + ": holds no poses, expected the result of condyle sweep");
  return run;
}

std::vector<NamedPlot> plots_over_each_other(const PlotCommand& command) {
  if (command.runs.size() > kMostRunsOverEachOther)
    throw InputError(fmt::format(
        "{} runs over each other, expected at most {}: each has a style of line of its own",
        command.runs.size(), kMostRunsOverEachOther));
  std::vector<Run> runs;
  for (const std::string& file : command.runs) {
    runs.push_back(read_plottable(file, false));
    warn_of_empty_curves(command.talk, file, runs.back());
  }
  const std::vector<std::string> names = run_names(command.runs);
  std::vector<NamedRun> named;
  for (std::size_t i = 0; i < runs.size(); ++i) named.push_back({names[i], &runs[i]});
  return chart_plots(overlay(named));
}

std::vector<NamedPlot> all_plots(const PlotCommand& command) {
  if (command.runs.size() > 1) return plots_over_each_other(command);
  const std::string& file = command.runs.front();
  if (is_study_file(file)) return study_plots(read_study_file(file));
  const Run run = read_plottable(file, true);
  warn_of_empty_curves(command.talk, file, run);
  return run_plots(run);
}

int run_plot(const PlotCommand& command) {
  std::vector<PlotFormat> formats;
  for (const std::string& text : command.formats) formats.push_back(format_from_name(text));
  CommandClock clock;
  const std::vector<NamedPlot> plots = all_plots(command);
  expect_gnuplot();  // as what is refused above, before a folder is made
  const std::vector<std::filesystem::path> files =
      write_plots(plots, make_picture_folder(command.folder), formats);
  for (const auto& file : files) say(command.talk, "wrote {}\n", file.string());
  CommandSummary facts =
      clock.summary(command.talk, fmt::format("{}", fmt::join(command.runs, " ")), 0);
  facts.files = files;
  return finish(command.talk, facts, {});
}

}  // namespace

void setup_plot(CLI::App& program, int& status) {
  const auto options = std::make_shared<PlotCommand>();
  CLI::App* command = program.add_subcommand(
      "plot", "Plot what a run or a study holds over what it sweeps; several runs over each other");
  command->add_option("RUN", options->runs, "result files (HDF5)")->required();
  command->add_option("-o,--output", options->folder, "folder for the plots")->required();
  add_list(*command, "--format", options->formats, "png, svg, pdf, or several of them");
  command->footer("Example: condyle plot out/phantom.h5 -o out --format png,svg");
  add_talk_options(*command, options->talk);
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_plot(*options); });
  });
}

}  // namespace condyle
