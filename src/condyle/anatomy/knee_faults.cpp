#include "condyle/anatomy/knee_faults.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kNarrowest = 55, kWidest = 110;  // articular ends of adults [mm]
constexpr double kLeastRatio = 0.85,
                 kMostRatio = 1.35;     // of femoral to tibial width: 1.01 to 1.13 in twelve knees
constexpr double kLeastEminence = 0.3;  // of its region: 1.5 to 2.8 mm in twelve knees [mm]
constexpr double kMostTurn = 0.6;       // of the tibia about its shaft [rad]
constexpr double kMostGap = 40;         // between bones as scanned [mm]

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
  if (const double across = surface_extents(cartilage).sizes[0];
      across < 0.3 * size || across > 3 * size)
    throw InputError(
        fmt::format("the {} cartilage is {:.3g} long, its bone {:.3g} wide, in the unit of the "
                    "files: expected both in one unit, and of one knee",
                    name, across, size));
  const std::vector<double> to_own = distances_to(cartilage, own),
                            to_other = distances_to(cartilage, other);
  const double far = to_own[to_own.size() / 2];
  if (far > to_other[to_other.size() / 2])
    throw InputError(
        fmt::format("the {} cartilage lies on the other bone: the two cartilages are interchanged, "
                    "or the bones, or the cartilage is of another knee or in another frame",
                    name));
  if (far > 0.2 * size)
    throw InputError(
        fmt::format("the {} cartilage lies {:.3g} off its bone, in the unit of the files: not in "
                    "one frame and unit with it",
                    name, far));
}

/// Mean radius of posterior condyles that one end of a mesh has, whichever it is; 0 where none has [mm].
double condyle_radius(CleanMesh mesh) {
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
        const CondylarAxis axis = find_condyles(mesh, ends, {0}).axis;
        return (axis.medial_radius + axis.lateral_radius) / 2;
      } catch (const InputError&) {  // not so
      }
    }
  }
  return 0;
}

/// Extent at right angles to `along` of what lies at most `reach` from the farthest point that way.
double width_at_end(const TriangleMesh& mesh, const Vector3d& along, double reach) {
  double farthest = -1e300;
  for (const Vector3d& p : mesh.vertices) farthest = std::max(farthest, along.dot(p));
  Vector3d middle = Vector3d::Zero();
  double count = 0;
  for (const Vector3d& p : mesh.vertices)
    if (along.dot(p) > farthest - reach) middle += p, ++count;
  middle /= count;
  double widest = 0;
  for (const Vector3d& p : mesh.vertices)
    if (along.dot(p) > farthest - reach) widest = std::max(widest, along.cross(p - middle).norm());
  return 2 * widest;
}

bool is_wider_at_other_end(const TriangleMesh& tibia, const KneeEnds& ends) {
  const SurfaceExtents extents = surface_extents(tibia);
  Vector3d along = extents.axes.col(0);
  if (along.dot(ends.joint - extents.middle) < 0) along *= -1;
  const double reach = 0.25 * extents.sizes[0];
  return width_at_end(tibia, -along, reach) > 1.2 * width_at_end(tibia, along, reach);
}

constexpr const char* kUpsideDown = "the tibia is upside down: its plateau does not face the femur";
constexpr const char* kTwoFemurs =
    "two femurs, or femur and tibia interchanged (the femur comes first): the mesh given as tibia "
    "has posterior condyles";

/// The hollows of a tibia's plateau may pass for small condyles.
constexpr double kLeastRadii = 0.85;  // of one bone's condyles to the other's

}  // namespace

void check_meshes(const KneeMeshes& meshes) {
  if (meshes.femur.triangles.empty()) throw InputError("the femur has no triangles");
  if (meshes.tibia.triangles.empty()) throw InputError("the tibia has no triangles");
  const double femur = surface_extents(meshes.femur).sizes[0],
               tibia = surface_extents(meshes.tibia).sizes[0];
  if (std::max(femur, tibia) > 8 * std::min(femur, tibia))
    throw InputError(
        fmt::format("the femur is {:.3g} long and the tibia {:.3g}, in the unit of the files: "
                    "expected both in one unit, and no vertex far from all others",
                    femur, tibia));
  const std::vector<double> apart = distances_to(meshes.tibia, meshes.femur);
  if (apart[apart.size() / 2] < 0.01 * tibia)
    throw InputError("femur and tibia are one and the same surface: expected two bones");
  if (meshes.femoral_cartilage)
    check_cartilage(*meshes.femoral_cartilage, meshes.femur, meshes.tibia, "femoral");
  if (meshes.tibial_cartilage)
    check_cartilage(*meshes.tibial_cartilage, meshes.tibia, meshes.femur, "tibial");
}

