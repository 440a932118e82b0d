#pragma once

/// Does a mesh look like what the scene says it is? Wrong bones and two knees in one file are
/// errors; a knee of the other side is a suspicion, since shapes vary.

#include <string>
#include <vector>

#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// Throws InputError with the figure that gave it away: a mesh that is too wide for one knee.
void check_one_knee(const TriangleMesh& mesh, const BoneFrame& frame);

/// Throws InputError where a mesh said to be a tibia has posterior condyles.
void check_is_no_femur(const CleanMesh& mesh, const BoneFrame& frame);
/// Throws InputError where the axis found in a mesh said to be a femur is none.
void check_is_femur(const CondylarAxis& axis);

/// Which side of a tibia reaches farther from front to back, medial over lateral; 0 where only one
/// plateau is there. Medial plateaus are the longer ones.
[[nodiscard]] double plateau_depth_ratio(const TriangleMesh& mesh, const BoneFrame& frame);

}  // namespace condyle
