/// What derivatives of the five free joint coordinates cost beside a warm pose of the Wismans-type knee:
/// by its twelve reference strains, and by its stiffnesses and insertions too.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/sensitivity.h"
#include "support/spring_knee.h"

namespace condyle::benchmarks {
namespace {

std::vector<ModelParameter> strains(const Model& model) {
  std::vector<ModelParameter> all;
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    all.push_back({ParameterKind::kReferenceStrain, i});
  return all;
}

std::vector<ModelParameter> with_insertions(const Model& model) {
  std::vector<ModelParameter> all = strains(model);
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    all.push_back({ParameterKind::kStiffness, i});
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving})
      for (const int component : {0, 1, 2})
        all.push_back({ParameterKind::kInsertion, i, body, component, Held::kReferenceStrain});
  }
  return all;
}

/// The five free joint coordinates.
std::vector<PoseOutput> coordinates() {
  std::vector<PoseOutput> all;
  for (std::size_t i = 1; i < 6; ++i) all.push_back({OutputKind::kJointCoordinate, i});
  return all;
}

/// `derivatives`: 0 the pose alone, 1 of reference strains, 2 of stiffness and insertions too.
void sensitivity_of_pose(benchmark::State& state) {
  const long derivatives = state.range(0);
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(test::spring_knee(), options);
  Drive drive = drive_of(solver.model());
  PoseResult result;
  solver.solve(drive, result);
  Sensitivity sensitivity(solver.model());
  const std::vector<PoseOutput> outputs = coordinates();
  const std::vector<ModelParameter> parameters =
      derivatives == 2 ? with_insertions(solver.model()) : strains(solver.model());
  Eigen::MatrixXd J;
  long pose = 0;
  for (auto _ : state) {
    drive.values[0] = 0.02 * std::sin(0.1 * static_cast<double>(++pose));
    solver.solve(drive, result);
    if (!result.converged()) return state.SkipWithError(result.reason.c_str());
    if (derivatives == 0) continue;
    if (!sensitivity.set(solver.linearized_solution())) return state.SkipWithError("singular");
    sensitivity.derivatives(outputs, parameters, J);
    benchmark::DoNotOptimize(J.data());
  }
  state.counters["parameters"] = derivatives == 0 ? 0 : static_cast<double>(parameters.size());
}
BENCHMARK(sensitivity_of_pose)->ArgName("derivatives")->Arg(0)->Arg(1)->Arg(2);

}  // namespace
}  // namespace condyle::benchmarks
