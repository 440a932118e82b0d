#include "phantom/stl.h"

#include <Eigen/Geometry>

#include <bit>
#include <cstdint>

namespace condyle::phantom {

namespace {

void append(std::string& bytes, std::uint32_t word, int count = 4) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>((word >> (8 * i)) & 0xff));
}

void append(std::string& bytes, const Eigen::Vector3f& v) {
  for (int a = 0; a < 3; ++a) append(bytes, std::bit_cast<std::uint32_t>(v[a]));
}

}  // namespace

std::string binary_stl(const TriangleMesh& mesh, const std::string& title) {
  std::string bytes = title.substr(0, 80);
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]],
                          &c = mesh.vertices[t[2]];
    append(bytes, Eigen::Vector3f((b - a).cross(c - a).normalized().cast<float>()));
    for (const Eigen::Vector3d* p : {&a, &b, &c}) append(bytes, Eigen::Vector3f(p->cast<float>()));
    append(bytes, 0, 2);
  }
  return bytes;
}

}  // namespace condyle::phantom
