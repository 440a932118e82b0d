#include "condyle/mesh_files/assimp_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <stdexcept>

namespace condyle {
namespace {

void append(ImportedMesh& mesh, const aiMesh& part) {
  const int offset = static_cast<int>(mesh.coordinates.size() / 3);
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& p = part.mVertices[i];
    mesh.coordinates.insert(mesh.coordinates.end(), {p.x, p.y, p.z});
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices)
        throw std::runtime_error("face refers to a vertex that is not there");
      mesh.corners.push_back(offset + static_cast<int>(face.mIndices[k]));
    }
  }
}

}  // namespace

bool assimp_knows(const std::string& ending) {
  return Assimp::Importer().IsExtensionSupported(ending);
}

ImportedMesh import_with_assimp(const std::string& file) {
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  ImportedMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene->mMeshes[i]);
  return mesh;
}

}  // namespace condyle