double tell_unit(const KneeEnds& ends, const std::optional<double>& given) {
  if (ends.femur_width == 0 || ends.gap > ends.tibia_width)
    throw InputError(
        fmt::format("femur and tibia are {:.3g} apart, in the unit of the files: expected both as "
                    "scanned, in one frame",
                    ends.gap));
  const double width = std::max(ends.femur_width, ends.tibia_width);
  const auto is_a_knee = [&](double to_mm) {
    return width * to_mm > 0.9 * kNarrowest && width * to_mm < 1.1 * kWidest;
  };
  if (given && is_a_knee(*given)) return *given;
  for (const double to_mm : {1.0, 10.0, 25.4, 1000.0})
    if (!given && is_a_knee(to_mm)) return to_mm;
  throw InputError(fmt::format(
      "the ends of femur and tibia that face each other are {:.3g} and {:.3g} wide, in the unit of "
      "the files: in {} that is no knee of an adult, which is {:.0f} to {:.0f} mm wide; {}",
      ends.femur_width, ends.tibia_width, given ? "the unit of --units" : "mm, cm, inch and m",
      kNarrowest, kWidest,
      given ? "expected another --units, or none (it is told from the width); knees of children "
              "and animals are not recognised"
            : "a unit said by --units has to make it one"));
}

Condyles find_condyles_or_say_why(CleanMesh& femur, const CleanMesh& tibia, const KneeEnds& ends) {
  try {
    return find_condyles(femur, ends);
  } catch (const InputError&) {
    const double first = condyle_radius(femur), second = condyle_radius(tibia);
    if (second > 0 && first < kLeastRadii * second)
      throw InputError(
          "femur and tibia are interchanged: the mesh given as tibia has posterior condyles, that "
          "given as femur none of its size");
    if (second > 0 && second > kLeastRadii * first) throw InputError(kTwoFemurs);
    if (first > 0 && is_wider_at_other_end(tibia.mesh, ends)) throw InputError(kUpsideDown);
    if (first > 0)
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
  std::string why = "no faces look at it";
  double eminence = 0;
  try {
    TibialShape found = find_tibial_frame(tibia, ends, condyles.frame.anterior);
    const Plateau& p = found.plateau;
    eminence = p.eminence;
    if (p.area > 0.45 * p.width * p.depth && p.depth < 0.85 * p.width &&
        p.width > 0.6 * ends.femur_width && eminence > kLeastEminence)
      return found;
    why = fmt::format(
        "what is there is {:.0f} by {:.0f} mm, {:.0f} % of it level, its middle {:.1f} mm higher",
        p.width, p.depth, 100 * p.area / (p.width * p.depth), p.eminence);
  } catch (const InputError&) {  // said below
  }
  if (condyle_radius(tibia) >
      kLeastRadii * (condyles.axis.medial_radius + condyles.axis.lateral_radius) / 2)
    throw InputError(kTwoFemurs);
  if (eminence < -kLeastEminence || is_wider_at_other_end(tibia.mesh, ends))
    throw InputError(kUpsideDown);
  throw InputError(fmt::format("no tibial plateau faces the femur: {}", why));
}

namespace {

/// Angle between a bone's shaft, as far as the mesh has one, and the direction that the frame says it goes
/// [rad]; 0 where there is none.
double shaft_astray(const TriangleMesh& bone,
                    const Vector3d& joint,
                    const Vector3d& expected,
                    double width) {
  constexpr double kFar = 0.75;  // widths from the joint, where only the shaft is
  const std::vector<double> areas = vertex_areas(bone);
  Vector3d sum = Vector3d::Zero();
  double area = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Vector3d d = bone.vertices[i] - joint;
    if (d.norm() < kFar * width) continue;
    sum += areas[i] * d.normalized();
    area += areas[i];
  }
  if (area < 0.05 * width * width || sum.norm() < 0.5 * area) return 0;
  return std::atan2(sum.cross(expected).norm(), sum.dot(expected));
}

}  // namespace

