#include "condyle/pictures/framing.h"

#include <algorithm>

#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t kOutlinePoints = 1500;    // of each shape
constexpr double kBoneReach = 1.15, kNear = 3;  // of the radius of what touches

void append_outline(const ShadedMesh& mesh, Points& points) {
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertices.size() / kOutlinePoints);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += stride)
    points.push_back(mesh.vertices[i].position.cast<double>());
}

void append_contacts(const Run& run, int body, Points& points) {
  const bool moves = body == run.scene.moving_body();
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    for (const ContactResult& contact : pose.contacts) {
      for (const ContactPointResult& point : contact.points)
        if (contact.closed) points.push_back(moves ? point.point_moving : point.point_ground);
    }
  }
}

Points insertions_on(const Scene& scene, int body) {
  Points points;
  for (const LigamentDescription& ligament : scene.ligaments) {
    for (const Attachment& end : ligament.ends)
      if (end.body == body) points.push_back(end.at);
  }
  return points;
}

/// The ball about the middle of some points.
struct Ball {
  Vector3d middle = Vector3d::Zero();
  double radius = 0;  // [mm]
  [[nodiscard]] bool holds(const Vector3d& p, double factor) const {
    return (p - middle).norm() <= factor * radius;
  }
};

Ball ball_around(const Points& points) {
  Ball ball;
  for (const Vector3d& p : points) ball.middle += p / static_cast<double>(points.size());
  for (const Vector3d& p : points) ball.radius = std::max(ball.radius, (p - ball.middle).norm());
  return ball;
}

Points points_of_body(const Run& run, const std::vector<BodyShape>& shapes, int body) {
  Points points, bone;
  for (const BodyShape& shape : shapes) {
    if (shape.body == body) append_outline(shape.mesh, shape.surface < 0 ? bone : points);
  }
  const Points insertions = insertions_on(run.scene, body);
  const bool touches = !points.empty();
  append_contacts(run, body, points);
  if (!touches) points.insert(points.end(), insertions.begin(), insertions.end());
  if (points.empty()) return bone;
  const Ball joint = ball_around(points);
  for (const Vector3d& p : insertions)
    if (touches && joint.holds(p, kNear)) points.push_back(p);
  for (const Vector3d& p : bone)
    if (joint.holds(p, kBoneReach)) points.push_back(p);
  return points;
}

}  // namespace

std::vector<Points> joint_points(const Run& run, const std::vector<BodyShape>& shapes) {
  std::vector<Points> points;
  for (std::size_t body = 0; body < run.scene.bodies.size(); ++body)
    points.push_back(points_of_body(run, shapes, static_cast<int>(body)));
  return points;
}

double joint_radius(const std::vector<Points>& joints) {
  double radius = 0;
  for (const Points& points : joints) radius = std::max(radius, ball_around(points).radius);
  return radius;
}

}  // namespace condyle
