#pragma once

/// What the choice of smoothing is worth to poses: "auto" beside "position" and beside the best one
/// length for all patches, which takes knowing the truth.

#include "accuracy/study.h"

namespace condyle::accuracy {

/// Adds the table and what has to hold.
void study_smoothed_poses(const Setting& setting, Study& study);

}  // namespace condyle::accuracy
