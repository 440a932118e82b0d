/// What one position of equilibrium of the shipped phantom costs with elastic layers, warm, a degree
/// from pose to pose, on one thread; beside rigid points on the same patches.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::benchmarks {
namespace {

constexpr double kStep = M_PI / 180;
constexpr int kSteps = 90;

/// The phantom's layers with a tolerance of the force by the lattice; rigid where it is 0.
Model phantom(double tolerance) {
  Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/layered.toml");
  static const auto surfaces = fit_surfaces(scene);
  for (ContactDescription& contact : scene.contacts)
    if (tolerance > 0)
      contact.layer->tolerance = tolerance;
    else
      contact.layer.reset();
  return build_model(scene, surfaces);
}

/// To 90 degrees and back, again and again. `range(0)`: tolerance in thousandths, 0 for rigid points.
void layered_pose(benchmark::State& state) {
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(phantom(1e-3 * static_cast<double>(state.range(0))), options);
  Drive drive = drive_of(solver.model());
  PoseResult result;
  long iterations = 0, poses = 0, points = 0;
  double error = 0;
  const auto solve = [&] {
    const int phase = static_cast<int>(poses++ % (2 * kSteps));
    drive.values[0] = kStep * (phase <= kSteps ? phase : 2 * kSteps - phase);
    solver.solve(drive, result);
    return result.converged();
  };
  while (poses < 2 * kSteps)
    if (!solve()) return state.SkipWithError(result.reason.c_str());
  poses = 0;
  for (auto _ : state) {
    if (!solve()) return state.SkipWithError(result.reason.c_str());
    iterations += result.iterations;
    for (const ContactResult& contact : result.contacts) {
      if (!contact.layer) continue;
      points += contact.layer->points;
      error = std::max(error, contact.layer->error);
    }
  }
  const auto count = static_cast<double>(poses);
  state.counters["iterations"] = static_cast<double>(iterations) / count;
  state.counters["points"] = static_cast<double>(points) / count;
  state.counters["error"] = error;
}
BENCHMARK(layered_pose)
    ->ArgName("tolerance")
    ->Arg(0)
    ->Arg(1)
    ->Arg(10)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace condyle::benchmarks
