#pragma once

/// The start pose of a new knee: as scanned, brought to the flexion that the template's strains are
/// given for, and its surfaces in touch.

#include "condyle/anatomy/new_knee.h"

namespace condyle {

/// Fits the surfaces of the scene that the knee would be written as, and fills `knee.start` and the
/// doubts about it.
void find_start(NewKnee& knee);

}  // namespace condyle
