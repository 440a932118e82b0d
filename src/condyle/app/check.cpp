#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <filesystem>
#include <memory>
#include <set>

#include "condyle/app/commands.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/describe.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

struct CheckOptions {
  std::string scene;
};

Eigen::Vector3d extent(const TriangleMesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return high - low;
}

// Loading is the check: a mesh that cannot be used throws.
void check_mesh(const std::string& owner, const MeshFile& file) {
  BodyDescription body;
  body.name = owner;
  body.mesh = file;
  const TriangleMesh mesh = load_body_mesh(body);
  const Eigen::Vector3d size = extent(mesh);
  fmt::print("mesh       {}: {} triangles, {:.4g} x {:.4g} x {:.4g} mm\n",
             file.path.filename().string(), mesh.triangles.size(), size.x(), size.y(), size.z());
}

/// Of the moving body, from its numbers or its mesh; throws where a motion has no use for it.
void print_mass(const Scene& scene) {
  const MassProperties mass = moving_mass(scene);
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(mass.inertia).eigenvalues();
  constexpr double kKilogram = 1e-3;  // tonne
  fmt::print(
      "mass       {}: {:.4g} kg, centre ({:.4g}, {:.4g}, {:.4g}) mm, principal moments {:.4g}, "
      "{:.4g}, {:.4g} kg mm^2\n",
      scene.bodies[scene.moving_body()].name, mass.mass / kKilogram, mass.center.x(),
      mass.center.y(), mass.center.z(), moments.x() / kKilogram, moments.y() / kKilogram,
      moments.z() / kKilogram);
}

int run_check(const CheckOptions& options) {
  const Scene scene = read_scene(options.scene);
  fmt::print("{}", describe(scene));
  std::set<std::filesystem::path> seen;
  for (const BodyDescription& body : scene.bodies) {
    if (body.mesh && seen.insert(body.mesh->path).second) check_mesh(body.name, *body.mesh);
  }
  for (const SurfaceDescription& surface : scene.surfaces) {
    const std::optional<MeshFile>& mesh = surface.patch.mesh;
    if (mesh && seen.insert(mesh->path).second) check_mesh(surface.name, *mesh);
  }
  if (scene.simulation) print_mass(scene);
  return 0;
}

}  // namespace

void setup_check(CLI::App& program, int& status) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      program.add_subcommand("check", "Read a scene and its meshes, and say what they hold");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
  command->footer("Example: condyle check data/phantom/knee.toml");
  command->callback([options, &status] { status = run_check(*options); });
}

}  // namespace condyle
