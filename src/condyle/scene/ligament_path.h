#pragma once

/// The path of a described ligament: straight, or wrapped on surfaces fixed to its bodies.

#include <memory>
#include <string>
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

/// Whether the shapes of all that a ligament wraps on are known: not before fit_wraps
/// (specimen/fit_wraps.h), where one is fitted to its bone.
[[nodiscard]] bool has_known_path(const Scene& scene, const LigamentDescription& ligament);

/// Of a ligament with a known path at the start pose.
struct StartPath {
  double length = 0;          ///< [mm]
  std::string key, expected;  ///< what is wrong: a key of the ligament, and what was expected there
};
[[nodiscard]] StartPath start_path(const Scene& scene, const LigamentDescription& ligament);

/// What speaks against the length of that path as one that a strain is measured on, half a sentence; empty where nothing does.
[[nodiscard]] std::string start_path_objection(const Scene& scene,
                                               const LigamentDescription& ligament);

/// Once the surfaces are known that are fitted to bones: slack lengths that follow from reference
/// strains on them. Throws InputError for an end that lies too deep in such a surface, and where
/// there is no path at the start pose.
void settle_fitted_paths(Scene& scene);

/// Length [mm] along the path at a pose; 0 where there is no path.
[[nodiscard]] double ligament_length(const Scene& scene,
                                     const LigamentDescription& ligament,
                                     const RigidTransform& X_BA);

}  // namespace condyle
