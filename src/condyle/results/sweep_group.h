#pragma once

/// A sweep as a group of a result file, for the runs and comparisons that hold one.

#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

/// What /sweep holds, in parts that can be asked for alone.
enum class SweepPart {
  kStatus,  ///< value, status, reason, remark
  kPose,    ///< pose, joint
  kContacts,
  kLigaments,
  kConditions,
  kSolver  ///< stability, newton, by which way poses were found
};
inline constexpr int kSweepPartCount = 6;

/// The part that has a member of /sweep: "ligaments", "route". That of the solver where it is none of the others'.
[[nodiscard]] SweepPart part_with(const std::string& member);

void write_sweep_part(const Hdf5Group& sweep,
                      SweepPart part,
                      const Scene& scene,
                      const Unit& unit,
                      const std::vector<PoseResult>& poses);

/// All of /sweep but the events; its values in `unit`.
void write_sweep(const Hdf5Group& sweep,
                 const Scene& scene,
                 const Unit& unit,
                 const std::vector<PoseResult>& poses);
[[nodiscard]] std::vector<PoseResult> read_sweep(const Hdf5Group& sweep,
                                                 const Scene& scene,
                                                 const Unit& unit);

}  // namespace condyle
