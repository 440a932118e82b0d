#pragma once

/// The shipped scene carried to another phantom knee.

#include <Eigen/Core>

#include <string>

#include "condyle/scene/scene.h"
#include "phantom/phantom_shape.h"

namespace condyle::phantom {

/// A point of the shipped phantom's bone on another one: sized with it, then moved along the normal
/// until it lies as deep in proportion to the bone's depth, outside positive [mm].
[[nodiscard]] Eigen::Vector3d carried_point(Bone bone,
                                            const Eigen::Vector3d& p,
                                            const PhantomParameters& knee);

/// The text of the shipped scene with the title and meshes of the knee `name` ("P001": "P001_femur.stl",
/// "P001_tibia.stl"), its insertions and the points of application of its loads, to 1e-7 mm. Reference
/// strains, stiffnesses, loads and the frames of the joint stay as they are. Throws InputError for a
/// scene with bodies of its own or with wraps.
[[nodiscard]] std::string carried_scene_text(const Scene& shipped,
                                             const PhantomParameters& knee,
                                             const std::string& name);

}  // namespace condyle::phantom
