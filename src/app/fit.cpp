#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/make_run.h"
#include "app/print_fit.h"
#include "input_error.h"
#include "results/output_file.h"
#include "scene/read_scene.h"
#include "scene/start_warnings.h"
#ifdef CONDYLE_PICTURES
#include "pictures/fit_picture.h"
#include "pictures/picture_folder.h"
#include "pictures/png_file.h"
#endif

namespace condyle {
namespace {

struct FitOptions {
  std::string scene, output, pictures;
};

#ifdef CONDYLE_PICTURES
void write_pictures(const std::filesystem::path& folder,
                    const Scene& scene,
                    const std::vector<FittedSurface>& surfaces) {
  for (const FitPicture& picture : draw_fit(scene, surfaces)) {
    const std::filesystem::path file = folder / (picture.name + ".png");
    write_png(file, picture.image);
    fmt::print("wrote {}\n", file.string());
  }
}
#endif

int run_fit(const FitOptions& options) {
  check_output_file(options.output);
  const Scene scene = read_scene(options.scene);
  refuse_to_overwrite_inputs(options.output, scene);
  const bool has_patches = std::any_of(
      scene.surfaces.begin(), scene.surfaces.end(),
      [](const SurfaceDescription& surface) { return surface.kind == SurfaceKind::kPatch; });
  if (!has_patches)
    throw InputError(options.scene + ": no surface has kind = \"patch\", expected one to fit");
#ifdef CONDYLE_PICTURES
  std::optional<std::filesystem::path> folder;
  if (!options.pictures.empty()) folder = make_picture_folder(options.pictures);
#endif
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  print_fit(surfaces);
  print_known_parts(surfaces);
  Run run = make_run(scene, surfaces);
  run.start = start_warnings(scene, surfaces);
  fmt::print("\n");
  for (const std::string& line : run.start) fmt::print("{}\n", line);
  write_run(options.output, run);
  fmt::print("wrote {}\n", options.output);
#ifdef CONDYLE_PICTURES
  if (folder) write_pictures(*folder, scene, surfaces);
#endif
  return 0;
}

}  // namespace

void setup_fit(CLI::App& program, int& status) {
  const auto options = std::make_shared<FitOptions>();
  CLI::App* command = program.add_subcommand("fit", "Fit the patches of a scene to its meshes");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
#ifdef CONDYLE_PICTURES
  command->add_option("--pictures", options->pictures,
                      "folder for maps of deviation and curvature (PNG)");
#endif
  command->callback([options, &status] { status = run_fit(*options); });
}

}  // namespace condyle
