/// What a motion costs: computing time against the time that passes on the knee, for two
/// tolerances, and one evaluation of a network's equations against its number of ports.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/network/network_equations.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::benchmarks {
namespace {

/// Argument: minus the power of ten of the tolerance. Fits are made once and not timed.
void motion(benchmark::State& state, const char* file) {
  Scene scene = read_scene(std::string(CONDYLE_SOURCE_DIR "/data/phantom/") + file);
  scene.simulation->tolerance = std::pow(10.0, -static_cast<double>(state.range(0)));
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  double computed = 0, passed = 0;
  Motion last;
  for (auto _ : state) {
    Simulation simulation = simulate(scene, surfaces);
    state.SetIterationTime(simulation.seconds);
    computed += simulation.seconds;
    last = std::move(simulation.motion);
    passed += last.frames.back().state.t;
  }
  state.counters["real_time"] = passed / computed;
  state.counters["steps"] = static_cast<double>(last.steps);
  state.counters["evaluations"] = static_cast<double>(last.evaluations);
  state.counters["us_a_step"] =
      1e6 * computed / static_cast<double>(state.iterations() * last.steps);
  state.counters["imbalance"] = last.largest_imbalance / last.energy_scale;
}
BENCHMARK_CAPTURE(motion, pendulum, "pendulum.toml")
    ->Arg(5)
    ->Arg(7)
    ->Arg(9)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(motion, blow, "blow.toml")
    ->Arg(5)
    ->Arg(7)
    ->Arg(9)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(motion, decaying_sine, "decaying-sine.toml")
    ->Arg(5)
    ->Arg(7)
    ->Arg(9)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// A body on as many springs as the argument says.
Network springs(int count) {
  Network network;
  MassProperties mass;
  mass.mass = 4e-3;
  mass.inertia = Eigen::Vector3d(100, 100, 8).asDiagonal();
  network.bodies = {{"body", mass, mass.center, false}};
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d at(30 * std::cos(i), 30 * std::sin(i), std::fmod(0.7 * i, 20));
    const int ground = add_port(network, "a", kGround, 2 * at);
    LineComponent line;
    line.from = ground;
    line.to = add_port(network, "b", 0, at);
    line.law = ForceLaw(QuadraticLaw{0.1, 20});
    network.lines.push_back(line);
  }
  return network;
}

void evaluation(benchmark::State& state) {
  const Network network = springs(static_cast<int>(state.range(0)));
  NetworkEquations equations(network);
  NetworkState at;
  at.bodies.resize(1);
  for (auto _ : state) {
    at.bodies[0].v.x() += 1e-9;
    benchmark::DoNotOptimize(equations.assemble(at) && equations.solve());
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(evaluation)
    ->RangeMultiplier(4)
    ->Range(8, 2048)
    ->Unit(benchmark::kMicrosecond)
    ->Complexity(benchmark::oN);

}  // namespace
}  // namespace condyle::benchmarks
