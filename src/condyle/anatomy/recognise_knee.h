#pragma once

/// What two meshes of a knee say of themselves: their unit, the side, and anatomical frames by
/// published rules, from their shape alone, wherever and however the files have them.

#include <optional>
#include <string>
#include <vector>

#include "condyle/anatomy/knee_meshes.h"
#include "condyle/scene/scene.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

struct RecogniseOptions {
  std::optional<double> to_mm;  ///< of the files' unit; absent: told from the size
  std::optional<Side> side;     ///< absent: told from the shape
};

struct RecognisedBone {
  BoneFrame frame;   ///< frame of the file, in mm; `lateral` is lateral on either side
  std::string rule;  ///< how it was found, one line, with its source
  double width = 0;  ///< mediolateral, of the articular end [mm]
  double shaft = 0;  ///< length of shaft that the frame could go by [mm]; 0: none
};

struct RecognisedKnee {
  double to_mm = 1;  ///< factor from the files' unit
  Side side = Side::kRight;
  double side_confidence = 0;  ///< 0.5: as likely the other; 1: certain
  std::string side_evidence;   ///< one line: which figures speak for it
  RecognisedBone femur, tibia;
  std::vector<std::string> doubts;  ///< what a person should look at, one line each
};

/// Throws InputError, one line without the name of a file, where the meshes are no knee (two
/// femurs, a tibia upside down, a pelvis, sizes that do not fit, one condyle, different units), or
/// where it cannot tell, with the option that settles it (--units, --side).
[[nodiscard]] RecognisedKnee recognise_knee(const KneeMeshes& meshes,
                                            const RecogniseOptions& options = {});

/// "right, 99.8 % sure", or "left, as --side says; right by its shape, 99.8 % sure"
[[nodiscard]] std::string side_in_words(const RecognisedKnee& knee);

}  // namespace condyle
