#include "pictures/ligament_labels.h"

#include <algorithm>

#include "pictures/ligament_groups.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

Vector3d anchor_of(const Scenery& scenery, std::size_t strand) {
  const LigamentDescription& ligament = scenery.run.scene.ligaments[strand];
  const std::vector<RigidTransform>& X_P = scenery.X_P;
  const auto end_in_P = [&](const Attachment& end) -> Vector3d {
    return X_P[static_cast<std::size_t>(end.body)] * end.at;
  };
  if (scenery.staging.alone()) {
    const bool first = scenery.staging.shows(scenery.run.scene, ligament.ends[0].body);
    return end_in_P(ligament.ends[first ? 0 : 1]);
  }
  if (scenery.staging.apart())
    return 0.5 * (end_in_P(ligament.ends[0]) + end_in_P(ligament.ends[1]));
  const auto line = ligament_line(scenery.run.scene, X_P, strand, scenery.pose.ligaments[strand]);
  return line.size() == 2 ? Vector3d(0.5 * (line[0] + line[1])) : line[line.size() / 2];
}

/// Of the strands the one nearest to their common middle.
Vector3d middle_anchor(const std::vector<Vector3d>& anchors) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& a : anchors) mean += a / static_cast<double>(anchors.size());
  return *std::min_element(anchors.begin(), anchors.end(),
                           [&](const Vector3d& a, const Vector3d& b) {
                             return (a - mean).squaredNorm() < (b - mean).squaredNorm();
                           });
}

}  // namespace

std::vector<LigamentLabel> ligament_labels(const Scenery& scenery) {
  std::vector<LigamentLabel> labels;
  for (const LigamentBundle& group : ligament_groups(scenery.run.scene)) {
    LigamentLabel label{group.name, 0, Vector3d::Zero()};
    std::vector<Vector3d> anchors;
    for (const std::size_t strand : group.members) {
      if (strand >= scenery.pose.ligaments.size()) continue;
      label.force += scenery.pose.ligaments[strand].force;
      if (scenery.staging.alone() && !scenery.seen[strand]) continue;
      anchors.push_back(anchor_of(scenery, strand));
    }
    if (anchors.empty()) continue;
    label.anchor = middle_anchor(anchors);
    labels.push_back(label);
  }
  return labels;
}

}  // namespace condyle
