#include "condyle/anatomy/femoral_frame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "condyle/anatomy/shaft_line.h"
#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/face_out.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kEnd =
    0.85;  // radius of the articular end about the middle of the axis, of its width
constexpr double kFemoralShaftFirst = 0.5, kFemoralShaftLast = 0.76,
                 kFemoralShaftLeast = 0.08;  // above the axis, of the width
// Where the sagittal outline lies 1.3 radii from the axis, seen from distal forward: eleven knees had
// it 13 to 25 degrees in front of what their shafts say is distal.
constexpr double kOutlineRadii = 1.3, kOutlineAngle = 17 * M_PI / 180;

constexpr double kMostCorrection =
    8 * M_PI / 180;  // of the outline by the tibia, which may be flexed

BoneFrame right_frame(const Vector3d& lateral, const Vector3d& proximal, const Vector3d& origin) {
  BoneFrame frame;
  frame.origin = origin;
  frame.lateral = lateral;
  frame.proximal = (proximal - lateral * lateral.dot(proximal)).normalized();
  frame.anterior = frame.proximal.cross(lateral);
  return frame;
}

/// How far the mesh reaches from the axis, within a wedge seen along it.
double farthest(const TriangleMesh& end, const BoneFrame& frame, double first, double last) {
  double most = 0;
  for (const Vector3d& p : end.vertices) {
    const Vector3d q = frame.components(p - frame.origin);
    const double angle = std::atan2(-q.x(), -q.y());
    if (angle > first && angle < last) most = std::max(most, std::hypot(q.x(), q.y()));
  }
  return most;
}

double width_of(const TriangleMesh& end, const BoneFrame& frame, double reach) {
  double low = 1e300, high = -1e300;
  for (const Vector3d& p : end.vertices) {
    const Vector3d q = frame.components(p - frame.origin);
    if (std::abs(q.y()) > reach) continue;
    low = std::min(low, q.z());
    high = std::max(high, q.z());
  }
  return high - low;
}

/// Share of an arc about the axis, 0 distal, + posterior, that the mesh fills between two distances from
/// the middle between the condyles.
double filled(const TriangleMesh& end,
              const BoneFrame& frame,
              double radius,
              const std::array<double, 2>& arc,
              const std::array<double, 2>& aside) {
  constexpr int kSteps = 10;
  std::array<bool, kSteps> steps{};
  for (const Vector3d& p : end.vertices) {
    const Vector3d q = frame.components(p - frame.origin);
    const double at = (std::atan2(-q.x(), -q.y()) - arc[0]) / (arc[1] - arc[0]),
                 z = std::abs(q.z());
    if (z >= aside[0] && z < aside[1] && at > 0 && at < 1 &&
        std::hypot(q.x(), q.y()) > 0.75 * radius)
      steps[static_cast<std::size_t>(at * kSteps)] = true;
  }
  return static_cast<double>(std::count(steps.begin(), steps.end(), true)) / kSteps;
}

/// The lower, the more like posterior condyles; none where it is none. Behind and below the axis the
/// outline is round and open between the condyles, in front the trochlea reaches farther.
std::optional<double> unlikeness(const TriangleMesh& end,
                                 const CondylarAxis& axis,
                                 const KneeEnds& ends) {
  const double radius = (axis.medial_radius + axis.lateral_radius) / 2, width = ends.femur_width;
  const BoneFrame frame =
      right_frame(axis.direction, -axis.distal, axis.point + axis.split * axis.direction);
  const double behind = farthest(end, frame, 0.8, 1.9) / radius,
               before = farthest(end, frame, -1.9, -0.8) / radius;
  // The notch, and the distal side of the condyles, which a sheet that stands on its head lacks.
  const double between = filled(end, frame, radius, {0.35, 1.75}, {0, 0.04 * width});
  const double below = filled(end, frame, radius, {-0.4, 0.35}, {0.1 * width, 0.5 * width});
  const double turned = std::acos(std::min(1.0, std::abs(axis.direction.dot(ends.across))));
  if (axis.coverage < 0.8 || axis.rms > 2 || radius < 0.17 * width || radius > 0.42 * width ||
      behind > 1.35 || before < 1.4 || between > 0.5 || below < 0.8 || turned > 0.45)
    return std::nullopt;
  return axis.rms + 2 * between + 3 * (behind - 1) + 2 * turned;
}

/// The best of candidates that are turned against the tibia by `turn` about its proximal direction.
std::optional<Condyles> best_candidate(const TriangleMesh& end, const KneeEnds& ends, double turn) {
  const std::vector<Vector3d> normals = vertex_normals(end);
  const Vector3d across = Eigen::AngleAxisd(turn, ends.proximal) * ends.across;
  std::optional<Condyles> best;
  double least = 1e300;
  for (const double sign : {1.0, -1.0})
    for (const double degrees : {0.0, 25.0, -25.0}) {
      const Eigen::AngleAxisd tilt(degrees * M_PI / 180, across);
      const BoneFrame frame = right_frame(sign * across, tilt * ends.proximal, ends.joint);
      try {
        const Condyles c{fit_condylar_axis(end, normals, frame), frame};
        const std::optional<double> found = unlikeness(end, c.axis, ends);
        if (!found || *found >= least) continue;
        least = *found;
        best = c;
      } catch (const InputError&) {  // no condyles where this candidate has them
      }
    }
  return best;
}

