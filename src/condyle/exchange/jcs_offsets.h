#pragma once

/// What is to be added to the columns of a robot's kinematics (jcs_heading.h), so that they are those of
/// the anatomical frames.

#include <array>
#include <filesystem>

namespace condyle {

/// Of the six joint coordinates [mm], [deg], by their senses in joint_table.h. `file` is State.cfg, with
/// "Position Offset (m,rad)" and "Channel Names 0" to 5 of [Knee JCS], or kinematic_offsets.csv. Throws
/// InputError with file, and line where there is one, for what it does not hold.
[[nodiscard]] std::array<double, 6> read_jcs_offsets(const std::filesystem::path& file);

}  // namespace condyle
