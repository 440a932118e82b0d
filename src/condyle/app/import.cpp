#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/tell.h"
#include "condyle/exchange/laxity_tables.h"
#include "condyle/exchange/osim_scene.h"
#include "condyle/exchange/ply_file.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

using Options = std::vector<const CLI::Option*>;

struct ImportCommand {
  std::vector<std::string> files;
  std::string output, side, offsets, step = "end";
  OsimOptions knee;
  OsimSceneOptions scene;
  LaxityTableOptions tests;
  Options of_models, of_tables;  ///< of the command line
};

std::optional<Side> parse_side(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text == "right") return Side::kRight;
  if (text == "left") return Side::kLeft;
  throw InputError("--side " + text + ": expected right or left");
}

bool is_table(const std::string& file) { return file_ending(file) == ".csv"; }

void check_table_options(const ImportCommand& command) {
  for (const auto& [name, sd] : {std::pair{"--sd-length", command.tests.sd_length},
                                 std::pair{"--sd-angle", command.tests.sd_angle}})
    if (!(sd > 0))
      throw InputError(
          sd == 0 ? fmt::format("{} is missing or 0, expected a standard deviation > 0", name)
                  : fmt::format("{} {}: expected a standard deviation > 0", name, sd));
  if (!(command.tests.held >= 0))
    throw InputError(fmt::format("--held {}: expected a difference >= 0", command.tests.held));
  if (command.step != "end" && command.step != "mean")
    throw InputError("--step " + command.step + ": expected end or mean");
}

int import_tests(ImportCommand& command) {
  check_table_options(command);
  check_output_file(command.output, ".csv");
  std::vector<std::filesystem::path> files(command.files.begin(), command.files.end());
  command.tests.mean = command.step == "mean";
  if (!command.offsets.empty()) command.tests.offsets = command.offsets;
  std::vector<std::filesystem::path> inputs = files;
  if (command.tests.offsets) inputs.push_back(*command.tests.offsets);
  refuse_to_overwrite(command.output, inputs);
  const LaxityTable table = laxity_table(files, command.tests);
  write_output_file(command.output, table.text);
  for (const std::string& note : table.notes) tell("{}\n", note);
  tell("wrote {}\n", command.output);
  return 0;
}

int import_model(ImportCommand& command) {
  const std::string& file = command.files.front();
  command.knee.side = parse_side(command.side);
  check_output_file(command.output, ".toml");
  refuse_to_overwrite(command.output, {file});
  const OsimModel model = read_osim(file);
  const OsimKnee knee = find_knee(model, file, command.knee);
  const OsimScene scene = osim_scene(model, knee, file, command.output, command.scene);
  refuse_to_overwrite(command.output, scene.used);
  for (const OsimMovedMesh& moved : scene.meshes) {
    check_output_file(moved.file, ".ply");
    refuse_to_overwrite(moved.file, scene.used);
    refuse_to_overwrite(moved.file, {file});
  }
  for (const OsimMovedMesh& moved : scene.meshes) write_output_file(moved.file, ply(moved.mesh));
  write_output_file(command.output, scene.text);
  tell("{}: joint {}, femur {}, tibia {}, {} ligaments\n", file, knee.joint, knee.femur.name,
       knee.tibia.name, knee.ligaments.size());
  tell("Not taken over as it is:\n");
  for (const std::string& note : scene.notes) tell("  {}\n", note);
  for (const OsimMovedMesh& moved : scene.meshes) tell("wrote {}\n", moved.file.string());
  tell("wrote {}\n", command.output);
  return 0;
}

void refuse_given(const Options& options, const std::string& meant_for) {
  for (const CLI::Option* option : options)
    if (option->count() > 0)
      throw InputError(option->get_name() + ": expected with " + meant_for + " only");
}

int run_import(ImportCommand& command) {
  const auto tables = std::count_if(command.files.begin(), command.files.end(), is_table);
  if (tables == static_cast<std::ptrdiff_t>(command.files.size())) {
    refuse_given(command.of_models, "a model (.osim)");
    return import_tests(command);
  }
  if (command.files.size() > 1)
    throw InputError(command.files[tables == 0 ? 1 : 0] +
                     ": expected one model (.osim), or tables of tests (.csv) alone");
  refuse_given(command.of_tables, "tables of tests (.csv)");
  return import_model(command);
}

/// Of models only.
Options add_model_options(CLI::App& command, ImportCommand& options) {
  return {command.add_option(
              "--joint", options.knee.joint,
              "of a model: the joint, where the one that most ligaments span is not meant"),
          command.add_option("--side", options.side,
                             "of a model: right or left, where names do not tell"),
          command
              .add_option("--compression", options.scene.compression,
                          "of a model: load along the tibia in N, in place of muscles and weight")
              ->capture_default_str()};
}

/// Of tables of tests only.
Options add_table_options(CLI::App& command, ImportCommand& options) {
  return {
      command.add_option("--sd-length", options.tests.sd_length,
                         "of tests: standard deviation of displacements in mm"),
      command.add_option("--sd-angle", options.tests.sd_angle,
                         "of tests: standard deviation of angles in deg"),
      command.add_option("--offsets", options.offsets,
                         "of tests: State.cfg or kinematic_offsets.csv, added to the kinematics"),
      command.add_option("--specimen", options.tests.specimen, "of tests: its name in the table")
          ->capture_default_str(),
      command
          .add_option("--held", options.tests.held,
                      "of tests: rows whose load differs by at most this are one step; 0: each row")
          ->capture_default_str(),
      command.add_option("--step", options.step, "of tests: of a step its end, or its mean")
          ->capture_default_str()};
}

}  // namespace

void setup_import(CLI::App& program, int& status) {
  const auto options = std::make_shared<ImportCommand>();
  CLI::App* command = program.add_subcommand(
      "import",
      "Make a scene of the knee of an OpenSim-JAM model, or a table of measurements of a robot's");
  command
      ->add_option("MODEL", options->files,
                   "model file of OpenSim 4 (.osim), or kinematics and kinetics of tests (.csv)")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "scene (TOML) or table of measurements (CSV) to write")
      ->required();
  options->of_models = add_model_options(*command, *options);
  options->of_tables = add_table_options(*command, *options);
  command->footer("Example: condyle import lenhart2015.osim -o knee.toml");
  command->callback([options, &status] { status = run_import(*options); });
}

}  // namespace condyle