void check_shafts(const CleanMesh& femur_mesh,
                  const FemoralShape& femur,
                  const CleanMesh& tibia_mesh,
                  const TibialShape& tibia) {
  constexpr double kMost = 40 * M_PI / 180;
  const double w = femur.width;
  const double up = shaft_astray(femur_mesh.mesh, femur.frame.origin, femur.frame.proximal, w),
               down = shaft_astray(tibia_mesh.mesh, tibia.frame.origin, -tibia.frame.proximal, w);
  for (const auto& [name, angle] : {std::pair("femur", up), std::pair("tibia", down)})
    if (angle > kMost)
      throw InputError(fmt::format(
          "the {}'s shaft goes {:.0f} degrees aside of where its articular end says: the knee is "
          "flexed too far to be recognised (expected at most some 60 degrees), or a bone is "
          "the wrong way round",
          name, angle * 180 / M_PI));
}

void check_both_sides(const TriangleMesh& cartilage,
                      double to_mm,
                      const BoneFrame& frame,
                      double width,
                      const char* name) {
  constexpr double kLeast = 0.15;  // of the width; an inner edge lies within 0.1 of the middle
  double medial = 0, lateral = 0;
  for (const Vector3d& p : cartilage.vertices) {
    const double z = frame.lateral.dot(to_mm * p - frame.origin);
    medial = std::max(medial, -z);
    lateral = std::max(lateral, z);
  }
  if (std::min(medial, lateral) < kLeast * width)
    throw InputError(
        fmt::format("the {} cartilage covers the {} side alone, expected both: of several files "
                    "name each",
                    name, medial < lateral ? "lateral" : "medial"));
}

void check_they_fit(const FemoralShape& femur,
                    const TibialShape& tibia,
                    const KneeEnds& ends,
                    const std::string& unit) {
  const double w = femur.width, ratio = w / tibia.plateau.width;
  if (ratio < kLeastRatio || ratio > kMostRatio)
    throw InputError(
        fmt::format("bones of different persons, or a part of one: the femur is {:.0f} mm wide at "
                    "the knee and the tibia {:.0f} mm, expected a ratio of {:.2f} to {:.2f}",
                    w, tibia.plateau.width, kLeastRatio, kMostRatio));
  for (const auto& [name, width] : {std::pair("femur", w), std::pair("tibia", tibia.plateau.width)})
    if (width < kNarrowest || width > kWidest)
      throw InputError(
          fmt::format("the {} is {:.1f} mm wide at the knee ({}), expected {:.0f} to {:.0f} mm, as "
                      "those of adults "
                      "are",
                      name, width, unit, kNarrowest, kWidest));
  const Vector3d q = femur.frame.components(tibia.plateau.middle - femur.frame.origin);
  const double beside = std::abs(q.z()), ahead = std::abs(q.x()), below = -q.y();
  if (ends.gap > kMostGap || beside > 0.2 * w || ahead > 0.35 * w || below < 0.15 * w ||
      below > 0.55 * w + ends.gap)
    throw InputError(fmt::format(
        "the ends of the bones do not face each other: from the axis of the femur the middle of "
        "the plateau lies {:.0f} mm sideways, {:.0f} mm to the front or back and {:.0f} mm "
        "distally, expected less than {:.0f}, less than {:.0f} and {:.0f} to {:.0f} mm",
        beside, ahead, below, 0.2 * w, 0.35 * w, 0.15 * w, 0.55 * w));
  const double turned =
      std::acos(std::clamp(femur.frame.lateral.dot(tibia.frame.lateral), -1.0, 1.0));
  if (turned > kMostTurn)
    throw InputError(
        fmt::format("the tibia is turned by {:.0f} degrees against the femur, from one lateral "
                    "direction to the other: expected less than {:.0f}",
                    turned * 180 / M_PI, kMostTurn * 180 / M_PI));
}

}  // namespace condyle
