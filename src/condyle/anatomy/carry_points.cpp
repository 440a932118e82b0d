#include "condyle/anatomy/carry_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/anatomy/register_bones.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// The bone in anatomical components, facing as it did.
TriangleMesh in_components(const FramedBone& bone) {
  TriangleMesh mesh = bone.mesh;
  for (Vector3d& p : mesh.vertices) p = bone.frame.components(p - bone.frame.origin);
  const bool mirrored = bone.frame.anterior.cross(bone.frame.proximal).dot(bone.frame.lateral) < 0;
  if (mirrored)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// How the registration is where a point is.
struct Neighbourhood {
  double rms = 0;      ///< gap of what is near [mm]
  double covered = 0;  ///< share of it that has a counterpart
  double away = 0;     ///< to the nearest that has one [mm]
  std::size_t nearest = 0;
};

Neighbourhood around(const Vector3d& aligned, const BoneRegistration& bones) {
  constexpr double kRadius = 12;
  Neighbourhood out;
  out.away = 1e300;
  double near = 0, facing = 0, sum = 0, squares = 0, least = 1e300;
  const SurfaceSamples& samples = bones.surface.before;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const double d = (samples.points[i] - aligned).norm(), trust = bones.found.trust[i];
    if (d < least) least = d, out.nearest = i;
    if (trust > 0) out.away = std::min(out.away, d);
    if (d > kRadius) continue;
    near += samples.areas[i];
    facing += trust > 0 ? samples.areas[i] : 0;
    sum += trust * samples.areas[i];
    squares += trust * samples.areas[i] * bones.found.gaps[i] * bones.found.gaps[i];
  }
  out.rms = sum > 0 ? std::sqrt(squares / sum) : 0;
  out.covered = near > 0 ? facing / near : 0;
  return out;
}

/// Calibrated on knees whose insertions are known (docs/new.md) [mm]: what remains where all is well,
/// the misfit around, how much around has no counterpart, that no bone was found, and shares of how
/// far the field moved the point, how far the nearest registered surface is and how far from its own
/// bone the point is.
double estimated_deviation(const Neighbourhood& near, double moved, double height, bool on_bone) {
  constexpr double kLeast = 1.5, kOffBone = 2, kEdge = 3, kShare = 0.2, kSpacing = 3;
  const double edge = kEdge * (1 - near.covered);
  const double away = std::max(0.0, near.away - kSpacing);
  return std::sqrt(kLeast * kLeast + near.rms * near.rms + edge * edge +
                   (on_bone ? 0 : kOffBone * kOffBone) +
                   kShare * kShare * (moved * moved + away * away + height * height));
}

/// Along the normal of the bone below or above, where there is bone: a point beside an edge stays.
std::optional<Vector3d> onto(const SampledSurface& samples,
                             const MeshDistance& mesh,
                             const Vector3d& p,
                             const Vector3d& normal) {
  constexpr double kDrop = 4, kBeside = 0.75;  // [mm]
  const auto opposite = samples.under(p, normal, kDrop);
  if (!opposite) return std::nullopt;
  const Vector3d below = p - opposite->height * samples.samples().normals[opposite->sample];
  const Vector3d down = mesh.closest(below);
  return (down - below).norm() < kBeside ? std::optional(down) : std::nullopt;
}

/// `point` and what comes back in anatomical components; `base`, the closest point of its own bone.
CarriedPoint carry(const BoneRegistration& bones,
                   const MeshDistance& other,
                   const Vector3d& point,
                   const Vector3d& base,
                   const Neighbourhood& near) {
  constexpr double kInserted = 3;  // a point farther from the bone is on another one [mm]
  CarriedPoint carried;
  const double height = (point - base).norm();
  carried.at = bones.at(base);
  const auto down = onto(bones.to, other, carried.at, bones.surface.normals[near.nearest]);
  if (down) {
    carried.dropped = (*down - carried.at).norm();
    carried.at = *down;
  }
  if (height > kInserted) carried.at += bones.at(point) - bones.at(base);
  carried.farther = std::max(0.0, other(carried.at) - height);
  carried.moved = (carried.at - bones.alignment.at(point)).norm();
  carried.uncertainty = estimated_deviation(near, carried.moved, height, down.has_value());
  return carried;
}

}  // namespace

CarriedPoints carry_points(const FramedBone& from,
                           const FramedBone& to,
                           const std::vector<Vector3d>& points) {
  const TriangleMesh one = in_components(from), other = in_components(to);
  std::vector<Vector3d> at;
  for (const Vector3d& p : points) at.push_back(from.frame.components(p - from.frame.origin));
  const BoneRegistration bones = register_bones(one, other, at);
  const MeshDistance on_one(one), on_other(other);

  CarriedPoints carried;
  carried.size = bones.alignment.size;
  carried.rms = bones.found.rms;
  for (const Vector3d& p : at) {
    const Vector3d base = on_one.closest(p);
    const Neighbourhood near = around(bones.alignment.at(base), bones);
    CarriedPoint point = carry(bones, on_other, p, base, near);
    point.at = to.frame.origin + to.frame.vector(point.at);
    carried.covered += near.covered / static_cast<double>(at.size());
    carried.points.push_back(point);
  }
  return carried;
}

}  // namespace condyle
