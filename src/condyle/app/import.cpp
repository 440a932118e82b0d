#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "condyle/app/commands.h"
#include "condyle/app/make_run.h"
#include "condyle/exchange/osim_scene.h"
#include "condyle/exchange/ply_file.h"
#include "condyle/input_error.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

struct ImportCommand {
  std::string model, output, side;
  OsimOptions knee;
  OsimSceneOptions scene;
};

std::optional<Side> parse_side(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text == "right") return Side::kRight;
  if (text == "left") return Side::kLeft;
  throw InputError("--side " + text + ": expected right or left");
}

int run_import(ImportCommand& command) {
  command.knee.side = parse_side(command.side);
  check_output_file(command.output);
  refuse_to_overwrite(command.output, {command.model});
  const OsimModel model = read_osim(command.model);
  const OsimKnee knee = find_knee(model, command.model, command.knee);
  const OsimScene scene = osim_scene(model, knee, command.model, command.output, command.scene);
  for (const OsimMovedMesh& moved : scene.meshes) {
    check_output_file(moved.file);
    write_output_file(moved.file, ply(moved.mesh));
  }
  (void)parse_scene(scene.text, command.output);  // what is written can be read
  write_output_file(command.output, scene.text);
  fmt::print("{}: joint {}, femur {}, tibia {}, {} ligaments\n", command.model, knee.joint,
             knee.femur.name, knee.tibia.name, knee.ligaments.size());
  fmt::print("Not taken over as it is:\n");
  for (const std::string& note : scene.notes) fmt::print("  {}\n", note);
  for (const OsimMovedMesh& moved : scene.meshes) fmt::print("wrote {}\n", moved.file.string());
  fmt::print("wrote {}\n", command.output);
  return 0;
}

}  // namespace

void setup_import(CLI::App& program, int& status) {
  const auto options = std::make_shared<ImportCommand>();
  CLI::App* command =
      program.add_subcommand("import", "Make a scene of the knee of an OpenSim-JAM model");
  command->add_option("MODEL", options->model, "model file of OpenSim 4 (.osim)")->required();
  command->add_option("-o,--output", options->output, "scene file to write (TOML)")->required();
  command->add_option("--joint", options->knee.joint,
                      "the joint, where the one that most ligaments span is not meant");
  command->add_option("--side", options->side, "right or left, where names do not tell");
  command
      ->add_option("--compression", options->scene.compression,
                   "load along the tibia in N, in place of muscles and weight")
      ->capture_default_str();
  command->footer("Example: condyle import lenhart2015.osim -o knee.toml");
  command->callback([options, &status] { status = run_import(*options); });
}

}  // namespace condyle
