#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "condyle/scene_file/read_scene.h"
#include "phantom/phantom_shape.h"

namespace condyle::phantom {
namespace {

Scene phantom_scene() {
  return read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data" / "phantom" / "knee.toml");
}

TEST(PhantomScene, HoldsTheBundlesOfAKnee) {
  std::set<std::string> names;
  for (const LigamentDescription& l : phantom_scene().ligaments) names.insert(l.name);
  for (const char* name :
       {"aACL", "pACL", "aPCL", "pPCL", "LCL", "aMCL", "iMCL", "pMCL", "mCAP", "lCAP"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(PhantomScene, InsertionsLieOnThePhantomsOwnBone) {
  const Scene scene = phantom_scene();
  for (const LigamentDescription& ligament : scene.ligaments)
    for (const Attachment& end : ligament.ends) {
      const Bone bone = scene.bodies[end.body].name == "femur" ? Bone::kFemur : Bone::kTibia;
      // the file gives them to 0.01 mm on the exact surface; the mesh is within its roughness of it
      EXPECT_LT((project(bone, end.at) - end.at).norm(), 0.02) << ligament.name;
    }
}

TEST(PhantomScene, SweepsFromExtensionTo120Degrees) {
  const Scene scene = phantom_scene();
  ASSERT_TRUE(scene.sweep);
  ASSERT_EQ(scene.sweep->values.size(), 25U);
  EXPECT_NEAR(scene.sweep->values.front(), 0, 1e-12);
  EXPECT_NEAR(scene.sweep->values.back(), 120 * 3.14159265358979324 / 180, 1e-12);
}

TEST(PhantomScene, BonesAreNamedByExistingMeshes) {
  for (const BodyDescription& body : phantom_scene().bodies) {
    ASSERT_TRUE(body.mesh);
    EXPECT_TRUE(std::filesystem::exists(body.mesh->path)) << body.mesh->path;
  }
}

}  // namespace
}  // namespace condyle::phantom
