#pragma once

/// The path of a described ligament: straight, or wrapped on surfaces fixed to its bodies.

#include <memory>
#include <vector>

#include "condyle/elements/body_origins.h"
#include "condyle/scene/scene.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle {

/// The ends of a ligament, that on the fixed body first.
[[nodiscard]] std::array<Eigen::Vector3d, 2> fixed_then_moving(
    const Scene& scene, const std::array<Attachment, 2>& ends);

/// The surfaces that a ligament may touch, from its end on the fixed body to that on the moving one,
/// half its thickness larger, in the frames of the files.
[[nodiscard]] std::vector<PathWrap> path_wraps(const Scene& scene,
                                               const LigamentDescription& ligament);

/// Index into Scene::wraps of the k-th of these.
[[nodiscard]] int wrap_on_path(const Scene& scene, const LigamentDescription& ligament, int k);

/// Null for a straight ligament. `origins`: of the frames in which it is to be computed.
[[nodiscard]] std::shared_ptr<const WrappedPath> ligament_path(const Scene& scene,
                                                               const LigamentDescription& ligament,
                                                               const BodyOrigins& origins = {});

/// Length [mm] along the path at a pose; 0 where there is no path.
[[nodiscard]] double ligament_length(const Scene& scene,
                                     const LigamentDescription& ligament,
                                     const RigidTransform& X_BA);

}  // namespace condyle
