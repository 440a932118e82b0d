#include "condyle/pictures/knee_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

#include "condyle/pictures/solids.h"
#include "condyle/results/contact_path.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr Rgb kContactColor = {22, 32, 43};
struct PathSize {
  double radius, dot;  // [mm]
  PathSize operator*(double size) const { return {radius * size, dot * size}; }
};
constexpr PathSize kOurPath = {0.5, 0.75}, kReferencePath = {0.3, 0.6};
constexpr double kArrowRadius = 0.95, kEllipseRim = 0.16, kLineRadius = 0.45;  // [mm]
constexpr double kSamePlace = 1e-6;                                            // [mm]
constexpr int kEllipseSides = 64;
constexpr double kCrossArm = 2.6, kCrossRadius = 0.55;  // [mm]

bool tibia_moves(const Scene& scene) { return tibia_body(scene) == scene.moving_body(); }

/// One piece of a path: what may be joined.
void add_piece(ShadedMesh& mesh, const std::vector<TubePoint>& piece, const PathSize& size) {
  for (std::size_t i = 1; i < piece.size(); ++i) append(mesh, tube({piece[i - 1], piece[i]}));
  for (const TubePoint& point : piece) append(mesh, ball(point.center, size.dot, point.paint));
}

}  // namespace

std::vector<ContactMark> contact_marks(const Scene& scene, const PoseResult& pose) {
  std::vector<ContactMark> marks;
  const RigidTransform X_PB = tibia_moves(scene) ? pose.X_BA.inverse() : RigidTransform();
  for (const ContactResult& contact : pose.contacts) {
    if (!contact.closed) continue;
    for (const ContactPointResult& point : contact.points) {
      const Vector3d out_of_fixed = X_PB.R * point.normal_ground;
      marks.push_back({X_PB * (contact.layer ? contact.resultant_ground : point.point_ground),
                       tibia_moves(scene) ? Vector3d(-out_of_fixed) : out_of_fixed, point.force,
                       beyond_edge(point), point.hertz});
      if (contact.layer) marks.back().peak_pressure = contact.layer->peak_pressure;
      if (point.hertz) marks.back().hertz->major_axis = X_PB.R * point.hertz->major_axis;
    }
  }
  return marks;
}

namespace {

using PaintOf = std::function<Paint(const PoseResult&)>;

ShadedMesh paths_of(const Scene& scene,
                    const SweepResult& sweep,
                    int body,
                    const PathSize& size,
                    const PaintOf& paint) {
  ShadedMesh mesh;
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    for (const std::vector<std::size_t>& poses : contact_path(sweep, c)) {
      std::vector<TubePoint> piece;
      for (const std::size_t i : poses) {
        const PoseResult& pose = sweep.poses[i];
        const Vector3d at = *acting_place(pose.contacts[c], pose.X_BA, body == scene.moving_body());
        if (!piece.empty() && (at - piece.back().center).norm() < kSamePlace) continue;
        piece.push_back({at, size.radius, paint(pose)});
      }
      add_piece(mesh, piece, size);
    }
  }
  return mesh;
}

}  // namespace

ShadedMesh contact_paths(const Run& run, int body, const PictureScales& scales) {
  const double range = std::max(1e-12, scales.sweep_high - scales.sweep_low);
  return paths_of(run.scene, run.sweep, body, kOurPath * scales.size, [&](const PoseResult& pose) {
    return Paint{map_color(ColorMap::kFlexion, (pose.value - scales.sweep_low) / range), 0.9};
  });
}

ShadedMesh reference_paths(const Run& run, int body, const PictureScales& scales) {
  const SweepResult* reference = reference_poses(run);
  if (reference == nullptr) return {};
  return paths_of(run.scene, *reference, body, kReferencePath * scales.size, [](const PoseResult&) {
    return Paint{kReferenceColor, 0.9};
  });
}

ShadedMesh contact_points(const std::vector<ContactMark>& marks, double radius) {
  ShadedMesh mesh;
  for (const ContactMark& mark : marks)
    append(mesh, ball(mark.point, radius, {kContactColor, 0.85}));
  return mesh;
}

ShadedMesh edge_crosses(const std::vector<ContactMark>& marks,
                        const Eigen::Matrix3d& R_VP,
                        const PictureScales& scales) {
  ShadedMesh mesh;
  const Paint paint = {kAlarmColor, 1};
  const double radius = kCrossRadius * scales.size;
  const Vector3d right = R_VP.row(0), up = R_VP.row(1);
  for (const ContactMark& mark : marks) {
    if (!(mark.beyond > 0)) continue;
    for (const double side : {1.0, -1.0}) {
      const Vector3d arm = kCrossArm * scales.size * (right + side * up).normalized();
      append(mesh, tube({{mark.point - arm, radius, paint}, {mark.point + arm, radius, paint}}));
    }
  }
  return mesh;
}

ShadedMesh contact_lines(const Scene& scene, const PoseResult& pose, const PictureScales& scales) {
  ShadedMesh mesh;
  const RigidTransform X_PB = tibia_moves(scene) ? pose.X_BA.inverse() : RigidTransform();
  for (const ContactResult& contact : pose.contacts) {
    if (!contact.closed || contact.shape != ContactShape::kLine || contact.points.size() < 2)
      continue;
    std::vector<TubePoint> ends;
    for (const ContactPointResult* end : {&contact.points.front(), &contact.points.back()})
      ends.push_back({X_PB * end->point_ground, kLineRadius * scales.size, {kContactColor, 0.85}});
    if ((ends[0].center - ends[1].center).norm() > 1e-3) append(mesh, tube(ends));
  }
  return mesh;
}

namespace {

/// A disc in the plane of two semi-axes, and its rim.
void add_ellipse(ShadedMesh& mesh, const Vector3d& center, const Vector3d& a, const Vector3d& b) {
  const Eigen::Vector3f normal = a.cross(b).normalized().cast<float>();
  const auto color = bytes({kHertzColor, 1});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back({center.cast<float>(), normal, color});
  std::vector<TubePoint> rim;
  for (int i = 0; i <= kEllipseSides; ++i) {
    const double angle = 2 * M_PI * i / kEllipseSides;
    const Vector3d at = center + std::cos(angle) * a + std::sin(angle) * b;
    rim.push_back({at, kEllipseRim, {kContactColor, 1}});
    mesh.vertices.push_back({at.cast<float>(), normal, color});
    const auto here = static_cast<std::uint32_t>(i);
    if (i > 0) mesh.triangles.push_back({first, first + here, first + here + 1});
  }
  append(mesh, tube(rim));
}

}  // namespace

ShadedMesh hertz_ellipses(const std::vector<ContactMark>& marks) {
  ShadedMesh mesh;
  for (const ContactMark& mark : marks) {
    if (!mark.hertz) continue;
    const auto [major, minor] = mark.hertz->semi_axes;
    const Vector3d& axis = mark.hertz->major_axis;
    add_ellipse(mesh, mark.point, major * axis, minor * mark.toward_femur.cross(axis));
  }
  return mesh;
}

ShadedMesh force_arrows(const std::vector<ContactMark>& marks, const PictureScales& scales) {
  ShadedMesh mesh;
  for (const ContactMark& mark : marks) {
    const double length = mark.force * scales.arrow_mm_per_n;
    if (length < scales.size) continue;
    append(mesh, arrow(mark.point, mark.point + length * mark.toward_femur,
                       kArrowRadius * scales.size, {kContactColor, 0.75}));
  }
  return mesh;
}

}  // namespace condyle
