#pragma once

/// What a result file holds of a calibration: /calibrate and /posterior (docs/results.md). Angles in
/// deg, lengths in mm, whatever is told of them.

#include "condyle/calibration/calibration.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

/// `scene` has the calibration that was asked for.
void write_calibration(const Hdf5Group& root,
                       const Scene& scene,
                       const CalibrationResult& calibration);
[[nodiscard]] CalibrationResult read_calibration(const Hdf5Group& root, const Scene& scene);

}  // namespace condyle
