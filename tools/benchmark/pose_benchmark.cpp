/// What one position of equilibrium costs, warm, in steps of five degrees of flexion, on one
/// thread: exact surfaces and bicubic patches, with and without the search for contacts, and the
/// floor under the patches. Times are per pose; compare them within one run.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/elements/line_element_block.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/small_lu.h"
#include "condyle/surface/patch.h"
#include "support/patch_knee.h"

namespace condyle::benchmarks {
namespace {

constexpr double kStep = 5 * M_PI / 180;
constexpr int kSteps = 18;  // 0 to 90 degrees

enum Knee : int { kQuadrics, kPatches };
enum Effort : int { kNoSearch, kSearch, kAll };

Model knee(Knee kind) { return kind == kQuadrics ? test::quadric_knee() : patch_knee(); }

/// Flexion of visit k: to 90 degrees and back, again and again.
double flexion(int k) {
  const int phase = k % (2 * kSteps);
  return kStep * (phase <= kSteps ? phase : 2 * kSteps - phase);
}

void per_pose(benchmark::State& state, long iterations, long poses) {
  state.counters["iterations"] = static_cast<double>(iterations) / static_cast<double>(poses);
}

/// Newton alone, from the state of the pose before: what a hand-written solver does.
void newton_alone(benchmark::State& state) {
  const Model model = knee(static_cast<Knee>(state.range(0)));
  EquilibriumSolver first(model);
  if (!first.solve().converged()) return state.SkipWithError("the first pose did not converge");
  EquilibriumState now = first.state();
  Newton newton(model);
  Drive drive = drive_of(model);
  long iterations = 0, poses = 0;
  for (auto _ : state) {
    drive.values[0] = flexion(static_cast<int>(++poses % (2 * kSteps)));
    const NewtonReport report = newton.solve(now, drive);
    if (report.outcome != NewtonOutcome::kConverged) return state.SkipWithError("not converged");
    iterations += report.iterations;
  }
  per_pose(state, iterations, poses);
}
BENCHMARK(newton_alone)->ArgName("patches")->Arg(kQuadrics)->Arg(kPatches);

/// The whole solver with its predictor: without the search (contacts held closed), with it, and
/// with the stability of each pose as well.
void pose(benchmark::State& state) {
  Model model = knee(static_cast<Knee>(state.range(0)));
  const auto effort = static_cast<Effort>(state.range(1));
  if (effort == kNoSearch)
    for (ContactPair& pair : model.pairs) pair.mode = ContactMode::kClosed;
  EquilibriumOptions options;
  options.description.stability = effort == kAll;
  EquilibriumSolver solver(std::move(model), options);
  Drive drive = drive_of(solver.model());
  PoseResult result;
  long iterations = 0, poses = 0;
  solver.solve(drive, result);
  for (auto _ : state) {
    drive.values[0] = flexion(static_cast<int>(++poses % (2 * kSteps)));
    solver.solve(drive, result);
    if (!result.converged()) return state.SkipWithError(result.reason.c_str());
    iterations += result.iterations;
  }
  per_pose(state, iterations, poses);
}
BENCHMARK(pose)
    ->ArgNames({"patches", "effort"})
    ->ArgsProduct({{kQuadrics, kPatches}, {kNoSearch, kSearch, kAll}});

/// The least that one iteration on patches costs: four surface points, the ligaments, one 9x9
/// solve.
void floor_of_one_iteration(benchmark::State& state) {
  const Model model = patch_knee();
  LineElementBlock elements(model.elements);
  RigidTransform X;
  SmallLu lu;
  double right[SmallLu::kMaxSize];
  for (auto _ : state) {
    X.p.x() += 1e-9;
    Wrench wrench;
    elements.add_to(X, {}, wrench);
    for (const ContactPair& pair : model.pairs) {
      benchmark::DoNotOptimize(pair.on_B->evaluate(Patch::place(X.p.x(), 0.5)));
      benchmark::DoNotOptimize(pair.on_A->evaluate(Patch::place(X.p.x(), 0.5)));
    }
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j)
        lu(i, j) = i == j ? 10 + i : wrench.F1(i % 3, j % 3) * 1e-4 + 0.1 * (i + 2 * j);
    for (int i = 0; i < 9; ++i) right[i] = i + wrench.f.x();
    lu.factor(9);
    lu.solve(right);
    benchmark::DoNotOptimize(right[0]);
  }
}
BENCHMARK(floor_of_one_iteration);

/// Cost against the number of ligaments.
void ligaments(benchmark::State& state) {
  Model model = test::quadric_knee();
  const std::size_t n = static_cast<std::size_t>(state.range(0)), few = model.elements.size();
  for (LineElement& element : model.elements)
    std::get<ToeLinearLaw>(element.law).stiffness *=
        static_cast<double>(few) / static_cast<double>(n);
  for (std::size_t i = few; i < n; ++i) {
    model.elements.push_back(model.elements[i % few]);
    model.element_names.push_back(model.element_names[i % few]);
  }
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(std::move(model), options);
  Drive drive = drive_of(solver.model());
  PoseResult result;
  long poses = 0;
  solver.solve(drive, result);
  for (auto _ : state) {
    drive.values[0] = flexion(static_cast<int>(++poses % (2 * kSteps)));
    solver.solve(drive, result);
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(ligaments)->RangeMultiplier(5)->Range(8, 1000)->Complexity(benchmark::oN);

}  // namespace
}  // namespace condyle::benchmarks

BENCHMARK_MAIN();
