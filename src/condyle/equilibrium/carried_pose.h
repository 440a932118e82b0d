#pragma once

/// A start for a pose from another one: what is prescribed has its new values, the rest stays.

#include "condyle/equilibrium/drive.h"

namespace condyle {

/// The pose X_BA at which the conditions hold with the values of the drive, the joint coordinates that none prescribes
/// being those of `X_BA`; without a joint by the least motion (da, L dπ). Conditions that cannot be
/// met are met as nearly as ten linear steps get.
[[nodiscard]] RigidTransform carried(const Model& model,
                                     const Drive& drive,
                                     const RigidTransform& X_BA);

}  // namespace condyle
