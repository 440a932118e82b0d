#include "phantom/write_knee.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <utility>

#include "condyle/input_error.h"
#include "phantom/mesh_shape.h"
#include "phantom/population.h"
#include "phantom/population_scene.h"
#include "phantom/split_triangles.h"
#include "phantom/stl.h"

namespace condyle::phantom {

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary);
  if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
    throw InputError(fmt::format("cannot write {}", file.string()));
}

std::string table_head() {
  std::string text = "knee,sex";
  for (const MeasureSpread& spread : measure_spreads())
    text += fmt::format(",{}{}", spread.name,
                        std::string(spread.unit) == "1" ? "" : fmt::format(" [{}]", spread.unit));
  return text + ",tibia.rise [mm],lateral.height [mm]\n";
}

std::string table_row(const std::string& name, const PopulationKnee& knee) {
  std::string text = fmt::format("{},{}", name, knee.woman ? "woman" : "man");
  for (const double measure : knee.measures) text += fmt::format(",{:.6g}", measure);
  const TibiaParameters& tibia = knee.parameters.tibia;
  return text + fmt::format(",{:.6g},{:.6g}\n", tibia.rise, tibia.lateral.height);
}

/// Sweeps all knees of the folder, each as it is and with other reference strains.
std::string study_text(std::uint64_t seed) {
  return fmt::format(
      "title = \"A population of phantom knees\"\n"
      "specimens = \".\"\n"
      "design = \"latin-hypercube\"\n"
      "samples = 64\n"
      "seed = {}\n"
      "outputs = [\"joint\", \"contact.force\", \"contact.point\", \"ligament.force\"]\n\n"
      "# What nobody knows of a knee beside its shape; the deviation is assumed.\n"
      "[[vary]]\n"
      "what = \"reference_strain\"\n"
      "of = \"*\"\n"
      "sd = 0.02\n",
      seed);
}

}  // namespace

WrittenMesh write_bone(const fs::path& file,
                       Bone bone,
                       const KneeMeshes& meshes,
                       const PhantomParameters& knee) {
  TriangleMesh mesh = mesh_bone(bone, meshes.resolution, knee);
  roughen(bone, meshes.roughness, mesh, knee);
  mesh = split_triangles(std::move(mesh), meshes.split);
  write(file, binary_stl(mesh, fmt::format("condyle phantom {}, right knee, mm", bone_name(bone))));
  return {mesh.vertices.size(), mesh.triangles.size()};
}

void write_population(const fs::path& folder,
                      const Scene& shipped,
                      int knees,
                      std::uint64_t seed,
                      const KneeMeshes& meshes) {
  const fs::path beyond = folder / fmt::format("P{:03}.toml", knees + 1);
  if (fs::exists(beyond))
    throw InputError(
        fmt::format("{}: is of another population, which the study would sweep as well, "
                    "expected a folder without",
                    beyond.string()));
  std::string table = table_head();
  for (int k = 1; k <= knees; ++k) {
    const std::string name = fmt::format("P{:03}", k);
    const auto number = static_cast<std::uint64_t>(k);
    const PopulationKnee knee = population_knee(seed, number);
    KneeMeshes own = meshes;
    own.roughness.seed = (seed << 32) + number;
    for (const Bone bone : {Bone::kFemur, Bone::kTibia})
      write_bone(folder / fmt::format("{}_{}.stl", name, bone_name(bone)), bone, own,
                 knee.parameters);
    write(folder / (name + ".toml"), carried_scene_text(shipped, knee.parameters, name));
    table += table_row(name, knee);
  }
  write(folder / "population.csv", table);
  write(folder / "study.toml", study_text(seed));
}

}  // namespace condyle::phantom
