#include "condyle/equilibrium/sweep.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/print_fit.h"
#include "condyle/app/progress.h"
#include "condyle/app/range_options.h"
#include "condyle/app/resume.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/input_error.h"
#include "condyle/results/journal.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sweep_table.h"
#include "condyle/results/uncertainty_group.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/study/mesh_uncertainty.h"

namespace condyle {
namespace {

struct SweepCommand {
  Talk talk;
  std::string scene, output;
  RangeOptions range;
  bool resume = false;
  std::string uncertainty;  ///< how many sweeps; empty: none
};

/// A flag's number goes through no check of CLI11: it may be of any size, or half a word.
int sweeps_of_uncertainty(const std::string& words) {
  constexpr int kMost = 1000000;
  if (words.empty()) return 0;
  int sweeps = 0;
  const char *begin = words.data(), *end = begin + words.size();
  const auto [last, error] = std::from_chars(begin, end, sweeps);
  if (error != std::errc() || last != end || sweeps > kMost)
    throw InputError(
        fmt::format("--uncertainty={}: expected a whole number of sweeps up to {}", words, kMost));
  return sweeps;
}

/// Keeps poses in the journal as soon as they are known, and counts them.
class KeptPoses {
 public:
  KeptPoses(const std::string& output, Journal& journal, const EarlierPoses& earlier)
      : output_(output), journal_(journal), resumed_(!earlier.poses.empty()) {
    if (earlier.journal_bytes > 0) words_.emplace(last_words(output, "poses"));
    for (const KnownPose& pose : earlier.poses)
      if (pose.open) there_.insert(key(pose));
  }
  void keep(const KnownPose& pose) {
    journal_.append(pose);
    if (!words_ && journal_.failure().empty()) words_.emplace(last_words(output_, "poses"));
    if (there_.insert(key(pose)).second) ++computed_;
  }
  [[nodiscard]] bool resumed() const { return resumed_; }
  [[nodiscard]] std::size_t computed() const { return computed_; }

 private:
  using Key = std::pair<double, int>;
  static Key key(const KnownPose& pose) { return {pose.pose.value, pose.visit}; }

  const std::string& output_;
  Journal& journal_;
  bool resumed_;
  std::optional<LastWords> words_;  ///< as soon as the journal holds a pose
  std::set<Key> there_;
  std::size_t computed_ = 0;
};

// The sweep with its table.
SweepResult sweep_aloud(const Talk& talk,
                        const Scene& scene,
                        const std::vector<FittedSurface>& surfaces,
                        std::vector<KnownPose> known,
                        KeptPoses& kept) {
  const SweepTable table(scene, quantity_of_sweep(scene), scene.sweep->values);
  say(talk, "{}", table.head());
  int done = 0, tried = 0;
  const int total = scene.sweep->arc_length ? 0 : static_cast<int>(scene.sweep->values.size());
  Progress progress(talk, "poses");
  SweepOptions options;
  options.known = std::move(known);
  options.on_pose = [&](const PoseResult& pose) {
    if (talk.plain()) {
      progress.clear();
      tell("{}", table.row(pose));
      std::fflush(stdout);
    }
    progress.at(tried = std::max(tried, ++done), total);
  };
  options.on_computed = [&](const KnownPose& pose) { kept.keep(pose); };
  options.on_open = [&](const KnownPose& pose) {
    kept.keep(pose);
    progress.at(++tried, total);
  };
  SweepResult result = sweep(scene, surfaces, options);
  progress.clear();
  say(talk, "\n{}\n", summary(result));
  if (kept.resumed())
    say(talk, "{} poses taken over, {} computed\n", result.poses.size() - kept.computed(),
        kept.computed());
  return result;
}

/// How sure the poses are, given the meshes; null where it was not asked for.
std::shared_ptr<const MeshUncertainty> uncertainty_aloud(const Talk& talk,
                                                         int sweeps,
                                                         const Scene& scene,
                                                         const std::vector<FittedSurface>& surfaces,
                                                         const std::vector<PoseResult>& poses) {
  if (sweeps == 0) return nullptr;
  Progress line(talk, "sweeps");
  StudyProgress progress([&](const std::string&, int done, int total) {
    line.at(done, total);
    return true;
  });
  auto found = mesh_uncertainty(scene, surfaces, poses, {sweeps, 1, 0}, progress);
  line.clear();
  say(talk, "{}\n", uncertainty_words(*found));
  return found;
}

int run_sweep(const SweepCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  check_output_file(command.output, ".h5");
  Scene scene = read_scene(command.scene);
  const int more_sweeps = sweeps_of_uncertainty(command.uncertainty);
  if (!command.uncertainty.empty()) check_uncertainty(scene, {more_sweeps, 1, 0});
  if (command.resume && scene.sweep && scene.sweep->arc_length) {
    throw InputError(command.scene +
                     ": [sweep]: path = \"arc length\", expected \"steps\" for --resume");
  }
  refuse_to_overwrite_inputs(command.output, scene);
  refuse_to_overwrite_inputs(journal_path(command.output), scene);
  override_range(command.scene, command.range, scene);
  const std::vector<InputFile> meshes = mesh_files(scene);
  const std::vector<FittedSurface> surfaces = fit_aloud(talk, scene);
  if (more_sweeps > 0) check_noise(scene, surfaces);
  Run run = make_run(scene, surfaces);
  expect_same(meshes, run.inputs);
  tell_warnings(talk, run);
  LineFile journal_file(journal_path(command.output), command.output);
  EarlierPoses earlier = earlier_poses(command.output, command.resume, scene, surfaces);
  if (!earlier.message.empty()) say(talk, "{}\n\n", earlier.message);
  Journal journal(journal_file, identity(scene, surfaces), earlier.journal_bytes);
  KeptPoses kept(command.output, journal, earlier);
  run.sweep = sweep_aloud(talk, scene, surfaces, std::move(earlier.poses), kept);
  run.sensitivities = sweep_sensitivities(scene, surfaces, run.sweep.poses);
  run.uncertainty = uncertainty_aloud(talk, more_sweeps, scene, surfaces, run.sweep.poses);
  const SweepResult& result = run.sweep;
  for (const std::string& line : event_lines(scene, swept_quantity(run), result))
    say(talk, "{}\n", line);
  write_and_end_journal(talk, command.output, run, journal, "poses");
  for (const std::string& line : failures(swept_quantity(run), result))
    tell(stderr, "condyle: {}\n", line);
  const bool all = result.count_converged() == static_cast<int>(result.poses.size());
  CommandSummary facts = clock.summary(talk, command.output, all ? 0 : kSomePoseFailed);
  tell_journal_failure(journal, facts);
  return finish(talk, facts, run);
}

}  // namespace

void setup_sweep(CLI::App& program, int& status) {
  const auto options = std::make_shared<SweepCommand>();
  CLI::App* command = program.add_subcommand(
      "sweep", "Find the positions of equilibrium over a range of motion or load");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  add_range_options(*command, options->range);
  command->add_flag("--resume", options->resume,
                    "take over what RUN.h5 and the journal of a stopped run hold");
  command->add_flag("--uncertainty{20}", options->uncertainty,
                    "how sure the poses are, given the meshes: by 20 sweeps, or --uncertainty=N");
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle sweep data/phantom/knee.toml -o out/phantom.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_sweep(*options); });
  });
}

}  // namespace condyle
