#pragma once

/// Does cartilage lie on its bone, as thick as cartilage is? One that is of another knee, or in another frame, lies in the bone
/// or far over it; a sweep would bring the bones together all the same.

#include <string>
#include <vector>

#include "condyle/anatomy/knee_meshes.h"
#include "condyle/anatomy/recognise_knee.h"

namespace condyle {

/// One line for each cartilage of which more than a tenth of the vertices lie deeper than 0.5 mm in its bone (0 to 2.6 % in nine
/// knees as scanned), or more than a twentieth higher over it than 0.075 of its width (6 mm of 80). `meshes` in mm; none is said
/// of a bone that does not enclose a volume.
[[nodiscard]] std::vector<std::string> cartilage_doubts(const KneeMeshes& meshes,
                                                        const RecognisedKnee& shape);

}  // namespace condyle
