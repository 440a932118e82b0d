#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/commands.h"
#include "app/make_run.h"
#include "app/print_fit.h"
#include "input_error.h"
#include "results/output_file.h"
#include "scene/read_scene.h"
#include "scene/start_warnings.h"

namespace condyle {
namespace {

struct FitOptions {
  std::string scene, output;
};

int run_fit(const FitOptions& options) {
  check_output_file(options.output);
  const Scene scene = read_scene(options.scene);
  refuse_to_overwrite_inputs(options.output, scene);
  const bool has_patches = std::any_of(
      scene.surfaces.begin(), scene.surfaces.end(),
      [](const SurfaceDescription& surface) { return surface.kind == SurfaceKind::kPatch; });
  if (!has_patches)
    throw InputError(options.scene + ": no surface has kind = \"patch\", expected one to fit");
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  print_fit(surfaces);
  print_known_parts(surfaces);
  Run run = make_run(scene, surfaces);
  run.start = start_warnings(scene, surfaces);
  fmt::print("\n");
  for (const std::string& line : run.start) fmt::print("{}\n", line);
  write_run(options.output, run);
  fmt::print("wrote {}\n", options.output);
  return 0;
}

}  // namespace

void setup_fit(CLI::App& program, int& status) {
  const auto options = std::make_shared<FitOptions>();
  CLI::App* command = program.add_subcommand("fit", "Fit the patches of a scene to its meshes");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  command->callback([options, &status] { status = run_fit(*options); });
}

}  // namespace condyle
