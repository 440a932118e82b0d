#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/list_option.h"
#include "condyle/app/progress.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/app/tell.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/pictures/knee_picture.h"
#include "condyle/pictures/movie.h"
#include "condyle/pictures/picture_folder.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/pressure_map.h"
#include "condyle/pictures/strip.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_view.h"
#include "condyle/results/without_poses.h"

namespace condyle {
namespace {

struct RenderCommand {
  Talk talk;
  std::string run, output;
  std::vector<double> at;  // degrees, mm, s or a factor, as swept
  std::vector<std::string> views = {"anterior", "medial", "plateau"};
  std::string size;
  bool proximity = false, pressure = false, hertz = false, strip = false, movie = false;
  int frames_per_second = 10;
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
    throw InputError(command.run + ": " + no_poses(run) + ", expected the result of condyle sweep");
  std::vector<std::size_t> poses;
  for (const double place :
       command.at.empty() ? default_places(stored_range(run, swept), swept) : command.at) {
    const std::size_t pose = nearest_pose_of(run, command.run, place);
    if (std::find(poses.begin(), poses.end(), pose) == poses.end()) poses.push_back(pose);
  }
  return poses;
}

// Poses of a movie: all, or those asked for.
std::vector<std::size_t> movie_poses(const RenderCommand& command,
                                     const Run& run,
                                     const SweptQuantity& swept) {
  if (!command.at.empty()) return chosen_poses(command, run, swept);
  std::vector<std::size_t> poses(run.sweep.poses.size());
  std::iota(poses.begin(), poses.end(), std::size_t{0});
  return poses;
}

// Leaves out what has no place, and says so of all that are no results.
int keep_drawable(const Run& run, const SweptQuantity& swept, std::vector<std::size_t>& poses) {
  int status = 0;
  std::erase_if(poses, [&](std::size_t pose) {
    const PoseResult& result = run.sweep.poses[pose];
    if (result.converged()) return false;
    tell(stderr, "condyle: {} at {}: {}\n",
         has_place(result) ? "picture with a mark" : "no picture", with_unit(swept, result.value),
         name(result.status));
    status = kSomePoseFailed;
    return !has_place(result);
  });
  return status;
}

// anterior_060, plateau_m005, medial_037.5; to nine decimals, beyond which a turn of units rounds.
std::string file_stem(View view, double shown) {
  const double rounded = std::round(1e9 * shown) / 1e9;
  const double magnitude = std::abs(rounded), whole = std::floor(magnitude);
  std::string fraction = fmt::format("{:.9f}", magnitude - whole).substr(1);
  fraction.erase(fraction.find_last_not_of(".0") + 1);
  return fmt::format("{}_{}{:03.0f}{}", name(view), rounded < 0 ? "m" : "", whole, fraction);
}

bool holds_pressures(const Run& run) {
  for (const PoseResult& pose : run.sweep.poses)
    for (const ContactResult& contact : pose.contacts)
      for (const ContactPointResult& point : contact.points)
        if (point.hertz) return true;
  return false;
}

// Where pictures go: into a folder, or, where the name asks for it, one into a file.
class Output {
 public:
  Output(const RenderCommand& command, const Run& run, std::size_t pictures) {
    const std::filesystem::path path(command.output);
    const std::string ending = file_ending(path);
    if (ending == ".mp4" && !command.movie)
      throw InputError(command.output + ": an MP4 is a movie: add --movie");
    if (ending != ".mp4" && ends_like_another_kind(path, ".png"))
      throw InputError(command.output +
                       ": pictures are PNG, expected a name that ends in .png, or a folder");
    if (ending != ".png" && ending != ".mp4") {
      folder_ = make_picture_folder(command.output);
      return;
    }
    if (pictures != 1)
      throw InputError(
          fmt::format("{}: {} pictures do not go into one file, expected a folder, or "
                      "one view and one value",
                      command.output, pictures));
    file_ = path;
    check_output_file(file_);
    refuse_to_overwrite(file_, {command.run});
    refuse_to_overwrite_sources(file_, run);
  }
  [[nodiscard]] std::filesystem::path path(const std::string& stem) const {
    return file_.empty() ? folder_ / (stem + ".png") : file_;
  }

