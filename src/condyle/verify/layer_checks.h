#pragma once

/// Contacts that carry by elastic layers: the stored field point by point, its sums, and the force
/// anew on a grid that has nothing to do with the solver's. docs/contact.md has the law.

#include <vector>

#include "condyle/verify/pose_checks.h"

namespace condyle::verification {

/// Depth, pressure and place of every stored point; what they add up to; what the law gives on
/// cells over both surfaces that are halved until the force settles; how deep the layers are pressed.
void check_layers(const Subject& subject, const PoseResult& pose, Ledger& ledger);

/// Of the depth that layers bear, so much is allowed.
inline constexpr double kDepthAllowed = 1.01;

/// So deep a contact's surfaces may overlap by its layers [mm].
[[nodiscard]] double bearable_depth(const Subject& subject, std::size_t contact);

/// Energy of the layers of a pose's contacts, its stored points carried to X [N mm].
[[nodiscard]] double layer_energy(const Subject& subject,
                                  const PoseResult& pose,
                                  const RigidTransform& X);

}  // namespace condyle::verification
