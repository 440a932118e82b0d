#pragma once

/// From a described scene to the reference model, and the three ways in which it differs from ours,
/// each of which can be taken alone: surfaces (fit_heights.h), law of the springs, contacts that
/// never open.

#include <vector>

#include "condyle/reference/fit_heights.h"
#include "condyle/reference/wismans_model.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// The strain at which a quadratic spring has the force of the toe-linear law that it stands for.
/// At the usual transition strain the two agree throughout the toe.
inline constexpr double kUsualMatchedStrain = 0.06;

/// Every toe-linear law becomes f = k (l - l₀)², tension only, with the same l₀ and the same force
/// at `strain`. Other laws stay as they are.
[[nodiscard]] Scene with_quadratic_springs(Scene scene, double strain = kUsualMatchedStrain);

/// Every contact held closed: it may pull.
[[nodiscard]] Scene with_closed_contacts(Scene scene);

/// Throws InputError, naming what the model cannot hold: it wants [joint], two contacts and one
/// condition, the flexion.
void check_wismans_scene(const Scene& scene);

/// With the laws of the scene as they are. `heights` as from fit_heights.
[[nodiscard]] WismansModel build_wismans_model(const Scene& scene,
                                               const std::vector<HeightFit>& heights);

}  // namespace condyle