 private:
  std::filesystem::path folder_, file_;
};

/// Counts pictures for the progress line, and remembers the files.
class Account {
 public:
  Account(const Talk& talk, std::size_t pictures)
      : talk_(talk), progress_(talk, "pictures"), total_(static_cast<int>(pictures)) {}
  void drew() { progress_.at(++done_, total_); }
  void wrote(const std::filesystem::path& file) {
    files_.push_back(file);
    if (!talk_.plain()) return;
    progress_.clear();
    tell("wrote {}\n", file.string());
    std::fflush(stdout);
  }
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const Talk& talk_;
  Progress progress_;
  int done_ = 0, total_;
  std::vector<std::filesystem::path> files_;
};

struct Job {
  const RenderCommand& command;
  const Run& run;
  SweptQuantity swept;
  std::vector<View> views;
  std::vector<std::size_t> poses;
  PictureOptions options;
};

void draw_singles(const Job& job, Account& account) {
  const Output output(job.command, job.run, job.views.size() * job.poses.size());
  KneePictures pictures(job.run, job.options);
  for (const std::size_t pose : job.poses) {
    for (const View view : job.views) {
      const double shown = job.swept.shown(job.run.sweep.poses[pose].value);
      const std::filesystem::path file = output.path(file_stem(view, shown));
      write_png(file, pictures.draw(view, pose));
      account.drew();
      account.wrote(file);
    }
  }
}

void draw_strips(const Job& job, Account& account) {
  const Output output(job.command, job.run, job.views.size());
  for (const View view : job.views) {
    const std::filesystem::path file = output.path(fmt::format("{}_strip", name(view)));
    PictureOptions options = job.options;
    if (job.command.size.empty()) {
      const PictureOptions page = strip_size(view, job.poses.size());
      options.width = page.width;
      options.height = page.height;
    }
    write_png(file, draw_strip(job.run, view, job.poses, options));
    account.drew();
    account.wrote(file);
  }
}

void draw_movies(const Job& job, Account& account) {
  const Output output(job.command, job.run, job.views.size());
  for (const View view : job.views) {
    const std::filesystem::path file = output.path(fmt::format("{}_movie", name(view)));
    Movie movie(file, job.command.frames_per_second);
    KneePictures pictures(job.run, job.options);
    for (const std::size_t pose : job.poses) {
      movie.add(pictures.draw(view, pose));
      account.drew();
    }
    movie.finish();
    account.wrote(file);
  }
}

PictureOptions options_of(const RenderCommand& command) {
  PictureOptions options;
  if (command.movie) options.width = 800, options.height = 600;
  if (!command.size.empty()) options = parse_size(command.size);
  if (command.proximity) options.colors = SurfaceColors::kGap;
  if (command.pressure) options.colors = SurfaceColors::kPressure;
  options.hertz = command.hertz;
  return options;
}

int run_render(const RenderCommand& command) {
  CommandClock clock;
  if (!command.size.empty()) (void)parse_size(command.size);
  std::vector<View> views;
  for (const std::string& text : command.views) views.push_back(view_from_name(text));
  const Run run = read_run(command.run);
  if (command.hertz && !holds_pressures(run))
    throw InputError(
        "--hertz: " + command.run +
        " holds no estimates of contact pressure, expected a scene with a surface that "
        "has a modulus");
  if (command.pressure && !(greatest_pressure(run) > 0))
    throw InputError("--pressure: " + command.run +
                     " holds no pressures, expected a scene with a [[contact]] of law = \"layer\"");
  const SweptQuantity swept = swept_quantity(run);
  std::vector<std::size_t> poses =
      command.movie ? movie_poses(command, run, swept) : chosen_poses(command, run, swept);
  const int status = keep_drawable(run, swept, poses);
  Account account(command.talk, views.size() * (command.strip ? 1 : poses.size()));
  if (!poses.empty()) {
    const Job job{command, run, swept, views, poses, options_of(command)};
    const auto draw = command.movie ? draw_movies : command.strip ? draw_strips : draw_singles;
    draw(job, account);
  }
  CommandSummary facts = clock.summary(command.talk, command.run, status);
  facts.files = account.files();
  return finish(command.talk, facts, run);
}

}  // namespace

void setup_render(CLI::App& program, int& status) {
  const auto options = std::make_shared<RenderCommand>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures of the poses of a run");
  command->add_option("RUN", options->run, "result file (HDF5)")->required();
  command
      ->add_option("-o,--output", options->output,
                   "folder for the pictures; or a file, NAME.png or NAME.mp4, for a single one")
      ->required();
  add_list(*command, "--at", options->at,
           "values of what was swept, such as 0,30,60 degrees; the nearest poses are drawn");
  add_list(*command, "--view", options->views,
           "anterior, posterior, medial, lateral, plateau, condyles, exploded");
  command->add_option("--size", options->size, "width and height in pixels, else 1200x900");
  CLI::Option* proximity = command->add_flag("--proximity", options->proximity,
                                             "gap between the articular surfaces in colours");
  command->add_flag("--pressure", options->pressure, "pressure of elastic layers in colours")
      ->excludes(proximity);
  command->add_flag("--hertz", options->hertz, "ellipses of contact pressure, to scale");
  CLI::Option* strip = command->add_flag("--strip", options->strip, "all values side by side");
  CLI::Option* movie = command
                           ->add_flag("--movie", options->movie,
                                      "a moving picture over all poses (or those of --at)")
                           ->excludes(strip);
  command->add_option("--fps", options->frames_per_second, "poses per second of a movie")
      ->check(CLI::Range(1, 100))
      ->needs(movie)
      ->capture_default_str();
  command->footer(
      "Example: condyle render out/phantom.h5 -o out --at 0,60,120 --view anterior,plateau");
  add_talk_options(*command, options->talk);
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_render(*options); });
  });
}

}  // namespace condyle
