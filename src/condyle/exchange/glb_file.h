#pragma once

/// A binary glTF 2.0 file (.glb) from plain data: meshes, a tree of nodes and one animation.
/// tinygltf, which writes the file, stays behind this door. Lengths in m, times in s.

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace condyle {

struct GlbMaterial {
  std::string name;
  std::array<double, 4> color = {1, 1, 1, 1};  ///< linear red, green, blue, opacity
  double roughness = 0.6;
  bool double_sided = true;
};

struct GlbMesh {
  std::string name;
  int material = -1;
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Where a node stands in its parent.
struct GlbPlace {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
};

/// Numbers that a viewer may read: "extras" of glTF.
struct GlbNumbers {
  std::string name;
  std::vector<double> values;
};

/// From this time on a node has this scale, the same in all directions.
struct GlbStep {
  double time = 0;  ///< [s], increasing
  double scale = 1;
};

struct GlbNode {
  std::string name;
  int mesh = -1;
  std::vector<int> children;
  GlbPlace place;               ///< outside the animation
  std::vector<GlbPlace> track;  ///< empty, or one for each time
  bool moves_scale = false;     ///< the scale of the track is animated too
  std::vector<GlbStep> steps;   ///< or the node has a scale of its own
  std::vector<GlbNumbers> extras;
};

struct GlbDocument {
  std::string title;
  std::vector<GlbMaterial> materials;
  std::vector<GlbMesh> meshes;
  std::vector<GlbNode> nodes;                              ///< the first is the root
  std::string animation;                                   ///< its name
  std::vector<double> times;                               ///< of the keyframes [s], increasing
  std::vector<GlbNumbers> extras;                          ///< of the scene
  std::vector<std::pair<std::string, std::string>> words;  ///< and texts
};

/// The bytes of the file. A mesh without triangles is left out.
[[nodiscard]] std::string glb_bytes(const GlbDocument& document);

}  // namespace condyle
