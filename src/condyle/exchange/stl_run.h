#pragma once

/// Bones and articular surfaces where the poses put them, as binary STL in mm, ground frame.

#include <string>
#include <vector>

#include "condyle/exchange/export_file.h"
#include "condyle/exchange/run_shapes.h"
#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// All bones of one pose; the articular surfaces where no body has a mesh.
[[nodiscard]] std::string stl_of_pose(const Run& run,
                                      const PoseResult& pose,
                                      const std::vector<RunShape>& shapes);

/// STEM_stl/femur_bone.stl, STEM_stl/tibia_bone_0003.stl ...: what stands still is written once,
/// what moves once for each pose, numbered as in the run.
[[nodiscard]] std::vector<ExportFile> stl_of_poses(const Run& run,
                                                   const std::vector<ShownPose>& shown,
                                                   const std::vector<RunShape>& shapes,
                                                   const std::string& stem);

/// A name as it may stand in the name of a file: blanks and other signs become underscores.
[[nodiscard]] std::string file_word(const std::string& name);

}  // namespace condyle
