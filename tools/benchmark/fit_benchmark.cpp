/// What a fit costs: points with known parameters onto a patch, against their number.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/surface/fit_system.h"

namespace condyle::benchmarks {
namespace {

SplineGrid grid() {
  return {.degree = 3, .nu = 30, .nv = 20, .u_min = 0, .u_max = 70, .v_min = 0, .v_max = 40};
}

std::vector<DataPoint> points(int count) {
  std::vector<DataPoint> result;
  result.reserve(count);
  for (int i = 0; i < count; ++i) {
    const double u = 70 * std::fmod(0.7548776662 * (i + 1), 1),
                 v = 40 * std::fmod(0.5698402910 * (i + 1), 1);
    result.push_back({{u, v, 0.01 * u * u + std::sin(v / 9)}, {u, v}, 1});
  }
  return result;
}

/// Normal equations and their solution; the penalty is the same for any number of points.
void fit_points(benchmark::State& state) {
  const std::vector<DataPoint> data = points(static_cast<int>(state.range(0)));
  const std::vector<CellMetric> cells(
      static_cast<std::size_t>(grid().cells_u() * grid().cells_v()));
  const PenaltyTerm penalty = assemble_penalty(grid(), cells);
  for (auto _ : state)
    benchmark::DoNotOptimize(solve_fit(assemble_data(grid(), data), penalty, 1.5));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(fit_points)
    ->Arg(25000)
    ->Arg(50000)
    ->Arg(100000)
    ->Arg(200000)
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oN);

}  // namespace
}  // namespace condyle::benchmarks
