#pragma once

/// What all threads of a study share: of each knee its model with the covers of its contacts, and where
/// it stands at each value of the sweep with its scene's own numbers.

#include <memory>
#include <optional>
#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/study/rough_mesh.h"
#include "condyle/study/study_plan.h"

namespace condyle {

/// Of one knee, or of one sample of a knee whose meshes are rough anew.
struct StudyModel {
  std::shared_ptr<const Model> model;
  ContactCovers covers;
  Swept swept;
  /// By values; none where the pose was not found.
  std::vector<std::optional<EquilibriumSolver::Standing>> nominal;
  std::vector<ContactSearch> searches;  ///< as the nominal pose at the first value leaves them
};

[[nodiscard]] StudyModel study_model(const Scene& scene,
                                     const std::vector<FittedSurface>& surfaces,
                                     const std::vector<double>& values,
                                     const SweepResult& nominal);

/// As the workers' solvers: what a pose is told of is no more than what a study keeps.
[[nodiscard]] EquilibriumOptions study_options();

class StudyModels {
 public:
  explicit StudyModels(const StudyPlan& plan);

  [[nodiscard]] const StudyModel& knee(std::size_t i) const { return knees_[i]; }
  [[nodiscard]] const SweepResult& nominal(std::size_t i) const { return sweeps_[i]; }
  /// What is made rough; empty where nothing is.
  [[nodiscard]] const std::vector<FittedMesh>& meshes(std::size_t i) const { return meshes_[i]; }

 private:
  std::vector<SweepResult> sweeps_;
  std::vector<StudyModel> knees_;
  std::vector<std::vector<FittedMesh>> meshes_;
};

}  // namespace condyle
