#pragma once

/// Vertices that are equal to the bit, found by hashing.

#include <cstddef>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Gives equal points (0 and -0 are equal) the same number, in the order of their first appearance.
class VertexIndex {
 public:
  /// Holds its points in `vertices`, which must be empty and outlive this. Numbers are int.
  VertexIndex(std::vector<Eigen::Vector3d>& vertices, std::size_t expected);

  /// The number of the point, which must be finite; it is added where it is new.
  int number_of(const Eigen::Vector3d& p);

 private:
  void grow();
  [[nodiscard]] std::size_t slot_of(const Eigen::Vector3d& p) const;

  std::vector<Eigen::Vector3d>& vertices_;
  std::vector<int> slots_;  ///< open addressing; -1: free; its size is a power of two
};

}  // namespace condyle
