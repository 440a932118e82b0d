#pragma once

/// From two meshes to a described knee: unit, side and frames from their shape, ligaments from a
/// template, and a start pose with the surfaces in touch. docs/new.md.

#include "condyle/anatomy/new_knee.h"

namespace condyle {

/// Throws InputError: the file and what is wrong with it, or what cannot be told and the option
/// that settles it.
[[nodiscard]] NewKnee knee_from_meshes(const NewKneeFiles& files, const RecogniseOptions& options);

}  // namespace condyle
