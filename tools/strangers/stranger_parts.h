#pragma once

/// The parts of condyle_strangers: each runs its sweeps and writes its section of the page.

#include "strangers/stranger_study.h"

namespace condyle::strangers {

/// Known knees at three loads.
void study_known(Study& study);
/// The same poses whichever way they are reached.
void study_steps(Study& study);
/// The same knee wherever its scanner had its zero.
void study_places(Study& study);
/// Rough bone.
void study_roughness(Study& study);
/// Time, one sweep after the other; the slowest failing pose is of all parts before it.
void study_time(Study& study);

}  // namespace condyle::strangers
