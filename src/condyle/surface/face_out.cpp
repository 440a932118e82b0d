#include "condyle/surface/face_out.h"

#include <Eigen/Geometry>

#include <utility>
#include <vector>

#include "condyle/mesh/mesh_measures.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

void turn_components(CleanMesh& mesh, const std::vector<double>& outwardness) {
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    const int c = mesh.component[t];
    if (!mesh.closed[c] && outwardness[c] < 0)
      std::swap(mesh.mesh.triangles[t][1], mesh.mesh.triangles[t][2]);
  }
}

int count_inward(const CleanMesh& mesh, const std::vector<double>& outwardness) {
  int count = 0;
  for (std::size_t c = 0; c < outwardness.size(); ++c)
    count += !mesh.closed[c] && outwardness[c] < 0;
  return count;
}

}  // namespace

int face_out_of_femur(CleanMesh& mesh, const BoneFrame& frame) {
  std::vector<Eigen::AlignedBox3d> boxes(mesh.closed.size());
  for (std::size_t t = 0; t < mesh.component.size(); ++t)
    for (const int v : mesh.mesh.triangles[t])
      boxes[mesh.component[t]].extend(frame.components(mesh.mesh.vertices[v]));
  const std::vector<Vector3d> areas = triangle_areas(mesh.mesh);
  std::vector<double> outwardness(mesh.closed.size(), 0.0);
  for (std::size_t t = 0; t < areas.size(); ++t) {
    const int c = mesh.component[t];
    const Vector3d p = triangle_middle(mesh.mesh, mesh.mesh.triangles[t]);
    outwardness[c] += frame.components(areas[t]).dot(frame.components(p) - boxes[c].center());
  }
  turn_components(mesh, outwardness);
  return count_inward(mesh, outwardness);
}

/// What faces mostly one way is a sheet of the plateau, which faces up. Of what encloses most of itself that sum is only that
/// of its holes: it has its triangles face away from its middle.
int face_out_of_tibia(CleanMesh& mesh, const BoneFrame& frame) {
  constexpr double kLeastOfASheet =
      0.15;  // of the area; of a tibia cut 40 mm below its top it is 0.13 to 0.14, and both agree
  const std::vector<Vector3d> areas = triangle_areas(mesh.mesh);
  struct Sums {
    Vector3d net = Vector3d::Zero(), middle = Vector3d::Zero();
    double area = 0, volume = 0;
  };
  std::vector<Sums> sums(mesh.closed.size());
  for (std::size_t t = 0; t < areas.size(); ++t) {
    Sums& of = sums[mesh.component[t]];
    of.net += areas[t];
    of.area += areas[t].norm();
    of.middle += areas[t].norm() * triangle_middle(mesh.mesh, mesh.mesh.triangles[t]);
  }
  for (std::size_t t = 0; t < areas.size(); ++t) {
    Sums& of = sums[mesh.component[t]];
    of.volume +=
        areas[t].dot(triangle_middle(mesh.mesh, mesh.mesh.triangles[t]) - of.middle / of.area);
  }
  std::vector<double> outwardness;
  for (const Sums& of : sums)
    outwardness.push_back(of.net.norm() > kLeastOfASheet * of.area ? of.net.dot(frame.proximal)
                                                                   : of.volume);
  turn_components(mesh, outwardness);
  return count_inward(mesh, outwardness);
}

}  // namespace condyle
