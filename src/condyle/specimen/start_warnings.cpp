#include "condyle/specimen/start_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/start_gap.h"
#include "condyle/specimen/strands_in_bone.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kLargestTransition = 0.3;  // of a toe region [-]

bool is_bounded(const Surface& surface) { return std::isfinite(surface.extent().radius); }

/// Neither surface has places to look from: two planes, or a plane and an endless cylinder.
bool unbounded(const std::vector<FittedSurface>& surfaces, const ContactDescription& contact) {
  return std::none_of(contact.surfaces.begin(), contact.surfaces.end(),
                      [&](int s) { return is_bounded(*surfaces[s].surface); });
}

void warn_of_gaps(const Scene& scene,
                  const std::vector<FittedSurface>& surfaces,
                  double limit,
                  std::vector<std::string>& lines) {
  // Else the start pose is a first estimate and no more.
  const bool sets_strains =
      std::any_of(scene.ligaments.begin(), scene.ligaments.end(),
                  [](const LigamentDescription& l) { return l.reference_strain.has_value(); });
  for (const ContactDescription& contact : scene.contacts) {
    if (unbounded(surfaces, contact)) continue;
    const double gap = start_gap(scene, surfaces, contact);
    if (!std::isfinite(gap)) {
      lines.push_back(fmt::format(
          "warning: contact \"{}\": its surfaces do not face each other at the start pose",
          contact.name));
      continue;
    }
    const bool matters = sets_strains && std::abs(gap) > limit;
    lines.push_back(fmt::format("{}contact \"{}\": {} of {:.2f} mm at the start pose{}",
                                matters ? "warning: " : "", contact.name,
                                gap < 0 ? "overlap" : "gap", std::abs(gap),
                                matters ? ", which the reference strains are given for" : ""));
  }
}

void warn_of_insertions(const Scene& scene,
                        const std::vector<TriangleMesh>& bones,
                        double limit,
                        std::vector<std::string>& lines) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (bones[b].triangles.empty()) continue;
    const MeshDistance distance(bones[b]);
    int count = 0, off = 0;
    double farthest = 0;
    std::string name;
    for (const LigamentDescription& ligament : scene.ligaments)
      for (const Attachment& end : ligament.ends) {
        if (end.body != static_cast<int>(b)) continue;
        const double d = distance(end.at);
        ++count;
        off += d > limit;
        if (d > farthest) farthest = d, name = ligament.name;
      }
    if (off > 0)
      lines.push_back(
          fmt::format("warning: {} of {} insertions on \"{}\" lie more than {:g} mm off its mesh, "
                      "\"{}\" {:.1f} mm",
                      off, count, scene.bodies[b].name, limit, name, farthest));
  }
}

/// What is odd about the law of a ligament of that length; nothing where all is as usual. A reference strain is
/// what somebody wrote: a slack one may be as slack as it likes.
std::string odd_law(const LigamentDescription& ligament, double length, double limit) {
  if (const auto* table = std::get_if<TableLaw>(&ligament.law)) {
    const double first = table->lengths.front(), last = table->lengths.back();
    return length >= first && length <= last
               ? ""
               : fmt::format(
                     "its {:.2f} mm at the start pose lie outside its table of {:.2f} to {:.2f} mm",
                     length, first, last);
  }
  const double slack = slack_length(ligament.law);
  if (!(slack > 0)) return "";
  const double strain = length / slack - 1;
  if (ligament.reference_strain && strain > limit)
    return fmt::format("its reference strain is {:+.0f} %", 100 * strain);
  if (!ligament.reference_strain && std::abs(strain) > limit)
    return fmt::format(
        "its slack length of {:.2f} mm means a strain of {:+.0f} % at the start pose", slack,
        100 * strain);
  const auto* toe = std::get_if<ToeLinearLaw>(&ligament.law);
  return toe != nullptr && toe->transition_strain > kLargestTransition
             ? fmt::format("its transition strain is {:.0f} %", 100 * toe->transition_strain)
             : "";
}

void warn_of_laws(const Scene& scene, double limit, std::vector<std::string>& lines) {
  if (scene.moving_body() < 0) return;
  const RigidTransform X_BA = start_pose(scene);
  for (const LigamentDescription& ligament : scene.ligaments) {
    const std::string odd = odd_law(ligament, ligament_length(scene, ligament, X_BA), limit);
    if (!odd.empty())
      lines.push_back(fmt::format("warning: ligament \"{}\": {}", ligament.name, odd));
  }
}

double bound(double length) { return std::isfinite(length) ? length : 0; }

/// How far an exact surface reaches, where it has bounds; of a patch 0 [mm]. A factor of 1000 is nearly always a
/// mistaken unit; a surface that is nearly flat is a plane.
double size_of(const SurfaceDescription& surface) {
  switch (surface.kind) {
    case SurfaceKind::kPatch:
      return 0;
    case SurfaceKind::kPlane:
    case SurfaceKind::kPolynomial:
      return 2 * bound(surface.known_radius);
    case SurfaceKind::kSphere:
      return 2 * surface.radius;
    case SurfaceKind::kCylinder:
      return std::max(2 * surface.radius, bound(surface.length));
    case SurfaceKind::kEllipsoid:
      return 2 * surface.semi_axes.maxCoeff();
    case SurfaceKind::kTorus:
      return 2 * (surface.radius + surface.minor_radius);
  }
  return 0;
}

/// Of exact surfaces far larger than a knee, one line each.
std::vector<std::string> size_warnings(const Scene& scene) {
  constexpr double kLargest = 2000, kSmallest = 0.5;  // as of ligaments [mm]
  std::vector<std::string> lines;
  for (const SurfaceDescription& surface : scene.surfaces)
    if (const double size = size_of(surface); size > kLargest || (size > 0 && size < kSmallest))
      lines.push_back(
          fmt::format("warning: surface \"{}\": {:.6g} mm across, expected {:g} to {:g} mm "
                      "(suspect the units)",
                      surface.name, size, kSmallest, kLargest));
  return lines;
}

}  // namespace

std::vector<std::string> start_warnings(const Scene& scene,
                                        const std::vector<FittedSurface>& surfaces,
                                        const std::vector<TriangleMesh>& bones,
                                        const StartLimits& limits) {
  std::vector<std::string> lines = size_warnings(scene);
  warn_of_gaps(scene, surfaces, limits.gap, lines);
  warn_of_insertions(scene, bones, limits.insertion, lines);
  warn_of_laws(scene, limits.strain, lines);
  for (std::string& line : wrap_warnings(scene, bones, limits.inside))
    lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> start_warnings(const Scene& scene,
                                        const std::vector<FittedSurface>& surfaces,
                                        const StartLimits& limits) {
  return start_warnings(scene, surfaces, body_meshes(scene, surfaces), limits);
}

}  // namespace condyle
