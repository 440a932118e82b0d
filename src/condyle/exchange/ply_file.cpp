#include "condyle/exchange/ply_file.h"

#include <fmt/format.h>

#include <iterator>

namespace condyle {

std::string ply(const TriangleMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment mm\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  const auto out = std::back_inserter(text);
  for (const Eigen::Vector3d& v : mesh.vertices)
    fmt::format_to(out, "{} {} {}\n", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
  for (const std::array<int, 3>& t : mesh.triangles)
    fmt::format_to(out, "3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

}  // namespace condyle
