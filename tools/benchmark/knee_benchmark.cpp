/// What a whole knee costs: four patches from mesh files, and a sweep of 25 poses on them.

#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::benchmarks {
namespace {

const std::filesystem::path kRoot = CONDYLE_SOURCE_DIR;
const std::filesystem::path kPhantom = kRoot / "data/phantom/knee.toml";
/// A living knee, of its full meshes; beside the project and not everywhere.
const std::filesystem::path kLenhart = kRoot / "../shared/specimens/lenhart2015/knee.toml";

/// Reads and cleans the meshes as well; every smoothing length is chosen from the data.
void knee_fit(benchmark::State& state, const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return state.SkipWithError("no such specimen here");
  Scene scene = read_scene(file);
  for (SurfaceDescription& surface : scene.surfaces) surface.patch.smoothing.reset();
  for (auto _ : state) benchmark::DoNotOptimize(fit_surfaces(scene));
}
BENCHMARK_CAPTURE(knee_fit, phantom, kPhantom)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(knee_fit, lenhart2015, kLenhart)->UseRealTime()->Unit(benchmark::kMillisecond);

/// 0 to 120 degrees by 5, without the search for events between the poses.
void knee_sweep(benchmark::State& state, const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return state.SkipWithError("no such specimen here");
  Scene scene = read_scene(file);
  scene.sweep->values.clear();
  for (int k = 0; k <= 24; ++k) scene.sweep->values.push_back(5 * k * M_PI / 180);
  const auto surfaces = fit_surfaces(scene);
  SweepOptions options;
  options.events = false;
  int converged = 0;
  for (auto _ : state) {
    const SweepResult result = sweep(scene, surfaces, options);
    converged = 0;
    for (const PoseResult& pose : result.poses) converged += pose.converged();
  }
  state.counters["converged"] = converged;
}
BENCHMARK_CAPTURE(knee_sweep, phantom, kPhantom)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(knee_sweep, lenhart2015, kLenhart)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace condyle::benchmarks
