#pragma once

/// Tables of the Lenhart 2015 knee and the poses of OpenSim-JAM's passive flexion.

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

namespace condyle::test {

using Table = std::vector<std::map<std::string, std::string>>;

inline const std::filesystem::path kJamFolder =
    CONDYLE_SOURCE_DIR "/../shared/specimens/lenhart2015";

inline std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, separator);) {
    if (!field.empty() && field.back() == '\r') field.pop_back();
    fields.push_back(field);
  }
  return fields;
}

/// Rows below the line of headings, which follows the line `after` where that is not empty.
inline Table read_table(const std::filesystem::path& file,
                        char separator,
                        const std::string& after = "") {
  std::ifstream stream(file);
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

inline double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::strtod(row.at(name).c_str(), nullptr);
}

/// OpenSim's axes are x anterior, y proximal, z lateral on this right knee.
inline JointFrames opensim_frames() {
  JointFrames frames;
  frames.X_F.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  frames.X_T.R = frames.X_F.R;
  return frames;
}

inline std::vector<std::pair<double, RigidTransform>> flexions_and_poses() {
  std::vector<std::pair<double, RigidTransform>> poses;
  for (const auto& row :
       read_table(kJamFolder / "jam_passive_flexion_states.sto", '\t', "endheader")) {
    const auto state = [&row](const std::string& name) {
      return number(row, "/jointset/knee_r/knee_" + name + "_r/value");
    };
    poses.push_back(
        {state("flex"),
         {rotation_from_joint_angles(opensim_frames(), state("flex"), state("add"), state("rot")),
          1000 * Eigen::Vector3d(state("tx"), state("ty"), state("tz"))}});
  }
  return poses;
}

/// The last frame of the settling for 0 degrees, else the one nearest to the angle.
inline RigidTransform pose_at(const std::vector<std::pair<double, RigidTransform>>& poses,
                              double degrees) {
  constexpr std::size_t kSettled = 50;
  const double wanted = degrees * std::numbers::pi / 180;
  std::size_t best = kSettled;
  for (std::size_t i = kSettled; i < poses.size(); ++i) {
    if (std::abs(poses[i].first - wanted) < std::abs(poses[best].first - wanted)) best = i;
  }
  return degrees == 0 ? poses[kSettled].second : poses[best].second;
}

}  // namespace condyle::test
