#pragma once

/// What an OpenSim 4 model file (.osim, XML) says about bones, joints, contact meshes and
/// ligaments, as plain data in mm, rad and N; names and paths of frames as they stand there. `path`
/// is where a component itself stands: "/jointset/knee_r/femur_r_offset". pugixml stays behind this
/// door.

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "condyle/math/rigid_transform.h"

namespace condyle {

/// A PhysicalOffsetFrame: fixed to another frame, by a translation and angles about its x, y and z
/// axes as turned so far.
struct OsimFrame {
  std::string name, path;
  std::string parent;       ///< the frame that it is fixed to
  RigidTransform X_parent;  ///< [mm]
};

/// One of the six axes of a CustomJoint, and how far it has gone at the default coordinates.
struct OsimAxis {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double value = 0;    ///< [rad] or [mm]
  std::string unread;  ///< what is not known and taken as 0: the kind of a function, a coordinate
};

struct OsimJoint {
  std::string type, name, path, parent, child;  ///< parent, child: frames
  std::array<OsimAxis, 3> rotations, translations;
};

struct OsimMesh {
  std::string name, path, frame, file;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of the file's numbers, to m; comes first
  RigidTransform X_frame;                           ///< location and orientation in the frame [mm]
  double modulus = 0, poisson = 0, layer = 0;       ///< [N/mm²], [-], [mm]; contact meshes only
};

/// Two contact meshes that may touch.
struct OsimContact {
  std::string name, target, casting;
  bool logarithmic = false;  ///< elastic_foundation_formulation is "nonlinear"
  bool applies = true;
};

struct OsimPathPoint {
  std::string type, path, frame;
  Eigen::Vector3d at;  ///< [mm]
};

/// A surface that paths wrap on, fixed to a frame. `sizes` [mm]: radius of a sphere or a cylinder,
/// whose axis is z; semi-axes of an ellipsoid; inner and outer radius of a torus about z, by which
/// OpenSim means those of its tube and of its ring.
struct OsimWrap {
  std::string type, name, frame;
  RigidTransform X_frame;  ///< [mm]
  Eigen::Vector3d sizes = Eigen::Vector3d::Zero();
  std::string quadrant;  ///< "all", or the half on which paths pass: "x", "-y"
  bool active = true;
};

/// Blankevoort1991Ligament.
struct OsimLigament {
  std::string name;
  bool applies = true;
  std::vector<std::string> wraps;  ///< names of wrap objects
  std::vector<OsimPathPoint> points;
  double stiffness = 0;             ///< [N] per unit strain
  double transition_strain = 0.06;  ///< the plugin's default
  double slack_length = 0;          ///< [mm]
};

struct OsimModel {
  std::string name;
  std::vector<std::string> bodies;
  std::vector<OsimFrame> frames;
  std::vector<OsimJoint> joints;
  std::vector<OsimMesh> bone_meshes;  ///< what is drawn
  std::vector<OsimMesh> contact_meshes;
  std::vector<OsimContact> contacts;
  std::vector<OsimWrap> wraps;
  std::vector<OsimLigament> ligaments;
  std::map<std::string, int> other_forces;  ///< how many of each type
};

/// Throws InputError where the file is missing, no XML, no model with frames (OpenSim 4 and its
/// development versions from 30505 on), in other units than m and N, or lacks a number.
[[nodiscard]] OsimModel read_osim(const std::filesystem::path& file);

}  // namespace condyle
