/// condyle_random_knees: sweeps of made-up knees, sound ones and ill ones, each pose judged by other code.
///
///     condyle_random_knees [SWEEPS] [--from K] [--threads N] [--seed S] [--rigid | --layers] [--only K -o FOLDER] [--wrong FILE]
///
/// Prints the table of statuses. --only writes one knee as a scene file and as a run, and says all about
/// it. Ends with 2 where a converged pose is false or anything but an InputError was thrown.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <thread>

#include "condyle/equilibrium/sweep.h"
#include "condyle/results/run_file.h"
#include "condyle/verify/verify.h"
#include "random/random_table.h"

namespace condyle::random_knees {
namespace {

struct Options {
  std::uint64_t sweeps = 1000, from = 0, seed = 1, every = 10;
  int threads = 1;
  std::optional<std::uint64_t> only;
  bool rigid = false, layers = false;
  std::string folder = "out", wrong;
};

LookOptions look_at(std::uint64_t k, const Options& options) {
  const bool closely = options.every > 0 && k % options.every == 0;
  return {closely, closely};
}

void say_all(const Options& options) {
  const std::uint64_t k = *options.only;
  const RandomKnee knee = random_knee(options.seed, k);
  const std::string file = fmt::format("{}/knee-{}", options.folder, k);
  std::ofstream(file + ".toml") << knee.text;
  fmt::print("{}: {}\n", file + ".toml", kind_of(knee));
  const SweepOutcome outcome = sweep_and_judge(knee, {true, true});
  if (!outcome.refused.empty()) return fmt::print("refused: {}\n", outcome.refused);
  Run run = run_of(knee);
  run.sweep = sweep(run.scene, surfaces_of(knee, run.scene));
  for (std::size_t i = 0; i < run.sweep.poses.size(); ++i) {
    const PoseResult& pose = run.sweep.poses[i];
    fmt::print("{} {:.6g}: {}{}{} {} iterations, {:.1f} ms, events {:.1f} ms {} {}\n", i,
               pose.value, name(pose.status), pose.reason.empty() ? "" : ": ", pose.reason,
               pose.iterations, 1e3 * pose.seconds, 1e3 * pose.event_seconds, pose.remark,
               pose.lowest_stiffness);
  }
  for (const std::string& fault : outcome.faults) fmt::print("{}\n", fault);
  if (!outcome.exception.empty()) return fmt::print("exception: {}\n", outcome.exception);
  for (const std::string& line : check_lines(verify_run(run, {true, false, {}})))
    fmt::print("{}\n", line);
  write_run(file + ".h5", run);
}

std::optional<SweepOutcome> outcome_of(std::uint64_t k, const Options& options) {
  const RandomKnee knee = random_knee(options.seed, k);
  if (has_layers(knee) ? options.rigid : options.layers) return std::nullopt;
  return sweep_and_judge(knee, look_at(k, options));
}

std::vector<std::optional<SweepOutcome>> sweep_all(const Options& options) {
  std::vector<std::optional<SweepOutcome>> outcomes(options.sweeps);
  std::atomic<std::uint64_t> next{0};
  std::vector<std::thread> team;
  for (int i = 0; i < options.threads; ++i)
    team.emplace_back([&] {
      for (std::uint64_t k; (k = next++) < options.sweeps;)
        outcomes[k] = outcome_of(options.from + k, options);
    });
  for (std::thread& thread : team) thread.join();
  return outcomes;
}

int run(int argc, char** argv) {
  CLI::App program("Sweeps of random knees, each pose judged by other code");
  Options options;
  program.add_option("SWEEPS", options.sweeps, "how many");
  program.add_option("--from", options.from, "number of the first");
  program.add_option("--seed", options.seed, "of all of them");
  program.add_option("--threads", options.threads, "at work");
  program.add_option("--every", options.every,
                     "which is looked at closely: pushes, second look; 0: none");
  program.add_flag("--rigid", options.rigid, "passes over knees with layers");
  program.add_flag("--layers", options.layers, "passes over knees without layers")
      ->excludes("--rigid");
  program.add_option("--only", options.only, "number of one knee that is told in full");
  program.add_option("-o,--output", options.folder, "folder for that one");
  program.add_option("--wrong", options.wrong, "file for what is wrong, a line each");
  CLI11_PARSE(program, argc, argv);
  if (options.only) {
    say_all(options);
    return 0;
  }
  RandomTable table;
  const std::vector<std::optional<SweepOutcome>> outcomes = sweep_all(options);
  for (std::uint64_t k = 0; k < options.sweeps; ++k)
    if (outcomes[k]) table.add(options.from + k, *outcomes[k]);
  fmt::print("{}", table.text());
  if (!options.wrong.empty()) {
    std::ofstream file(options.wrong);
    for (const std::string& wrong : table.wrongs()) file << wrong << '\n';
  }
  return table.good() ? 0 : 2;
}

}  // namespace
}  // namespace condyle::random_knees

int main(int argc, char** argv) {
  try {
    return condyle::random_knees::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
