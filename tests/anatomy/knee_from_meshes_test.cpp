/// A scene from two meshes: the phantom's own come back as the phantom, wherever its files have it, in
/// whatever unit, and mirrored as a left knee.

#include "condyle/anatomy/knee_from_meshes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

#include "anatomy/knee_variants.h"
#include "condyle/anatomy/new_scene_text.h"
#include "condyle/exchange/ply_file.h"
#include "condyle/input_error.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/results/line_file.h"
#include "condyle/results/output_file.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"
#include "support/closed_shapes.h"
#include "support/cracked_mesh.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const fs::path kPhantom = fs::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml";
const fs::path kMeshes = fs::path(CONDYLE_SOURCE_DIR) / "meshes";

/// p -> factor (R p + shift), R maybe a reflection.
struct Map {
  Matrix3d R = Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
  double factor = 1;
  [[nodiscard]] Vector3d operator()(const Vector3d& p) const { return factor * (R * p + shift); }
  [[nodiscard]] bool mirrors() const { return R.determinant() < 0; }
};

class NewKneeOfThePhantom : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] NewKneeFiles files(const Map& map) const {
    NewKneeFiles files;
    files.femur = folder_ / "femur.ply";
    files.tibia = folder_ / "tibia.ply";
    files.template_scene = kPhantom;
    for (const char* bone : {"femur", "tibia"}) {
      TriangleMesh mesh = load_mesh(kMeshes / (std::string(bone) + ".stl"), 1);
      for (Vector3d& v : mesh.vertices) v = map(v);
      if (map.mirrors())
        for (std::array<int, 3>& t : mesh.triangles) std::swap(t[0], t[1]);
      write_output_file(folder_ / (std::string(bone) + ".ply"), ply(mesh));
    }
    return files;
  }

  /// Insertions back in the phantom's frame, the farthest from the phantom's own [mm].
  [[nodiscard]] static double farthest(const NewKnee& knee, const Map& map) {
    double worst = 0;
    for (const NewLigament& ligament : knee.ligaments)
      for (std::size_t k = 0; k < 2; ++k) {
        const Vector3d own =
            knee.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)].ends[k].at;
        worst = std::max(worst, (ligament.ends[k].at - knee.shape.to_mm * map(own)).norm());
      }
    return worst;
  }

  fs::path folder_ = test::fresh_folder("new knee");
};

TEST_F(NewKneeOfThePhantom, IsThePhantom) {
  const NewKnee knee = knee_from_meshes(files({}), {});
  EXPECT_EQ(knee.shape.to_mm, 1);
  EXPECT_EQ(knee.shape.side, Side::kRight);
  EXPECT_LT(farthest(knee, {}), 0.5);
  EXPECT_LT(knee.start.X_FT.p.norm(), 0.5);
  EXPECT_EQ(knee.start.extended, 0);
}

