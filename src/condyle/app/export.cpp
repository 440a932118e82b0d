#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/list_option.h"
#include "condyle/app/tell.h"
#include "condyle/exchange/csv_run.h"
#include "condyle/exchange/glb_run.h"
#include "condyle/exchange/opensim_run.h"
#include "condyle/exchange/pressure_export.h"
#include "condyle/exchange/run_table.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/exchange/vtk_run.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

struct ExportCommand {
  std::string run, output;
  std::vector<std::string> formats;
  std::vector<double> at;
  std::size_t triangles = 0;
};

const std::vector<std::string> kFormats = {"glb", "vtk", "opensim", "csv", "stl"};
const std::vector<std::string> kDefaultFormats = {"glb", "vtk", "opensim", "csv"};
const std::vector<std::string> kFileEndings = {".glb", ".mot", ".sto", ".csv", ".stl"};

bool is_one_of(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::string format_of_ending(const std::string& ending) {
  return ending == ".mot" || ending == ".sto" ? "opensim" : ending.substr(1);
}

void check_formats(const ExportCommand& command, const std::string& ending) {
  for (const std::string& format : command.formats) {
    if (!is_one_of(kFormats, format)) {
      throw InputError(fmt::format("--format {}: expected {}", format, fmt::join(kFormats, ", ")));
    }
  }
  if (ending.empty() || command.formats.empty()) return;
  if (command.formats != std::vector<std::string>{format_of_ending(ending)}) {
    throw InputError(fmt::format("--format {}: {} is a single file, expected a folder",
                                 fmt::join(command.formats, ","), command.output));
  }
}

/// The ending of a file of one format, or nothing for a folder.
std::string ending_of(const ExportCommand& command) {
  const fs::path path(command.output);
  std::string ending = file_ending(path);
  if (is_one_of(kFileEndings, ending)) return ending;
  if (ending == ".vtp" || ending == ".pvd") {
    throw InputError(fmt::format("{}: a series of many files, expected a folder, with --format vtk",
                                 command.output));
  }
  if (!ending.empty() && !fs::is_directory(path)) {
    throw InputError(fmt::format("{}: unknown format, expected a name that ends in {}, or a folder",
                                 command.output, fmt::join(kFileEndings, ", ")));
  }
  return "";
}

/// Of the poses asked for, or of all.
int report_failures(const ExportCommand& command, const Run& run) {
  const SweptQuantity swept = swept_quantity(run);
  int status = 0;
  std::vector<const PoseResult*> asked;
  for (const double value : command.at)
    asked.push_back(&run.sweep.poses[nearest_pose_of(run, command.run, value)]);
  if (command.at.empty())
    for (const PoseResult& pose : run.sweep.poses) asked.push_back(&pose);
  for (const PoseResult* pose : asked) {
    if (pose->converged()) continue;
    tell(stderr, "condyle: {} {:g}{}: {}\n", has_place(*pose) ? "marked" : "left out",
         swept.shown(pose->value), swept.unit_after_number(), name(pose->status));
    status = kSomePoseFailed;
  }
  return status;
}

class Exporter {
 public:
  Exporter(const ExportCommand& command, const Run& run)
      : command_(command),
        run_(run),
        shown_(command.at.empty() ? shown_poses(run, command.run)
                                  : shown_poses_at(run, command.run, command.at)) {
    options_.bone_triangles = command.triangles;
  }

  /// All files of one folder, made before any is written.
  [[nodiscard]] std::vector<ExportFile> folder(const std::vector<std::string>& formats) const {
    const std::string stem = file_word(fs::path(command_.run).stem().string());
    std::vector<ExportFile> files;
    for (const std::string& format : std::set<std::string>(formats.begin(), formats.end())) {
      if (format == "glb") files.push_back({stem + ".glb", bytes(".glb")});
      if (format == "csv") files.push_back({stem + ".csv", bytes(".csv")});
      if (format == "csv" && has_layers(run_))
        files.push_back({stem + "_pressures.csv", csv_of_pressures(run_, shown_)});
      if (format == "opensim" && run_.scene.joint) files.push_back({stem + ".mot", bytes(".mot")});
      if (format == "opensim") files.push_back({stem + ".sto", bytes(".sto")});
      if (format == "vtk") append(files, vtk_of_poses(run_, shown_, shapes(), stem));
      if (format == "stl") append(files, stl_of_poses(run_, shown_, shapes(), stem));
    }
    return files;
  }

  [[nodiscard]] std::string bytes(const std::string& ending) const {
    if (ending == ".glb") return glb_of_poses(run_, shown_, options_);
    if (ending == ".csv") return csv_of_poses(run_, shown_);
    if (ending == ".mot") return mot_of_poses(run_, results(), command_.run);
    if (ending == ".sto") return sto_of_poses(run_, results());
    if (shown_.size() != 1) {
      throw InputError(
          fmt::format("{}: holds one pose, the run {} of them, expected --at VALUE, or a folder",
                      command_.output, shown_.size()));
    }
    return stl_of_pose(run_, run_.sweep.poses[shown_[0].index], shapes());
  }

 private:
  static void append(std::vector<ExportFile>& files, std::vector<ExportFile> more) {
    for (ExportFile& file : more) files.push_back(std::move(file));
  }
  /// OpenSim's files have no place for a mark.
  [[nodiscard]] std::vector<ShownPose> results() const {
    return converged_only(run_, command_.run, shown_);
  }
  [[nodiscard]] std::vector<RunShape> shapes() const { return run_shapes(run_, options_); }

  const ExportCommand& command_;
  const Run& run_;
  std::vector<ShownPose> shown_;
  ShapeOptions options_;
};

void make_folder(const fs::path& folder) {
  if (fs::is_directory(folder)) return;
  std::error_code error;
  fs::create_directory(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                 error ? error.message() : "something else is there"));
  }
}

