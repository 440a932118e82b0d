#include "condyle/anatomy/knee_faults.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kNarrowest = 55, kWidest = 110;  // articular ends of adults [mm]
constexpr double kLeastRatio = 0.85,
                 kMostRatio = 1.35;  // of femoral to tibial width: 1.01 to 1.13 in twelve knees
constexpr double kMostGap = 40;      // between bones as scanned [mm]

/// Distances from about a thousand vertices of `mesh` to `other`, sorted.
std::vector<double> distances_to(const TriangleMesh& mesh, const TriangleMesh& other) {
  const MeshDistance distance(other);
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / 1000);
  std::vector<double> found;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step)
    found.push_back(distance(mesh.vertices[i]));
  std::sort(found.begin(), found.end());
  return found;
}

void check_cartilage(const TriangleMesh& cartilage,
                     const TriangleMesh& own,
                     const TriangleMesh& other,
                     const char* name) {
  if (cartilage.triangles.empty())
    throw InputError(fmt::format("the {} cartilage has no triangles", name));
  const double size = surface_extents(own).sizes[1];
  const std::vector<double> to_own = distances_to(cartilage, own),
                            to_other = distances_to(cartilage, other);
  const double far = to_own[to_own.size() / 2];
  if (far > to_other[to_other.size() / 2])
    throw InputError(
        fmt::format("the {} cartilage lies on the other bone: the two cartilages are interchanged, "
                    "or the bones",
                    name));
  if (far > 0.2 * size)
    throw InputError(
        fmt::format("the {} cartilage lies {:.3g} off its bone, in the unit of the files: not in "
                    "one frame and unit with it",
                    name, far));
}

/// Does one end of a mesh, whichever it is, have posterior condyles?
bool has_condyles(CleanMesh mesh) {
  const SurfaceExtents extents = surface_extents(mesh.mesh);
  const double width = std::clamp(extents.sizes[1], kNarrowest, kWidest);
  for (const double end : {1.0, -1.0}) {
    const Vector3d distal = end * extents.axes.col(0);
    double lowest = -1e300;
    for (const Vector3d& p : mesh.mesh.vertices)
      lowest = std::max(lowest, distal.dot(p - extents.middle));
    KneeEnds ends;
    ends.joint = extents.middle + distal * (lowest - 0.05 * width);
    ends.proximal = -distal;
    ends.femur_width = ends.tibia_width = width;
    for (int i = 0; i < 6; ++i) {
      ends.across = Eigen::AngleAxisd(i * M_PI / 6, distal) * extents.axes.col(1);
      try {
        (void)find_condyles(mesh, ends);
        return true;
      } catch (const InputError&) {  // not so
      }
    }
  }
  return false;
}

double widest_across(const TriangleMesh& mesh,
                     const Vector3d& middle,
                     double reach,
                     const Vector3d& across) {
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : mesh.vertices) {
    if ((p - middle).norm() > reach) continue;
    low = std::min(low, across.dot(p));
    high = std::max(high, across.dot(p));
  }
  return std::max(0.0, high - low);
}

}  // namespace

void check_meshes(const KneeMeshes& meshes) {
  if (meshes.femur.triangles.empty()) throw InputError("the femur has no triangles");
  if (meshes.tibia.triangles.empty()) throw InputError("the tibia has no triangles");
  const double femur = surface_extents(meshes.femur).sizes[0],
               tibia = surface_extents(meshes.tibia).sizes[0];
  if (std::max(femur, tibia) > 8 * std::min(femur, tibia))
    throw InputError(
        fmt::format("the femur is {:.3g} long and the tibia {:.3g}, in the unit of the files: "
                    "expected both in one unit",
                    femur, tibia));
  const std::vector<double> apart = distances_to(meshes.tibia, meshes.femur);
  if (apart[apart.size() / 2] < 0.01 * tibia)
    throw InputError("femur and tibia are one and the same surface: expected two bones");
  if (meshes.femoral_cartilage)
    check_cartilage(*meshes.femoral_cartilage, meshes.femur, meshes.tibia, "femoral");
  if (meshes.tibial_cartilage)
    check_cartilage(*meshes.tibial_cartilage, meshes.tibia, meshes.femur, "tibial");
}

