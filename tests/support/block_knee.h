#pragma once

/// A knee of two blocks for tests of pictures: nothing is computed, every place is easy to name. x
/// anterior, y proximal, z to the right of the body; the tibia's block lies below y = 0, the
/// femur's above. A left knee is the mirror image of the right one.

#include "condyle/results/run_file.h"

namespace condyle {

/// Side +1: z is lateral (right knee), -1: mirrored.
inline Eigen::Vector3d mirrored(double side, double x, double y, double lateral) {
  return {x, y, side * lateral};
}

/// A box between two corners, faces outward.
inline TriangleMesh box(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline LigamentDescription strand(const std::string& name,
                                  const Eigen::Vector3d& femur,
                                  const Eigen::Vector3d& tibia) {
  LigamentDescription ligament;
  ligament.name = name;
  ligament.ends = {Attachment{0, femur}, Attachment{1, tibia}};
  ligament.law = ToeLinearLaw{1000, 0.06, 40};
  return ligament;
}

inline Scene block_scene(double side) {
  Scene scene;
  scene.title = "Blocks";
  scene.bodies.resize(2);
  scene.bodies[0].name = "femur";
  scene.bodies[0].fixed = true;
  scene.bodies[1].name = "tibia";
  AnatomicalFrame frame;
  frame.lateral = {0, 0, side};
  frame.anterior = {1, 0, 0};
  frame.proximal = {0, 1, 0};
  JointDescription joint;
  joint.side = side > 0 ? Side::kRight : Side::kLeft;
  joint.femur = joint.tibia = frame;
  joint.femur.body = 0;
  joint.tibia.body = 1;
  scene.joint = joint;
  scene.contacts.resize(2);
  scene.contacts[0].name = "medial";
  scene.contacts[1].name = "lateral";
  scene.ligaments = {strand("LCL", mirrored(side, 0, 20, 36), mirrored(side, 0, -20, 36)),
                     strand("MCL1", mirrored(side, 5, 20, -36), mirrored(side, 5, -20, -36)),
                     strand("MCL2", mirrored(side, -5, 20, -36), mirrored(side, -5, -20, -36))};
  scene.conditions.resize(1);
  scene.conditions[0].name = "flexion";
  scene.sweep = SweepDescription{false, 0, "flexion", {0.0, 0.5, 1.0}};
  return scene;
}

inline ContactResult block_contact(double x, double z, double force) {
  ContactPointResult point;
  point.force = force;
  point.point_ground = point.point_moving = {x, 0, z};
  point.normal_ground = {0, -1, 0};  // out of the femur, which is fixed
  point.relative_curvature = {0.02, 0.03};
  ContactResult contact;
  contact.closed = true;
  contact.force = force;
  contact.points = {point};
  return contact;
}

/// Three poses at 0, 0.5 and 1 rad, all with the bodies where they are modelled; LCL taut, at 2.5 %
/// strain and 5 % in the last, MCL slack.
inline Run block_run(double side = 1) {
  Run run;
  run.scene = block_scene(side);
  run.bodies = {{"femur", box(mirrored(side, -20, 2, -30), mirrored(side, 20, 40, 30))},
                {"tibia", box(mirrored(side, -20, -2, -30), mirrored(side, 20, -40, 30))}};
  for (int i = 0; i < 3; ++i) {
    PoseResult pose;
    pose.value = pose.joint.flexion = 0.5 * i;
    pose.status = PoseStatus::kConverged;
    pose.contacts = {block_contact(-4.0 * i, -15 * side, 200),
                     block_contact(-2.0 * i, 15 * side, 100)};
    pose.ligaments = {{40, i == 2 ? 0.05 : 0.025, 30}, {40, -0.05, 0}, {40, -0.05, 0}};
    pose.conditions = {{pose.value, 0}};
    run.sweep.poses.push_back(pose);
  }
  return run;
}

/// The blocks with a ball on the femur, its lowest point `height` above a plane of radius 50 on the
/// tibia, y up: surfaces 0 and 1 of the first contact [mm].
inline Run ball_over_plane(double radius, double height) {
  Run run = block_run();
  run.scene.surfaces.resize(2);
  SurfaceDescription &ball = run.scene.surfaces[0], &plane = run.scene.surfaces[1];
  ball.name = "ball";
  ball.body = 0;
  ball.kind = SurfaceKind::kSphere;
  ball.radius = radius;
  ball.point = {0, radius + height, 0};
  plane.name = "plane";
  plane.body = 1;
  plane.kind = SurfaceKind::kPlane;
  plane.direction = {0, 1, 0};
  plane.known_radius = 50;
  run.scene.contacts[0].surfaces = {0, 1};
  return run;
}

}  // namespace condyle
