/// Mesh files in the formats that the program reads itself. What assimp reads is read in a process of its
/// own (mesh_files/isolated_import.h) and is no door of this one.

#include <Eigen/Core>
#include <stdexcept>

#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh_files/mesh_readers.h"
#include "fuzz/door_list.h"
#include "fuzz/refusal.h"

namespace condyle::fuzz {
namespace {

/// What readers promise of every mesh (mesh_readers.h), and what is done with it next.
void use(TriangleMesh mesh) {
  const auto n = static_cast<int>(mesh.vertices.size());
  if (n == 0 || mesh.triangles.empty()) throw std::logic_error("an empty mesh is accepted");
  for (const Eigen::Vector3d& vertex : mesh.vertices)
    if (!vertex.allFinite()) throw std::logic_error("a vertex is not finite");
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle)
      if (corner < 0 || corner >= n) throw std::logic_error("a corner is no vertex");
  const CleanMesh clean = clean_mesh(std::move(mesh));
  for (const std::string& line : describe(clean.report)) expect_one_line(line);
}

void open_mesh(Bytes bytes, const char* name, TriangleMesh (*read)(const MeshBytes&)) {
  const std::string content = text_of(bytes);
  taken([&] { use(read(MeshBytes(name, content))); });
}

}  // namespace

void open_stl(Bytes bytes) { open_mesh(bytes, "bone.stl", read_stl); }
void open_ply(Bytes bytes) { open_mesh(bytes, "bone.ply", read_ply); }
void open_obj(Bytes bytes) { open_mesh(bytes, "bone.obj", read_obj); }
void open_off(Bytes bytes) { open_mesh(bytes, "bone.off", read_off); }

}  // namespace condyle::fuzz