double tell_unit(const KneeEnds& ends) {
  struct Unit {
    const char* name;
    double to_mm;
  };
  const double width = std::sqrt(ends.femur_width * ends.tibia_width);
  for (const Unit& unit : {Unit{"mm", 1}, Unit{"cm", 10}, Unit{"inch", 25.4}, Unit{"m", 1000}})
    if (width * unit.to_mm > 0.9 * kNarrowest && width * unit.to_mm < 1.1 * kWidest)
      return unit.to_mm;
  throw InputError(fmt::format(
      "the ends of femur and tibia that face each other are {:.3g} and {:.3g} wide: in none of mm, "
      "cm, inch and m is that a knee of {:.0f} to {:.0f} mm; say the unit by --units",
      ends.femur_width, ends.tibia_width, kNarrowest, kWidest));
}

Condyles find_condyles_or_say_why(CleanMesh& femur, const CleanMesh& tibia, const KneeEnds& ends) {
  try {
    return find_condyles(femur, ends);
  } catch (const InputError&) {
    const bool first = has_condyles(femur), second = has_condyles(tibia);
    if (first && second)
      throw InputError(
          "two femurs: both meshes have posterior condyles, expected a femur and a tibia");
    if (second)
      throw InputError(
          "femur and tibia are interchanged: the mesh given as tibia has posterior condyles, that "
          "given as femur none");
    if (first)
      throw InputError(
          "the femur's condyles do not face the tibia: the bones are not in one frame, or one is "
          "upside down");
    throw InputError(
        "the mesh given as femur has no two posterior condyles about one axis with a notch between "
        "them: no femur, or not both condyles");
  }
}

TibialShape find_tibia_or_say_why(CleanMesh& tibia,
                                  const KneeEnds& ends,
                                  const Condyles& condyles) {
  const SurfaceExtents extents = surface_extents(tibia.mesh);
  const double here = widest_across(tibia.mesh, ends.joint, 0.4 * extents.sizes[0], ends.across);
  const Vector3d other = 2 * extents.middle - ends.joint;
  const double there = widest_across(tibia.mesh, other, 0.4 * extents.sizes[0], ends.across);
  if (extents.sizes[0] > 1.2 * ends.femur_width && there > 1.3 * here)
    throw InputError(fmt::format(
        "the tibia is upside down: its end at the femur is {:.0f} mm wide, the other one {:.0f} mm",
        here, there));
  TibialShape found = find_tibial_frame(tibia, ends, condyles.frame.anterior);
  const Plateau& p = found.plateau;
  if (p.area < 0.45 * p.width * p.depth || p.depth > 0.95 * p.width) {
    if (has_condyles(tibia))
      throw InputError("two femurs: the mesh given as tibia has posterior condyles too");
    throw InputError(
        fmt::format("no tibial plateau faces the femur: what is there is {:.0f} by {:.0f} mm, "
                    "{:.0f} % of it level, expected an oblong of at least 45 %",
                    p.width, p.depth, 100 * p.area / (p.width * p.depth)));
  }
  return found;
}

void check_they_fit(const FemoralShape& femur, const TibialShape& tibia, const KneeEnds& ends) {
  for (const auto& [name, width] :
       {std::pair("femur", femur.width), std::pair("tibia", tibia.plateau.width)})
    if (width < kNarrowest || width > kWidest)
      throw InputError(
          fmt::format("the {} is {:.0f} mm wide at the knee, expected {:.0f} to {:.0f} mm: say the "
                      "unit by --units",
                      name, width, kNarrowest, kWidest));
  const double ratio = femur.width / tibia.plateau.width;
  if (ratio < kLeastRatio || ratio > kMostRatio)
    throw InputError(
        fmt::format("bones of different persons: the femur is {:.0f} mm wide and the tibia {:.0f} "
                    "mm, expected a ratio of {:.2f} to {:.2f}",
                    femur.width, tibia.plateau.width, kLeastRatio, kMostRatio));
  const Vector3d q = femur.frame.components(tibia.plateau.middle - femur.frame.origin);
  if (ends.gap > kMostGap || std::abs(q.z()) > 0.25 * femur.width || q.y() > 0)
    throw InputError(fmt::format(
        "the ends of the bones do not face each other: the plateau's middle lies {:.0f} mm beside "
        "and {:.0f} mm below the femur's axis, the bones are {:.0f} mm apart",
        std::abs(q.z()), -q.y(), ends.gap));
}

}  // namespace condyle
