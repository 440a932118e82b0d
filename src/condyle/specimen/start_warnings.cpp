#include "condyle/specimen/start_warnings.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/strands_in_bone.h"
#include "condyle/surface/affordable_samples.h"
#include "condyle/surface/mesh_distance.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 2;              // of the points where gaps are looked for [mm]
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

}  // namespace

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

namespace {

/// The gap from places of one surface to another one, its frame being that of the place's body.
class GapFrom {
 public:
  GapFrom(const Surface& a, const Surface& b, const RigidTransform& X_ba)
      : a_(a), b_(b), X_ba_(X_ba) {}

  struct At {
    Place on_a, on_b;
    double gap = std::numeric_limits<double>::infinity();  ///< where they do not face each other
    SurfacePoint a, b;
  };
  [[nodiscard]] At at(const Place& place, const Place* near = nullptr) const {
    At at{place, {}, std::numeric_limits<double>::infinity(), a_.evaluate(place), {}};
    const Vector3d p = X_ba_ * at.a.c;
    at.on_b = b_.closest(p, near != nullptr ? *near : b_.seed(p));
    at.b = b_.evaluate(at.on_b);
    const bool faces = (X_ba_.R * at.a.n).dot(at.b.n) <= -0.5;
    if (faces && a_.edge_distance(at.on_a) >= 0 && b_.edge_distance(at.on_b) >= 0)
      at.gap = at.b.n.dot(p - at.b.c);
    return at;
  }

  /// From a place near it, to 1e-9 mm where it lies within both surfaces: Newton's steps where the gap bends upwards, with
  /// the second derivative -(K_a + K_b), else along its slope, halved until it falls.
  [[nodiscard]] double least_near(At at) const {
    constexpr int kSteps = 30, kHalvings = 20;
    for (int k = 0; k < kSteps; ++k) {
      const double before = at.gap;
      Vector3d step = step_from(at);
      bool fell = false;
      for (int half = 0; half < kHalvings && !fell; ++half, step /= 2) {
        const At next = this->at(a_.moved(at.on_a, at.a, step), &at.on_b);
        fell = next.gap < at.gap;
        if (fell) at = next;
      }
      if (!fell || before - at.gap < 1e-9) break;
    }
    return at.gap;
  }

 private:
  [[nodiscard]] Vector3d step_from(const At& at) const {
    constexpr double kFarthest = 2;  // [mm]
    const Vector3d t = at.a.n.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << t, at.a.n.cross(t);
    const Eigen::Vector2d slope = tangents.transpose() * (X_ba_.R.transpose() * at.b.n);
    const Eigen::Matrix2d bend =
        -tangents.transpose() * (at.a.K + X_ba_.R.transpose() * at.b.K * X_ba_.R) * tangents;
    const bool upwards = bend(0, 0) > 0 && bend.determinant() > 0;
    Eigen::Vector2d step = upwards ? Eigen::Vector2d(-bend.inverse() * slope)
                                   : Eigen::Vector2d(-slope * kFarthest / slope.norm());
    if (!(step.norm() <= kFarthest)) step *= kFarthest / step.norm();
    return tangents * step;
  }

  const Surface &a_, &b_;
  RigidTransform X_ba_;
};

}  // namespace

double start_gap(const Scene& scene,
                 const std::vector<FittedSurface>& surfaces,
                 const ContactDescription& contact) {
  const RigidTransform X_BA = start_pose(scene);
  const auto pose = [&](int s) {
    return scene.surfaces[s].body == scene.moving_body() ? X_BA : RigidTransform{};
  };
  double least = std::numeric_limits<double>::infinity();
  for (const bool turned : {false, true}) {
    const int from = contact.surfaces[turned ? 1 : 0], to = contact.surfaces[turned ? 0 : 1];
    const Surface& a = *surfaces[from].surface;
    if (!is_bounded(a)) continue;
    const GapFrom gap(a, *surfaces[to].surface, pose(to).inverse() * pose(from));
    std::optional<GapFrom::At> lowest;
    for (const Place& place : affordable_samples(a, kSpacing))
      if (GapFrom::At at = gap.at(place); !lowest || at.gap < lowest->gap) lowest = std::move(at);
    if (lowest && std::isfinite(lowest->gap)) least = std::min(least, gap.least_near(*lowest));
  }
  return least;
}

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
  std::vector<TriangleMesh> bones;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    bones.push_back(body_mesh(scene, static_cast<int>(b), surfaces));
  return start_warnings(scene, surfaces, bones, limits);
}

}  // namespace condyle
