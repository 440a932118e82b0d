#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/start_run.h"
#include "condyle/app/tell.h"
#include "condyle/math/decompositions.h"
#include "condyle/network/simulate.h"
#include "condyle/report/summary_json.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/describe.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/fit_wraps.h"
#include "condyle/specimen/start_warnings.h"

namespace condyle {
namespace {

struct CheckOptions {
  std::string scene, report;
};

Eigen::Vector3d extent(const TriangleMesh& mesh) {
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return high - low;
}

void print_mesh(const MeshFile& file, const TriangleMesh& mesh) {
  const Eigen::Vector3d size = extent(mesh);
  tell("mesh       {}: {} triangles, {:.4g} x {:.4g} x {:.4g} mm\n", file.path.filename().string(),
       mesh.triangles.size(), size.x(), size.y(), size.z());
}

void print_meshes(const Scene& scene, const std::vector<TriangleMesh>& bones) {
  std::set<std::filesystem::path> seen;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const std::optional<MeshFile>& file = scene.bodies[b].mesh;
    if (file && seen.insert(file->path).second) print_mesh(*file, bones[b]);
  }
  for (const SurfaceDescription& surface : scene.surfaces) {
    const std::optional<MeshFile>& file = surface.patch.mesh;
    if (!file || !seen.insert(file->path).second) continue;
    BodyDescription body;
    body.mesh = file;
    print_mesh(*file, load_body_mesh(body));
  }
}

/// Of the moving body, from its numbers or its mesh; throws where a motion has no use for it.
void print_mass(const Scene& scene) {
  const MassProperties mass = moving_mass(scene);
  const Eigen::Vector3d moments = symmetric_eigenvalues(mass.inertia).values;
  constexpr double kKilogram = 1e-3;  // tonne
  tell(
      "mass       {}: {:.4g} kg, centre ({:.4g}, {:.4g}, {:.4g}) mm, principal moments {:.4g}, "
      "{:.4g}, {:.4g} kg mm^2\n",
      scene.bodies[scene.moving_body()].name, mass.mass / kKilogram, mass.center.x(),
      mass.center.y(), mass.center.z(), moments.x() / kKilogram, moments.y() / kKilogram,
      moments.z() / kKilogram);
}

int run_check(const CheckOptions& options) {
  Scene scene = read_scene(options.scene);
#ifdef CONDYLE_PICTURES
  if (!options.report.empty()) {
    check_scene_page(options.report);
    refuse_to_overwrite_inputs(options.report, scene);
  }
#endif
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  std::vector<std::string> remarks;
  const std::vector<TriangleMesh> bones = body_meshes(scene, surfaces, &remarks);
  fit_wraps(scene, bones);
  tell("{}", describe(scene));
  print_meshes(scene, bones);
  for (const std::string& line : describe_wrap_fits(scene)) tell("{}\n", line);
  for (std::string& line : start_warnings(scene, surfaces, bones))
    remarks.push_back(std::move(line));
  std::vector<const FitReport*> reports;
  for (const FittedSurface& surface : surfaces)
    if (surface.report) reports.push_back(&*surface.report);
  for (const std::string& line : fit_warnings(reports)) tell("warning: {}\n", line);
  for (const std::string& line : remarks) tell("{}\n", line);
  if (scene.simulation) print_mass(scene);
#ifdef CONDYLE_PICTURES
  if (!options.report.empty()) {
    std::vector<std::string> warnings;
    std::copy_if(remarks.begin(), remarks.end(), std::back_inserter(warnings), is_warning);
    write_scene_page(options.report, start_run(scene, surfaces), warnings);
    tell("wrote {}\n", options.report);
  }
#endif
  return 0;
}

}  // namespace

void setup_check(CLI::App& program, int& status) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      program.add_subcommand("check", "Read a scene and its meshes, and say what they hold");
  command->add_option("SCENE", options->scene, "scene file (TOML)")->required();
#ifdef CONDYLE_PICTURES
  command->add_option("--report", options->report,
                      "picture to write (PNG): bones, frames, insertions at the start pose");
#endif
  command->footer("Example: condyle check data/phantom/knee.toml");
  command->callback([options, &status] { status = run_check(*options); });
}

}  // namespace condyle
