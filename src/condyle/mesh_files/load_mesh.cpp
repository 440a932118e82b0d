#include "condyle/mesh_files/load_mesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include <fmt/format.h>

#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/isolated_import.h"
#include "condyle/mesh_files/mesh_bytes.h"
#include "condyle/mesh_files/mesh_readers.h"

namespace condyle {
namespace {

constexpr double kLargest = 2000, kSmallest = 5;  // [mm], extent of a bone or a cartilage

TriangleMesh read_mesh(const std::filesystem::path& file) {
  const std::string ending = file_ending(file);
  const MeshBytes bytes(file);
  if (ending == ".stl") return read_stl(bytes);
  if (ending == ".ply") return read_ply(bytes);
  if (ending == ".obj") return read_obj(bytes);
  if (ending == ".off") return read_off(bytes);
  if (ending.empty() || !importer_knows(ending))
    bytes.fail(
        fmt::format("unsupported mesh format \"{}\", expected .stl, .ply, .obj, .off, or another "
                    "that assimp reads (.3mf, .glb, .dae, .x3d ...)",
                    ending));
  return import_isolated(file);
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

void check_numbers(const std::filesystem::path& file, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      throw InputError(
          fmt::format("{}: vertex {} is not a number (NaN or infinite)", file.string(), i));
}

void check_size(const std::filesystem::path& file, const TriangleMesh& mesh, double to_mm) {
  const double extent = box_of_triangles(mesh).sizes().maxCoeff();
  if (extent <= kLargest && extent >= kSmallest) return;
  throw InputError(fmt::format("{}: a knee of {}? expected a mesh of {} to {} mm{}", file.string(),
                               readable_length(extent), kSmallest, kLargest,
                               suspected_unit(extent / to_mm)));
}

}  // namespace

TriangleMesh load_mesh_of_any_unit(const std::filesystem::path& file) {
  TriangleMesh mesh = read_mesh(file);
  if (mesh.triangles.empty()) throw InputError(fmt::format("{}: mesh has no faces", file.string()));
  check_numbers(file, mesh);
  return mesh;
}

TriangleMesh load_mesh(const std::filesystem::path& file, double to_mm) {
  TriangleMesh mesh = load_mesh_of_any_unit(file);
  for (Eigen::Vector3d& p : mesh.vertices) p *= to_mm;
  check_size(file, mesh, to_mm);
  return mesh;
}

}  // namespace condyle
