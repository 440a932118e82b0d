#include "network/simulate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "app/commands.h"
#include "app/make_run.h"
#include "app/progress.h"
#include "app/summary.h"
#include "app/talk.h"
#include "input_error.h"
#include "results/sweep_table.h"

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
  const SweepTable table(scene);
  fmt::print("{}", table.head());
  const std::size_t step = std::max<std::size_t>(1, poses.size() / 30);
  for (std::size_t i = 0; i < poses.size(); i += step) fmt::print("{}", table.row(poses[i]));
}

void print_events(const Scene& scene, const Simulation& simulation) {
  for (const ContactEvent& event : simulation.motion.events) {
    const std::string& contact = scene.contacts[simulation.contact_of[event.contact]].name;
    fmt::print("{:.6f} s: {} {}", event.t, contact, event.closing ? "closes" : "opens");
    if (event.closing && event.speed > 0) fmt::print(" at {:.4g} mm/s", event.speed);
    fmt::print("\n");
  }
}

void print_balance(const Simulation& simulation) {
  const Motion& motion = simulation.motion;
  if (motion.frames.empty()) return;
  const MotionFrame &first = motion.frames.front(), &last = motion.frames.back();
  const auto change = [&](double EnergySum::*part) {
    return (last.energy.*part - first.energy.*part) / kJoule;
  };
  fmt::print(
      "\nEnergy in J: kinetic {:+.6g}, gravity {:+.6g}, ligaments {:+.6g}, dissipated {:.6g}, "
      "loads "
      "gave {:.6g}\n",
      change(&EnergySum::kinetic), change(&EnergySum::gravity), change(&EnergySum::elastic),
      last.dissipated / kJoule, last.driver_work / kJoule);
  fmt::print("Balance kept to {:.1e} of the largest of them\n",
             motion.largest_imbalance / std::max(motion.energy_scale, 1e-300));
  fmt::print("{:.3f} s of motion of {:.4g} kg in {:.3f} s, {} steps\n",
             last.state.t - first.state.t, simulation.mass.mass * 1e3, simulation.seconds,
             motion.steps);
}

void print_motion(const Scene& scene, const Simulation& simulation) {
  print_rows(scene, simulation.poses);
  print_events(scene, simulation);
  print_balance(simulation);
}

int report_failures(const Simulation& simulation) {
  int status = 0;
  if (!simulation.motion.completed) {
    fmt::print(stderr, "condyle: stopped {}\n", simulation.motion.reason);
    status = kDidNotSucceed;
  }
  const auto failed = std::find_if(simulation.poses.begin(), simulation.poses.end(),
                                   [](const PoseResult& pose) { return !pose.converged(); });
  if (failed != simulation.poses.end()) {
    fmt::print(stderr, "condyle: at {:.6g} s: {}\n", failed->value, failed->reason);
    status = kDidNotSucceed;
  }
  return status;
}

int run_simulate(const SimulateCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  auto [scene, surfaces, run] = begin_study(talk, command.scene, command.output, [](Scene& s) {
    if (!s.simulation)
      throw InputError(s.file.string() +
                       ": [simulate] is missing, expected time, rate and gravity");
    s.sweep.reset();  // another command's
  });
  Progress progress(talk, "frames");
  run.simulation =
      simulate(scene, surfaces, [&](int done, int total) { progress.at(done, total); });
  progress.clear();
  run.sweep.poses = run.simulation->poses;
  if (talk.plain()) print_motion(scene, *run.simulation);
  write_run(command.output, run);
  say(talk, "wrote {}\n", command.output);
  return finish(talk, clock.summary(talk, command.output, report_failures(*run.simulation)), run);
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
