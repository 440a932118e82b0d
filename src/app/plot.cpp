#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "input_error.h"
#include "pictures/picture_folder.h"
#include "pictures/plot_run.h"
#include "results/run_file.h"

namespace condyle {
namespace {

struct PlotCommand {
  std::string run, folder;
  std::vector<std::string> formats = {"png"};
};

PlotFormat format_from_name(const std::string& text) {
  if (text == "png") return PlotFormat::kPng;
  if (text == "svg") return PlotFormat::kSvg;
  throw InputError("--format " + text + ": expected png or svg");
}

int run_plot(const PlotCommand& command) {
  std::vector<PlotFormat> formats;
  for (const std::string& text : command.formats) formats.push_back(format_from_name(text));
  const Run run = read_run(command.run);
  if (run.sweep.poses.empty() && !run.laxity)
    throw InputError(command.run + ": holds no poses, expected the result of condyle sweep");
  for (const auto& file : plot_run(run, make_picture_folder(command.folder), formats))
    fmt::print("wrote {}\n", file.string());
  std::fflush(stdout);
  return 0;
}

}  // namespace

void setup_plot(CLI::App& program, int& status) {
  const auto options = std::make_shared<PlotCommand>();
  CLI::App* command = program.add_subcommand(
      "plot", "Plot joint coordinates, contact and ligament forces of a run");
  command->add_option("RUN", options->run, "result file of condyle sweep (HDF5)")->required();
  command->add_option("-o,--output", options->folder, "folder for the plots")->required();
  command->add_option("--format", options->formats, "png, svg or both")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->footer("Example: condyle plot out/phantom.h5 -o out --format png,svg");
  command->callback([options, &status] { status = run_plot(*options); });
}

}  // namespace condyle
