#include "condyle/exchange/glb_solids.h"

#include <cmath>
#include <numbers>

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Turned about y: a profile of rings (radius, height, normal's share outwards and upwards).
struct Ring {
  double radius, height, outward, upward;
};
GlbMesh turned(const std::string& name, int material, const std::vector<Ring>& rings) {
  constexpr std::uint32_t kSides = 16;
  GlbMesh mesh;
  mesh.name = name;
  mesh.material = material;
  for (const Ring& ring : rings) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides, c = std::cos(angle),
                   s = std::sin(angle);
      mesh.positions.push_back(
          Vector3d(ring.radius * s, ring.height, ring.radius * c).cast<float>());
      mesh.normals.push_back(
          Vector3d(ring.outward * s, ring.upward, ring.outward * c).normalized().cast<float>());
    }
  }
  for (std::uint32_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = r * kSides + i, b = r * kSides + (i + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  }
  return mesh;
}

}  // namespace

GlbMesh unit_cylinder(const std::string& name, int material, double radius) {
  return turned(name, material,
                {{0, 0, 0, -1},
                 {radius, 0, 0, -1},
                 {radius, 0, 1, 0},
                 {radius, 1, 1, 0},
                 {radius, 1, 0, 1},
                 {0, 1, 0, 1}});
}

GlbMesh diamond(const std::string& name, int material, double radius) {
  GlbMesh mesh;
  mesh.name = name;
  mesh.material = material;
  for (int octant = 0; octant < 8; ++octant) {
    const Vector3d sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const bool mirrored = sign.prod() < 0;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int axis = 0; axis < 3; ++axis) {
      const int k = mirrored ? 2 - axis : axis;
      mesh.positions.push_back((radius * sign[k] * Vector3d::Unit(k)).cast<float>());
      mesh.normals.push_back(sign.normalized().cast<float>());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

GlbMesh ball(const std::string& name, int material, double radius) {
  std::vector<Ring> rings;
  for (int i = 0; i <= 10; ++i) {
    const double latitude = std::numbers::pi * (i / 10.0 - 0.5);
    const double out = i == 0 || i == 10 ? 0 : std::cos(latitude), up = std::sin(latitude);
    rings.push_back({radius * out, radius * up, out, up});
  }
  return turned(name, material, rings);
}

}  // namespace condyle
