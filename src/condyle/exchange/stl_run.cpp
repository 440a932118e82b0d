#include "condyle/exchange/stl_run.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "condyle/control_characters.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Little-endian, as the format wants and as this machine is.
template <typename T>
void append(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void append(std::string& bytes, const Vector3d& v) {
  for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(v[k]));
}

void append_triangles(std::string& bytes, const TriangleMesh& mesh, const RigidTransform& X) {
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    const Vector3d a = X * mesh.vertices[triangle[0]], b = X * mesh.vertices[triangle[1]],
                   c = X * mesh.vertices[triangle[2]];
    append(bytes, Vector3d((b - a).cross(c - a).normalized()));
    append(bytes, a);
    append(bytes, b);
    append(bytes, c);
    append(bytes, std::uint16_t{0});
  }
}

std::string stl(const std::vector<std::pair<const TriangleMesh*, RigidTransform>>& parts) {
  std::string bytes = "condyle, mm";
  bytes.resize(80, ' ');
  std::size_t count = 0;
  for (const auto& part : parts) count += part.first->triangles.size();
  append(bytes, static_cast<std::uint32_t>(count));
  for (const auto& [mesh, X] : parts) append_triangles(bytes, *mesh, X);
  return bytes;
}

}  // namespace

std::string file_word(const std::string& name) {
  constexpr std::size_t kLongest = 100;  // bytes: names of files have at most 255
  std::size_t end = std::min(name.size(), kLongest);
  while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U)
    --end;
  std::string word = name.substr(0, end);
  for (std::size_t at = 0; at < word.size();) {
    const std::size_t size = utf8_size(word, at);
    const char c = word[at];
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    if (size <= 1 && !plain) word[at] = '_';
    at += std::max<std::size_t>(size, 1);
  }
  return word;
}

std::string stl_of_pose(const Run& run,
                        const PoseResult& pose,
                        const std::vector<RunShape>& shapes) {
  const bool bones =
      std::any_of(shapes.begin(), shapes.end(), [](const RunShape& shape) { return shape.bone; });
  std::vector<std::pair<const TriangleMesh*, RigidTransform>> parts;
  for (const RunShape& shape : shapes) {
    if (shape.bone == bones)
      parts.emplace_back(&shape.mesh, body_pose(run.scene, pose.X_BA, shape.body));
  }
  return stl(parts);
}

std::vector<ExportFile> stl_of_poses(const Run& run,
                                     const std::vector<ShownPose>& shown,
                                     const std::vector<RunShape>& shapes,
                                     const std::string& stem) {
  std::vector<ExportFile> files;
  for (const RunShape& shape : shapes) {
    const std::string name = stem + "_stl/" + file_word(shape.name);
    if (shape.body != run.scene.moving_body()) {
      files.push_back({name + ".stl", stl({{&shape.mesh, RigidTransform()}})});
      continue;
    }
    for (const ShownPose& pose : shown) {
      files.push_back({fmt::format("{}_{:04d}.stl", name, pose.index),
                       stl({{&shape.mesh, run.sweep.poses[pose.index].X_BA}})});
    }
  }
  return files;
}

}  // namespace condyle
