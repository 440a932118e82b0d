#include "equilibrium/sweep.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/make_run.h"
#include "app/print_fit.h"
#include "input_error.h"
#include "results/output_file.h"
#include "results/sweep_table.h"
#include "scene/read_scene.h"
#include "scene/sweep_range.h"

namespace condyle {
namespace {

constexpr int kSomePoseFailed = 2;

struct SweepCommand {
  std::string scene, output;
  std::optional<double> from, to, step;  // in the unit of the scene
};

// What the command line says about the range stands in for what the scene says.
void override_range(const SweepCommand& command, Scene& scene) {
  if (!scene.sweep)
    throw InputError(command.scene + ": [sweep] is missing, expected what to vary and how far");
  if (!command.from && !command.to && !command.step) return;
  std::vector<double>& values = scene.sweep->values;
  const double unit = declared_sweep_unit(scene).factor;
  const double step = values.size() > 1 ? (values[1] - values[0]) / unit : 1;
  try {
    values = range_values(command.from.value_or(values.front() / unit),
                          command.to.value_or(values.back() / unit), command.step.value_or(step));
  } catch (const InputError& error) {
    throw InputError(fmt::format("--from, --to, --step: {}", error.what()));
  }
  for (double& value : values) value *= unit;
}

int run_sweep(const SweepCommand& command) {
  check_output_file(command.output);
  Scene scene = read_scene(command.scene);
  refuse_to_overwrite_inputs(command.output, scene);
  override_range(command, scene);
  fmt::print("{}\n\n", scene.title);
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  print_fit(surfaces);
  const SweepTable table(scene);
  fmt::print("{}", table.head());
  SweepOptions options;
  options.on_pose = [&](const PoseResult& pose) {
    fmt::print("{}", table.row(pose));
    std::fflush(stdout);
  };
  const SweepResult result = sweep(scene, surfaces, options);
  fmt::print("\n{}\n", summary(result));
  for (const std::string& line : event_lines(scene, result)) fmt::print("{}\n", line);
  write_run(command.output, make_run(scene, surfaces, result));
  fmt::print("wrote {}\n", command.output);
  std::fflush(stdout);
  for (const std::string& line : failures(scene, result)) fmt::print(stderr, "condyle: {}\n", line);
  return result.count_converged() == static_cast<int>(result.poses.size()) ? 0 : kSomePoseFailed;
}

}  // namespace

void setup_sweep(CLI::App& program, int& status) {
  const auto options = std::make_shared<SweepCommand>();
  CLI::App* command = program.add_subcommand(
      "sweep", "Find the positions of equilibrium over a range of motion or load");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  command->add_option("--from", options->from, "first value, in the unit of the scene");
  command->add_option("--to", options->to, "last value");
  command->add_option("--step", options->step, "step between values");
  command->callback([options, &status] { status = run_sweep(*options); });
}

}  // namespace condyle
