/// The 31 ligament strands of OpenSim-JAM's passive flexion (Lenhart 2015 knee) that run straight
/// from femur to tibia: their lengths and forces, computed by that program, at ten flexion angles.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "condyle/elements/joint_coordinates.h"
#include "condyle/elements/line_element.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Table = std::vector<std::map<std::string, std::string>>;

const std::filesystem::path kFolder = CONDYLE_SOURCE_DIR "/../shared/specimens/lenhart2015";

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, separator);) {
    if (!field.empty() && field.back() == '\r') field.pop_back();
    fields.push_back(field);
  }
  return fields;
}

/// Rows below the line of headings, which follows the line `after` where that is not empty.
Table read_table(const std::string& file, char separator, const std::string& after = "") {
  std::ifstream stream(kFolder / file);
  std::string line;
  while (!after.empty() && std::getline(stream, line) && line != after) {
  }
  std::getline(stream, line);
  const std::vector<std::string> names = split(line, separator);
  Table table;
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = split(line, separator);
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < fields.size(); ++i) row[names[i]] = fields[i];
    table.push_back(row);
  }
  return table;
}

double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::strtod(row.at(name).c_str(), nullptr);
}

struct Strand {
  std::string name;
  LineElement element;
};

std::vector<Strand> straight_strands() {
  std::vector<Strand> strands;
  for (const auto& row : read_table("lenhart2015_ligaments.csv", ',')) {
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

/// OpenSim's axes are x anterior, y proximal, z lateral on this right knee.
JointFrames opensim_frames() {
  JointFrames frames;
  frames.X_F.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  frames.X_T.R = frames.X_F.R;
  return frames;
}

std::vector<std::pair<double, RigidTransform>> flexions_and_poses() {
  std::vector<std::pair<double, RigidTransform>> poses;
  for (const auto& row : read_table("jam_passive_flexion_states.sto", '\t', "endheader")) {
    const auto state = [&row](const std::string& name) {
      return number(row, "/jointset/knee_r/knee_" + name + "_r/value");
    };
    poses.push_back(
        {state("flex"),
         {rotation_from_joint_angles(opensim_frames(), state("flex"), state("add"), state("rot")),
          1000 * Vector3d(state("tx"), state("ty"), state("tz"))}});
  }
  return poses;
}

/// The last frame of the settling for 0 degrees, else the one nearest to the angle.
RigidTransform pose_at(const std::vector<std::pair<double, RigidTransform>>& poses,
                       double degrees) {
  constexpr std::size_t kSettled = 50;
  const double wanted = degrees * std::numbers::pi / 180;
  std::size_t best = kSettled;
  for (std::size_t i = kSettled; i < poses.size(); ++i) {
    if (std::abs(poses[i].first - wanted) < std::abs(poses[best].first - wanted)) best = i;
  }
  return degrees == 0 ? poses[kSettled].second : poses[best].second;
}

TEST(JamLigaments, LengthsAndForcesAreThoseOfJamToThePrintedDigits) {
  if (!std::filesystem::exists(kFolder)) GTEST_SKIP() << "no specimen at " << kFolder;
  const std::vector<Strand> strands = straight_strands();
  ASSERT_EQ(strands.size(), 31u);
  const auto poses = flexions_and_poses();
  ASSERT_EQ(poses.size(), 251u);
  std::map<std::string, std::map<std::string, std::string>> printed;
  for (const auto& row : read_table("jam_passive_flexion_ligaments.csv", ','))
    printed[row.at("ligament")] = row;
  // The table prints 1e-6 m and 1e-4 N, so half of these, and a little for the digits of the
  // states.
  constexpr double kLengthDigits = 0.505e-3, kForceDigits = 0.505e-4;  // mm, N
  int taut = 0;
  for (const int degrees : {0, 10, 20, 30, 40, 50, 60, 70, 80, 90}) {
    const RigidTransform X = pose_at(poses, degrees);
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
