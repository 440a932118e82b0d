#include "condyle/network/simulate.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/progress.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/input_error.h"
#include "condyle/results/motion_view.h"
#include "condyle/results/sweep_table.h"

namespace condyle {
namespace {

constexpr int kDidNotSucceed = 2;
constexpr double kJoule = 1e3;  // N mm

struct SimulateCommand {
  Talk talk;
  std::string scene, output;
};

/// At most some thirty rows of the table that a sweep prints.
void print_rows(const Scene& scene, const std::vector<PoseResult>& poses) {
  const SweepTable table(scene, quantity_of_motion());
  tell("{}", table.head());
  const std::size_t step = std::max<std::size_t>(1, poses.size() / 30);
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
  tell("Balance kept to {:.1e} of the largest of them\n", motion.imbalance);
  tell("{:.3f} s of motion of {:.4g} kg in {:.3f} s, {} steps\n",
       motion.change(&MotionEnergies::time), mass * 1e3, motion.seconds, motion.steps);
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

int run_simulate(const SimulateCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  auto [scene, surfaces, run] =
      begin_study(talk, command.scene, command.output, [](const Scene& s) {
        if (!s.simulation)
          throw InputError(s.file.string() +
                           ": [simulate] is missing, expected time, rate and gravity");
      });
  Progress progress(talk, "frames");
  const auto simulation = std::make_shared<const Simulation>(
      simulate(scene, surfaces, [&](int done, int total) { progress.at(done, total); }));
  run.study = simulation;
  progress.clear();
  run.sweep.poses = simulation->poses;
  if (talk.plain()) print_motion(run);
  write_run(command.output, run);
  say(talk, "wrote {}\n", command.output);
  return finish(talk, clock.summary(talk, command.output, report_failures(*simulation)), run);
}

}  // namespace

void setup_simulate(CLI::App& program, int& status) {
  const auto options = std::make_shared<SimulateCommand>();
  CLI::App* command = program.add_subcommand(
      "simulate", "Release, strike or drive the knee and follow its motion in time");
  command->add_option("SCENE", options->scene, "scene file (TOML) with [simulate]")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle simulate data/phantom/pendulum.toml -o out/pendulum.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_simulate(*options); });
  });
}

}  // namespace condyle
