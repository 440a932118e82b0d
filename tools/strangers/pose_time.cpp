#include "strangers/pose_time.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "accuracy/clock.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/model_parameter.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::strangers {
namespace {

/// The nominal parameters with each reference strain moved.
Parameters drawn_strains(const Model& model, double sd, std::mt19937_64& engine) {
  std::normal_distribution<double> normal(0, 1);
  Parameters parameters = parameters_of(model);
  Drive drive = drive_of(model);
  for (std::size_t i = 0; i < model.elements.size(); ++i)
    change({ParameterKind::kReferenceStrain, i}, sd * normal(engine), model, parameters, drive);
  return parameters;
}

}  // namespace

PoseTime pose_time(const std::filesystem::path& file, double strain_sd, int sweeps) {
  const Scene scene = read_scene(file);
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(build_model(scene, fit_surfaces(scene)), options);
  const Swept flexion = condition_value(static_cast<std::size_t>(scene.sweep->index));
  Drive drive = flexion.with(drive_of(solver.model()), 0);
  PoseResult pose;
  solver.solve(drive, pose);
  const EquilibriumSolver::Standing start = solver.standing();
  std::mt19937_64 engine(1);
  std::vector<double> times;
  PoseTime found;
  for (int i = 0; i < sweeps; ++i) {
    solver.reset();
    solver.set_parameters(drawn_strains(solver.model(), strain_sd, engine));
    solver.go_back(start);
    for (int step = 0; step <= 18; ++step) {
      flexion.in(drive) = step * 5 * M_PI / 180;
      times.push_back(
          accuracy::processor_microseconds([&] { solver.solve(drive, pose, Patience::kWay); }));
      found.failed += pose.converged() ? 0 : 1;
    }
  }
  found.poses = static_cast<int>(times.size());
  for (const double time : times) found.mean += time / static_cast<double>(times.size());
  std::nth_element(times.begin(), times.begin() + found.poses / 2, times.end());
  found.median = times[static_cast<std::size_t>(found.poses) / 2];
  return found;
}

}  // namespace condyle::strangers
