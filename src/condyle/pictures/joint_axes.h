#pragma once

/// The anatomical frames of a joint, drawn as arrows from their origins: the femur's thick, the
/// tibia's thin.

#include "condyle/pictures/shaded_mesh.h"
#include "condyle/pictures/staging.h"

namespace condyle {

/// Colours of the three directions, told apart by colour-blind readers too [Okabe and Ito 2008].
inline constexpr Rgb kLateralColor = {213, 94, 0}, kAnteriorColor = {0, 114, 178},
                     kProximalColor = {0, 158, 115};

/// Of the bodies that are shown, in P; nothing for a scene without [joint].
[[nodiscard]] ShadedMesh joint_axes(const Scene& scene,
                                    const Staging& staging,
                                    const std::vector<RigidTransform>& X_P);

}  // namespace condyle
