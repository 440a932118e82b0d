/// Frames of real knees against those that their scenes give, which are those of a model or an image.

#include <gtest/gtest.h>

#include <filesystem>

#include <fmt/format.h>

#include "anatomy/knee_variants.h"
#include "support/specimens.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using test::angle_between;

using test::kSpecimens;

/// Frame of the files, one for both bones: anterior, proximal, lateral.
struct Specimen {
  std::string name;
  fs::path femur, tibia;
  Eigen::Matrix3d axes;
  double to_mm = 1;
};

Eigen::Matrix3d axes_of(const Vector3d& anterior,
                        const Vector3d& proximal,
                        const Vector3d& lateral) {
  Eigen::Matrix3d m;
  m << anterior, proximal, lateral;
  return m;
}

std::vector<Specimen> specimens() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  const fs::path lenhart = kSpecimens / "lenhart2015", oai = kSpecimens / "oai_pymskt",
                 ssm = kSpecimens / "clouthier2019_ssm";
  std::vector<Specimen> all = {
      {"Lenhart", lenhart / "lenhart2015-R-femur-subchondral-bone.stl",
       lenhart / "lenhart2015-R-tibia-subchondral-bone.stl", axes_of(x, y, z), 1000},
      {"OAI", oai / "femur_bone.ply", oai / "tibia_bone.ply", axes_of(-y, z, -x)},
      {"mean", ssm / "mean_Femur.ply", ssm / "mean_Tibia_shifted.ply", axes_of(y, z, x)}};
  for (const char* name : {"S001", "S010", "S020", "S030", "S040", "S060", "S080", "S100"})
    all.push_back({name, ssm / "population" / fmt::format("{}_Femur.ply", name),
                   ssm / "population" / fmt::format("{}_Tibia.ply", name), axes_of(y, z, x)});
  return all;
}

/// In the unit of the files; a mesh of less than 5 is not read as such.
KneeMeshes read(const Specimen& s) {
  const auto mesh = [&](const fs::path& file) {
    return test::mapped(clean_mesh(load_mesh(file, s.to_mm)).mesh,
                        [&](const Vector3d& p) { return Vector3d(p / s.to_mm); });
  };
  return {mesh(s.femur), mesh(s.tibia), {}, {}};
}

BoneFrame given(const Specimen& s) {
  return {.origin = Vector3d::Zero(),
          .lateral = s.axes.col(2),
          .anterior = s.axes.col(0),
          .proximal = s.axes.col(1)};
}

void print_against(const std::string& name, const RecognisedBone& bone, const BoneFrame& f) {
  const Vector3d l = f.components(bone.frame.lateral), p = f.components(bone.frame.proximal),
                 o = f.components(bone.frame.origin);
  fmt::print(
      "  {}: lateral {:.1f} forward, {:.1f} up, proximal {:.1f} forward [deg], origin {:.1f} "
      "anterior, {:.1f} proximal, {:.1f} lateral, width {:.1f}, shaft {:.0f} mm\n",
      name, std::asin(l.x()) / kDegree, std::asin(l.y()) / kDegree, std::asin(p.x()) / kDegree,
      o.x(), o.y(), o.z(), bone.width, bone.shaft);
}

}  // namespace

TEST(RecognisedSpecimens, AreRightKneesAndTheirMirrorImagesLeftOnes) {
  if (!fs::exists(kSpecimens)) GTEST_SKIP() << "no specimens here";
  for (const Specimen& s : specimens()) {
    SCOPED_TRACE(s.name);
    const KneeMeshes meshes = read(s);
    const RecognisedKnee knee = recognise_knee(meshes);
    const RecognisedKnee mirrored = recognise_knee(
        test::mapped(meshes, [](const Vector3d& p) { return Vector3d(-p.x(), p.y(), p.z()); }));
    EXPECT_EQ(knee.to_mm, s.to_mm);
    EXPECT_EQ(knee.side, Side::kRight);
    EXPECT_EQ(mirrored.side, Side::kLeft);
    EXPECT_GT(std::min(knee.side_confidence, mirrored.side_confidence), 0.95);
    // Scanned near extension, both bones have the same lateral direction, each from its own shape.
    EXPECT_LT(angle_between(knee.femur.frame.lateral, knee.tibia.frame.lateral) / kDegree, 6);
    // No axis of a knee is far from that of its image or model.
    for (const RecognisedBone* bone : {&knee.femur, &knee.tibia})
      EXPECT_LT(test::axes_apart(bone->frame, given(s)) / kDegree, 20);
    fmt::print("{}: {:.4f}, {}\n", s.name, knee.side_confidence, knee.side_evidence);
    print_against("femur", knee.femur, given(s));
    print_against("tibia", knee.tibia, given(s));
  }
}

TEST(RecognisedSpecimens, LenhartsFramesAreThoseOfTheModel) {
  if (!fs::exists(kSpecimens / "lenhart2015")) GTEST_SKIP() << "no specimens here";
  const Specimen s = specimens()[0];
  const RecognisedKnee knee = recognise_knee(read(s));
  test::expect_frame(knee.femur.frame, given(s), 3, 4);
  test::expect_frame(knee.tibia.frame, given(s), 3, 4);
  EXPECT_EQ(knee.doubts.size(), 2u) << "sheets without shafts";
}

}  // namespace condyle
