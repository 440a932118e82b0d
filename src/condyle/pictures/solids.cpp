#include "condyle/pictures/solids.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace condyle {
namespace {

constexpr int kSides = 12;
constexpr int kCapRings = 3;

/// A circle of a surface of revolution: where, how wide, and how far its normals lean along the
/// axis.
struct Ring {
  Eigen::Vector3d center;
  double radius;
  double lean;  ///< cosine between normal and axis
  std::array<std::uint8_t, 4> color;
};

Eigen::Vector3d any_perpendicular(const Eigen::Vector3d& axis) { return axis.unitOrthogonal(); }

/// Rings around `axis` with the side direction x, appended and sewn to the ring before.
void add_ring(ShadedMesh& mesh,
              const Ring& ring,
              const Eigen::Vector3d& axis,
              const Eigen::Vector3d& x,
              bool sew) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const Eigen::Vector3d y = axis.cross(x);
  const double across = std::sqrt(std::max(0.0, 1 - ring.lean * ring.lean));
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const Eigen::Vector3d out = std::cos(angle) * x + std::sin(angle) * y;
    mesh.vertices.push_back({(ring.center + ring.radius * out).cast<float>(),
                             (across * out + ring.lean * axis).cast<float>(), ring.color});
  }
  if (!sew) return;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides, below = first - kSides;
    mesh.triangles.push_back({below + i, below + j, first + j});
    mesh.triangles.push_back({below + i, first + j, first + i});
  }
}

Eigen::Vector3d direction_at(const std::vector<TubePoint>& line, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, line.size() - 1);
  return (line[after].center - line[before].center).normalized();
}

/// Half a ball at the end of a tube: sign -1 at its start, +1 at its end.
void add_cap(ShadedMesh& mesh,
             const TubePoint& end,
             const Eigen::Vector3d& axis,
             const Eigen::Vector3d& x,
             int sign) {
  for (int k = 0; k < kCapRings; ++k) {
    const int step = sign < 0 ? kCapRings - k : k + 1;
    const double lean = sign * std::sin(0.5 * std::numbers::pi * step / kCapRings);
    const double wide = std::max(1e-3, std::sqrt(std::max(0.0, 1 - lean * lean)));
    add_ring(mesh,
             {end.center + lean * end.radius * axis, wide * end.radius, lean, bytes(end.paint)},
             axis, x, sign > 0 || k > 0);
  }
}

}  // namespace

ShadedMesh tube(const std::vector<TubePoint>& line) {
  assert(line.size() >= 2);
  ShadedMesh mesh;
  Eigen::Vector3d x = any_perpendicular(direction_at(line, 0));
  add_cap(mesh, line.front(), direction_at(line, 0), x, -1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector3d axis = direction_at(line, i);
    // The side direction is carried along with the least twist.
    x = (x - axis.dot(x) * axis).normalized();
    add_ring(mesh, {line[i].center, line[i].radius, 0, bytes(line[i].paint)}, axis, x, true);
  }
  add_cap(mesh, line.back(), direction_at(line, line.size() - 1), x, +1);
  return mesh;
}

ShadedMesh ball(const Eigen::Vector3d& center, double radius, const Paint& paint) {
  ShadedMesh mesh;
  constexpr int kRings = 10;
  for (int k = 0; k <= kRings; ++k) {
    const double lean = -std::cos(std::numbers::pi * k / kRings);
    const double wide = std::max(1e-4, std::sqrt(std::max(0.0, 1 - lean * lean)));
    add_ring(mesh,
             {center + lean * radius * Eigen::Vector3d::UnitZ(), wide * radius, lean, bytes(paint)},
             Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), k > 0);
  }
  return mesh;
}

ShadedMesh arrow(const Eigen::Vector3d& tail,
                 const Eigen::Vector3d& head,
                 double radius,
                 const Paint& paint) {
  const double length = (head - tail).norm();
  const Eigen::Vector3d axis = (head - tail) / length;
  const double tip = std::min(5.5 * radius, 0.5 * length), wide = 2.4 * radius;
  const Eigen::Vector3d neck = head - tip * axis, x = any_perpendicular(axis);
  const double lean = wide / std::hypot(wide, tip);
  const auto color = bytes(paint);
  ShadedMesh mesh;
  add_ring(mesh, {tail, 1e-3 * radius, -1, color}, axis, x, false);
  add_ring(mesh, {tail, radius, -1, color}, axis, x, true);
  add_ring(mesh, {tail, radius, 0, color}, axis, x, true);
  add_ring(mesh, {neck, radius, 0, color}, axis, x, true);
  add_ring(mesh, {neck, radius, -1, color}, axis, x, true);
  add_ring(mesh, {neck, wide, -1, color}, axis, x, true);
  add_ring(mesh, {neck, wide, lean, color}, axis, x, true);
  add_ring(mesh, {head, 1e-3 * radius, lean, color}, axis, x, true);
  return mesh;
}

}  // namespace condyle
