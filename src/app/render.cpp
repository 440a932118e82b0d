#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "input_error.h"
#include "pictures/knee_picture.h"
#include "pictures/picture_folder.h"
#include "pictures/png_file.h"
#include "pictures/swept_quantity.h"
#include "results/run_file.h"

namespace condyle {
namespace {

constexpr int kSomePoseFailed = 2;

struct RenderCommand {
  std::string run, folder;
  std::vector<double> at;  // degrees, mm or a factor, as swept
  std::vector<std::string> views = {"anterior", "medial", "plateau"};
  std::string size = "1200x900";
};

PictureOptions parse_size(const std::string& text) {
  PictureOptions options;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%6dx%6d%c", &options.width, &options.height, &rest) == 2)
    return options;
  throw InputError("--size " + text + ": expected WIDTHxHEIGHT in pixels, such as 1200x900");
}

struct Range {
  double low, high;
};
Range stored_range(const Run& run, const SweptQuantity& swept) {
  Range range{1e300, -1e300};
  for (const PoseResult& pose : run.sweep.poses) {
    range.low = std::min(range.low, swept.shown(pose.value));
    range.high = std::max(range.high, swept.shown(pose.value));
  }
  return range;
}

// Where nothing is asked for: round angles of flexion, else both ends and the middle.
std::vector<double> default_places(const Range& stored, const SweptQuantity& swept) {
  std::vector<double> places;
  for (const double angle : {0.0, 30.0, 60.0, 90.0, 120.0}) {
    if (swept.flexion && angle > stored.low - 0.5 && angle < stored.high + 0.5)
      places.push_back(angle);
  }
  if (places.empty()) places = {stored.low, 0.5 * (stored.low + stored.high), stored.high};
  return places;
}

// Stored poses nearest to the places asked for, each once.
std::vector<std::size_t> chosen_poses(const RenderCommand& command,
                                      const Run& run,
                                      const SweptQuantity& swept) {
  if (run.sweep.poses.empty())
    throw InputError(command.run + ": holds no poses, expected the result of condyle sweep");
  const Range stored = stored_range(run, swept);
  const double tolerance = 0.02 * (stored.high - stored.low) + 0.5;
  std::vector<std::size_t> poses;
  for (const double place : command.at.empty() ? default_places(stored, swept) : command.at) {
    if (!(place > stored.low - tolerance && place < stored.high + tolerance)) {
      throw InputError(fmt::format("--at {:g}: {} holds {:g} to {:g}", place, command.run,
                                   stored.low, stored.high));
    }
    const std::size_t pose = nearest_pose(run.scene, run.sweep, place).value();
    if (std::find(poses.begin(), poses.end(), pose) == poses.end()) poses.push_back(pose);
  }
  return poses;
}

// anterior_060.png, plateau_m005.png, medial_037.5.png
std::string file_name(View view, double shown) {
  const double rounded = std::round(100 * shown) / 100;
  const double magnitude = std::abs(rounded), whole = std::floor(magnitude);
  std::string fraction =
      magnitude > whole ? fmt::format("{:g}", std::round(100 * (magnitude - whole)) / 100).substr(1)
                        : "";
  return fmt::format("{}_{}{:03.0f}{}.png", name(view), rounded < 0 ? "m" : "", whole, fraction);
}

int run_render(const RenderCommand& command) {
  const PictureOptions options = parse_size(command.size);
  std::vector<View> views;
  for (const std::string& text : command.views) views.push_back(view_from_name(text));
  const Run run = read_run(command.run);
  const SweptQuantity swept = swept_quantity(run.scene);
  const std::vector<std::size_t> poses = chosen_poses(command, run, swept);
  const std::filesystem::path folder = make_picture_folder(command.folder);
  KneePictures pictures(run, options);
  int status = 0;
  for (const std::size_t pose : poses) {
    const PoseResult& result = run.sweep.poses[pose];
    if (!result.converged()) {
      fmt::print(stderr, "condyle: no picture at {}: {}\n", with_unit(swept, result.value),
                 name(result.status));
      status = kSomePoseFailed;
      continue;
    }
    for (const View view : views) {
      const std::filesystem::path file = folder / file_name(view, swept.shown(result.value));
      write_png(file, pictures.draw(view, pose));
      fmt::print("wrote {}\n", file.string());
      std::fflush(stdout);
    }
  }
  return status;
}

}  // namespace

void setup_render(CLI::App& program, int& status) {
  const auto options = std::make_shared<RenderCommand>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures of the poses of a run");
  command->add_option("RUN", options->run, "result file of condyle sweep (HDF5)")->required();
  command->add_option("-o,--output", options->folder, "folder for the pictures")->required();
  command
      ->add_option("--at", options->at,
                   "values of what was swept, such as 0,30,60 degrees; the nearest poses are drawn")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--view", options->views, "anterior, posterior, medial, lateral, plateau")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command->add_option("--size", options->size, "width and height in pixels")->capture_default_str();
  command->footer(
      "Example: condyle render out/phantom.h5 -o out --at 0,60,120 --view anterior,plateau");
  command->callback([options, &status] { status = run_render(*options); });
}

}  // namespace condyle
