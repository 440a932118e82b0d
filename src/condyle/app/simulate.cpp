#include "condyle/network/simulate.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/progress.h"
#include "condyle/app/resume.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/results/motion_journal.h"
#include "condyle/results/motion_view.h"
#include "condyle/results/sweep_table.h"

namespace condyle {
namespace {

constexpr int kDidNotSucceed = 2;
constexpr double kJoule = 1e3;  // N mm

struct SimulateCommand {
  Talk talk;
  std::string scene, output;
  bool resume = false;
};

/// At most some thirty rows of the table that a sweep prints.
void print_rows(const Scene& scene, const std::vector<PoseResult>& poses) {
  const std::size_t step = std::max<std::size_t>(1, poses.size() / 30);
  std::vector<double> times;
  for (std::size_t i = 0; i < poses.size(); i += step) times.push_back(poses[i].value);
  const SweepTable table(scene, quantity_of_motion(), times);
  tell("{}", table.head());
  for (std::size_t i = 0; i < poses.size(); i += step) tell("{}", table.row(poses[i]));
}

void print_events(const MotionView& motion) {
  for (const MotionEvent& event : motion.events) {
    tell("{:.6f} s: {} {}", event.time, event.contact, event.closing ? "closes" : "opens");
    if (event.closing && event.speed > 0) tell(" at {:.4g} mm/s", event.speed);
    tell("\n");
  }
}

void print_balance(const MotionView& motion, double mass) {
  if (motion.energies.empty()) return;
  const auto change = [&](double MotionEnergies::*part) { return motion.change(part) / kJoule; };
  tell("\nEnergy in J: kinetic {:+.6g}, gravity {:+.6g}, ligaments {:+.6g}, ",
       change(&MotionEnergies::kinetic), change(&MotionEnergies::gravity),
       change(&MotionEnergies::elastic));
  if (motion.layered) tell("layers {:+.6g}, ", change(&MotionEnergies::layers));
  tell("dissipated {:.6g}, loads gave {:.6g}\n", change(&MotionEnergies::dissipated),
       change(&MotionEnergies::work));
  if (!motion.computed) return;
  tell("Balance kept to {:.1e} of the largest of them\n", motion.computed->imbalance);
  tell("{:.3f} s of motion of {:.4g} kg in {:.3f} s, {} steps\n",
       motion.change(&MotionEnergies::time), mass * 1e3, motion.computed->seconds,
       motion.computed->steps);
}

void print_motion(const Run& run) {
  print_rows(run.scene, run.sweep.poses);
  const MotionView motion = *motion_view(run);
  print_events(motion);
  print_balance(motion, run.simulation()->mass.mass);
}

int report_failures(const Simulation& simulation) {
  int status = 0;
  if (!simulation.motion.completed) {
    tell(stderr, "condyle: stopped {}\n", simulation.motion.reason);
    status = kDidNotSucceed;
  }
  const auto failed = std::find_if(simulation.poses.begin(), simulation.poses.end(),
                                   [](const PoseResult& pose) { return !pose.converged(); });
  if (failed != simulation.poses.end()) {
    tell(stderr, "condyle: at {:.6g} s: {}\n", failed->value, failed->reason);
    status = kDidNotSucceed;
  }
  return status;
}

/// What an earlier run left, and a word about it.
MotionContents earlier_motion(const SimulateCommand& command, const JournalParts& parts) {
  MotionContents journal = read_motion_journal(journal_path(command.output), parts);
  const std::size_t frames = journal.frames();
  say_what_is_resumed(command.talk, command.output, command.resume, journal.head, parts,
                      frames == 0 ? "" : fmt::format("{} frames", frames));
  return command.resume ? journal : MotionContents{};
}

std::shared_ptr<const Simulation> simulate_aloud(const SimulateCommand& command,
                                                 const Scene& scene,
                                                 const std::vector<FittedSurface>& surfaces,
                                                 MotionContents earlier,
                                                 MotionJournal& journal) {
  Progress progress(command.talk, "frames");
  std::optional<LastWords> words;
  const auto hold_frames = [&] {
    if (!words) words.emplace(last_words(command.output, "frames"));
  };
  if (!earlier.stretches.empty()) hold_frames();
  SimulationKeeping keeping;
  keeping.refinements = std::move(earlier.refinements);
  keeping.stretches = std::move(earlier.stretches);
  keeping.on_refinement = [&](const LatticeRefinement& refinement) { journal.append(refinement); };
  keeping.on_stretch = [&](const MotionStretch& stretch) {
    journal.append(stretch);
    hold_frames();
  };
  return std::make_shared<const Simulation>(simulate(
      scene, surfaces, [&](int done, int total) { progress.at(done, total); }, keeping));
}

int run_simulate(const SimulateCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  auto [scene, surfaces, run] =
      begin_study(talk, command.scene, command.output, [&](const Scene& s) {
        check_simulated_scene(s);
        check_journal_file(command.output, s, kMotionJournal);
      });
  LineFile journal_file(journal_path(command.output), command.output);
  const JournalParts parts = motion_parts(scene, surfaces);
  MotionContents earlier = earlier_motion(command, parts);
  MotionJournal journal(journal_file, kMotionJournal, parts, earlier.whole_bytes);
  const auto simulation = simulate_aloud(command, scene, surfaces, std::move(earlier), journal);
  run.study = simulation;
  run.sweep.poses = simulation->poses;
  if (talk.plain()) print_motion(run);
  write_and_end_journal(talk, command.output, run, journal, "frames");
  CommandSummary facts = clock.summary(talk, command.output, report_failures(*simulation));
  tell_journal_failure(journal, facts);
  return finish(talk, facts, run);
}

}  // namespace

void setup_simulate(CLI::App& program, int& status) {
  const auto options = std::make_shared<SimulateCommand>();
  CLI::App* command = program.add_subcommand(
      "simulate", "Release, strike or drive the knee and follow its motion in time");
  command->add_option("SCENE", options->scene, "scene file (TOML) with [simulate]")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  add_resume_option(*command, options->resume);
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle simulate data/phantom/pendulum.toml -o out/pendulum.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_simulate(*options); });
  });
}

}  // namespace condyle