/// Of "a b" and "a_b" the files have one name.
void expect_names_that_differ(const fs::path& folder, const std::vector<ExportFile>& files) {
  std::set<fs::path> names;
  for (const ExportFile& file : files)
    if (!names.insert(file.path).second)
      throw InputError(
          fmt::format("{}: two surfaces would be in this file, expected names that differ in "
                      "letters and digits",
                      (folder / file.path).string()));
}

/// Sources are known by path and by bytes; of measurements the run holds no bytes, and its paths start where it was
/// computed. So no table is replaced that is not one of these.
void refuse_to_overwrite_measurements(const fs::path& file, const Run& run) {
  if (!run.scene.calibration || file_ending(file) != ".csv" || !fs::is_regular_file(file)) return;
  const std::string_view expected = kTableHead;
  std::string head(expected.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (stream.gcount() > 0 && head != expected)
    throw InputError(fmt::format(
        "{}: begins otherwise than a table of a run (\"{}\"), it may hold measurements, expected "
        "another file to write",
        file.string(), expected));
}

void refuse_to_overwrite_any_source(const fs::path& file, const Run& run) {
  refuse_to_overwrite_sources(file, run);
  refuse_to_overwrite_measurements(file, run);
}

void write_folder(const fs::path& folder, const std::vector<ExportFile>& files, const Run& run) {
  expect_names_that_differ(folder, files);
  for (const ExportFile& file : files) refuse_to_overwrite_any_source(folder / file.path, run);
  make_folder(folder);
  std::size_t quiet = 0;
  for (const ExportFile& file : files) {
    if (file.path.has_parent_path()) make_folder(folder / file.path.parent_path());
    write_output_file(folder / file.path, file.bytes);
    if (file.path.has_parent_path())
      ++quiet;
    else
      tell("wrote {}\n", (folder / file.path).string());
  }
  if (quiet > 0) tell("wrote {} files in folders beside them\n", quiet);
}

int run_export(const ExportCommand& command) {
  const std::string ending = ending_of(command);
  check_formats(command, ending);
  if (!ending.empty()) check_output_file(command.output);
  const Run run = read_run(command.run);
  const Exporter exporter(command, run);
  if (ending.empty()) {
    fs::path folder(command.output);
    if (!folder.has_filename()) folder = folder.parent_path();
    const fs::path parent = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
    if (!fs::is_directory(parent)) {
      throw InputError(fmt::format("{}: there is no folder {}, expected one that exists",
                                   command.output, parent.string()));
    }
    write_folder(folder,
                 exporter.folder(command.formats.empty() ? kDefaultFormats : command.formats), run);
  } else {
    refuse_to_overwrite(command.output, {command.run});
    refuse_to_overwrite_any_source(command.output, run);
    write_output_file(command.output, exporter.bytes(ending));
    tell("wrote {}\n", command.output);
  }
  return report_failures(command, run);
}

}  // namespace

void setup_export(CLI::App& program, int& status) {
  const auto options = std::make_shared<ExportCommand>();
  CLI::App* command = program.add_subcommand(
      "export", "Write a run for other programs: glTF, ParaView, OpenSim, CSV, STL");
  command->add_option("RUN", options->run, "result file of condyle sweep or simulate (HDF5)")
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "a file that ends in .glb, .mot, .sto, .csv or .stl, or a folder")
      ->required();
  add_list(*command, "--format", options->formats,
           "for a folder: glb, vtk, opensim, csv, stl; all but stl where none is named");
  add_list(*command, "--at", options->at,
           "values of what was swept, such as 0,30,60 degrees; the nearest poses are taken");
  command->add_option("--triangles", options->triangles,
                      "at most about so many triangles in each bone; 0: all of them");
  command->footer("Example: condyle export out/phantom.h5 -o out/phantom.glb");
  command->callback([options, &status] { status = run_export(*options); });
}

}  // namespace condyle
