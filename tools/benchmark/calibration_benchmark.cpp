/// What a fit of the Wismans-type knee asks for: 65 poses and 325 rows with their derivatives by twelve
/// reference strains, by stiffnesses too, and by insertions too, at numbers that change from one
/// evaluation to the next; and how long the first poses take.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/calibration/predictions.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/measured_knee.h"

namespace condyle::benchmarks {
namespace {

std::vector<FreeParameter> parameters_of(const Scene& scene, long how_many) {
  std::vector<FreeParameter> parameters = test::free_strains(scene);
  for (std::size_t i = 0; i < scene.ligaments.size() && how_many > 12; ++i)
    parameters.push_back(test::free_number("stiffness", {ParameterKind::kStiffness, i}, 0.3, true));
  for (std::size_t i = 0; i < scene.ligaments.size() && how_many > 24; ++i)
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving})
      for (const int component : {0, 1, 2})
        parameters.push_back(test::free_number(
            "insertion", {ParameterKind::kInsertion, i, body, component, Held::kReferenceStrain},
            2));
  return parameters;
}

void evaluate_calibration(benchmark::State& state, bool derivatives) {
  const Scene scene = test::measured_knee();
  const MeasurementTable table = test::table_of_laxity(scene);
  const std::vector<FreeParameter> parameters = parameters_of(scene, state.range(0));
  Predictions predictions(scene, fit_surfaces(scene), table, parameters);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(parameters.size())), y;
  Eigen::MatrixXd J;
  const long before = predictions.counts().poses;
  long step = 0;
  for (auto _ : state) {
    ++step;
    for (Eigen::Index j = 0; j < theta.size(); ++j)
      theta[j] = 0.1 * parameters[static_cast<std::size_t>(j)].prior_sd *
                 std::sin(0.7 * static_cast<double>(step) + static_cast<double>(j));
    if (!predictions.evaluate(theta, y, derivatives ? &J : nullptr))
      return state.SkipWithError(predictions.failure().c_str());
    benchmark::DoNotOptimize(y.data());
  }
  state.counters["poses"] = benchmark::Counter(
      static_cast<double>(predictions.counts().poses - before), benchmark::Counter::kIsRate);
}

void calibration_poses(benchmark::State& state) { evaluate_calibration(state, false); }
void calibration_derivatives(benchmark::State& state) { evaluate_calibration(state, true); }
BENCHMARK(calibration_poses)->ArgName("parameters")->Arg(12)->Unit(benchmark::kMicrosecond);
BENCHMARK(calibration_derivatives)
    ->ArgName("parameters")
    ->Arg(12)
    ->Arg(24)
    ->Arg(96)
    ->Unit(benchmark::kMicrosecond);

/// Model, samples of the contact search, and the walk from the start pose to all 65 poses.
void calibration_start(benchmark::State& state) {
  const Scene scene = test::measured_knee();
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const MeasurementTable table = test::table_of_laxity(scene);
  const std::vector<FreeParameter> parameters = test::free_strains(scene);
  for (auto _ : state) {
    const Predictions predictions(scene, surfaces, table, parameters);
    state.counters["poses"] = static_cast<double>(predictions.counts().poses);
  }
}
BENCHMARK(calibration_start)->Unit(benchmark::kMillisecond);

/// The same for another thread.
void calibration_copy(benchmark::State& state) {
  const Scene scene = test::measured_knee();
  const Predictions predictions(scene, fit_surfaces(scene), test::table_of_laxity(scene),
                                test::free_strains(scene));
  for (auto _ : state) benchmark::DoNotOptimize(Predictions(predictions).rows());
}
BENCHMARK(calibration_copy)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace condyle::benchmarks
