#include "condyle/mesh_files/assimp_import.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

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

/// Formats with parts in other files name them as they like. Those are read that lie in the file's own folder or below,
/// links followed to where they lead; none is written.
class OwnFolder : public Assimp::DefaultIOSystem {
 public:
  explicit OwnFolder(const std::string& file)
      : folder_(std::filesystem::canonical(file).parent_path()) {}

  bool Exists(const char* file) const override {
    return own(file) && DefaultIOSystem::Exists(file);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    return reads && own(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  [[nodiscard]] bool own(const char* file) const {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(file, error);
    return !error &&
           std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first ==
               folder_.end();
  }
  std::filesystem::path folder_;
};

}  // namespace

bool assimp_knows(const std::string& ending) {
  return Assimp::Importer().IsExtensionSupported(ending);
}

ImportedMesh import_with_assimp(const std::string& file) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OwnFolder(file));  // it takes it over
  const aiScene* scene =
      importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  ImportedMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(mesh, *scene->mMeshes[i]);
  return mesh;
}

}  // namespace condyle
