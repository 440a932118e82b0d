#pragma once

/// A run that nobody computed: numbers that are easy to recognise in a file.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"

namespace condyle {

inline ContactPointResult made_up_point(double seed) {
  ContactPointResult point;
  point.force = 10 * seed;
  point.point_ground = {seed, seed + 0.1, seed + 0.2};
  point.point_moving = {-seed, -seed - 0.1, -seed - 0.2};
  point.normal_ground = {0, 1, 0};
  point.gap = 1e-11 * seed;
  point.relative_curvature = {0.01 * seed, 0.02 * seed};
  point.on_edge = seed > 2;
  return point;
}

inline PoseResult made_up_pose(double i) {
  PoseResult pose;
  pose.value = 0.1 * i;
  pose.status = PoseStatus::kConverged;
  pose.X_BA.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.X_BA.p = {i, 2 * i, 3 * i};
  pose.joint = {0.1 * i, 0.2, 0.3, 4, 5, 6};
  ContactResult contact;
  contact.closed = true;
  contact.points = {made_up_point(1 + i), made_up_point(2 + i)};
  contact.force = contact.points[0].force + contact.points[1].force;
  pose.contacts = {contact};
  pose.ligaments = {{30 + i, 0.01 * i, 7 * i}};
  pose.conditions = {{0.1 * i, -20 * i}};
  pose.stability = 1;
  pose.lowest_stiffness = 8 + i;
  pose.iterations = 3;
  pose.residual = 1e-12;
  pose.seconds = 5e-6;
  pose.trace.route = PoseRoute::kPartsDescents;
  pose.trace.origin = PoseOrigin::kNextPose;
  pose.trace.parts = 3;
  pose.trace.searches = 12;
  pose.trace.closings = 2;
  pose.trace.openings = 1;
  for (int k = 0; k < 3 + static_cast<int>(i); ++k) pose.trace.residuals.add(std::pow(0.3, 1 << k));
  return pose;
}

inline RunPatch made_up_patch() {
  RunPatch patch;
  patch.surface = "ball";
  patch.body = 0;
  patch.data.knots_u = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  patch.data.knots_v = {0, 1, 2, 3, 4, 5, 6, 7};
  patch.data.nu = 5;
  patch.data.nv = 4;
  for (int i = 0; i < 20; ++i) patch.data.control_points.emplace_back(i, 0.5 * i, -i);
  patch.data.orientation = -1;
  patch.data.mask_nu = 1;
  patch.data.mask_nv = 2;
  patch.data.mask = {1, 2, 3, 4, 5, -6};
  patch.report.surface = "ball";
  patch.report.mesh_vertices = 1234;
  patch.report.control_points = {5, 4};
  patch.report.smoothing_length = 2.5;
  patch.report.rms = 0.05;
  patch.report.p95 = 0.1;
  patch.report.max = 0.2;
  patch.report.core_rms = 0.04;
  patch.report.core_max = 0.15;
  patch.report.normal_rms = 0.02;
  patch.report.curvature_range = {-0.01, 0.06};
  patch.report.seconds = 0.3;
  patch.report.notes = {"2 strays dropped", "with \xC2\xB5"};
  return patch;
}

inline void expect_same_trace(const PoseTrace& a, const PoseTrace& b) {
  EXPECT_EQ(a.route, b.route);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.parts, b.parts);
  EXPECT_EQ(a.searches, b.searches);
  EXPECT_EQ(a.closings, b.closings);
  EXPECT_EQ(a.openings, b.openings);
  EXPECT_EQ(std::vector<double>(a.residuals.begin(), a.residuals.end()),
            std::vector<double>(b.residuals.begin(), b.residuals.end()));
}

/// Three poses: one with a single contact point, one that failed, one with two contact points.
inline Run made_up_run() {
  Run run;
  run.scene = parse_scene(kSmallScene, "some/knee.toml");
  run.sweep.poses = {made_up_pose(0), made_up_pose(1), made_up_pose(2)};
  run.sweep.poses[0].contacts[0].points.pop_back();
  run.sweep.poses[1] = PoseResult{};
  run.sweep.poses[1].value = 0.1;
  run.sweep.poses[1].status = PoseStatus::kSingular;
  run.sweep.poses[1].reason = "nothing resists turning about x";
  run.scene.sweep->values = {0, 0.1, 0.2};
  run.patches = {made_up_patch()};
  BodyMesh femur;
  femur.name = "femur";
  femur.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  femur.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  run.bodies = {femur, {"tibia", {}}};
  return run;
}

}  // namespace condyle
