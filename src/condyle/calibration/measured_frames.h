#pragma once

/// Joint coordinates as a measurement tells them whose anatomical frames differ from the scene's.
///
/// Of each bone six numbers: shifts t along [mm] and a turn w about [rad] the axes of its frame,
///     X' = X ∘ (exp([w]x), t)
/// so that X'.p = X.p + R t, R' = R exp([w]x). Exact for frames turned by any w.

#include <array>

#include "condyle/elements/joint_coordinates.h"

namespace condyle {

struct FrameOffsets {
  std::array<double, 6> femur{}, tibia{};
};

[[nodiscard]] JointFrames moved_frames(const JointFrames& frames, const FrameOffsets& offsets);

/// Columns: derivatives of the six joint coordinates, told in the moved frames, by the offsets of the
/// femur's frame, then of the tibia's; [-, 1/mm, mm].
[[nodiscard]] Eigen::Matrix<double, 6, 12> derivatives_by_frames(const JointFrames& frames,
                                                                 const FrameOffsets& offsets,
                                                                 const RigidTransform& X_BA);

}  // namespace condyle
