#pragma once

/// Triangles as the renderer takes them: positions, smooth normals and a colour per vertex.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/pictures/image.h"

namespace condyle {

struct ShadedVertex {
  Eigen::Vector3f position;  ///< [mm]
  Eigen::Vector3f normal;    ///< unit
  std::array<std::uint8_t, 4>
      color;  ///< sRGB and, in the last byte, how far it shows through bone (255: fully)
};
static_assert(sizeof(ShadedVertex) == 28, "laid out as the vertex buffer expects");

struct ShadedMesh {
  std::vector<ShadedVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Colour and how far it shows through bone, 0 to 1.
struct Paint {
  Rgb color = {128, 128, 128};
  double through = 1;
};
[[nodiscard]] std::array<std::uint8_t, 4> bytes(const Paint& paint);

/// Vertex normals weighted by area and smoothed once or more over the neighbours, so that the
/// roughness of segmentation does not glitter.
[[nodiscard]] ShadedMesh shade(const TriangleMesh& mesh, const Paint& paint, int smoothing = 2);

/// Every edge has two triangles, which run along it in opposite directions, and the volume is
/// positive: from outside no back face is ever seen.
[[nodiscard]] bool is_closed(const TriangleMesh& mesh);

/// Adds `part` to `whole`.
void append(ShadedMesh& whole, const ShadedMesh& part);

}  // namespace condyle
