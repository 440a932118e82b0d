/// The 31 ligament strands of OpenSim-JAM's passive flexion (Lenhart 2015 knee) that run straight
/// from femur to tibia: their lengths and forces, computed by that program, at ten flexion angles.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "condyle/elements/line_element.h"
#include "support/jam_knee.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::number;
using test::read_table;

struct Strand {
  std::string name;
  LineElement element;
};

std::vector<Strand> straight_strands() {
  std::vector<Strand> strands;
  for (const auto& row : read_table(test::kJamFolder / "lenhart2015_ligaments.csv", ',')) {
    const bool straight = row.at("via_points").empty() && row.at("wrap_objects").empty();
    if (!straight || row.at("frame1") != "femur_distal_r" || row.at("frameN") != "tibia_proximal_r")
      continue;
    const Vector3d femur(number(row, "x1_m"), number(row, "y1_m"), number(row, "z1_m"));
    const Vector3d tibia(number(row, "xN_m"), number(row, "yN_m"), number(row, "zN_m"));
    const ToeLinearLaw law{number(row, "linear_stiffness_N_per_strain"), 0.06,
                           1000 * number(row, "slack_length_m")};
    strands.push_back({row.at("name"), {1000 * femur, 1000 * tibia, law}});
  }
  return strands;
}

TEST(JamLigaments, LengthsAndForcesAreThoseOfJamToThePrintedDigits) {
  if (!std::filesystem::exists(test::kJamFolder))
    GTEST_SKIP() << "no specimen at " << test::kJamFolder;
  const std::vector<Strand> strands = straight_strands();
  ASSERT_EQ(strands.size(), 31u);
  const auto poses = test::flexions_and_poses();
  ASSERT_EQ(poses.size(), 251u);
  std::map<std::string, std::map<std::string, std::string>> printed;
  for (const auto& row : read_table(test::kJamFolder / "jam_passive_flexion_ligaments.csv", ','))
    printed[row.at("ligament")] = row;
  // The table prints 1e-6 m and 1e-4 N, so half of these, and a little for the digits of the
  // states.
  constexpr double kLengthDigits = 0.505e-3, kForceDigits = 0.505e-4;  // mm, N
  int taut = 0;
  for (const int degrees : {0, 10, 20, 30, 40, 50, 60, 70, 80, 90}) {
    const RigidTransform X = test::pose_at(poses, degrees);
    std::string at = "@";
    at += std::to_string(degrees);
    for (const Strand& strand : strands) {
      const LineElementState state = line_element_state(strand.element, X);
      const auto& row = printed.at(strand.name);
      EXPECT_NEAR(state.length, 1000 * number(row, "length_m" + at), kLengthDigits)
          << strand.name << at;
      EXPECT_NEAR(state.force, number(row, "force_spring_N" + at), kForceDigits)
          << strand.name << at;
      if (state.force > 0) ++taut;
    }
  }
  EXPECT_GT(taut, 50);
}

}  // namespace
}  // namespace condyle
