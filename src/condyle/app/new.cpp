#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/anatomy/knee_from_meshes.h"
#include "condyle/anatomy/new_scene_text.h"
#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/default_template.h"
#include "condyle/app/start_run.h"
#include "condyle/app/tell.h"
#include "condyle/control_characters.h"
#include "condyle/input_error.h"
#include "condyle/mesh_files/mesh_bytes.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/scene_words.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

struct NewCommand {
  std::string femur, tibia, side = "auto", units = "auto", scene, output, report;
  std::vector<std::string> cartilage;
};

std::optional<Side> side_option(const std::string& text) {
  if (text == "auto") return std::nullopt;
  return text == "right" ? Side::kRight : Side::kLeft;
}

std::optional<double> units_option(const std::string& text) {
  if (text == "auto") return std::nullopt;
  return text == "mm" ? 1.0 : text == "cm" ? 10.0 : 1000.0;
}

NewKneeFiles files_of(const NewCommand& command) {
  NewKneeFiles files{command.femur, command.tibia, {}, {}};
  for (const std::string& file : command.cartilage) files.cartilage.emplace_back(file);
  files.template_scene = command.scene.empty() ? default_template() : fs::path(command.scene);
  return files;
}

void check_outputs(const NewCommand& command, const NewKneeFiles& files) {
  std::vector<std::string> named = command.cartilage;
  named.insert(named.end(), {command.femur, command.tibia});
  for (const std::string& name : named)
    if (has_control_characters(name))
      throw InputError(quotable(name) +
                       ": a name with control characters, which a scene cannot hold");
  check_output_file(command.output, ".toml");
#ifdef CONDYLE_PICTURES
  if (!command.report.empty()) check_scene_page(command.report);
#endif
  if (fs::path(command.report).lexically_normal() == fs::path(command.output).lexically_normal())
    throw InputError(command.report + ": scene and report, expected two files");
  std::vector<fs::path> read = files.cartilage;
  read.insert(read.end(), {files.femur, files.tibia, files.template_scene});
  refuse_to_overwrite(command.output, read);
  if (!command.report.empty()) refuse_to_overwrite(command.report, read);
}

void print_shape(const NewKnee& knee) {
  tell("unit       {}\n", unit_name(knee.shape.to_mm));
  tell("side       {}: {}\n", side_in_words(knee.shape), knee.shape.side_evidence);
  tell("femur      {:.1f} mm wide; {}\n", knee.shape.femur.width, knee.shape.femur.rule);
  tell("tibia      {:.1f} mm wide; {}\n", knee.shape.tibia.width, knee.shape.tibia.rule);
}

void print_ligaments(const NewKnee& knee) {
  tell("template   {}: {}\n", knee.files.template_scene.string(), knee.model.scene.title);
  for (const auto& [carried, bone] : {std::pair{&knee.femur, "femur"}, {&knee.tibia, "tibia"}})
    tell(
        "           {}: {:.2f}, {:.2f}, {:.2f} times as large (anterior, proximal, lateral), "
        "surfaces to "
        "{:.1f} mm rms\n",
        bone, carried->size.x(), carried->size.y(), carried->size.z(), carried->rms);
  tell("ligament     end    moved  sure to [mm]\n");
  for (const NewLigament& ligament : knee.ligaments)
    for (std::size_t k = 0; k < 2; ++k)
      tell("  {:<10} {}  {:5.1f}  {:5.1f}\n",
           k == 0 ? knee.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)].name
                  : std::string(),
           ligament.on_femur[k] ? "femur" : "tibia", ligament.ends[k].moved,
           ligament.ends[k].uncertainty);
}

void print_start(const NewKnee& knee) {
  const NewStart& start = knee.start;
  const auto degrees = [](double angle) { return std::round(angle * 1800 / M_PI) / 10 + 0.0; };
  tell("scan       flexion {:.1f}, adduction {:.1f}, internal rotation {:.1f} degrees\n",
       degrees(start.scan.flexion), degrees(start.scan.adduction),
       degrees(start.scan.internal_rotation));
  tell(
      "start      flexed by {:.1f} degrees, {:.2f} mm along the tibia, adducted by {:.2f} "
      "degrees\n",
      degrees(-start.extended), start.shifted, degrees(start.tilted));
  if (!knee.doubts.empty()) tell("To look at:\n");
  for (const std::string& doubt : knee.doubts) tell("  {}\n", doubt);
}

int run_new(const NewCommand& command) {
  const NewKneeFiles files = files_of(command);
  check_outputs(command, files);
  const NewKnee knee = knee_from_meshes(
      files, {.to_mm = units_option(command.units), .side = side_option(command.side)});
  const std::string text = new_scene_text(knee, command.output);
  Scene scene = parse_scene(text, command.output);  // what is written can be read
#ifdef CONDYLE_PICTURES
  if (!command.report.empty()) {
    const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
    fit_wraps(scene, surfaces);
    write_scene_page(command.report, start_run(scene, surfaces), knee.doubts);
  }
#endif
  write_output_file(command.output, text);
  print_shape(knee);
  print_ligaments(knee);
  print_start(knee);
  if (!command.report.empty()) tell("wrote {}\n", command.report);
  tell("wrote {}\n", command.output);
  return 0;
}

}  // namespace

void setup_new(CLI::App& program, int& status) {
  const auto options = std::make_shared<NewCommand>();
  CLI::App* command = program.add_subcommand("new",
                                             "Make a scene of two bones: unit, side and frames "
                                             "from their shape, ligaments from a template");
  command->add_option("FEMUR", options->femur, "mesh of the femur")->required();
  command->add_option("TIBIA", options->tibia, "mesh of the tibia, in the same frame and unit")
      ->required();
  command
      ->add_option("--cartilage", options->cartilage,
                   "after FEMUR and TIBIA: meshes of the femoral and the tibial cartilage (two for "
                   "the tibia if they are apart)")
      ->expected(2, 3);
  command->add_option("--side", options->side, "of the body")
      ->check(CLI::IsMember({"auto", "left", "right"}))
      ->capture_default_str();
  command->add_option("--units", options->units, "of the meshes")
      ->check(CLI::IsMember({"auto", "mm", "cm", "m"}))
      ->capture_default_str();
  command->add_option(
      "--template", options->scene,
      "scene whose ligaments and loads are carried over; the phantom where none is given");
  command->add_option("-o,--output", options->output, "scene file to write (TOML)")->required();
#ifdef CONDYLE_PICTURES
  command->add_option("--report", options->report,
                      "picture to write (PNG): bones, frames, insertions, what to look at");
#endif
  command->footer("Example: condyle new meshes/femur.stl meshes/tibia.stl -o out/new.toml");
  command->callback([options, &status] { status = run_new(*options); });
}

}  // namespace condyle
