#pragma once

/// The ligaments of an OpenSim-JAM model that lead from one bone of the knee to the other, as
/// straight strands.

#include <map>
#include <string>
#include <vector>

#include "condyle/exchange/osim_frames.h"
#include "condyle/exchange/osim_model.h"

namespace condyle {

struct OsimStrand {
  std::string name;
  Eigen::Vector3d femur, tibia;                    ///< ends in the frames of the two bodies [mm]
  double stiffness = 0;                            ///< [N] per unit strain
  double transition_strain = 0, slack_length = 0;  ///< [-], [mm]
};

struct OsimStrands {
  std::vector<OsimStrand> strands;
  std::vector<std::string> notes;  ///< what was left out or changed, one line each
};

/// `in_femur` and `in_tibia` are the bodies welded to either bone, with their poses in it. What of
/// a path lies along one bone keeps its length: it is taken off, and k, ε_t and l₀ are rescaled so
/// that the force stays what it was at every pose.
[[nodiscard]] OsimStrands find_strands(const OsimModel& model,
                                       const OsimFrames& frames,
                                       const std::map<std::string, RigidTransform>& in_femur,
                                       const std::map<std::string, RigidTransform>& in_tibia);

/// The frame of a ligament's point. Throws InputError, naming the ligament, where it is not there.
[[nodiscard]] OsimPlace place_of(const OsimFrames& frames,
                                 const OsimLigament& ligament,
                                 const OsimPathPoint& point);

}  // namespace condyle
