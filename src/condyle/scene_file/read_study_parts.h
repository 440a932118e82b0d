#pragma once

/// The parts of a study file, each read into the study in the units used inside. Called in this order
/// by read_study.

#include <vector>

#include "condyle/scene/study_with_scenes.h"
#include "condyle/scene_file/section.h"

namespace condyle {

/// The key `specimens`: their paths and the scenes, whose sweeps visit the same values.
void read_specimens(const Section& root, ReadStudy& read);

/// The [[vary]] tables, or what [calibrate] of the first scene leaves free: the same numbers of each
/// scene, and the roughness.
void read_varied_numbers(const Section& root, ReadStudy& read);

}  // namespace condyle