TEST_F(NewKneeOfThePhantom, IsTheSameFarOffTurnedAndInMetres) {
  const NewKnee here = knee_from_meshes(files({}), {});
  const Map map{Eigen::AngleAxisd(2.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix(),
                {1500, -800, 2300},
                1e-3};
  const NewKnee there = knee_from_meshes(files(map), {});
  EXPECT_EQ(there.shape.to_mm, 1000);
  EXPECT_EQ(there.shape.side, Side::kRight);
  ASSERT_EQ(there.ligaments.size(), here.ligaments.size());
  for (std::size_t l = 0; l < here.ligaments.size(); ++l)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT((there.ligaments[l].ends[k].at - 1e3 * map(here.ligaments[l].ends[k].at)).norm(),
                0.02)
          << l;
  EXPECT_NEAR(there.start.scan.flexion, here.start.scan.flexion, 1e-4);
  EXPECT_NEAR(there.start.shifted, here.start.shifted, 0.01);
}

TEST_F(NewKneeOfThePhantom, MirroredIsALeftKneeThatMovesTheSame) {
  const NewKnee right = knee_from_meshes(files({}), {});
  Map map;
  map.R(2, 2) = -1;
  const NewKnee left = knee_from_meshes(files(map), {});
  EXPECT_EQ(left.shape.side, Side::kLeft);
  for (std::size_t l = 0; l < right.ligaments.size(); ++l)
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT((left.ligaments[l].ends[k].at - map(right.ligaments[l].ends[k].at)).norm(), 0.02)
          << l;
  EXPECT_NEAR(left.start.scan.adduction, right.start.scan.adduction, 1e-4);
  EXPECT_NEAR(left.start.shifted, right.start.shifted, 0.01);
}

// A fabella, or what a segmentation left behind the condyles.
TEST_F(NewKneeOfThePhantom, IsThePhantomWithALoosePieceBehindIt) {
  NewKneeFiles with_piece = files({});
  TriangleMesh femur = load_mesh(kMeshes / "femur.stl", 1),
               piece = test::ellipsoid_solid({8, 8, 8}, 1);
  for (Vector3d& p : piece.vertices) p += Vector3d(-60, 20, 0);
  test::append(femur, piece);
  write_output_file(with_piece.femur, ply(femur));
  const NewKnee knee = knee_from_meshes(with_piece, {});
  EXPECT_LT(farthest(knee, {}), 0.5);
  EXPECT_TRUE(std::any_of(knee.doubts.begin(), knee.doubts.end(), [](const std::string& doubt) {
    return doubt.find(
               "a piece apart from the bone, 16 by 16 by 16 mm about [-60.0, 20.0, 0.0] "
               "mm") != std::string::npos;
  }));
}

TEST_F(NewKneeOfThePhantom, IsBroughtTogetherAndExtended) {
  // The tibia flexed by 20 degrees about z through the origin and 3 mm away from the femur.
  NewKneeFiles apart = files({});
  TriangleMesh tibia = load_mesh(kMeshes / "tibia.stl", 1);
  const Matrix3d flexed = Eigen::AngleAxisd(-20 * M_PI / 180, Vector3d::UnitZ()).toRotationMatrix();
  for (Vector3d& v : tibia.vertices) v = flexed * (v - Vector3d(0, 3, 0));
  write_output_file(apart.tibia, ply(tibia));
  apart.cartilage = {apart.femur,
                     apart.tibia};  // as cartilage: no offsets, the bones have to touch
  const NewKnee knee = knee_from_meshes(apart, {});
  EXPECT_NEAR(knee.start.extended * 180 / M_PI, 20, 1.5);
  EXPECT_NEAR(knee.start.shifted, 3, 0.7);
  // The tibia where the phantom has it.
  const RigidTransform back{flexed, flexed * Vector3d(0, -3, 0)};
  const RigidTransform error = knee.start.X_FT * back;
  EXPECT_LT(error.p.norm(), 1.5);
  EXPECT_LT(Eigen::AngleAxisd(error.R).angle() * 180 / M_PI, 2);
  EXPECT_FALSE(knee.doubts.empty());
}

TEST_F(NewKneeOfThePhantom, ConditionsOfTheTemplateThatAreLeftOutAreTold) {
  NewKneeFiles held = files({});
  std::string scene = bytes_of_file(held.template_scene);
  for (std::size_t at; (at = scene.find("../../meshes/")) != std::string::npos;)
    scene.replace(at, 13, kMeshes.string() + "/");
  scene.insert(scene.find("[[condition]]"),
               "[[condition]]\nname = \"adduction\"\nkind = \"adduction\"\nvalue = 0\n\n");
  held.template_scene = held.femur.parent_path() / "held.toml";
  write_output_file(held.template_scene, scene);
  const std::string line =
      "condition \"adduction\" of the template is left out: the scene prescribes flexion alone";
  const auto told = [&](const NewKneeFiles& files) {
    const NewKnee knee = knee_from_meshes(files, {});
    return std::count(knee.doubts.begin(), knee.doubts.end(), line);
  };
  EXPECT_EQ(told(held), 1);
  EXPECT_EQ(told(files({})), 0);
}

TEST_F(NewKneeOfThePhantom, NamesTheFileWhoseSeamsWereJoined) {
  Map in_cm;
  in_cm.factor = 0.1;
  const NewKneeFiles cracked = files(in_cm);
  write_output_file(cracked.tibia, ply(test::cracked(load_mesh(cracked.tibia, 1), 1, 0.002)));
  const NewKnee knee = knee_from_meshes(cracked, {});
  const auto joined = std::find_if(
      knee.doubts.begin(), knee.doubts.end(),
      [](const std::string& line) { return line.find("seam: ") != std::string::npos; });
  ASSERT_NE(joined, knee.doubts.end());
  const std::string start = cracked.tibia.string() + ": seam: along ";
  ASSERT_EQ(joined->substr(0, start.size()), start) << *joined;
  const double length = std::stod(joined->substr(start.size()));
  EXPECT_GT(length, 80) << *joined;  // around the bone, in mm whatever the unit of the file
  EXPECT_LT(length, 400) << *joined;
}

// The superficial strands of the medial ligament end 45 mm below the origin.
TEST_F(NewKneeOfThePhantom, NamesInsertionsBeyondTheEndOfATibiaThatIsCutShort) {
  const auto beyond = [](const NewKnee& knee) {
    std::string found;
    for (const std::string& line : knee.doubts)
      if (line.find("farther from the bone") != std::string::npos) found += line;
    return found;
  };
  EXPECT_EQ(beyond(knee_from_meshes(files({}), {})), "");
  NewKneeFiles cut = files({});
  const auto kept = [](const Vector3d& p) { return p.y() > -40; };
  write_output_file(cut.tibia, ply(test::part(load_mesh(kMeshes / "tibia.stl", 1), kept)));
  const NewKnee knee = knee_from_meshes(cut, {});
  const std::string line = beyond(knee);
  EXPECT_NE(line.find("3 of 26: \"aMCL\" tibia "), std::string::npos) << line;
  for (const NewLigament& ligament : knee.ligaments) {
    const std::string& name =
        knee.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)].name;
    const bool is_below = name == "aMCL" || name == "iMCL" || name == "pMCL";
    for (std::size_t end = 0; end < 2; ++end) {
      const bool missing = is_below && !ligament.on_femur[end];
      EXPECT_NEAR(ligament.ends[end].farther, missing ? 6 : 0, missing ? 3 : 2.9) << name;
    }
  }
}

