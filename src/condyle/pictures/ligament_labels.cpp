#include "condyle/pictures/ligament_labels.h"

#include <algorithm>
#include <optional>

#include "condyle/pictures/ligament_groups.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// Where a strand is drawn: one place where a body is seen alone.
std::vector<Vector3d> line_of(const Scenery& scenery, std::size_t strand) {
  const LigamentDescription& ligament = scenery.run.scene.ligaments[strand];
  const std::vector<RigidTransform>& X_P = scenery.X_P;
  const auto end_in_P = [&](const Attachment& end) -> Vector3d {
    return X_P[static_cast<std::size_t>(end.body)] * end.at;
  };
  if (scenery.staging.alone()) {
    const bool first = scenery.staging.shows(scenery.run.scene, ligament.ends[0].body);
    return {end_in_P(ligament.ends[first ? 0 : 1])};
  }
  if (scenery.staging.apart()) return {end_in_P(ligament.ends[0]), end_in_P(ligament.ends[1])};
  return ligament_line(scenery.run.scene, X_P, strand, scenery.pose);
}

bool on_page(const Scenery& scenery, const Vector3d& p, const Frame& page) {
  const Vector3d at = scenery.camera.project(p);
  return at.x() > page.left && at.x() < page.right && at.y() > page.top && at.y() < page.bottom;
}

/// Of a line the place nearest to its middle that the page shows.
std::optional<Vector3d> shown_middle(const Scenery& scenery,
                                     const std::vector<Vector3d>& line,
                                     const Frame& page) {
  constexpr int kSteps = 24;  // even: the middle is one of the places
  for (int away = 0; away <= kSteps / 2; ++away) {
    for (const int step : {kSteps / 2 + away, kSteps / 2 - away}) {
      const double t = static_cast<double>(step) / kSteps * static_cast<double>(line.size() - 1);
      const std::size_t k = std::min(static_cast<std::size_t>(t), line.size() - 1);
      const double rest = t - static_cast<double>(k);
      const Vector3d p = line[k] + rest * (line[std::min(k + 1, line.size() - 1)] - line[k]);
      if (on_page(scenery, p, page)) return p;
    }
  }
  return std::nullopt;
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

std::vector<LigamentLabel> ligament_labels(const Scenery& scenery, const Frame& page) {
  std::vector<LigamentLabel> labels;
  for (const LigamentBundle& group : ligament_groups(scenery.run.scene)) {
    LigamentLabel label{group.name, 0, Vector3d::Zero()};
    std::vector<Vector3d> anchors;
    for (const std::size_t strand : group.members) {
      if (strand >= scenery.pose.ligaments.size()) continue;
      label.force += scenery.pose.ligaments[strand].force;
      if (scenery.staging.alone() && !scenery.seen[strand]) continue;
      if (const auto middle = shown_middle(scenery, line_of(scenery, strand), page))
        anchors.push_back(*middle);
    }
    if (anchors.empty()) continue;
    label.anchor = middle_anchor(anchors);
    labels.push_back(label);
  }
  return labels;
}

}  // namespace condyle
