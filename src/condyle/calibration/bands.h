#pragma once

/// Joint coordinates and forces of the unloaded knee over flexion, with what prior and posterior leave
/// open.

#include <vector>

#include "condyle/calibration/calibration.h"

namespace condyle {

/// Angles of the bands [rad]: those of [sweep] where it varies the flexion of the tests, else 25 over
/// the flexions of the table, or one where it has but one.
[[nodiscard]] std::vector<double> band_flexions(const Scene& scene, const MeasurementTable& table);

/// Six joint coordinates, the force of each ligament and each contact, of the knee itself: nuisance
/// parameters are no part of it. Delta method; NaN where there is no pose. Needs the fit, what it knows,
/// and the flexions of the bands; its poses are counted in `result`.
[[nodiscard]] std::vector<Band> find_bands(const Scene& scene,
                                           const std::vector<FittedSurface>& surfaces,
                                           CalibrationResult& result);

}  // namespace condyle
