#pragma once

/// Newton-Raphson on all 16 unknowns at once, and a sweep with it: each value from the one before,
/// the step halved where that fails. No contact opens: one that pulls is reported as such.

#include <optional>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/reference/wismans_model.h"

namespace condyle {

struct WismansOptions {
  int max_iterations = 60;
  double longest_step = 4;    ///< [mm] of a translation or a surface coordinate in one iteration
  double largest_turn = 0.1;  ///< [rad] in one iteration
  int halvings = 8;           ///< of a step of the sweep
};

struct WismansSolution {
  PoseStatus status = PoseStatus::kNotComputed;
  WismansVector unknowns = WismansVector::Zero();
  int iterations = 0;
  double residual = 0;  ///< largest out-of-balance force [N], moments divided by L
  [[nodiscard]] bool converged() const { return status == PoseStatus::kConverged; }
};

/// Newton-Raphson from `start`.
[[nodiscard]] WismansSolution solve(const WismansModel& model,
                                    const WismansVector& start,
                                    const WismansOptions& options = {});

/// Unknowns to start from at a pose in the model's frames: the coordinates where the surfaces of
/// each pair are nearest (over a grid), and the contact forces and the moment that balance best.
[[nodiscard]] WismansVector first_guess(const WismansModel& model, const RigidTransform& X_BA);

/// What the solution says about the pose, in the engine's words.
[[nodiscard]] PoseResult describe(const WismansModel& model, const WismansSolution& solution);

/// Solves over values of the flexion or of the factor on a load (`load`, an index). The first pose
/// starts at the model's own start, and where that leads nowhere at `other_starts`, poses in the
/// frames of files as that.
[[nodiscard]] SweepResult sweep(WismansModel model,
                                std::optional<std::size_t> load,
                                const std::vector<double>& values,
                                const std::vector<RigidTransform>& other_starts = {},
                                const WismansOptions& options = {});

}  // namespace condyle
