#pragma once

/// What moves what: derivatives of all that the poses of a sweep tell by the numbers that its scene
/// asks for ([sweep] sensitivities), at poses that are solved already. A sweep without them does not
/// come here.

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

#include "condyle/equilibrium/pose_output.h"
#include "condyle/equilibrium/scene_numbers.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

struct SensitivityOutput {
  std::string place;  ///< under /sweep: "joint/flexion", "contacts/medial/force"
  Unit unit;          ///< in which results tell it: deg, mm, N or N mm
  PoseOutput output;
};

struct SweepSensitivities {
  std::vector<SensitivityOutput> outputs;
  std::vector<SceneParameter> parameters;
  /// Outputs by parameters, one matrix a pose, in the units used inside; NaN where the pose did not
  /// converge, or has no derivatives: Newton's matrix is singular there.
  std::vector<Eigen::MatrixXd> by_pose;
  /// Contacts that are about to open or to close at a pose, by name, with commas: derivatives are
  /// those of one side (sensitivity.h). Mostly empty.
  std::vector<std::string> one_sided;
};

/// The six joint coordinates where the scene has a joint, the force of each contact and ligament,
/// the multiplier of each condition.
[[nodiscard]] std::vector<SensitivityOutput> sensitivity_outputs(const Scene& scene);

/// At each pose of the scene's sweep, by steps or by arc length: Newton polishes it on the contacts
/// that it has, and its matrix has the derivatives. Null where the scene asks for none: then nothing
/// is built or computed.
[[nodiscard]] std::shared_ptr<const SweepSensitivities> sweep_sensitivities(
    const Scene& scene,
    const std::vector<FittedSurface>& surfaces,
    const std::vector<PoseResult>& poses);

}  // namespace condyle