TEST_F(NewKneeOfThePhantom, IsASceneThatCanBeRead) {
  const NewKnee knee = knee_from_meshes(files({}), {});
  const fs::path file = folder_ / "knee.toml";
  const std::string text = new_scene_text(knee, file);
  EXPECT_NE(text.find("mesh = \"femur.ply\""), std::string::npos);
  const Scene scene = parse_scene(text, file);
  EXPECT_EQ(scene.ligaments.size(), knee.ligaments.size());
  EXPECT_EQ(scene.loads.size(), knee.model.scene.loads.size());
  EXPECT_LT((start_pose(scene).p - knee.start.X_FT.p).norm(), 1e-9);
  for (std::size_t l = 0; l < scene.ligaments.size(); ++l)
    EXPECT_NEAR(*scene.ligaments[l].reference_strain,
                *knee.model.scene.ligaments[l].reference_strain, 1e-8);
}

// A wrap that the template fits to some of its ligaments is fitted to those here as well.
TEST_F(NewKneeOfThePhantom, KeepsWhichLigamentsLeadAWrap) {
  const std::string wrapped = read_scene(kPhantom.parent_path() / "wrapped.toml").text;
  std::string text = wrapped;
  for (std::size_t at = 0; (at = text.find("../../meshes", at)) != std::string::npos;)
    text.replace(at, 12, kMeshes.string());
  const std::size_t fit = text.find("fit = \"bone\"");
  ASSERT_NE(fit, std::string::npos);
  text.insert(fit, "ligaments = [\"iMCL\"]\n");
  write_output_file(folder_ / "template.toml", text);
  NewKneeFiles asked = files({});
  asked.template_scene = folder_ / "template.toml";
  const fs::path file = folder_ / "knee.toml";
  const std::string made = new_scene_text(knee_from_meshes(asked, {}), file);
  EXPECT_NE(made.find("fit = \"bone\"\nligaments = [\"iMCL\"]"), std::string::npos) << made;
  EXPECT_NO_THROW((void)parse_scene(made, file));
}

// Bones that were scanned 3 mm apart, as their cartilage keeps them.
TEST_F(NewKneeOfThePhantom, OfBonesAloneHasOffsetsAndCondylesThatGoOnAtTheirSides) {
  NewKneeFiles apart = files({});
  TriangleMesh tibia = load_mesh(kMeshes / "tibia.stl", 1);
  for (Vector3d& v : tibia.vertices) v.y() -= 3;
  write_output_file(apart.tibia, ply(tibia));
  const fs::path file = folder_ / "knee.toml";
  const Scene bare = parse_scene(new_scene_text(knee_from_meshes(apart, {}), file), file);
  for (const SurfaceDescription& surface : bare.surfaces) {
    EXPECT_NEAR(surface.patch.offset, 1.5, 0.3) << surface.name;
    const bool goes_on = surface.patch.region_least_cosine.value_or(1) == 0;
    EXPECT_EQ(goes_on, surface.name.ends_with("condyle")) << surface.name;
  }
  const Scene touching = parse_scene(new_scene_text(knee_from_meshes(files({}), {}), file), file);
  for (const SurfaceDescription& surface : touching.surfaces)
    EXPECT_FALSE(surface.patch.region_least_cosine) << surface.name;
}

TEST_F(NewKneeOfThePhantom, NamesWhatIsWrong) {
  const auto refused = [](const NewKneeFiles& files, const std::string& words) {
    try {
      (void)knee_from_meshes(files, {});
      FAIL() << "expected: " << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  const NewKneeFiles good = files({});
  NewKneeFiles missing = good;
  missing.tibia = folder_ / "none.stl";
  refused(missing, "none.stl");
  NewKneeFiles twice = good;
  twice.tibia = twice.femur;
  refused(twice, "femur");
  NewKneeFiles swapped = good;
  std::swap(swapped.femur, swapped.tibia);
  refused(swapped, "tibia");
  NewKneeFiles no_joint = good;
  no_joint.template_scene = fs::path(CONDYLE_SOURCE_DIR) / "data/dortmans/problem1.toml";
  refused(no_joint, "as a template, expected a scene with [joint]");
}

}  // namespace
}  // namespace condyle
