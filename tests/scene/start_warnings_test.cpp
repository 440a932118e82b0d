#include "condyle/specimen/start_warnings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/start_gap.h"

namespace condyle {
namespace {

struct StartWarnings : testing::Test {
  Scene scene = read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
  std::vector<FittedSurface> surfaces = fit_surfaces(scene);

  /// The first warning that holds the words; empty where there is none.
  [[nodiscard]] std::string warning(const std::string& words) const {
    for (const std::string& line : start_warnings(scene, surfaces))
      if (line.starts_with("warning: ") && line.find(words) != std::string::npos) return line;
    return "";
  }
};

// The exact bones overlap by 0.03 mm in both compartments; fits to rough meshes differ by 0.3 mm. Some
// bundles run straight through its bones (docs/phantom.md).
TEST_F(StartWarnings, HasNoneForThePhantomButThoseOfStrandsInBone) {
  for (const std::string& line : start_warnings(scene, surfaces))
    if (line.starts_with("warning: ")) {
      EXPECT_TRUE(line.starts_with("warning: straight through \"")) << line;
    }
  for (const ContactDescription& contact : scene.contacts)
    EXPECT_NEAR(start_gap(scene, surfaces, contact), -0.03, 0.35) << contact.name;
}

// The least gap, to better than 2 mm between samples tell, from whichever side.
TEST_F(StartWarnings, MeasuresGapsWhicheverSurfaceIsNamedFirst) {
  for (const double up : {0.0, -3.0, 2.0}) {
    scene.bodies[scene.moving_body()].start_translation = Eigen::Vector3d(0, up, 0);
    for (ContactDescription contact : scene.contacts) {
      const double gap = start_gap(scene, surfaces, contact);
      std::swap(contact.surfaces[0], contact.surfaces[1]);
      EXPECT_NEAR(start_gap(scene, surfaces, contact), gap, 1e-6) << contact.name << ", " << up;
    }
  }
}

TEST_F(StartWarnings, SeesAGapAndAnOverlap) {
  scene.bodies[scene.moving_body()].start_translation += Eigen::Vector3d(0, -4, 0);
  EXPECT_NE(warning("contact").find("gap of"), std::string::npos);
  scene.bodies[scene.moving_body()].start_translation += Eigen::Vector3d(0, 8, 0);
  EXPECT_NE(warning("contact").find("overlap of"), std::string::npos);
}

TEST_F(StartWarnings, SeesAnInsertionOffTheBone) {
  scene.ligaments[0].ends[0].at += Eigen::Vector3d(0, 0, 60);
  EXPECT_NE(warning("insertions").find("\"" + scene.ligaments[0].name + "\""), std::string::npos);
}

// Half the slack length doubles the length over it: more than 80 % of strain. The phantom's scene
// gives the strain at the start pose itself; then it is no surprise.
TEST_F(StartWarnings, SeesAStrainThatCannotBe) {
  auto& law = std::get<ToeLinearLaw>(scene.ligaments[1].law);
  law.slack_length /= 2;
  EXPECT_EQ(warning("slack length"), "");
  scene.ligaments[1].reference_strain.reset();
  EXPECT_NE(warning("slack length").find(scene.ligaments[1].name), std::string::npos);
}

// A strain of 2.7 was meant in per cent; a table ends where nobody measured.
TEST_F(StartWarnings, SeesALawThatCannotBeMeant) {
  LigamentDescription& ligament = scene.ligaments[1];
  const double length = ligament_length(scene, ligament, start_pose(scene));
  auto& law = std::get<ToeLinearLaw>(ligament.law);
  law.slack_length = length / 3.7;
  EXPECT_NE(warning("its reference strain is +270 %").find(ligament.name), std::string::npos);
  law.slack_length = 2 * length;  // slack, as somebody wrote
  EXPECT_EQ(warning("its reference strain"), "");
  law.transition_strain = 6;
  EXPECT_NE(warning("its transition strain is 600 %"), "");
  ligament.law = make_table_law({1.1 * length, 1.3 * length}, {0, 100});
  EXPECT_NE(warning("outside its table"), "");
  ligament.law = make_table_law({0.9 * length, 1.1 * length}, {0, 100});
  EXPECT_EQ(warning("outside its table"), "");
}

// Two planes have no places to look from, which says nothing about the scene.
TEST_F(StartWarnings, SaysNothingAboutSurfacesWithoutBounds) {
  for (const int s : scene.contacts[0].surfaces) {
    scene.surfaces[s].kind = SurfaceKind::kPlane;
    scene.surfaces[s].direction = Eigen::Vector3d::UnitY();
    surfaces[s] = {make_exact_surface(scene.surfaces[s]), {}};
  }
  EXPECT_EQ(warning("\"" + scene.contacts[0].name + "\""), "");
}

}  // namespace
}  // namespace condyle
