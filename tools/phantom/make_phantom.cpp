/// condyle_phantom: writes the phantom knee's two bones as binary STL, prints how a scene of it moves on
/// the exact surfaces, or writes a population of knees with their scenes (docs/phantom.md).
///
///   condyle_phantom -o meshes
///   condyle_phantom -o DIR --resolution 1.0 --roughness 0.1 --correlation 3 --seed 7
///   condyle_phantom -o DIR --exact
///   condyle_phantom -o DIR --split 3
///   condyle_phantom --motion data/phantom/knee.toml
///   condyle_phantom --population 20 --seed 1 --exact -o DIR

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_wraps.h"
#include "phantom/exact_motion.h"
#include "phantom/mesh_shape.h"
#include "phantom/write_knee.h"

namespace {

void print_motion(const std::filesystem::path& file) {
  using namespace condyle;
  Scene scene = read_scene(file);
  const std::vector<FittedSurface> surfaces = phantom::exact_surfaces(scene);
  fit_wraps(scene, surfaces);
  const SweepResult result = sweep(scene, surfaces);
  std::fputs(phantom::motion_table(scene, result, {0, 10, 20, 30, 45, 60, 90, 120}).c_str(),
             stdout);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace condyle::phantom;
  // CLI::Range lets nan pass
  const CLI::Validator finite(
      [](std::string& text) {
        return std::isfinite(std::strtod(text.c_str(), nullptr)) ? std::string()
                                                                 : text + " is not a number";
      },
      "");
  CLI::App app{"Meshes of the phantom knee"};
  std::filesystem::path folder, scene, shipped = "data/phantom/knee.toml";
  KneeMeshes meshes{.resolution = kResolution, .roughness = {}, .split = 0};
  Roughness& roughness = meshes.roughness;
  bool exact = false;
  int knees = 0;
  CLI::Option* output = app.add_option(
      "-o,--output", folder, "folder for femur.stl and tibia.stl, made where there is none");
  app.add_option("--motion", scene, "scene to sweep on the exact surfaces, printed as a table")
      ->check(CLI::ExistingFile)
      ->excludes(output);
  app.add_option("--resolution", meshes.resolution, "grid cell [mm]")
      ->capture_default_str()
      ->check(finite)
      ->check(CLI::Range(0.2, 8.0));
  app.add_option("--roughness", roughness.rms, "rms [mm]")
      ->capture_default_str()
      ->check(finite)
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--correlation", roughness.correlation, "correlation length [mm]")
      ->capture_default_str()
      ->check(finite)
      ->check(CLI::Range(0.1, 50.0));
  app.add_option("--seed", roughness.seed, "of the roughness, of the population")
      ->capture_default_str();
  app.add_flag("--exact", exact, "no roughness");
  app.add_option("--split", meshes.split, "times that each triangle is cut into four, at the end")
      ->capture_default_str()
      ->check(CLI::Range(0, 4));
  app.add_option("--population", knees, "knees of a population, each with its scene")
      ->check(CLI::Range(1, 999))
      ->needs(output);
  app.add_option("--scene", shipped, "scene that a population's are carried from")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (!scene.empty()) {
    print_motion(scene);
    return 0;
  }
  if (folder.empty()) {
    std::fprintf(stderr, "condyle_phantom: expected -o DIR or --motion SCENE\n");
    return 1;
  }
  if (exact) roughness.rms = 0;

  try {
    std::error_code refused;
    std::filesystem::create_directories(folder, refused);
    if (refused)
      throw condyle::InputError(folder.string() + ": cannot be made: " + refused.message());
    if (knees > 0) {
      write_population(folder, condyle::read_scene(shipped), knees, roughness.seed, meshes);
      std::printf("%s: %d knees\n", folder.string().c_str(), knees);
      return 0;
    }
    for (const Bone bone : {Bone::kFemur, Bone::kTibia}) {
      const std::filesystem::path file = folder / (std::string(bone_name(bone)) + ".stl");
      const WrittenMesh written = write_bone(file, bone, meshes);
      std::printf("%s: %zu vertices, %zu triangles\n", file.string().c_str(), written.vertices,
                  written.triangles);
    }
  } catch (const condyle::InputError& error) {
    std::fprintf(stderr, "condyle_phantom: %s\n", error.what());
    return 1;
  }
  return 0;
}
