#include "condyle/specimen/mesh_reader.h"

#include "condyle/mesh_files/load_mesh.h"

namespace condyle {

InputError error_of_mesh(const MeshFile& file, const std::string& what) {
  return InputError(file.named_at.empty() ? what : file.named_at + ": " + what);
}

TriangleMesh load_mesh(const MeshFile& file) {
  try {
    return load_mesh(file.path, file.to_mm);
  } catch (const InputError& error) {
    throw error_of_mesh(file, error.what());
  }
}

}  // namespace condyle
