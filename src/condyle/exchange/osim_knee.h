#pragma once

/// The knee of an OpenSim-JAM model: two bodies, their anatomical frames, contact meshes and
/// ligaments, in the frames of the bodies that carry the contact meshes.

#include <optional>
#include <string>
#include <vector>

#include "condyle/exchange/osim_model.h"
#include "condyle/exchange/osim_strands.h"
#include "condyle/scene/scene.h"

namespace condyle {

struct OsimOptions {
  std::string joint;         ///< name of the joint; empty: the one that most ligaments span
  std::optional<Side> side;  ///< where names do not tell
};

/// A mesh in the frame of its bone.
struct OsimPlacedMesh {
  OsimMesh mesh;
  RigidTransform X;  ///< of the scaled mesh in the bone's frame [mm]
};

struct OsimBody {
  std::string name;                                     ///< in the model
  Eigen::Vector3d origin, lateral, anterior, proximal;  ///< anatomical frame; [mm]
  std::optional<OsimPlacedMesh> bone;
};

/// A contact of two compartments, or of one.
struct OsimPair {
  std::optional<Compartment> compartment;
  OsimPlacedMesh femur, tibia;
  bool logarithmic = false;  ///< pressure law of their layers
};

struct OsimKnee {
  std::string joint;
  Side side = Side::kRight;
  OsimBody femur, tibia;
  RigidTransform X_FT;  ///< tibia in the femur's frame at the model's default coordinates
  std::vector<OsimPair> contacts;
  std::vector<OsimPlacedWrap> wraps;
  std::vector<OsimStrand> ligaments;
  std::vector<std::string> notes;  ///< what was left out or changed, one line each
};

/// Throws InputError, naming `file`, where there are no ligaments, no joint that they span, no
/// contact meshes, or a frame that is not there.
[[nodiscard]] OsimKnee find_knee(const OsimModel& model,
                                 const std::string& file,
                                 const OsimOptions& options = {});

}  // namespace condyle
