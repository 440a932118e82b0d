#include "pictures/ligament_labels.h"

#include <algorithm>

#include "pictures/ligament_groups.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

Vector3d anchor_of(const Scenery& scenery,
                   const std::vector<RigidTransform>& X_P,
                   std::size_t strand) {
  const LigamentDescription& ligament = scenery.run.scene.ligaments[strand];
  if (scenery.view == View::kPlateau) {
    const int tibia = tibia_body(scenery.run.scene);
    const Attachment& end = ligament.ends[ligament.ends[0].body == tibia ? 0 : 1];
    return X_P[static_cast<std::size_t>(end.body)] * end.at;
  }
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
  const std::vector<RigidTransform> X_P = body_poses(scenery.run.scene, scenery.pose.X_BA);
  std::vector<LigamentLabel> labels;
  for (const LigamentBundle& group : ligament_groups(scenery.run.scene)) {
    LigamentLabel label{group.name, 0, Vector3d::Zero()};
    std::vector<Vector3d> anchors;
    for (const std::size_t strand : group.members) {
      if (strand >= scenery.pose.ligaments.size()) continue;
      label.force += scenery.pose.ligaments[strand].force;
      if (scenery.view == View::kPlateau && !scenery.seen_from_above[strand]) continue;
      anchors.push_back(anchor_of(scenery, X_P, strand));
    }
    if (anchors.empty()) continue;
    label.anchor = middle_anchor(anchors);
    labels.push_back(label);
  }
  return labels;
}

}  // namespace condyle
