#pragma once

/// Points in space as nanoflann wants to see them, and its tree over them.

#include <Eigen/Core>

#include <nanoflann.hpp>
#include <utility>
#include <vector>

namespace condyle {

/// Keeps a reference: the points must stay as they are.
struct PointCloud {
  const std::vector<Eigen::Vector3d>& points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using PointTree = nanoflann::
    KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointCloud>, PointCloud, 3>;

/// Of the point that is nearest to p.
struct NearestPoint {
  std::size_t index = 0;
  double square = 0;  ///< of the distance [mm²]
};
[[nodiscard]] inline NearestPoint nearest_point(const PointTree& tree, const Eigen::Vector3d& p) {
  NearestPoint nearest;
  nanoflann::KNNResultSet<double> result(1);
  result.init(&nearest.index, &nearest.square);
  tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
  return nearest;
}

/// Those nearer to p than `radius`, with the squares of their distances, in no order.
inline void points_within(const PointTree& tree,
                          const Eigen::Vector3d& p,
                          double radius,
                          std::vector<std::pair<std::size_t, double>>& found) {
  nanoflann::RadiusResultSet<double, std::size_t> result(radius * radius, found);
  tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
}

}  // namespace condyle
