#pragma once

/// Wide tables of laxity tests on a robot, as Open Knee(s) and KneeHub publish them, become the tidy table
/// of measurements (calibration/measurement_table.h) in mm, deg, N and N m.
///
/// A test is a pair of files with the same beginning of the name, that of the kinematics and that of the
/// kinetics: Laxity_60deg_AP1_kinematics_in_JCS_experiment.csv, Laxity_60deg_AP1_kinetics_..csv. The
/// first column of both is "Applied Load (N|Nm)" or "Flexion Angle (deg)"; which load is applied is that
/// of the kinetics whose column is the same. A passive path needs no kinetics.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace condyle {

struct LaxityTableOptions {
  double sd_length = 0, sd_angle = 0;  ///< standard deviations [mm], [deg], > 0
  std::string specimen = "knee";
  /// State.cfg or kinematic_offsets.csv: added to the kinematics, column by column.
  std::optional<std::filesystem::path> offsets;
  double held =
      0;  ///< rows in sequence whose load differs by at most this are one step [N], [N m],
          ///< [deg]; 0: each row is one
  bool mean = false;  ///< of a step its mean, else its last row
};

struct LaxityTable {
  std::string text;                ///< CSV
  std::vector<std::string> notes;  ///< what the table does not hold: loads beside the one applied
};

/// Throws InputError with file, line and column for unknown headings, numbers that are none, a test
/// without its kinetics, and offsets that are not those of the columns.
[[nodiscard]] LaxityTable laxity_table(const std::vector<std::filesystem::path>& files,
                                       const LaxityTableOptions& options);

}  // namespace condyle
