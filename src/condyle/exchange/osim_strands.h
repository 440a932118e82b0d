#pragma once

/// The ligaments of an OpenSim-JAM model that lead from one bone of the knee to the other, and the
/// surfaces on these bones that they wrap on.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "condyle/exchange/osim_frames.h"
#include "condyle/exchange/osim_model.h"

namespace condyle {

/// A surface that strands wrap on, in the frame of its bone.
struct OsimPlacedWrap {
  OsimWrap wrap;
  bool on_femur = false;
  RigidTransform X;                     ///< [mm]
  std::optional<Eigen::Vector3d> side;  ///< a point on the half that its quadrant names [mm]
};

struct OsimStrand {
  std::string name;
  Eigen::Vector3d femur, tibia;                    ///< ends in the frames of the two bodies [mm]
  double stiffness = 0;                            ///< [N] per unit strain
  double transition_strain = 0, slack_length = 0;  ///< [-], [mm]
  std::vector<std::size_t> wraps = {};  ///< indices into OsimStrands::wraps, from femur to tibia
};

struct OsimStrands {
  std::vector<OsimStrand> strands;
  std::vector<OsimPlacedWrap> wraps;
  std::vector<std::string> notes;  ///< what was left out or changed, one line each
};

/// The two bones: bodies welded to either, with their poses in it, and the start pose.
struct OsimBones {
  const std::map<std::string, RigidTransform>& in_femur;
  const std::map<std::string, RigidTransform>& in_tibia;
  RigidTransform X_FT;  ///< of the tibia in the femur [mm]
};

/// What of a path lies along one bone keeps its length: it is taken off, and k, ε_t and l₀ are
/// rescaled so that the force stays what it was at every pose. Wraps of one bone are in the order in
/// which the strand passes them at the start pose, as OpenSim goes by where they are and not by their list.
[[nodiscard]] OsimStrands find_strands(const OsimModel& model,
                                       const OsimFrames& frames,
                                       const OsimBones& bones);

/// The frame of a ligament's point. Throws InputError, naming the ligament, where it is not there.
[[nodiscard]] OsimPlace place_of(const OsimFrames& frames,
                                 const OsimLigament& ligament,
                                 const OsimPathPoint& point);

}  // namespace condyle
