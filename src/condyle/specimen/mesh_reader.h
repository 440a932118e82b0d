#pragma once

#include <functional>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// What stands in for reading a mesh file, from either of two threads: a mesh in memory, in mm.
using MeshReader = std::function<TriangleMesh(const MeshFile&)>;

}  // namespace condyle
