#pragma once

/// Which of many points is nearest: a k-d tree.

#include <Eigen/Core>

#include <vector>

namespace condyle::verification {

class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<Eigen::Vector3d>& points);
  /// Index of the point nearest to p; there must be one.
  [[nodiscard]] std::size_t of(const Eigen::Vector3d& p) const;

 private:
  void build(const std::vector<Eigen::Vector3d>& points, std::size_t begin, std::size_t end);
  void search(std::size_t begin,
              std::size_t end,
              const Eigen::Vector3d& p,
              std::size_t& best,
              double& square) const;

  std::vector<Eigen::Vector3d> sorted_;
  std::vector<std::size_t> order_;  ///< the middle of a range divides it
  std::vector<signed char> axis_;   ///< along which, by place in order_
};

}  // namespace condyle::verification
