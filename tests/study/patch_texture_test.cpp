#include "condyle/study/patch_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/study/rough_mesh.h"
#include "phantom/mesh_shape.h"
#include "phantom/roughness.h"

namespace condyle {
namespace {

/// The phantom with a texture of known strength, made by the phantom's own field.
class KnownTexture : public ::testing::Test {
 protected:
  /// Mean over four patches and two fields.
  [[nodiscard]] PatchTexture told(double rms, double correlation) const {
    PatchTexture mean;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const MeshReader read = [&](const MeshFile& file) {
        const phantom::Bone bone =
            file.path.stem() == "femur" ? phantom::Bone::kFemur : phantom::Bone::kTibia;
        TriangleMesh mesh = bone == phantom::Bone::kFemur ? femur : tibia;
        phantom::roughen(bone, {rms, correlation, seed}, mesh);
        return mesh;
      };
      add_mean(fit_surfaces(scene, {}, read), mean);
    }
    return mean;
  }

 private:
  void add_mean(const std::vector<FittedSurface>& surfaces, PatchTexture& mean) const {
    const std::vector<FittedMesh> meshes = fitted_meshes(scene, surfaces);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const FittedMesh& mesh = meshes[i % 2];  // femur, tibia, femur, tibia
      const auto over = vertices_over_patch(mesh.mesh, mesh.moved, *surfaces[i].surface, 0);
      const PatchTexture one = texture_beside(over, scene.surfaces[i].patch, *surfaces[i].report);
      mean.rms += one.rms / 8;
      mean.correlation += one.correlation / 8;
      mean.left += one.left / 8;
    }
  }

  const Scene scene = read_scene(CONDYLE_SOURCE_DIR "/data/phantom/knee.toml");
  const TriangleMesh femur = phantom::mesh_bone(phantom::Bone::kFemur, phantom::kResolution),
                     tibia = phantom::mesh_bone(phantom::Bone::kTibia, phantom::kResolution);
};

TEST_F(KnownTexture, IsToldFromWhatTheFitLeaves) {
  for (const auto& [rms, correlation] : {std::pair{0.2, 1.0}, {0.2, 1.5}, {0.4, 1.5}}) {
    const PatchTexture texture = told(rms, correlation);
    EXPECT_NEAR(texture.rms / rms, 1, 0.1) << rms << " mm, l = " << correlation;
    EXPECT_NEAR(texture.correlation / correlation, 1, 0.2) << rms << " mm, l = " << correlation;
  }
}

/// A texture as broad as the smoothing is followed by the fit: what is left is less than it.
TEST_F(KnownTexture, IsMoreThanTheFitLeavesOfABroadOne) {
  const PatchTexture texture = told(0.2, 3);
  EXPECT_LT(texture.left, 0.165);
  EXPECT_NEAR(texture.rms, 0.2, 0.03);
  EXPECT_NEAR(texture.correlation, 3, 0.6);
}

std::vector<VertexOverPatch> vertices_at(const std::vector<double>& edge_distances) {
  std::vector<VertexOverPatch> vertices;
  for (const double distance : edge_distances)
    vertices.push_back(
        {0, Eigen::Vector3d(distance, 0, 0), Eigen::Vector3d::UnitZ(), 0.1, distance});
  return vertices;
}

TEST(PatchTexture, FewVerticesTellNone) {
  EXPECT_TRUE(std::isnan(texture_beside({}, {}, {}).rms));
  EXPECT_TRUE(std::isnan(
      texture_beside(vertices_at(std::vector<double>(kFewestOfTexture - 1, 5)), {}, {}).rms));
}

TEST(PatchTexture, TheMiddleOfANarrowPatchBeginsHalfWay) {
  EXPECT_EQ(vertices_that_tell(vertices_at({1, 3.9, 4.1, 9})), 2u);
  EXPECT_EQ(vertices_that_tell(vertices_at({0.5, 0.9, 1.1, 2})), 2u);
}

}  // namespace
}  // namespace condyle
