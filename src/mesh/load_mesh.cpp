#include "mesh/load_mesh.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <string>

#include <fmt/format.h>

#include "input_error.h"
#include "mesh/mesh_file_check.h"

namespace condyle {
namespace {

constexpr double kLargest = 2000, kSmallest = 5;  // [mm], extent of a bone or a cartilage

void append(TriangleMesh& mesh, const aiMesh& part, double to_mm) {
  const int offset = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    mesh.vertices.emplace_back(to_mm * double(p.x), to_mm * double(p.y), to_mm * double(p.z));
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    const bool known = face.mIndices[0] < part.mNumVertices &&
                       face.mIndices[1] < part.mNumVertices && face.mIndices[2] < part.mNumVertices;
    if (!known) throw InputError("face refers to a vertex that is not there");
    mesh.triangles.push_back({offset + static_cast<int>(face.mIndices[0]),
                              offset + static_cast<int>(face.mIndices[1]),
                              offset + static_cast<int>(face.mIndices[2])});
  }
}

TriangleMesh import(const std::filesystem::path& file, double to_mm) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (scene == nullptr) throw InputError(importer.GetErrorString());
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene->mMeshes[i], to_mm);
  return mesh;
}

/// The unit in which the numbers of the file would make a knee; empty where none would.
std::string suspected_unit(double extent_in_file) {
  struct Unit {
    const char* name;
    double to_mm;
  };
  constexpr std::array<Unit, 3> kUnits = {{{"mm", 1}, {"cm", 10}, {"m", 1000}}};
  for (const Unit& unit : kUnits) {
    const double extent = extent_in_file * unit.to_mm;
    if (extent > 20 && extent < 600)
      return fmt::format("; its numbers look like {}: check mesh_units", unit.name);
  }
  return "; check mesh_units";
}

std::string readable_length(double mm) {
  return mm > 2000 ? fmt::format("{:.4g} m", mm / 1000) : fmt::format("{:.3g} mm", mm);
}

void check_size(const std::filesystem::path& file, const TriangleMesh& mesh, double to_mm) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite())
      throw InputError(
          fmt::format("{}: vertex {} is not a number (NaN or infinite)", file.string(), i));
    box.extend(mesh.vertices[i]);
  }
  const double extent = box.sizes().maxCoeff();
  if (extent <= kLargest && extent >= kSmallest) return;
  throw InputError(fmt::format("{}: a knee of {}? expected a mesh of {} to {} mm{}", file.string(),
                               readable_length(extent), kSmallest, kLargest,
                               suspected_unit(extent / to_mm)));
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, double to_mm) {
  const MeshFileCounts promised = check_mesh_file(file);
  TriangleMesh mesh;
  try {
    mesh = import(file, to_mm);
  } catch (const std::exception& error) {
    std::string reason = error.what();
    std::replace_if(
        reason.begin(), reason.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    throw InputError(fmt::format("{}: mesh cannot be read: {}", file.string(), reason));
  }
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: mesh has no faces", file.string()));
  if (promised.faces && static_cast<long>(mesh.triangles.size()) < *promised.faces)
    throw InputError(fmt::format("{}: {} of {} faces can be read; the file is damaged",
                                 file.string(), mesh.triangles.size(), *promised.faces));
  check_size(file, mesh, to_mm);
  return mesh;
}

}  // namespace condyle
