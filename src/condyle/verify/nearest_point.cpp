#include "condyle/verify/nearest_point.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace condyle::verification {

NearestPoint::NearestPoint(const std::vector<Eigen::Vector3d>& points)
    : order_(points.size()), axis_(points.size(), 0) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  build(points, 0, order_.size());
  for (const std::size_t i : order_) sorted_.push_back(points[i]);
}

void NearestPoint::build(const std::vector<Eigen::Vector3d>& points,
                         std::size_t begin,
                         std::size_t end) {
  if (end - begin < 2) return;
  Eigen::Vector3d low = points[order_[begin]], high = low;
  for (std::size_t i = begin; i < end; ++i) {
    low = low.cwiseMin(points[order_[i]]);
    high = high.cwiseMax(points[order_[i]]);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](std::size_t a, std::size_t b) { return points[a][axis] < points[b][axis]; });
  axis_[middle] = static_cast<signed char>(axis);
  build(points, begin, middle);
  build(points, middle + 1, end);
}

void NearestPoint::search(std::size_t begin,
                          std::size_t end,
                          const Eigen::Vector3d& p,
                          std::size_t& best,
                          double& square) const {
  if (begin >= end) return;
  const std::size_t middle = (begin + end) / 2;
  const Eigen::Vector3d& point = sorted_[middle];
  const double distance = (point - p).squaredNorm();
  if (distance < square) square = distance, best = middle;
  const double side = p[axis_[middle]] - point[axis_[middle]];
  if (side < 0) {
    search(begin, middle, p, best, square);
    if (side * side < square) search(middle + 1, end, p, best, square);
  } else {
    search(middle + 1, end, p, best, square);
    if (side * side < square) search(begin, middle, p, best, square);
  }
}

std::size_t NearestPoint::of(const Eigen::Vector3d& p) const {
  std::size_t best = 0;
  double square = std::numeric_limits<double>::infinity();
  search(0, order_.size(), p, best, square);
  return order_[best];
}

}  // namespace condyle::verification
