#pragma once

/// Processor time of a pose where a study varies a knee: sweeps in one process, from the stored start
/// pose, with reference strains drawn anew for each.

#include <filesystem>

namespace condyle::strangers {

struct PoseTime {
  double median = 0, mean = 0;  ///< [us]
  int poses = 0, failed = 0;
};

/// `sweeps` sweeps of the scene from 0 to 90 degrees by 5; normal strains of that deviation are added.
[[nodiscard]] PoseTime pose_time(const std::filesystem::path& scene, double strain_sd, int sweeps);

}  // namespace condyle::strangers
