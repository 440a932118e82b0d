#pragma once

/// The 16 equations of the model, all at once, with their derivatives.
///
/// Rows of contact c = 0, 1, from 5 c on:   c_B - (a + R c_A) = 0 (3),   t_B·(R n_A) = 0 (2).
/// Rows 10 to 15 are the principle of virtual work: with q = (a, flexion, adduction, internal
/// rotation) the generalised forces Q_i = Σ F·∂x/∂q_i vanish, but for the flexion moment M:
///     Q_a = 0 (3),   Q_flexion - M = 0,   Q_adduction = 0,   Q_internal rotation = 0.
/// A spring has Q_i = -f ∂L/∂q_i, a contact Q_i = p n_B·∂x/∂q_i at its point on A.

#include "condyle/math/rigid_transform.h"
#include "condyle/reference/wismans_model.h"

namespace condyle {

struct WismansSystem {
  WismansVector residual;  ///< [mm], [-], [N], [N mm]
  WismansMatrix jacobian;  ///< ∂residual/∂unknowns
  double force_scale = 0;  ///< sum of the magnitudes of all forces [N]
};
[[nodiscard]] WismansSystem assemble(const WismansModel& model, const WismansVector& unknowns);

/// The pose that the unknowns stand for.
[[nodiscard]] RigidTransform pose_of(const WismansModel& model, const WismansVector& unknowns);

}  // namespace condyle
