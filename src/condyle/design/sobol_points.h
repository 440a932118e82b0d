#pragma once

/// Sobol's sequence with the direction numbers of [Joe 2008], from Boost.Random's engine of 64 bits,
/// shifted digitally: each coordinate's bits are exclusive-ored with random ones, which depend on the
/// seed and the coordinate. The shift keeps the one point in each elementary interval and moves the
/// first point of the sequence, which would be the origin: none is skipped, so that any 2^m first points
/// are a net.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace condyle {

class SobolPoints {
 public:
  /// 1 <= dimensions <= kMostDimensions: as many as the engine has.
  static const std::size_t kMostDimensions;
  SobolPoints(std::size_t dimensions, std::uint64_t seed);

  /// One coordinate of point k < 2^63, in the order of Gray's code: exclusive-or of as many direction
  /// numbers as Gray's code of k has ones. Threads may ask at the same time.
  [[nodiscard]] double coordinate(std::uint64_t k, std::size_t dimension) const;

 private:
  std::size_t dimensions_;
  std::vector<std::uint64_t> directions_;  ///< by bits of Gray's code, then dimensions
  std::vector<std::uint64_t> shift_;
};

}  // namespace condyle
