#pragma once

/// Which side of an open sheet of bone is outside: told where the anatomy is known.

#include "condyle/mesh/clean_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// Turns open components so that they face out of the bone (closed ones do already); returns how
/// many.
int face_out_of_femur(CleanMesh& mesh, const BoneFrame& frame);
int face_out_of_tibia(CleanMesh& mesh, const BoneFrame& frame);

}  // namespace condyle
