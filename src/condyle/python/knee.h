#pragma once

/// What stands behind the objects of the Python module: plain C++, constant once made, shared between threads and kept
/// alive by whoever looks at it. Nothing here knows Python.

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "condyle/elements/load.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/on_progress.h"
#include "condyle/results/run_file.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle::python {

/// A load of one's own: the wrench on the moving body about the origin of its frame, both as the scene has them.
using OwnLoad = std::function<void(const RigidTransform& X_BA, Wrench& wrench)>;

/// A scene with functions that no file can hold: laws stand in `scene`, loads beside it.
struct KneeScene {
  Scene scene;
  std::map<std::size_t, OwnLoad> loads = {};  ///< by index into Scene::loads
  std::string own_function = {};              ///< '[[ligament]] "aACL": law', where there is one

  /// Throws InputError where it has functions of its own: `what` cannot hold them.
  void expect_writable(const std::string& what) const;
};

/// A scene whose surfaces are fitted, with its wraps.
struct FittedKnee {
  KneeScene knee;
  std::vector<FittedSurface> surfaces;
  std::vector<InputFile> meshes;  ///< as they were before
};
/// Throws InputError as fit_surfaces; what `on_patch` throws comes through.
[[nodiscard]] std::shared_ptr<const FittedKnee> fit_knee(const KneeScene& scene,
                                                         const OnProgress& on_patch);

/// The surfaces of `fitted` with what else `scene` says: ligaments, loads, conditions. Throws InputError where its surfaces
/// have other names, bodies or kinds.
[[nodiscard]] std::shared_ptr<const FittedKnee> with_surfaces_of(const FittedKnee& fitted,
                                                                 const KneeScene& scene);

/// A number that drives a knee, in the unit of its scene.
struct DrivenNumber {
  Swept which;
  double factor = 1;  ///< to the unit used inside
};

/// A model that any number of solvers share.
class KneeModel {
 public:
  explicit KneeModel(std::shared_ptr<const FittedKnee> fitted);

  [[nodiscard]] const Scene& scene() const { return fitted_->knee.scene; }
  [[nodiscard]] const FittedKnee& fitted() const { return *fitted_; }
  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return model_; }
  [[nodiscard]] const ContactCovers& covers() const { return covers_; }
  /// Names of conditions, NAME.scale and, where no condition has that name, NAME of loads.
  [[nodiscard]] const std::map<std::string, DrivenNumber, std::less<>>& driven() const {
    return driven_;
  }
  /// A run of this knee without poses: patches, meshes, warnings. Made once.
  [[nodiscard]] const Run& empty_run() const;
  /// From the scene's start pose, by a solver that starts anew; any number of threads may ask.
  [[nodiscard]] PoseResult solve_anew(const Drive& drive) const;

 private:
  std::shared_ptr<const FittedKnee> fitted_;
  std::shared_ptr<const Model> model_;
  ContactCovers covers_;
  std::map<std::string, DrivenNumber, std::less<>> driven_;
  mutable std::mutex making_run_, lending_;
  mutable std::vector<std::unique_ptr<EquilibriumSolver>> idle_;  ///< as newly made
  mutable std::unique_ptr<const Run> empty_run_;
};

}  // namespace condyle::python
