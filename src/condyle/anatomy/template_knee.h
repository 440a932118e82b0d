#pragma once

/// A knee whose ligaments are carried over to another one: any scene with a joint, two bodies with
/// meshes, and ligaments.

#include <filesystem>

#include "condyle/anatomy/recognise_knee.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct TemplateKnee {
  Scene scene;
  TriangleMesh femur, tibia;  ///< cleaned, frames of their bodies [mm]
  RecognisedKnee shape;       ///< frames by the rules of recognise_knee, those of the bodies
  JointCoordinates start;     ///< of the scene's start pose, in these frames
};

/// Throws InputError where the scene cannot be read or lacks what a template needs.
[[nodiscard]] TemplateKnee load_template(const std::filesystem::path& scene);

/// The meshes of surfaces that have one of their own on a body, as one; empty where there are none.
/// [mm], frame of the body.
[[nodiscard]] TriangleMesh cartilage_of(const Scene& scene, int body);

/// One mesh after the other, neither changed.
void append(TriangleMesh& mesh, const TriangleMesh& other);

/// The joint that two frames make.
[[nodiscard]] JointDescription joint_of(
    Side side, int femur, const BoneFrame& femur_frame, int tibia, const BoneFrame& tibia_frame);

}  // namespace condyle
