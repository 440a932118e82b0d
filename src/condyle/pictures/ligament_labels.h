#pragma once

/// One label per ligament of a picture, and the point its leader line goes to.

#include <string>
#include <vector>

#include "condyle/pictures/scenery.h"

namespace condyle {

struct LigamentLabel {
  std::string name;
  double force = 0;        ///< of all strands [N]
  Eigen::Vector3d anchor;  ///< [mm], in P
};

/// In the order of the scene. Where a view shows one body alone the anchor is an insertion on
/// it, and ligaments whose insertions are all hidden have no label; else it is the middle of the
/// bundle's middle strand, or the place nearest to it that lies inside `page` [pixel]; a ligament
/// with nothing there has no label.
[[nodiscard]] std::vector<LigamentLabel> ligament_labels(const Scenery& scenery, const Frame& page);

}  // namespace condyle
