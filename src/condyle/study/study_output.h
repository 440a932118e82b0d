#pragma once

/// What is kept of each pose of a study.

#include <string>
#include <vector>

#include "condyle/equilibrium/pose_output.h"
#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

struct StudyOutput {
  std::string name;  ///< "anterior_drawer", "aACL.force", "medial.force", "medial.point.x"
  Unit unit;         ///< in which it is kept: mm, deg, N or 1
  PoseOutput output;
};

/// Words of `outputs`: "joint" (joint coordinates but the one that is swept), "joint.anterior_drawer";
/// "contact.force", "contact.point" (of the resultant, ground frame); "ligament.force",
/// "ligament.strain", "ligament.length": of all; "aACL.force", "medial.point": of one. None: "joint",
/// "contact.force", "ligament.force". Each once, in the order asked for. Throws InputError naming
/// `study` and the word.
[[nodiscard]] std::vector<StudyOutput> study_outputs(const Scene& scene,
                                                     const std::vector<std::string>& words,
                                                     const std::string& study);

}  // namespace condyle
