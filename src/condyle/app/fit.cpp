#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/print_fit.h"
#include "condyle/app/progress.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/input_error.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"
#ifdef CONDYLE_PICTURES
#include "condyle/pictures/fit_picture.h"
#include "condyle/pictures/picture_folder.h"
#include "condyle/pictures/png_file.h"
#endif

namespace condyle {
namespace {

struct FitOptions {
  Talk talk;
  std::string scene, output, pictures;
};

#ifdef CONDYLE_PICTURES
std::vector<std::filesystem::path> write_pictures(const Talk& talk,
                                                  const std::filesystem::path& folder,
                                                  const Scene& scene,
                                                  const std::vector<FittedSurface>& surfaces) {
  std::vector<std::filesystem::path> files;
  for (const FitPicture& picture : draw_fit(scene, surfaces)) {
    const std::filesystem::path file = folder / (picture.name + ".png");
    write_png(file, picture.image);
    say(talk, "wrote {}\n", file.string());
    files.push_back(file);
  }
  return files;
}
#endif

int run_fit(const FitOptions& options) {
  const Talk& talk = options.talk;
  CommandClock clock;
  check_output_file(options.output, ".h5");
  Scene scene = read_scene(options.scene);
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
  const std::vector<InputFile> meshes = mesh_files(scene);
  const std::vector<FittedSurface> surfaces = fit_aloud(talk, scene);
  if (talk.plain()) print_known_parts(surfaces);
  Run run = make_run(scene, surfaces);
  expect_same(meshes, run.inputs);
  run.study = FitStudy{};
  say(talk, "\n");
  for (const std::string& line : run.start)
    if (!is_warning(line)) say(talk, "{}\n", line);
  tell_warnings(talk, run);
  write_run(options.output, run);
  say(talk, "wrote {}\n", options.output);
  CommandSummary facts = clock.summary(talk, options.output, 0);
#ifdef CONDYLE_PICTURES
  if (folder) facts.files = write_pictures(talk, *folder, scene, surfaces);
#endif
  return finish(talk, facts, run);
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
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle fit data/phantom/knee.toml -o out/fit.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_fit(*options); });
  });
}

}  // namespace condyle
