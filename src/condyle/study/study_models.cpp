#include "condyle/study/study_models.h"

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/sweep.h"

namespace condyle {
namespace {

SweepResult sweep_of(const StudyKnee& knee, const std::vector<double>& values) {
  EquilibriumSolver solver(build_model(knee.scene, knee.surfaces), study_options());
  SweepOptions options;
  options.stability = options.events = false;
  return sweep(solver, swept_of(*knee.scene.sweep), values, options);
}

/// The state of a pose that was told, polished; none where it leads elsewhere.
std::optional<EquilibriumSolver::Standing> standing_at(const PoseResult& told,
                                                       const Drive& drive,
                                                       EquilibriumSolver& solver) {
  if (!told.converged() || !can_restore(solver.model(), told)) return std::nullopt;
  solver.reset();
  solver.set_state(restore_state(solver.model(), told), drive);
  if (!solver.solve(drive, Patience::kNone).converged()) return std::nullopt;
  return solver.standing();
}

}  // namespace

EquilibriumOptions study_options() {
  EquilibriumOptions options;
  options.description.stability = false;
  return options;
}

StudyModel study_model(const Scene& scene,
                       const std::vector<FittedSurface>& surfaces,
                       const std::vector<double>& values,
                       const SweepResult& nominal) {
  StudyModel made;
  made.model = std::make_shared<const Model>(build_model(scene, surfaces));
  made.covers = cover_pairs(*made.model);
  made.swept = swept_of(*scene.sweep);
  EquilibriumSolver solver(made.model, made.covers, study_options());
  Drive drive = drive_of(*made.model);
  for (std::size_t i = 0; i < values.size(); ++i) {
    made.swept.in(drive) = values[i];
    made.nominal.push_back(standing_at(nominal.poses[i], drive, solver));
    if (i == 0) made.searches = solver.searches();
  }
  return made;
}

StudyModels::StudyModels(const StudyPlan& plan) {
  for (const StudyKnee& knee : plan.knees) {
    sweeps_.push_back(sweep_of(knee, plan.values));
    knees_.push_back(study_model(knee.scene, knee.surfaces, plan.values, sweeps_.back()));
    std::vector<FittedMesh>& rough = meshes_.emplace_back();
    if (plan.study.roughness) rough = fitted_meshes(knee.scene, knee.surfaces);
  }
}

}  // namespace condyle