struct OutlinePoint {
  Eigen::Vector2d at;  // anterior, distal of the axis [mm]
  double area;         // [mm²]
};

/// How far the outline reaches along an angle from distal forward: kCrest of the surface lie farther, so that
/// single vertices have no say [mm].
double support(const std::vector<OutlinePoint>& outline, double angle) {
  constexpr double kCrest = 25;  // [mm²]
  constexpr double kStep = 0.1;  // [mm]
  constexpr int kSteps = 60;
  const Eigen::Vector2d e(std::sin(angle), std::cos(angle));
  double most = 0;
  for (const OutlinePoint& q : outline) most = std::max(most, e.dot(q.at));
  std::array<double, kSteps + 1> area{};
  for (const OutlinePoint& q : outline)
    area[static_cast<std::size_t>(std::min((most - e.dot(q.at)) / kStep, kSteps + 0.0))] += q.area;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    if (sum + area[i] >= kCrest) return most - kStep * (i + (kCrest - sum) / area[i]);
    sum += area[i];
  }
  return most - kStep * kSteps;
}

/// From distal forward, where the outline first reaches a multiple of the radius.
double outline_angle(const FemoralShape& shape) {
  const std::vector<double> areas = vertex_areas(shape.end);
  std::vector<OutlinePoint> outline;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const Vector3d q = shape.frame.components(shape.end.vertices[i] - shape.frame.origin);
    if (q.y() < shape.cylinder.radius && std::hypot(q.x(), q.y()) > 0.9 * shape.cylinder.radius)
      outline.push_back({{q.x(), -q.y()}, areas[i]});
  }
  const double reach = kOutlineRadii * shape.cylinder.radius;
  double low = -0.7, high = 1.4;
  if (support(outline, low) > reach || support(outline, high) < reach) return kOutlineAngle;
  for (int i = 0; i < 30; ++i)
    (support(outline, (low + high) / 2) < reach ? low : high) = (low + high) / 2;
  return low;
}

/// Forward by `angle` about the lateral direction.
Vector3d lean_forward(const BoneFrame& frame, double angle) {
  return frame.proximal * std::cos(angle) + frame.anterior * std::sin(angle);
}

/// Proximal by the shaft where it is there, otherwise by the outline.
void set_proximal(FemoralShape& shape, const TriangleMesh& femur) {
  BoneFrame& frame = shape.frame;
  const double w = shape.width;
  const auto line =
      find_shaft_line(femur, frame.origin, frame.proximal,
                      {kFemoralShaftFirst * w, kFemoralShaftLast * w, kFemoralShaftLeast * w});
  shape.shaft = line ? line->length : 0;
  shape.shaft_first = kFemoralShaftFirst * w;
  if (line) shape.lean = std::asin(line->direction.dot(frame.lateral));
  const Vector3d proximal =
      line ? line->direction : lean_forward(frame, kOutlineAngle - outline_angle(shape));
  frame = right_frame(frame.lateral, proximal, frame.origin);
}

/// Halfway from what the outline says to the tibia as scanned: most are scanned near extension.
void lean_to_tibia(BoneFrame& frame, const Vector3d& tibia_proximal) {
  const double tibia =
      std::atan2(frame.anterior.dot(tibia_proximal), frame.proximal.dot(tibia_proximal));
  const double correction = std::clamp(tibia / 2, -kMostCorrection, kMostCorrection);
  frame = right_frame(frame.lateral, lean_forward(frame, correction), frame.origin);
}

}  // namespace

Condyles find_condyles(CleanMesh& femur, const KneeEnds& ends, const std::vector<double>& turns) {
  face_out_of_femur(femur, right_frame(ends.across, ends.proximal, ends.joint));
  const TriangleMesh end = crop_ball(femur.mesh, ends.joint, 0.95 * ends.femur_width);
  std::optional<Condyles> found;
  for (const double turn : turns)
    if (!found) found = best_candidate(end, ends, turn);
  if (!found) throw InputError("no posterior condyles");
  return *found;
}

FemoralShape find_femoral_frame(const TriangleMesh& femur,
                                const Condyles& condyles,
                                const KneeEnds& ends,
                                const Vector3d& tibia_proximal) {
  FemoralShape shape;
  shape.frame = condyles.frame;
  shape.axis = condyles.axis;
  shape.width = ends.femur_width;
  shape.end = crop_ball(femur, ends.joint, 0.95 * ends.femur_width);
  for (int iteration = 0; iteration < 5; ++iteration) {
    const std::vector<Vector3d> normals = vertex_normals(shape.end);
    if (iteration > 0) shape.axis = fit_condylar_axis(shape.end, normals, shape.frame);
    shape.cylinder = fit_posterior_cylinder(shape.end, normals, shape.axis);
    shape.frame =
        right_frame(shape.cylinder.direction, shape.frame.proximal, shape.cylinder.middle);
    shape.width = width_of(shape.end, shape.frame, 0.35 * shape.width);
    set_proximal(shape, femur);
    shape.end = crop_ball(femur, shape.frame.origin, kEnd * shape.width);
  }
  if (shape.shaft == 0) lean_to_tibia(shape.frame, tibia_proximal);
  return shape;
}

}  // namespace condyle
